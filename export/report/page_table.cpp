#include <algorithm>
#include <numeric>

#include "export/report/page_blocks.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kPad = 3.0, kGutter = 16.0;
constexpr double kLargest = 7.4, kSmallest = 4.6, kUsualWord = 8.0;
constexpr std::size_t kMostLines = 4;

/// How a table is set: the size of its letters and the widths of its columns.
struct Setting {
    double size = kLargest;
    std::vector<double> widths;
    [[nodiscard]] double pitch() const { return 1.3 * size; }
};

/// The widest single word of a text.
double longest_word(const Paper& paper, std::string_view text, double size) {
    double wide = 0.0;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        wide = std::max(wide, paper.width(word, Face::bold, size));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
    }
    return wide;
}

/// What numbers need so that none is ever cut, and words for the longest that is usual (longer ones are broken); in
/// letters of size 1.
std::vector<double> needed(const Paper& paper, const Table& table) {
    constexpr double kMeasured = 10.0;
    std::vector<double> wide;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        double least = longest_word(paper, table.columns[c].title, kMeasured);
        for (const TableRow& row : table.rows)
            least = std::max(least, table.columns[c].numeric ? paper.width(row.cells[c] + "*", Face::bold, kMeasured)
                                                             : std::min(longest_word(paper, row.cells[c], kMeasured),
                                                                        kUsualWord * kMeasured));
        wide.push_back(least / kMeasured);
    }
    return wide;
}

Setting set(const Paper& paper, const Table& table, double width) {
    Setting setting;
    std::vector<double> least = needed(paper, table);
    const double pads = 2.0 * kPad * static_cast<double>(least.size());
    const double fitting = (width - pads) / std::max(std::accumulate(least.begin(), least.end(), 0.0), 1.0);
    setting.size = std::clamp(fitting, kSmallest, kLargest);
    for (double& wide : least) wide = wide * setting.size + 2.0 * kPad;
    // Shares decide; a column that would be narrower than it needs gets that, and the others share what is left.
    std::vector<bool> fixed(least.size(), false);
    setting.widths.assign(least.size(), 0.0);
    for (bool again = true; again;) {
        again = false;
        double left = width, shares = 0.0;
        for (std::size_t c = 0; c < least.size(); ++c) fixed[c] ? left -= least[c] : shares += table.columns[c].share;
        for (std::size_t c = 0; c < least.size(); ++c) {
            setting.widths[c] = fixed[c] ? least[c] : left * table.columns[c].share / shares;
            if (!fixed[c] && setting.widths[c] < least[c]) fixed[c] = again = true;
        }
    }
    return setting;
}

class TablePages {
  public:
    TablePages(PageFlow& flow, const Table& table)
        : flow_(flow),
          paper_(flow.paper()),
          table_(table),
          side_by_side_(std::max<std::size_t>(table.side_by_side, 1)) {
        const double gutters = kGutter * static_cast<double>(side_by_side_ - 1);
        width_ = (kColumn - gutters) / static_cast<double>(side_by_side_);
        setting_ = set(paper_, table, width_);
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            titles_.push_back(wrapped(paper_, table.columns[c].title, Face::bold, title_size(),
                                      setting_.widths[c] - 2.0 * kPad, kMostLines));
        std::size_t lines = 1;
        for (const auto& title : titles_) lines = std::max(lines, title.size());
        head_height_ = static_cast<double>(lines) * 1.2 * title_size() + 2.0 * kPad;
    }

    void draw() {
        caption();
        if (table_.rows.empty()) return;
        side_by_side_ == 1 ? in_one_column() : in_several();
        flow_.skip(8.0);
    }

  private:
    [[nodiscard]] double title_size() const { return 0.92 * setting_.size; }

    void caption() {
        constexpr double kSize = 8.5;
        flow_.need(head_height_ + 5.0 * setting_.pitch() + 2.0 * kSize);
        if (table_.caption.empty()) return;
        flow_.words(table_.caption, Face::bold, kSize, inks::kText);
        flow_.skip(2.0);
    }

    void head(double left, double top) {
        double x = left;
        for (std::size_t c = 0; c < titles_.size(); ++c) {
            double y =
                top + head_height_ - kPad - 1.0 - 1.2 * title_size() * static_cast<double>(titles_[c].size() - 1);
            for (const std::string& line : titles_[c]) {
                put(line, x, setting_.widths[c], y, table_.columns[c].numeric, Face::bold, title_size(), inks::kDim);
                y += 1.2 * title_size();
            }
            x += setting_.widths[c];
        }
        paper_.line({left, top + head_height_}, {left + width_, top + head_height_}, {inks::kText, 0.7, Dash::solid});
    }

    void put(const std::string& text, double x, double width, double baseline, bool right, Face face, double size,
             const Ink& ink) {
        const double from = right ? x + width - kPad - paper_.width(text, face, size) : x + kPad;
        paper_.text(text, {from, baseline}, face, size, ink);
    }

