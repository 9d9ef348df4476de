#include "export/report/page_flow.hpp"

#include <algorithm>

#include "planner/text/utf8.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kTop = 62.0, kBottom = kPaperHeight - 44.0;
constexpr double kHeadLine = 44.0, kBannerHeight = 24.0;

/// The longest beginning (at least one character) that is not wider than `width`.
std::size_t fitting(const Paper& paper, std::string_view text, Face face, double size, double width,
                    std::string_view ending = "") {
    std::vector<std::size_t> ends;
    for (std::size_t at = 0; at < text.size(); ends.push_back(at))
        at += planner::first_character(text.substr(at)).size();
    std::size_t fits = 0, too_many = ends.size() + 1;
    while (too_many - fits > 1) {
        const std::size_t middle = (fits + too_many) / 2;
        const std::string shown = std::string(text.substr(0, ends[middle - 1])) + std::string(ending);
        (paper.width(shown, face, size) <= width ? fits : too_many) = middle;
    }
    return ends.empty() ? 0 : ends[std::max<std::size_t>(fits, 1) - 1];
}

/// Takes one line from the beginning of a text.
std::string line_of(const Paper& paper, std::string_view& text, Face face, double size, double width) {
    std::string line;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, std::min(text.find(' '), text.size()));
        const std::string longer = line.empty() ? std::string(word) : line + " " + std::string(word);
        if (paper.width(longer, face, size) > width) {
            if (!line.empty()) return line;
            const std::size_t end = fitting(paper, word, face, size, width);
            line = std::string(word.substr(0, end));
            text.remove_prefix(end);
            return line;
        }
        line = longer;
        text.remove_prefix(std::min(word.size() + 1, text.size()));
    }
    return line;
}

}  // namespace

std::string cut(const Paper& paper, std::string_view text, Face face, double size, double width) {
    if (paper.width(text, face, size) <= width) return std::string(text);
    std::string shown(text.substr(0, fitting(paper, text, face, size, width, "…")));
    while (!shown.empty() && shown.back() == ' ') shown.pop_back();
    return shown + "…";
}

std::vector<std::string> wrapped(const Paper& paper, std::string_view text, Face face, double size, double width,
                                 std::size_t most) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        if (lines.size() + 1 == most) {
            lines.push_back(cut(paper, text, face, size, width));
            break;
        }
        lines.push_back(line_of(paper, text, face, size, width));
    }
    if (lines.empty()) lines.emplace_back();
    return lines;
}

PageFlow::PageFlow(Paper& paper, const PageEdges& edges) : paper_(paper), edges_(edges) {
    begin_page();
}

void PageFlow::begin_page() {
    double head = kHeadLine - 8.0;
    if (!edges_.banner.empty()) {
        paper_.rectangle({0.0, 0.0}, {kPaperWidth, kBannerHeight}, inks::kBad);
        const double wide = paper_.width(edges_.banner, Face::bold, 12.0);
        paper_.text(edges_.banner, {0.5 * (kPaperWidth - wide), 16.5}, Face::bold, 12.0, inks::kPaper);
        paper_.frame({3.0, 3.0}, {kPaperWidth - 6.0, kPaperHeight - 6.0}, {inks::kBad, 6.0, Dash::solid});
        head = kHeadLine;
    }
    const double right = paper_.width(edges_.right, Face::regular, 7.5);
    paper_.text(edges_.right, {kPaperWidth - kEdge - right, head}, Face::regular, 7.5, inks::kDim);
    paper_.text(cut(paper_, edges_.title, Face::bold, 8.5, kColumn - right - 16.0), {kEdge, head}, Face::bold, 8.5,
                inks::kText);
    paper_.line({kEdge, head + 5.0}, {kPaperWidth - kEdge, head + 5.0}, {inks::kRule, 0.6, Dash::solid});
    const double foot = kPaperHeight - 26.0;
    paper_.line({kEdge, foot - 10.0}, {kPaperWidth - kEdge, foot - 10.0}, {inks::kRule, 0.6, Dash::solid});
    const std::string number = "page " + std::to_string(page_) + " of " + std::to_string(edges_.pages);
    const double number_wide = paper_.width(number, Face::regular, 7.5);
    paper_.text(number, {kPaperWidth - kEdge - number_wide, foot}, Face::regular, 7.5, inks::kDim);
    paper_.text(cut(paper_, edges_.foot, Face::regular, 7.5, kColumn - number_wide - 16.0), {kEdge, foot},
                Face::regular, 7.5, inks::kDim);
    y_ = kTop;
}

double PageFlow::room() const {
    return kBottom - y_;
}
double PageFlow::whole_room() const {
    return kBottom - kTop;
}
bool PageFlow::at_top() const {
    return y_ <= kTop;
}

void PageFlow::new_page() {
    paper_.turn_page();
    ++page_;
    begin_page();
}

void PageFlow::need(double height) {
    if (room() < height && !at_top()) new_page();
}

void PageFlow::words(std::string_view text, Face face, double size, const Ink& ink, double indent) {
    const double pitch = 1.38 * size;
    for (const std::string& line : wrapped(paper_, text, face, size, kColumn - indent)) {
        need(pitch);
        paper_.text(line, {kEdge + indent, y_ + size}, face, size, ink);
        y_ += pitch;
    }
}

Result<std::string> drawn_pages(const std::string& title, PageEdges edges, const std::function<void(PageFlow&)>& draw) {
    Result<std::string> pdf = std::string();
    for (int pass = 0; pass < 2; ++pass) {
        auto paper = Paper::blank(title);
        if (!paper) return paper.error();
        PageFlow flow(*paper, edges);
        draw(flow);
        edges.pages = flow.page();
        paper->turn_page();
        pdf = paper->finished();
        if (!pdf) return pdf;
    }
    return pdf;
}

}  // namespace aerogram::exporter
