#pragma once
#include <cmath>
#include <cstddef>
#include <string>

#include "planner/mission/mission_reader.hpp"

/// Missions written in memory for the benchmarks.
namespace aerogram::bench {

/// Two words in stroke letters by n drones, at the smallest size that holds the standard preset's spacing.
inline planner::Mission words(std::size_t n, const std::string& method = "straight") {
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
    const std::string rows = std::to_string(side);
    const std::string text =
        "[show]\nname = \"words\"\n"
        "origin = { latitude_deg = 47.5, longitude_deg = 19.04, height_m = 145, heading_deg = 75 }\n"
        "geoid_undulation_m = 43.5\n"
        "[fleet]\ndrones = " +
        std::to_string(n) + "\npads = { rows = " + rows + ", columns = " + rows +
        ", spacing_m = 2.5, center_m = [0, -40] }\n"
        "[airspace]\ngeofence = [[47.49, 19.03], [47.51, 19.03], [47.51, 19.05], [47.49, 19.05]]\n"
        "[[keyframe]]\nname = \"HELLO\"\ntext = \"HELLO\"\ncenter_m = [0, 0, 60]\ncolor = \"#40c4ff\"\n"
        "[[keyframe]]\nname = \"WORLD\"\ntext = \"WORLD\"\ncenter_m = [0, 0, 60]\ncolor = \"#69f0ae\"\n"
        "arrive = { method = \"" +
        method + "\" }\n";
    return planner::parse_mission(text, "words.toml").value();
}

}  // namespace aerogram::bench
