#include "export/decimal.hpp"

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
    const std::int64_t power = power_of_ten(digits);
    if (units < 0) out += '-';
    const std::int64_t magnitude = units < 0 ? -units : units;
    std::array<char, 24> text{};
    const char* end = std::to_chars(text.data(), text.data() + text.size(), magnitude / power).ptr;
    out.append(static_cast<const char*>(text.data()), end);
    if (digits == 0) return;
    out += '.';
    std::int64_t rest = magnitude % power;
    for (std::int64_t place = power / 10; place > 0; place /= 10) {
        out += static_cast<char>('0' + rest / place);
        rest %= place;
    }
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