    /// A cell's lines: numbers stay whole, words wrap.
    [[nodiscard]] std::vector<std::string> lines_of(const TableRow& row, std::size_t c, std::size_t most) const {
        const bool bad = std::find(row.bad_cells.begin(), row.bad_cells.end(), c) != row.bad_cells.end();
        const std::string text = row.cells[c] + (bad ? "*" : "");
        if (table_.columns[c].numeric) return {text};
        return wrapped(paper_, text, face_of(row, c), setting_.size, setting_.widths[c] - 2.0 * kPad, most);
    }
    [[nodiscard]] static Face face_of(const TableRow& row, std::size_t c) {
        const bool bad = row.bad || std::find(row.bad_cells.begin(), row.bad_cells.end(), c) != row.bad_cells.end();
        return bad ? Face::bold : Face::regular;
    }

    /// Draws a row and returns its height.
    double draw_row(const TableRow& row, double left, double top, bool stripe, double height,
                    const std::vector<std::vector<std::string>>& cells) {
        if (row.bad || stripe)
            paper_.rectangle({left, top}, {width_, height}, row.bad ? inks::kBadGround : inks::kStripe);
        double x = left;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const Face face = face_of(row, c);
            double y = top + kPad - 1.0 + setting_.size;
            for (const std::string& line : cells[c]) {
                put(line, x, setting_.widths[c], y, table_.columns[c].numeric, face, setting_.size,
                    face == Face::bold ? inks::kBad : inks::kText);
                y += setting_.pitch();
            }
            x += setting_.widths[c];
        }
        return height;
    }

    void in_one_column() {
        head(kEdge, flow_.y());
        flow_.skip(head_height_);
        for (std::size_t r = 0; r < table_.rows.size(); ++r) {
            std::vector<std::vector<std::string>> cells;
            std::size_t lines = 1;
            for (std::size_t c = 0; c < table_.columns.size(); ++c) {
                cells.push_back(lines_of(table_.rows[r], c, kMostLines));
                lines = std::max(lines, cells.back().size());
            }
            const double height = static_cast<double>(lines) * setting_.pitch() + 2.0 * kPad - 2.0;
            if (flow_.room() < height) {
                flow_.new_page();
                head(kEdge, flow_.y());
                flow_.skip(head_height_);
            }
            flow_.skip(draw_row(table_.rows[r], kEdge, flow_.y(), r % 2 == 1, height, cells));
        }
        paper_.line({kEdge, flow_.y()}, {kPaperWidth - kEdge, flow_.y()}, {inks::kRule, 0.5, Dash::solid});
    }

    void in_several() {
        const double height = setting_.pitch() + 1.6;
        for (std::size_t next = 0; next < table_.rows.size();) {
            if (next > 0) flow_.new_page();
            const double room = flow_.room() - head_height_;
            const auto fit = static_cast<std::size_t>(std::max(1.0, room / height));
            const std::size_t left_over = table_.rows.size() - next;
            const std::size_t each = std::min(fit, (left_over + side_by_side_ - 1) / side_by_side_);
            const double top = flow_.y();
            for (std::size_t s = 0; s < side_by_side_ && next < table_.rows.size(); ++s) {
                const double left = kEdge + static_cast<double>(s) * (width_ + kGutter);
                head(left, top);
                for (std::size_t i = 0; i < each && next < table_.rows.size(); ++i, ++next)
                    single_line_row(table_.rows[next], left, top + head_height_ + static_cast<double>(i) * height,
                                    i % 2 == 1, height);
            }
            flow_.skip(head_height_ + static_cast<double>(each) * height);
        }
    }

    void single_line_row(const TableRow& row, double left, double top, bool stripe, double height) {
        std::vector<std::vector<std::string>> cells;
        for (std::size_t c = 0; c < table_.columns.size(); ++c) cells.push_back(lines_of(row, c, 1));
        draw_row(row, left, top - 1.0, stripe, height, cells);
    }

    PageFlow& flow_;
    Paper& paper_;
    const Table& table_;
    std::size_t side_by_side_;
    double width_ = 0.0, head_height_ = 0.0;
    Setting setting_;
    std::vector<std::vector<std::string>> titles_;
};

}  // namespace

void draw_table(PageFlow& flow, const Table& table) {
    TablePages(flow, table).draw();
}

void draw_facts(PageFlow& flow, const std::vector<Fact>& facts) {
    constexpr double kSize = 8.0, kName = 150.0;
    Paper& paper = flow.paper();
    flow.need(1.4 * kSize * static_cast<double>(std::min<std::size_t>(facts.size(), 12)));
    for (const Fact& fact : facts) {
        const auto lines = wrapped(paper, fact.value, Face::regular, kSize, kColumn - kName);
        flow.need(1.4 * kSize * static_cast<double>(std::min<std::size_t>(lines.size(), 10)));
        paper.text(cut(paper, fact.name, Face::regular, kSize, kName - 8.0), {kEdge, flow.y() + kSize}, Face::regular,
                   kSize, inks::kDim);
        for (const std::string& line : lines) {
            flow.need(1.4 * kSize);
            paper.text(line, {kEdge + kName, flow.y() + kSize}, Face::regular, kSize, inks::kText);
            flow.skip(1.4 * kSize);
        }
    }
    flow.skip(6.0);
}

}  // namespace aerogram::exporter
