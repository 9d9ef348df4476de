#include "planner/takeoff.hpp"

#include <algorithm>

#include "planner/motion/neighbours.hpp"

namespace aerogram::planner {
namespace {

/// Take-off climbs this far above the minimum navigation altitude, so that neither the earth's curvature nor a file's
/// rounding puts a sideways motion below it.
constexpr double kClearOfFloor_m = 0.1;
constexpr double kRounding_m = 1e-9;  ///< pads of a regular grid at exactly the separation are far enough apart

/// The lowest layer that none of a drone's nearer neighbours before it has.
std::vector<std::uint32_t> layers_of(const Points& pads_m, double required_m) {
    Points flat_m = pads_m;
    for (Vec3& p : flat_m) p.z = 0.0;
    std::vector<std::vector<std::uint32_t>> before(pads_m.size());
    NeighbourGrid(flat_m, required_m).for_each_pair([&](std::size_t i, std::size_t j) {
        if (glm::length(flat_m[j] - flat_m[i]) < required_m - kRounding_m)
            before[std::max(i, j)].push_back(static_cast<std::uint32_t>(std::min(i, j)));
    });
    std::vector<std::uint32_t> layer(pads_m.size(), 0);
    for (std::size_t i = 0; i < pads_m.size(); ++i) {
        std::vector<std::uint32_t> taken;
        for (const std::uint32_t j : before[i]) taken.push_back(layer[j]);
        std::sort(taken.begin(), taken.end());
        for (const std::uint32_t t : taken)
            if (t == layer[i]) ++layer[i];
    }
    return layer;
}

}  // namespace

PadLayers pad_layers(const Points& pads_m, const Limits& limits) {
    const double required_m = planned_separation_m(limits);
    PadLayers layers{pads_m, layers_of(pads_m, required_m), 1};
    layers.count = 1 + *std::max_element(layers.layer_of.begin(), layers.layer_of.end());
    double highest_pad_m = pads_m.front().z;
    for (const Vec3& pad : pads_m) highest_pad_m = std::max(highest_pad_m, pad.z);
    for (std::size_t i = 0; i < pads_m.size(); ++i) {
        // Layers are level: with pads at different heights, steps of one layer would come near those of the next.
        const double base_m = layers.count == 1 ? pads_m[i].z : highest_pad_m;
        layers.lifted_m[i].z = base_m + limits.min_navigation_altitude_m + kClearOfFloor_m +
                               layers.layer_of[i] * required_m * limits.downwash;
    }
    return layers;
}

}  // namespace aerogram::planner
