#pragma once
#include <string>
#include <vector>

#include "planner/leg.hpp"
#include "planner/mission/mission_reader.hpp"
#include "planner/plan.hpp"
#include "planner/route.hpp"
#include "planner/timeline.hpp"

/// Missions of a few keyframes for the tests of route, legs, timeline and plan.
namespace aerogram::planner::test {

/// Keyframes after the same head: show, fleet of n drones on pads 3 m apart in rows of four.
inline Mission show_of(const std::string& keyframes, std::size_t drones = 8) {
    const std::string head =
        "[show]\nname = \"small\"\norigin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = 400 }\n"
        "geoid_undulation_m = 48.9\n[fleet]\ndrones = " +
        std::to_string(drones) + "\npads = { rows = 4, columns = 4, spacing_m = 3 }\n";
    return parse_mission(head + keyframes, "small.toml").value();
}

/// A keyframe of a shape at its smallest size, 40 m up.
inline std::string keyframe(const std::string& name, const std::string& shape, const std::string& more = "") {
    return "[[keyframe]]\nname = \"" + name + "\"\nshape = \"" + shape + "\"\ncenter_m = [0, 0, 40]\n" + more + "\n";
}

inline const std::string kFlowOn = "hold_s = 0\narrive = { method = \"flow\" }";
inline const std::string kFlow = "arrive = { method = \"flow\" }";
/// A line turned by half a turn, everybody keeping the own slot: all meet in the middle.
inline const std::string kHalfTurn = "rotate_deg = [0, 180, 0]\n";

/// What plan() does up to the timeline.
struct Stages {
    Route route;
    std::vector<Leg> legs;
    std::vector<LegMotion> motions;
};
inline Stages stages_of(const Mission& mission) {
    Stages stages{build_route(mission, Run{}).value(), {}, {}};
    stages.legs = legs_of(mission, stages.route);
    for (const Leg& leg : stages.legs) stages.motions.push_back(plan_leg(mission, stages.route, leg, Run{}).value());
    return stages;
}
inline Result<Timeline> timeline_of(const Mission& mission) {
    const Stages stages = stages_of(mission);
    return build_timeline(mission, stages.route, stages.legs, stages.motions);
}

inline const Act* find_act(const std::vector<Act>& acts, const std::string& name) {
    for (const Act& act : acts) {
        if (act.name == name) return &act;
    }
    return nullptr;
}

}  // namespace aerogram::planner::test
