#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace aerogram {

/// Seconds since 1970-01-01T00:00:00Z, leap seconds not counted.
using UtcSeconds = std::int64_t;

/// "2026-12-31T22:00:00Z" as seconds, in the proleptic Gregorian calendar; years 1970 to 9999. Absent when it is not
/// written just so or no such moment exists.
[[nodiscard]] std::optional<UtcSeconds> parse_utc(std::string_view text);
/// The text that parse_utc reads. @param utc_s  of the years 1970 to 9999.
[[nodiscard]] std::string utc_text(UtcSeconds utc_s);
/// With milliseconds: "2026-12-31T22:00:00.250Z".
[[nodiscard]] std::string utc_text_ms(std::int64_t utc_ms);

}  // namespace aerogram
