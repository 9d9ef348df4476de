#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "export/outgoing/format.hpp"
#include "geo/color.hpp"

/// The JSON chunk of a GLB file.
namespace aerogram::exporter {

/// Places in the binary chunk, bytes. Its parts in order: corners, triangles, key times, key values, lights.
struct GlbLayout {
    struct Times {
        std::uint64_t offset = 0;  ///< in the part of key times
        std::uint32_t count = 0;
        float first_s = 0.0F, last_s = 0.0F;
    };
    struct Drone {
        std::size_t times = 0;  ///< which of `times`
        std::uint64_t values_offset = 0;
        std::uint32_t first_light = 0, lights = 0;
        Rgb8 first_color;  ///< the first bright one; dark: never lit
    };
    std::vector<Times> times;
    std::vector<Drone> drones;
    std::uint64_t times_bytes = 0, values_bytes = 0, lights_bytes = 0;
};

/// An octahedron of 0.25 m: corners (6 x 3 floats), then triangles (8 x 3 uint16).
[[nodiscard]] std::string glb_shape();
inline constexpr std::uint64_t kGlbCornerBytes = 72, kGlbTriangleBytes = 48;

[[nodiscard]] std::string glb_document(const OutgoingShow& show, const Seal& seal, const GlbLayout& layout);

}  // namespace aerogram::exporter
