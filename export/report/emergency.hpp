#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "export/report/pair_grid.hpp"
#include "export/report/survey.hpp"

/// Manoeuvres of drones that leave the show (docs/report.md); in the coordinates of the survey.
namespace aerogram::exporter {

struct EmergencyModel {
    double acceleration_mps2 = 2.0;  ///< brakes with it
    double wait_s = 0.0;             ///< from the alarm to descending or rising: the fastest has come to rest
    double land_mps = 2.0, rise_mps = 2.5, return_mps = 5.0;  ///< in the metric: vertical ones over the downwash
    double lowest_layer = 0.0, layer = 0.0;                   ///< z in the survey's coordinates
    std::size_t layers = 1;
    std::string words;

    /// z at which drone d flies home when it comes from below.
    [[nodiscard]] double return_z(std::size_t drone) const {
        return lowest_layer + layer * static_cast<double>(drone % layers);
    }
};
[[nodiscard]] EmergencyModel emergency_model(const OutgoingFacts& facts, const Survey& all);

/// Everybody's places that a manoeuvre needs; of one drone at one whole second.
struct Stop {
    Vec3 from{}, speed_mps{}, hold{};  ///< speed in the metric
    double brake_s = 0.0;
    Stance stance = Stance::flying;  ///< while it holds
    bool in_air = false;

    /// Where it is `after_s` seconds after the alarm, holding.
    [[nodiscard]] Vec3 at(double after_s) const;
};
[[nodiscard]] Stop stop_of(const Survey& all, const EmergencyModel& model, std::size_t drone, std::size_t second);
/// What straight lines of length dt miss a braking drone by.
[[nodiscard]] double missed_braking_m(const EmergencyModel& model, double step_s);

/// How much closer than the truth reported distances may be; whoever is found within that is reported as touching, and
/// nobody closer is looked for.
[[nodiscard]] double resolution_m(const Survey& all, const EmergencyModel& model);

/// Where a drone comes down when it lands from where it holds: on its own pad where it is above it.
[[nodiscard]] double ground_z(const Survey& all, std::size_t drone);
[[nodiscard]] Vec3 home_of(const Survey& all, std::size_t drone);

/// The ways home of a drone that holds: rise, cross, sink. Times after the alarm.
struct Way {
    Vec3 hold{}, high{}, above_home{}, home{};
    double rise_s = 0.0, cross_s = 0.0, sink_s = 0.0, home_s = 0.0;  ///< when each begins, and the end

    [[nodiscard]] Vec3 at(double after_s) const;
};
[[nodiscard]] Way way_home(const Survey& all, const EmergencyModel& model, std::size_t drone, const Stop& stop);

/// The closest so far.
struct Found {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t first = 0, second = 0;
    double time_s = 0.0;

    void note(double d, std::size_t i, std::size_t j, double t_s) {
        if (d < distance) *this = {d, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), t_s};
    }
};

/// The three manoeuvres at one second.
struct Manoeuvres {
    Found hold, land, back;
};
/// Of one drone, the worst to choose, while the others fly on. One an entry of a whole second.
[[nodiscard]] std::vector<Manoeuvres> one_leaves(const Survey& all, const EmergencyModel& model, const Run& run);
/// Of all at once.
[[nodiscard]] std::vector<Manoeuvres> all_leave(const Survey& all, const EmergencyModel& model, const Run& run);

}  // namespace aerogram::exporter
