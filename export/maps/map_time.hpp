#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "geo/utc.hpp"

/// Dates and times of KML and CZML.
namespace aerogram::exporter {

/// Microseconds since 1970-01-01T00:00:00Z of an ISO 8601 date and time, years 1970 to 9999: "2026-12-31T22:00:00Z",
/// with a fraction of a second, and "+01:00" in the place of Z; without either it is UTC. Digits beyond the sixth are
/// cut. Absent for anything else.
[[nodiscard]] std::optional<std::int64_t> utc_micros(std::string_view text);

/// Reads many times that are near each other, each as utc_micros does.
class UtcReader {
  public:
    [[nodiscard]] std::optional<std::int64_t> micros(std::string_view text);

  private:
    std::string minute_;  ///< "2026-12-31T22:00", of the last one
    std::int64_t minute_us_ = 0;
};

}  // namespace aerogram::exporter
