#include "export/maps/map_time.hpp"

#include "export/bytes/decimal.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kWholeSeconds = 19, kMinutes = 16;  ///< lengths of "2026-12-31T22:00:00" and "2026-12-31T22:00"
constexpr std::int64_t kSecond_us = 1'000'000;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

/// ".25" and the like, taken from the front of the text.
std::optional<std::int64_t> taken_fraction(std::string_view& text) {
    if (!text.starts_with('.')) return 0;
    text.remove_prefix(1);
    if (text.empty() || !is_digit(text.front())) return std::nullopt;
    std::int64_t us = 0, unit = kSecond_us / 10;
    for (; !text.empty() && is_digit(text.front()); text.remove_prefix(1), unit /= 10)
        us += unit * (text.front() - '0');
    return us;
}

/// "Z", nothing, "+01:00" or "-0530": seconds east of Greenwich.
std::optional<std::int64_t> zone_s(std::string_view text) {
    if (text.empty() || text == "Z") return 0;
    if (text.front() != '+' && text.front() != '-') return std::nullopt;
    const bool west = text.front() == '-';
    text.remove_prefix(1);
    const bool colon = text.size() == 5 && text[2] == ':';
    if (!colon && text.size() != 4) return std::nullopt;
    const auto hours = parse_whole(text.substr(0, 2), 0, 14), minutes = parse_whole(text.substr(colon ? 3 : 2), 0, 59);
    if (!hours || !minutes) return std::nullopt;
    return (west ? -60 : 60) * (60 * *hours + *minutes);
}

}  // namespace

std::optional<std::int64_t> utc_micros(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    if (text.size() < kWholeSeconds) return std::nullopt;
    const auto whole_s = parse_utc(std::string(text.substr(0, kWholeSeconds)) + "Z");
    if (!whole_s) return std::nullopt;
    text.remove_prefix(kWholeSeconds);
    const auto fraction_us = taken_fraction(text);
    const auto east_s = fraction_us ? zone_s(text) : std::nullopt;
    if (!east_s) return std::nullopt;
    return (*whole_s - *east_s) * kSecond_us + *fraction_us;
}

std::optional<std::int64_t> UtcReader::micros(std::string_view text) {
    if (text.size() > kWholeSeconds && text.ends_with('Z') && text.substr(0, kMinutes) == minute_ &&
        text[kMinutes] == ':' && is_digit(text[kMinutes + 1]) && is_digit(text[kMinutes + 2]) &&
        text[kMinutes + 1] < '6') {
        const std::int64_t second = 10 * (text[kMinutes + 1] - '0') + (text[kMinutes + 2] - '0');
        text.remove_prefix(kWholeSeconds);
        const auto fraction_us = taken_fraction(text);
        if (fraction_us && text == "Z") return minute_us_ + second * kSecond_us + *fraction_us;
        return std::nullopt;
    }
    const auto us = utc_micros(text);
    if (us && text.size() > kWholeSeconds && text.ends_with('Z') && is_digit(text.front())) {
        minute_ = text.substr(0, kMinutes);
        minute_us_ = *us - *us % (60 * kSecond_us);
    }
    return us;
}

}  // namespace aerogram::exporter
