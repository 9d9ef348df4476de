#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "planner/motion/flight_plan.hpp"
#include "planner/motion/timing.hpp"

/// A show of thousands of drones that needs no planner: a square of pads rises, folds into a block of ten layers, which
/// turns, grows, turns on, shrinks and unfolds to a sheet again; six keyframes, straight transitions at the limits'
/// pace. Every formation is a linear image of the drone's place in the grid (folding apart, which keeps its distances
/// too), and neighbouring images differ by little enough that no two drones come nearer than kClosest_m.
namespace aerogram::exporter::large {

inline constexpr double kSpacing_m = 2.5, kClosest_m = 1.7;

/// Where a drone stands in the fleet's grid: columns, and rows folded by tens into layers.
struct Place {
    double column = 0.0, row = 0.0, fold = 0.0, layer = 0.0;
};
inline Place place_of(std::size_t drone, std::size_t side) {
    const double middle = 0.5 * static_cast<double>(side - 1);
    const std::size_t row = drone / side;
    return {static_cast<double>(drone % side) - middle, static_cast<double>(row) - middle,
            static_cast<double>(row / 10) - 0.05 * static_cast<double>(side), static_cast<double>(row % 10)};
}

inline std::vector<double> minimum_jerk(std::size_t rows) {
    std::vector<double> s(rows, 1.0);
    for (std::size_t k = 0; k + 3 < rows; ++k) {
        const double u = k < 3 ? 0.0 : static_cast<double>(k - 1) / static_cast<double>(rows - 3);
        s[k] = u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
    }
    return s;
}

class Builder {
  public:
    explicit Builder(std::size_t drones)
        : drones_(drones), side_(static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(drones))))) {}

    planner::FlightPlan plan() {
        plan_.name = "Large";
        plan_.origin = {{35.65860, 139.74540, 40.0}, 20.0, 36.7};
        plan_.limits.ceiling_m = 120.0;
        plan_.endurance_s = 3600.0;
        plan_.pads_m = sheet(0.0);
        plan_.tracks.resize(drones_);
        const double reach_m = 2.0 * kSpacing_m * static_cast<double>(side_) + 50.0;
        plan_.airspace.geofence_m = {{-reach_m, -reach_m},
                                     {reach_m, -reach_m},
                                     {1.1 * reach_m, 0.0},
                                     {reach_m, reach_m},
                                     {-reach_m, 1.05 * reach_m}};
        plan_.airspace.audience_m = {
            {{-30.0, -reach_m - 60.0}, {30.0, -reach_m - 60.0}, {30.0, -reach_m - 20.0}, {-30.0, -reach_m - 20.0}}};
        const Points above = sheet(8.0);
        fly("take-off", planner::ActRole::takeoff, plan_.pads_m, above);
        const std::array<std::pair<double, double>, 5> blocks{
            {{0.0, 1.0}, {0.7, 1.0}, {0.7, 1.5}, {0.0, 1.5}, {0.0, 1.0}}};
        Points at = above;
        for (const auto& [turn, size] : blocks) at = keyframe(at, block(turn, size));
        at = keyframe(at, sheet(30.0));
        fly("return", planner::ActRole::transit, at, above);
        fly("landing", planner::ActRole::landing, above, plan_.pads_m);
        return std::move(plan_);
    }

  private:
    [[nodiscard]] Points sheet(double height_m) const {
        Points points(drones_);
        for (std::size_t i = 0; i < drones_; ++i) {
            const Place p = place_of(i, side_);
            points[i] = {kSpacing_m * p.column, kSpacing_m * p.row, height_m};
        }
        return points;
    }
    [[nodiscard]] Points block(double turn_rad, double size) const {
        Points points(drones_);
        const double c = std::cos(turn_rad), s = std::sin(turn_rad), d = size * kSpacing_m;
        for (std::size_t i = 0; i < drones_; ++i) {
            const Place p = place_of(i, side_);
            points[i] = {d * (c * p.column - s * p.fold), d * (s * p.column + c * p.fold), 12.0 + d * p.layer};
        }
        return points;
    }

    Points keyframe(const Points& from, Points to) {
        const std::string name = "K" + std::to_string(plan_.keyframes.size() + 1);
        fly("to " + name, planner::ActRole::transit, from, to);
        add(name, planner::ActRole::hold, 8'000, planner::Hold{to});
        planner::PlannedKeyframe keyframe{name, to, {}, {}, plan_.acts.back().start_ms, plan_.duration_ms()};
        for (std::size_t i = 0; i < drones_; ++i) {
            const double shade = static_cast<double>(i * 7919 % 256) / 255.0;
            keyframe.slot_of.emplace_back(i);
            keyframe.colors.push_back({shade, 1.0 - shade, plan_.keyframes.size() % 2 == 0 ? 0.25 : 0.75});
            auto& lights = plan_.tracks[i].lights;
            lights.push_back({plan_.acts.back().start_ms / 20 * 20, keyframe.colors.back(), true});
        }
        plan_.cues.push_back({keyframe.stands_from_ms, name});
        plan_.keyframes.push_back(std::move(keyframe));
        return to;
    }

    void fly(const std::string& name, planner::ActRole role, const Points& from, const Points& to) {
        planner::Motion motion = planner::Straight{from, to, minimum_jerk(63)};
        const Millis shortest_ms = planner::shortest_duration(motion, plan_.limits).duration_ms;
        add(name, role, (shortest_ms / 20 + 1) * 20, std::move(motion));
    }

    void add(const std::string& name, planner::ActRole role, Millis duration_ms, planner::Motion motion) {
        planner::ActCertificate c;
        c.name = name;
        c.role = role;
        c.start_ms = plan_.duration_ms();
        c.duration_ms = duration_ms;
        c.required_separation_m = planned_separation_m(plan_.limits);
        c.separation.lower_bound_m = c.required_separation_m;
        c.extremes = planner::extremes(motion, static_cast<double>(duration_ms) / 1000.0);
        c.altitude_min_m = -1.0;  // claims little, and is true
        c.altitude_max_m = plan_.limits.ceiling_m;
        c.method = role == planner::ActRole::hold ? "hold" : "straight";
        plan_.certificate.acts.push_back(c);
        plan_.acts.push_back({name, role, planner::Timing::free, c.start_ms, duration_ms, std::move(motion)});
    }

    std::size_t drones_, side_;
    planner::FlightPlan plan_;
};

inline planner::FlightPlan show(std::size_t drones) {
    return Builder(drones).plan();
}

}  // namespace aerogram::exporter::large
