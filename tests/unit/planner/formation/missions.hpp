#pragma once
#include <optional>
#include <string>
#include <utility>

#include "planner/formation/formation.hpp"
#include "planner/mission/mission.hpp"
#include "planner/sampling/closest_pair.hpp"

/// Missions made by hand for the tests of formations.
namespace aerogram::planner::testing {

inline Part part_of(Source source, std::size_t drones, Size size = {}) {
    Part part;
    part.source = std::move(source);
    part.size = size;
    part.drones = drones;
    part.line = 7;
    return part;
}

inline Size high(double height_m) {
    return {std::nullopt, std::nullopt, height_m};
}
inline Size wide(double width_m) {
    return {width_m, std::nullopt, std::nullopt};
}
inline Size flat(double width_m, double height_m) {
    return {width_m, std::nullopt, height_m};
}

inline TextSource text(std::string words) {
    TextSource source;
    source.text = std::move(words);
    return source;
}

inline ShapeSource shape(ShapeKind kind) {
    ShapeSource source;
    source.kind = kind;
    return source;
}

/// A mission of one keyframe that stands 1,000 m up under a ceiling of 2,000 m, so that heights do not matter.
inline Mission mission_of(std::vector<Part> parts) {
    Mission mission;
    mission.file = "show.toml";
    mission.limits.ceiling_m = 2000.0;
    Keyframe keyframe;
    keyframe.name = "shown";
    keyframe.center_m = {0, 0, 1000};
    for (const Part& part : parts) mission.fleet.drones += part.drones;
    keyframe.parts = std::move(parts);
    mission.keyframes.push_back(std::move(keyframe));
    return mission;
}

inline Result<Formation> build(const Mission& mission) {
    return build_formation(mission, 0, Run{});
}

/// The formation of one part, relative to its centre; a failed build throws with the reason.
inline Formation built(Part part) {
    Formation formation = build(mission_of({std::move(part)})).value();
    for (Vec3& p : formation.points_m) p.z -= 1000.0;
    return formation;
}

struct Box {
    Vec3 low{}, high{};
    [[nodiscard]] Vec3 size() const { return high - low; }
};
inline Box box_of(const Points& points) {
    Box box{points.front(), points.front()};
    for (const Vec3& p : points) {
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
    }
    return box;
}

}  // namespace aerogram::planner::testing
