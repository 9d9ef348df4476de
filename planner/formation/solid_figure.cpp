#include "planner/formation/solid_figure.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "planner/formation/drawn_solid.hpp"
#include "planner/mesh/solids.hpp"

namespace aerogram::planner {

Result<Figure> solid_figure(const PartRef& ref, TriangleMesh mesh, SolidStyle style, const Run& run) {
    const MeshBox box = box_of(mesh);
    const auto skin = std::make_shared<const TriangleMesh>(moved(std::move(mesh), -box.middle()));
    auto drawn = drawn_solid(ref, skin, style, box.size(), run);
    if (!drawn) return drawn.error();
    Figure figure = stretchable_figure(box.size(), std::move(drawn->sample));
    figure.coverage = std::move(drawn->coverage);
    figure.colors_at = colors_of(skin);
    return figure;
}

Result<Figure> extruded_figure(const PartRef& ref, const Region& region, const Run& run) {
    const Size& size = ref.part.size;
    const Vec2 extent = bounds_of(region).size();
    // As sizing will stretch it: of two sides given the smaller scale rules.
    std::optional<double> scale;
    if (size.width_m && extent.x > 0.0) scale = *size.width_m / extent.x;
    if (size.height_m && extent.y > 0.0) scale = std::min(scale.value_or(1e300), *size.height_m / extent.y);
    if (!size.depth_m || !scale) return ref.error(".size_m: style = \"solid\" needs a depth and a width or height");
    return solid_figure(ref, extruded(region, *size.depth_m / *scale), SolidStyle::surface, run);
}

}  // namespace aerogram::planner
