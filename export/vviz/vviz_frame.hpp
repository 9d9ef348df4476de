#pragma once
#include "geo/vec3.hpp"
#include "planner/mission/export_wishes.hpp"

namespace aerogram::exporter {

/// VVIZ places stand on X right, Y up, and Z away from the audience (verge: a left-handed frame) or towards it
/// (finale). Right is our +x, away from the audience our +y. Property: from_vviz(to_vviz(p, f), f) = p exactly.
[[nodiscard]] inline Vec3 to_vviz(const Vec3& show_m, planner::VvizFlavour flavour) {
    return {show_m.x, show_m.z, flavour == planner::VvizFlavour::verge ? show_m.y : -show_m.y};
}
[[nodiscard]] inline Vec3 from_vviz(const Vec3& vviz_m, planner::VvizFlavour flavour) {
    return {vviz_m.x, flavour == planner::VvizFlavour::verge ? vviz_m.z : -vviz_m.z, vviz_m.y};
}

}  // namespace aerogram::exporter
