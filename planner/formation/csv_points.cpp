#include "planner/formation/csv_points.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace aerogram::planner {
namespace {

constexpr std::string_view kAccepted = "expected the columns [Name,]x_m,y_m,z_m[,Red,Green,Blue]";

std::string_view trimmed(std::string_view text) {
    const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

/// The fields of one line; a field in double quotes may hold commas, "" inside stands for a quote.
std::vector<std::string> split(std::string_view line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"') {
            if (quoted && i + 1 < line.size() && line[i + 1] == '"') {
                fields.back() += c;
                ++i;
            } else {
                quoted = !quoted;
            }
        } else if (c == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    for (std::string& field : fields) field = std::string(trimmed(field));
    return fields;
}

std::optional<double> number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// Where each wanted value stands in a line.
enum Column : std::size_t { kX, kY, kZ, kRed, kGreen, kBlue, kColumns };

struct Header {
    std::array<std::optional<std::size_t>, kColumns> place;
    std::size_t fields = 0;
    bool colored = false;
};

class Reader {
  public:
    Reader(std::string_view text, const std::string& file) : text_(text), file_(file) {
        if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    }

    Result<CsvPoints> read() {
        std::string_view line;
        if (!next_line(line))
            return Error{ErrorCode::invalid_input, file_ + ": the file is empty; " + std::string(kAccepted)};
        if (read_header(line)) {
            while (next_line(line)) read_point(line);
            if (problems_.empty() && out_.points_m.empty()) problem("no points after the header");
        }
        if (!problems_.empty()) return Error{ErrorCode::invalid_input, problems_};
        return std::move(out_);
    }

  private:
    /// The next line that is not blank.
    bool next_line(std::string_view& line) {
        while (!text_.empty()) {
            const std::size_t end = std::min(text_.find('\n'), text_.size());
            line = trimmed(text_.substr(0, end));
            text_.remove_prefix(std::min(end + 1, text_.size()));
            ++line_;
            if (!line.empty()) return true;
        }
        return false;
    }

    void problem(const std::string& what) {
        if (!problems_.empty()) problems_ += '\n';
        problems_ += file_ + ":" + std::to_string(line_) + ": " + what;
    }

    bool read_header(std::string_view line) {
        static constexpr std::array<std::array<std::string_view, 2>, kColumns> kNames{
            {{"x_m", "x"}, {"y_m", "y"}, {"z_m", "z"}, {"Red", "red"}, {"Green", "green"}, {"Blue", "blue"}}};
        const std::vector<std::string> fields = split(line);
        header_.fields = fields.size();
        for (std::size_t f = 0; f < fields.size(); ++f) {
            const auto column = std::find_if(kNames.begin(), kNames.end(), [&](const auto& names) {
                return fields[f] == names[0] || fields[f] == names[1];
            });
            if (column == kNames.end()) {
                if (fields[f] == "Name" || fields[f] == "name") continue;
                problem("unknown column \"" + fields[f] + "\"; " + std::string(kAccepted));
                return false;
            }
            auto& place = header_.place[static_cast<std::size_t>(column - kNames.begin())];
            if (place) {
                problem("column \"" + fields[f] + "\" twice");
                return false;
            }
            place = f;
        }
        const bool positions = header_.place[kX] && header_.place[kY] && header_.place[kZ];
        header_.colored = header_.place[kRed] && header_.place[kGreen] && header_.place[kBlue];
        const bool some_color = header_.place[kRed] || header_.place[kGreen] || header_.place[kBlue];
        if (positions && header_.colored == some_color) return true;
        problem("columns missing; " + std::string(kAccepted));
        return false;
    }

    void read_point(std::string_view line) {
        const std::vector<std::string> fields = split(line);
        if (fields.size() != header_.fields) {
            problem(std::to_string(fields.size()) + " fields, expected " + std::to_string(header_.fields));
            return;
        }
        static constexpr std::array<std::string_view, kColumns> kKeys{"x_m", "y_m", "z_m", "Red", "Green", "Blue"};
        std::array<double, kColumns> values{};
        for (std::size_t c = 0; c < (header_.colored ? kColumns : kRed); ++c) {
            const std::string& field = fields[*header_.place[c]];
            const auto value = number(field);
            const bool lamp = c >= kRed;
            if (!value || (lamp && (*value < 0.0 || *value > 255.0 || std::floor(*value) != *value))) {
                problem(std::string(kKeys[c]) + " = \"" + field + "\": must be " +
                        (lamp ? "a whole number from 0 to 255" : "a number of metres"));
                return;
            }
            values[c] = *value;
        }
        out_.points_m.emplace_back(values[kX], values[kY], values[kZ]);
        if (!header_.colored) return;
        const auto lamp = [](double v) { return static_cast<std::uint8_t>(v); };
        out_.colors.push_back(from_8bit({lamp(values[kRed]), lamp(values[kGreen]), lamp(values[kBlue])}));
    }

    std::string_view text_;
    std::string file_;
    Header header_;
    CsvPoints out_;
    std::string problems_;
    std::size_t line_ = 0;
};

}  // namespace

Result<CsvPoints> parse_csv_points(std::string_view text, const std::string& file) {
    return Reader(text, file).read();
}

}  // namespace aerogram::planner
