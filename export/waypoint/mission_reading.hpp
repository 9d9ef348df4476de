#pragma once
#include <optional>

#include "export/record/recorded_show.hpp"
#include "export/waypoint/mission_items.hpp"
#include "geo/utc.hpp"

namespace aerogram::exporter {

/// What the items of one mission mean for a recorded drone, taken one after another. Places become waypoints; a speed
/// over the ground counts for the leg to the next; a wait for a time of day (hour, minute and second all given) is its
/// waypoint's until_s, here still the second of the day (settle_times), a wait for some seconds lengthens its hold;
/// waits before the first waypoint and other items that move nobody (DO_ and CONDITION_ commands) are passed over.
class MissionReading {
  public:
    /// @param home  absent: the file has none; it is the place of the first take-off then.
    /// @param home_amsl_m  what AMSL altitudes are taken from.
    MissionReading(std::optional<geo::Geodetic> home, std::optional<double> home_amsl_m)
        : home_(home), home_amsl_m_(home_amsl_m) {}

    /// Errors: invalid_input for other navigation commands, frames that are neither AMSL nor above home, AMSL and no
    /// home, no home yet, values out of range.
    [[nodiscard]] Status take(const MissionItem& item);
    /// Home and waypoints; the name is the caller's.
    [[nodiscard]] RecordedDrone drone() const;

  private:
    [[nodiscard]] Status place(const MissionItem& item);
    [[nodiscard]] Result<double> above_home_m(const MissionItem& item) const;
    void wait(const MissionItem& item);

    std::optional<geo::Geodetic> home_;
    std::optional<double> home_amsl_m_;
    std::optional<double> speed_mps_;
    std::vector<Waypoint> waypoints_;
};

/// Times of day become show times, and RecordedShow::timing says how the missions keep time: "absolute" where every
/// drone waits for a time, else kSpeedTiming where one sets a speed. Waits are less than a day apart, so that a show
/// may go through midnight. @param start_utc_s  of show time 0; absent: times count from the first drone's first wait.
void settle_times(RecordedShow& show, const std::optional<UtcSeconds>& start_utc_s);

}  // namespace aerogram::exporter
