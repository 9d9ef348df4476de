#pragma once
#include "geo/vec3.hpp"

/// glTF: X right, Y up, -Z away from the audience.
namespace aerogram::exporter {

[[nodiscard]] inline Vec3 to_gltf(const Vec3& show) {
    return {show.x, show.z, -show.y};
}
[[nodiscard]] inline Vec3 from_gltf(const Vec3& gltf) {
    return {gltf.x, -gltf.z, gltf.y};
}

}  // namespace aerogram::exporter
