#include "export/waypoint/mission_reading.hpp"

#include <algorithm>
#include <cmath>

namespace aerogram::exporter {
namespace {

constexpr int kFirstCondition = 112;
constexpr double kDay_s = 86'400.0, kHighest_m = 100'000.0, kFastest_mps = 1'000.0;

Error refused(const std::string& what) {
    return {ErrorCode::invalid_input, what};
}

bool above_home(int frame) {
    return frame == mav::kGlobalRelative || frame == mav::kGlobalRelativeInt;
}
bool amsl(int frame) {
    return frame == mav::kGlobal || frame == mav::kGlobalInt;
}
bool on_earth(double latitude_deg, double longitude_deg) {
    return std::abs(latitude_deg) <= 90.0 && std::abs(longitude_deg) <= 180.0;
}

/// Of the hour, minute and second that a wait names, all of them whole.
std::optional<double> second_of_day(const MissionItem& wait) {
    const double hour = wait.params[1], minute = wait.params[2], second = wait.params[3];
    const auto whole = [](double value, double below) {
        return value >= 0.0 && value < below && value == std::floor(value);
    };
    if (!whole(hour, 24.0) || !whole(minute, 60.0) || !whole(second, 60.0)) return std::nullopt;
    return 3600.0 * hour + 60.0 * minute + second;
}

bool waits(const RecordedDrone& drone) {
    return std::ranges::any_of(drone.waypoints, [](const Waypoint& w) { return w.until_s.has_value(); });
}
bool sets_speeds(const RecordedDrone& drone) {
    return std::ranges::any_of(drone.waypoints, [](const Waypoint& w) { return w.speed_mps.has_value(); });
}

}  // namespace

Status MissionReading::take(const MissionItem& item) {
    const int c = item.command;
    if (c == mav::kDelay) {
        wait(item);
    } else if (c == mav::kChangeSpeed) {
        const bool over_ground = item.params[0] == 0.0 || item.params[0] == 1.0;
        if (over_ground && item.params[1] > 0.0 && item.params[1] <= kFastest_mps) speed_mps_ = item.params[1];
    } else if (c < kFirstCondition) {
        return place(item);
    }
    return Done{};
}

void MissionReading::wait(const MissionItem& item) {
    if (waypoints_.empty()) return;
    if (item.params[0] > 0.0) {
        waypoints_.back().hold_s = std::min(kDay_s, waypoints_.back().hold_s + item.params[0]);
    } else if (const auto second = second_of_day(item)) {
        waypoints_.back().until_s = second;
    }
}

Result<double> MissionReading::above_home_m(const MissionItem& item) const {
    if (std::abs(item.params[6]) > kHighest_m) return refused("altitude must be within 100 km");
    if (above_home(item.frame)) return item.params[6];
    if (!amsl(item.frame))
        return refused("frame " + std::to_string(item.frame) + ": must be 0 or 5 (AMSL), 3 or 6 (above home)");
    if (!home_amsl_m_)
        return refused("frame " + std::to_string(item.frame) + ": this file holds no home to measure AMSL from");
    return item.params[6] - *home_amsl_m_;
}

Status MissionReading::place(const MissionItem& item) {
    const int c = item.command;
    const bool stops = c == mav::kWaypoint || c == mav::kLoiterTime || c == mav::kSpline;
    if (!stops && c != mav::kTakeoff && c != mav::kLand && c != mav::kReturn)
        return refused("command " + std::to_string(c) +
                       ": only take-off, waypoint, timed loiter, spline, return and land are read");
    const double latitude_deg = item.params[4], longitude_deg = item.params[5];
    const bool somewhere = latitude_deg != 0.0 || longitude_deg != 0.0;
    if (!on_earth(latitude_deg, longitude_deg))
        return refused("latitude and longitude must be within 90 and 180 degrees");
    if (!home_ && c == mav::kTakeoff && somewhere) home_ = geo::Geodetic{latitude_deg, longitude_deg, 0.0};
    if (!home_) return refused("this file holds no home: it must begin with a take-off that has a place");
    Waypoint waypoint{*home_, 0.0, 0.0, Waypoint::Kind::land, {}, {}};
    if (c != mav::kReturn) {
        const auto altitude_m = above_home_m(item);
        if (!altitude_m) return altitude_m.error();
        waypoint.altitude_above_home_m = *altitude_m;
        // Take-off and landing without a place happen where the vehicle is; at the ends of a mission that is home.
        if (stops || somewhere) waypoint.place = {latitude_deg, longitude_deg, 0.0};
        waypoint.kind = c == mav::kTakeoff ? Waypoint::Kind::takeoff
                        : c == mav::kLand  ? Waypoint::Kind::land
                                           : Waypoint::Kind::fly_to;
    }
    if (stops) waypoint.hold_s = item.params[0];
    if (waypoint.hold_s < 0.0 || waypoint.hold_s > kDay_s) return refused("hold must be from 0 to 86400 s");
    waypoint.speed_mps = std::exchange(speed_mps_, std::nullopt);
    waypoints_.push_back(waypoint);
    return Done{};
}

RecordedDrone MissionReading::drone() const {
    RecordedDrone drone;
    drone.home = home_;
    drone.home_amsl_m = home_amsl_m_;
    drone.waypoints = waypoints_;
    return drone;
}

void settle_times(RecordedShow& show, const std::optional<UtcSeconds>& start_utc_s) {
    std::optional<double> zero;
    if (start_utc_s) zero = static_cast<double>(*start_utc_s % static_cast<UtcSeconds>(kDay_s));
    for (RecordedDrone& drone : show.drones) {
        std::optional<double> before_s;
        for (Waypoint& waypoint : drone.waypoints) {
            if (!waypoint.until_s) continue;
            if (!zero) zero = *waypoint.until_s;
            double since_s = *waypoint.until_s - *zero;  // to a multiple of a day
            if (!before_s && since_s < -0.5 * kDay_s) since_s += kDay_s;
            if (!before_s && since_s > 0.5 * kDay_s) since_s -= kDay_s;
            if (before_s) since_s += kDay_s * std::ceil((*before_s - since_s) / kDay_s);
            waypoint.until_s = before_s = since_s;
        }
    }
    if (std::ranges::all_of(show.drones, waits)) {
        show.timing = kAbsoluteTiming;
    } else if (std::ranges::any_of(show.drones, sets_speeds)) {
        show.timing = kSpeedTiming;
    }
}

}  // namespace aerogram::exporter
