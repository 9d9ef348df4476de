#include "geo/utc.hpp"

#include <array>
#include <cstdio>

#include "geo/contract.hpp"

namespace aerogram {
namespace {

constexpr std::int64_t kDay_s = 86'400;
constexpr int kFirstYear = 1970, kLastYear = 9999;
constexpr std::string_view kPattern = "0000-00-00T00:00:00Z";

bool leap(int year) {
    return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
}

int days_in(int year, int month) {
    constexpr std::array kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && leap(year) ? 1 : 0);
}

/// Days from 1970-01-01 to the first of January of a year.
std::int64_t days_before(int year) {
    const std::int64_t y = year - 1;
    return 365 * (y - 1969) + (y / 4 - y / 100 + y / 400) - (1969 / 4 - 1969 / 100 + 1969 / 400);
}

}  // namespace

std::optional<UtcSeconds> parse_utc(std::string_view text) {
    if (text.size() != kPattern.size()) return std::nullopt;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool digit = text[i] >= '0' && text[i] <= '9';
        if (kPattern[i] == '0' ? !digit : text[i] != kPattern[i]) return std::nullopt;
    }
    const auto number = [&](std::size_t from, std::size_t count) {
        int value = 0;
        for (std::size_t i = from; i < from + count; ++i) value = 10 * value + (text[i] - '0');
        return value;
    };
    const int year = number(0, 4), month = number(5, 2), day = number(8, 2);
    const int hour = number(11, 2), minute = number(14, 2), second = number(17, 2);
    if (year < kFirstYear || month < 1 || month > 12 || day < 1 || day > days_in(year, month)) return std::nullopt;
    if (hour > 23 || minute > 59 || second > 59) return std::nullopt;
    std::int64_t days = days_before(year) + day - 1;
    for (int m = 1; m < month; ++m) days += days_in(year, m);
    return days * kDay_s + hour * 3600 + minute * 60 + second;
}

std::string utc_text(UtcSeconds utc_s) {
    AEROGRAM_REQUIRE(utc_s >= 0 && utc_s < days_before(kLastYear + 1) * kDay_s, utc_s);
    std::int64_t days = utc_s / kDay_s;
    const std::int64_t rest = utc_s % kDay_s;
    int year = kFirstYear, month = 1;
    while (days >= (leap(year) ? 366 : 365)) days -= leap(year++) ? 366 : 365;
    while (days >= days_in(year, month)) days -= days_in(year, month++);
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%04d-%02d-%02dT%02d:%02d:%02dZ", year, month, static_cast<int>(days) + 1,
                  static_cast<int>(rest / 3600), static_cast<int>(rest / 60 % 60), static_cast<int>(rest % 60));
    return text.data();
}

std::string utc_text_ms(std::int64_t utc_ms) {
    std::string text = utc_text(utc_ms / 1000);
    text.pop_back();
    std::array<char, 8> fraction{};
    std::snprintf(fraction.data(), fraction.size(), ".%03dZ", static_cast<int>(utc_ms % 1000));
    return text + fraction.data();
}

}  // namespace aerogram
