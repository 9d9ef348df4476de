#include "export/skybrush/skyb_comment.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <vector>

#include "export/bytes/decimal.hpp"
#include "export/skybrush/skybrush_frame.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::string_view kFirstLine = "aerogram 1", kUncertified = "UNCERTIFIED ";
constexpr double kAny = 1e6;
constexpr std::size_t kMostLines = 64;

/// In the order of the line "limits".
constexpr std::array kLimits{&Limits::min_separation_m,
                             &Limits::formation_spacing_m,
                             &Limits::downwash,
                             &Limits::export_margin_m,
                             &Limits::speed_horizontal_mps,
                             &Limits::speed_up_mps,
                             &Limits::speed_down_mps,
                             &Limits::acceleration_mps2,
                             &Limits::jerk_mps3,
                             &Limits::min_navigation_altitude_m,
                             &Limits::ceiling_m};

/// A title on one line.
std::string one_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
    return text;
}

void add(std::string& out, std::string_view word, std::string_view value) {
    out.append(word).append(" ").append(value).append("\n");
}

/// The fewest digits that are read back as the same numbers.
void add(std::string& out, std::string_view word, std::span<const double> values) {
    out.append(word);
    for (const double value : values) {
        std::array<char, 32> text{};
        const auto end = std::to_chars(text.begin(), text.end(), value).ptr;
        out.append(" ").append(text.begin(), end);
    }
    out.append("\n");
}

void add_place(std::string& out, std::string_view word, const Vec3& show_m) {
    const Vec3 p = to_skybrush(show_m);
    out.append(word);
    for (const double coordinate : {p.x, p.y, p.z}) {
        out.append(" ");
        append_fixed(out, coordinate, 3);
    }
    out.append("\n");
}

/// The lines of a comment, word by word; the first problem is kept.
class CommentReader {
  public:
    explicit CommentReader(std::string_view text) : lines_(text, '\n') {}

    Result<std::optional<SkybComment>> read() {
        std::string_view first = lines_.next().value_or("");
        comment_.show.certified = !first.starts_with(kUncertified);
        if (!comment_.show.certified) first.remove_prefix(kUncertified.size());
        if (trimmed(first) != kFirstLine) return std::optional<SkybComment>();
        for (std::size_t n = 0; n < kMostLines; ++n) {
            const auto line = lines_.next();
            if (!line) break;
            const std::size_t space = std::min(line->find(' '), line->size());
            take(line->substr(0, space), line->substr(std::min(space + 1, line->size())));
        }
        if (!problem_.empty()) return Error{ErrorCode::invalid_input, problem_};
        return std::optional(std::move(comment_));
    }

  private:
    void take(std::string_view word, std::string_view value) {
        SkybShowFacts& show = comment_.show;
        if (word == "title") show.title = value;
        if (word == "drone") comment_.drone = value;
        if (word == "show") show.show_hash = hash(value);
        if (word == "certified") show.certified = show.certified && value == "yes";
        if (word == "home") comment_.home_m = place(word, value);
        if (word == "land") comment_.land_m = place(word, value);
        if (word == "origin") show.origin = origin(value);
        if (word == "endurance") show.endurance_s = numbers(word, value, 1, 1).front();
        if (word == "limits") show.limits = limits(value);
    }

    std::string hash(std::string_view value) {
        const bool sound = value.size() == 64 && value.find_first_not_of("0123456789abcdef") == std::string_view::npos;
        if (!sound) fail("show", value, "64 lower-case hex digits");
        return std::string(value);
    }

    /// Zeros after a problem.
    std::vector<double> numbers(std::string_view word, std::string_view value, std::size_t least, std::size_t most) {
        std::vector<double> values;
        Fields fields(value, ' ');
        while (const auto field = fields.next()) {
            const auto number = parse_number(*field, kAny);
            if (!number || values.size() == most) return bad_numbers(word, value, least);
            values.push_back(*number);
        }
        return values.size() < least ? bad_numbers(word, value, least) : values;
    }
    std::vector<double> bad_numbers(std::string_view word, std::string_view value, std::size_t least) {
        fail(word, value, std::to_string(least) + " numbers");
        return std::vector<double>(least, 0.0);
    }

    Vec3 place(std::string_view word, std::string_view value) {
        const std::vector<double> p = numbers(word, value, 3, 3);
        return from_skybrush({p[0], p[1], p[2]});
    }

    geo::ShowOrigin origin(std::string_view value) {
        const std::vector<double> n = numbers("origin", value, 4, 5);
        geo::ShowOrigin origin{{n[0], n[1], n[2]}, n[3], std::nullopt};
        if (n.size() == 5) origin.geoid_undulation_m = n[4];
        const bool sound = std::abs(n[0]) <= 90.0 && std::abs(n[1]) <= 180.0 && std::abs(n[3]) <= 360.0;
        if (!sound) fail("origin", value, "latitude, longitude, height and heading");
        return origin;
    }

    Limits limits(std::string_view value) {
        const std::vector<double> n = numbers("limits", value, kLimits.size(), kLimits.size());
        Limits limits;
        for (std::size_t k = 0; k < kLimits.size(); ++k) {
            limits.*kLimits[k] = n[k];
            if (n[k] < 0.0) fail("limits", value, "numbers of at least 0");
        }
        if (limits.downwash < 1.0) fail("limits", value, "a downwash of at least 1");
        return limits;
    }

    void fail(std::string_view word, std::string_view value, const std::string& what) {
        if (problem_.empty()) problem_ = "comment: " + std::string(word) + " " + shown(value) + ": must be " + what;
    }

    Fields lines_;
    SkybComment comment_;
    std::string problem_;
};

}  // namespace

std::string skyb_comment(const SkybComment& comment) {
    const SkybShowFacts& show = comment.show;
    std::string out(show.certified ? "" : kUncertified);
    out.append(kFirstLine).append("\n");
    add(out, "title", one_line(show.title));
    add(out, "drone", one_line(comment.drone));
    if (show.show_hash) add(out, "show", *show.show_hash);
    add(out, "certified", show.certified ? "yes" : "no");
    if (comment.home_m) add_place(out, "home", *comment.home_m);
    if (comment.land_m) add_place(out, "land", *comment.land_m);
    if (show.origin) {
        const geo::Geodetic& ground = show.origin->ground;
        std::vector<double> values{ground.latitude_deg, ground.longitude_deg, ground.height_m,
                                   show.origin->heading_deg};
        if (show.origin->geoid_undulation_m) values.push_back(*show.origin->geoid_undulation_m);
        add(out, "origin", values);
    }
    if (show.limits) {
        std::vector<double> values;
        for (const auto limit : kLimits) values.push_back((*show.limits).*limit);
        add(out, "limits", values);
    }
    if (show.endurance_s) add(out, "endurance", std::array{*show.endurance_s});
    return out;
}

Result<std::optional<SkybComment>> read_skyb_comment(std::string_view text) {
    return CommentReader(text).read();
}

}  // namespace aerogram::exporter
