#include "export/bytes/decimal.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "geo/contract.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::array<std::int64_t, 10> kPowers{1,       10,        100,        1'000,       10'000,
                                               100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};

std::int64_t power_of_ten(int digits) {
    AEROGRAM_REQUIRE(digits >= 0 && digits <= 9, digits);
    return kPowers[static_cast<std::size_t>(digits)];
}

}  // namespace

std::int64_t in_units(double value, int digits) {
    const double scaled = value * static_cast<double>(power_of_ten(digits));
    AEROGRAM_REQUIRE(std::abs(scaled) < 4.6e18, value);  // false for NaN as well
    return std::llround(scaled);
}

void append_units(std::string& out, std::int64_t units, int digits) {
    AEROGRAM_REQUIRE(digits >= 0 && digits <= 9, digits);
    std::array<char, 24> text{};
    std::size_t at = text.size();
    const auto prepend = [&](char c) { text[--at] = c; };
    std::uint64_t rest = static_cast<std::uint64_t>(units < 0 ? -units : units);
    for (int place = 0; place < digits; ++place, rest /= 10) prepend(static_cast<char>('0' + rest % 10));
    if (digits > 0) prepend('.');
    do {
        prepend(static_cast<char>('0' + rest % 10));
        rest /= 10;
    } while (rest > 0);
    if (units < 0) prepend('-');
    out.append(&text[at], text.size() - at);
}

void append_fixed(std::string& out, double value, int digits) {
    append_units(out, in_units(value, digits), digits);
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<double> parse_number(std::string_view text, double limit) {
    text = trimmed(text);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(std::abs(value) <= limit)) return std::nullopt;
    return value;
}

std::optional<std::int64_t> parse_whole(std::string_view text, std::int64_t lowest, std::int64_t highest) {
    text = trimmed(text);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < lowest || value > highest)
        return std::nullopt;
    return value;
}

std::optional<std::string_view> Fields::next() {
    if (!rest_) return std::nullopt;
    const std::size_t end = rest_->find(separator_);
    const std::string_view field = rest_->substr(0, end);
    if (end == std::string_view::npos) {
        rest_.reset();
    } else {
        rest_ = rest_->substr(end + 1);
    }
    return field;
}

std::string shown(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string result = "\"";
    for (const char c : text.substr(0, kLongest)) result += c >= ' ' && c <= '~' ? c : '?';
    result += text.size() > kLongest ? "...\"" : "\"";
    return result;
}

}  // namespace aerogram::exporter
