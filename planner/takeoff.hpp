#pragma once
#include <cstdint>
#include <vector>

#include "geo/limits.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Where take-off ends and landing begins. Pads that are far enough apart make one layer, each drone as high above its
/// own pad as the next. Pads closer than the planned separation are dealt out to layers, so that drones of one layer
/// are far enough apart side by side, and layers far enough one above the other (downwash included); the fleet then
/// leaves layer by layer, the highest first, so that nobody rises through or hovers below a moving neighbour's wash for
/// longer than it must, and comes back the lowest first.
struct PadLayers {
    Points lifted_m;                      ///< by drone
    std::vector<std::uint32_t> layer_of;  ///< by drone; 0 is the lowest
    std::uint32_t count = 1;
};

/// Properties: (1) lifted places keep the planned separation (2) pads that are far enough apart make one layer (3) a
/// pad's layer depends on the pads before it alone. Greedy colouring in pad order, O(n).
/// @param pads_m  distinct places on the ground.
[[nodiscard]] PadLayers pad_layers(const Points& pads_m, const Limits& limits);

}  // namespace aerogram::planner
