#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/formation/formation.hpp"
#include "planner/mission/mission.hpp"
#include "planner/sampling/closest_pair.hpp"

namespace aerogram::exporter {

/// What there is to say about one keyframe's formation before anything is planned. Spacings are in the separation
/// metric.
struct FormationFacts {
    std::string show, keyframe;
    std::size_t number = 1, keyframes = 1;  ///< the keyframe counts from 1, of so many
    std::size_t drones = 0, spares = 0;     ///< all slots; those of them that the keyframe does not need
    double downwash = 1.0;
    double asked_spacing_m = 0.0;                   ///< the mission's formation_spacing_m
    std::optional<planner::ClosestPair> closest;    ///< of all slots; absent for a single drone
    Vec3 low_m{}, high_m{};                         ///< the box of the slots that are not spare, show frame
    std::vector<double> nearest_m;                  ///< of each slot that is not spare to any other; empty: one drone
    std::vector<std::optional<double>> coverage_m;  ///< one a part, as in Formation
    std::string note;                               ///< the formation's
};

/// @param formation  of mission.keyframes[index].
[[nodiscard]] FormationFacts facts_of(const planner::Mission& mission, std::size_t index,
                                      const planner::Formation& formation);

/// The same for people, a name and a text each: "drones", "50, of which 4 are spare".
struct FactLine {
    std::string name, text;
};
[[nodiscard]] std::vector<FactLine> fact_lines(const FormationFacts& facts);

/// "2.20": with a fixed count of decimals, '.' whatever the locale; never "-0.00".
[[nodiscard]] std::string fixed(double value, int decimals);

}  // namespace aerogram::exporter
