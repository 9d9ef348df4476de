#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "geo/run.hpp"
#include "planner/formation/svg_ink.hpp"
#include "planner/sampling/density_field.hpp"

namespace aerogram::planner {

/// Visible layers as drones show them: all at one spacing, lines stood upon, areas with their outlines and insides.
struct LayerShares {
    std::vector<std::size_t> count;  ///< one a layer, their sum exact
    double spacing = 0.0;
};
/// How many of `count` drones each layer gets: as many as its length and area hold at the one spacing at which they are
/// `count` together. @param layers  at least one, as visible() gives them. @param count  >= 1.
/// @param density  over these coordinates: areas get drones by its mean; empty: even. Where it is 0 all over, it does
/// not count.
[[nodiscard]] LayerShares share_out(const std::vector<InkLayer>& layers, std::size_t count,
                                    std::optional<double> outline_share, const DensityField& density = {});

/// Exactly count[i] points on layer i, layer by layer. Where areas touch, the upper one's outline is stood upon.
/// @param density  over these coordinates; empty: even.
/// Properties: (1) counts exact (2) deterministic (3) points of areas are in the union of the areas to a fifth of a
/// spacing.
[[nodiscard]] std::vector<std::vector<Vec2>> layer_points(const std::vector<InkLayer>& layers,
                                                          const std::vector<std::size_t>& count,
                                                          std::optional<double> outline_share,
                                                          const DensityField& density, const Run& run);

/// Layers moved by -middle and then stretched.
[[nodiscard]] std::vector<InkLayer> placed(const std::vector<InkLayer>& layers, const Vec2& middle,
                                           const Vec2& stretch);

/// The box of all areas and lines.
[[nodiscard]] Bounds bounds_of(const std::vector<InkLayer>& layers);

}  // namespace aerogram::planner
