#include "export/report/report_words.hpp"

#include <algorithm>
#include <cmath>

#include "export/bytes/decimal.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kLargestShown = 1e9;

/// Digits of the absolute value.
std::string magnitude(double value, int digits) {
    std::string text;
    append_fixed(text, std::abs(value), digits);
    return text;
}

bool is_zero(const std::string& magnitude_text) {
    return magnitude_text.find_first_not_of("0.") == std::string::npos;
}

}  // namespace

std::string fixed_text(double value, int digits) {
    if (!std::isfinite(value) || std::abs(value) > kLargestShown) return kAbsent;
    const std::string text = magnitude(value, digits);
    return value < 0.0 && !is_zero(text) ? "−" + text : text;
}

std::string signed_text(double value, int digits) {
    const std::string text = fixed_text(value, digits);
    return value > 0.0 && text != kAbsent && !is_zero(text) ? "+" + text : text;
}

std::string count_text(std::size_t count) {
    std::string text = std::to_string(count);
    for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
    return text;
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return count_text(count) + " " + (count == 1 ? one : many);
}

std::string clock_text(double time_s, int digits) {
    if (!std::isfinite(time_s) || std::abs(time_s) > kLargestShown) return kAbsent;
    const std::int64_t unit = digits == 0 ? 1 : digits == 1 ? 10 : digits == 2 ? 100 : 1000;
    const std::int64_t whole = std::llround(std::abs(time_s) * static_cast<double>(unit));
    const std::int64_t minutes = whole / (60 * unit), rest = whole % (60 * unit);
    std::string seconds;
    append_units(seconds, rest, digits);
    if (rest < 10 * unit) seconds.insert(0, "0");
    return (time_s < 0.0 && whole != 0 ? "−" : "") + std::to_string(minutes) + ":" + seconds;
}

std::string percent_text(double share, int digits) {
    const std::string text = fixed_text(100.0 * share, digits);
    return text == kAbsent ? text : text + " %";
}

std::string place_text(const Vec3& p) {
    return fixed_text(p.x, 1) + ", " + fixed_text(p.y, 1) + ", " + fixed_text(p.z, 1);
}

std::string drones_text(std::span<const std::size_t> numbers, std::size_t most) {
    if (numbers.empty()) return kAbsent;
    const std::size_t shown = numbers.size() <= most + 1 ? numbers.size() : most;
    const std::size_t more = numbers.size() - shown;
    std::string text;
    for (std::size_t i = 0; i < shown; ++i) {
        const bool last = i + 1 == shown && more == 0;
        text += (i == 0 ? "" : last ? " and " : ", ") + std::to_string(numbers[i]);
    }
    return more == 0 ? text : text + " and " + count_text(more) + " more";
}

std::string ranges_text(std::span<const std::size_t> numbers, std::size_t most) {
    std::string text;
    std::size_t ranges = 0;
    for (std::size_t i = 0; i < numbers.size(); ++ranges) {
        if (ranges == most) return text + " … (" + count_text(numbers.size()) + ")";
        std::size_t end = i + 1;
        while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
        text += (ranges == 0 ? "" : ", ") + std::to_string(numbers[i]);
        if (end > i + 1) text += (end == i + 2 ? ", " : "–") + std::to_string(numbers[end - 1]);
        i = end;
    }
    return text.empty() ? kAbsent : text;
}

std::string origin_text(const geo::ShowOrigin& origin) {
    const auto degrees = [](double value, const char* positive, const char* negative) {
        return fixed_text(std::abs(value), 7) + "° " + (value < 0.0 ? negative : positive);
    };
    return degrees(origin.ground.latitude_deg, "N", "S") + ", " + degrees(origin.ground.longitude_deg, "E", "W");
}

std::string grouped_hash(const std::string& hash, std::size_t begin, std::size_t end) {
    std::string text;
    for (std::size_t i = begin; i < std::min(end, hash.size()); ++i) {
        if (i != begin && (i - begin) % 4 == 0) text += ' ';
        text += hash[i];
    }
    return text;
}

std::string short_hash(const std::string& hash) {
    return hash.empty() ? "none" : grouped_hash(hash, 0, 12);
}

int digits_of_margin(double margin, int least) {
    int digits = least;
    while (margin < 0.0 && digits < 6 && is_zero(magnitude(margin, digits))) ++digits;
    return digits;
}

int rule_digits(const ReportRule& rule) {
    return digits_of_margin(rule.held ? 0.0 : rule.margin, rule.unit == "s" ? 1 : 3);
}

}  // namespace aerogram::exporter
