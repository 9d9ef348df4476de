#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "export/picture/formation_facts.hpp"
#include "planner/formation/formation.hpp"
#include "planner/mission/mission.hpp"
#include "planner/picture/picture.hpp"

/// Formations and decoded pictures for the tests of this folder.
namespace aerogram::exporter {

inline planner::Mission mission_of_one(const std::string& show, const std::string& keyframe) {
    planner::Mission mission;
    mission.name = show;
    mission.keyframes.resize(1);
    mission.keyframes.front().name = keyframe;
    mission.limits.formation_spacing_m = 2.0;
    return mission;
}

inline planner::Formation formation_of(const Points& points_m, const Rgb& color = {1.0, 1.0, 1.0}) {
    planner::Formation formation;
    formation.points_m = points_m;
    formation.colors.assign(points_m.size(), color);
    formation.part.assign(points_m.size(), 0);
    formation.spare.assign(points_m.size(), false);
    return formation;
}

/// The sRGB bytes of a pixel, 0xRRGGBB.
inline std::uint32_t pixel(const planner::Picture& picture, const Vec2& at) {
    const auto x = static_cast<std::size_t>(at.x), y = static_cast<std::size_t>(at.y);
    const std::size_t i = 4 * (y * picture.width + x);
    return (std::uint32_t{picture.rgba[i]} << 16U) | (std::uint32_t{picture.rgba[i + 1]} << 8U) | picture.rgba[i + 2];
}

inline int brightness(std::uint32_t rgb) {
    return static_cast<int>((rgb >> 16U) + ((rgb >> 8U) & 0xFFU) + (rgb & 0xFFU));
}

}  // namespace aerogram::exporter
