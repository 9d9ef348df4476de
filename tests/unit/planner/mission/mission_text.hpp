#pragma once
#include <string>
#include <string_view>

#include "planner/mission/mission_reader.hpp"

/// The smallest sound mission, in the pieces that tests replace.
namespace aerogram::planner::test {

inline const std::string kShow = R"([show]
name = "test"
origin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = 400 }
)";
inline const std::string kFleet = R"([fleet]
drones = 4
pads = { rows = 2, columns = 2, spacing_m = 3 }
)";
inline const std::string kKeyframe = R"([[keyframe]]
name = "a"
shape = "line"
center_m = [0, 0, 20]
)";
inline const std::string kGroups = R"([[group]]
name = "left"
drones = "1-2"
[[group]]
name = "right"
drones = [4, 3]
weight = 3
)";

inline Result<Mission> parse(const std::string& text) {
    return parse_mission(text, "m.toml");
}
/// The smallest mission with more text at its end.
inline Result<Mission> parse_with(const std::string& more) {
    return parse(kShow + kFleet + kKeyframe + more);
}

/// The message of a mission that must be refused; "accepted" when it was not.
inline std::string message(const Result<Mission>& mission) {
    return mission ? "accepted" : mission.error().message;
}

}  // namespace aerogram::planner::test
