#pragma once
#include "geo/vec3.hpp"

namespace aerogram::exporter {

/// Skybrush shows stand on X front, Y left, Z up. Front is away from the audience, our +y; left is our -x. Both frames
/// are right-handed, so nothing is mirrored, and the heading of their +X is the heading of our +y. Properties: (1)
/// from_skybrush(to_skybrush(p)) = p exactly (2) cross products commute with both.
[[nodiscard]] inline Vec3 to_skybrush(const Vec3& show_m) {
    return {show_m.y, -show_m.x, show_m.z};
}
[[nodiscard]] inline Vec3 from_skybrush(const Vec3& skybrush_m) {
    return {-skybrush_m.y, skybrush_m.x, skybrush_m.z};
}

}  // namespace aerogram::exporter
