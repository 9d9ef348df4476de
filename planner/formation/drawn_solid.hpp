#pragma once
#include <functional>
#include <memory>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/formation/figure.hpp"
#include "planner/mesh/triangle_mesh.hpp"

namespace aerogram::planner {

/// A figure whose points depend on its proportions and take long to find: they are sought once for proportions that
/// differ by less than one part in a hundred, and stretched by the rest.
/// @param extent  natural width, depth and height. @param sample  the points, the box's middle at (0, 0, 0), after
/// stretching.
[[nodiscard]] Figure stretchable_figure(const Vec3& extent, std::function<Points(const Vec3& stretch)> sample);

/// A solid in one style, ready to be sampled.
struct DrawnSolid {
    std::function<Points(const Vec3& stretch)> sample;  ///< ref.part.drones points after stretching
    std::function<double(const Vec3& stretch, const Points& points)> coverage;  ///< as Figure::coverage
};
/// @param mesh  around (0, 0, 0). @param extent  of the figure that a density map lies over.
/// Errors: as solid_figure.
Result<DrawnSolid> drawn_solid(const PartRef& ref, const std::shared_ptr<const TriangleMesh>& mesh, SolidStyle style,
                               const Vec3& extent, const Run& run);

/// The box around the vertices that triangles use.
struct MeshBox {
    Vec3 low{}, high{};
    [[nodiscard]] Vec3 middle() const { return 0.5 * (low + high); }
    [[nodiscard]] Vec3 size() const { return high - low; }
};
/// @param mesh  with a triangle.
[[nodiscard]] MeshBox box_of(const TriangleMesh& mesh);

[[nodiscard]] TriangleMesh moved(TriangleMesh mesh, const Vec3& by);
[[nodiscard]] TriangleMesh stretched(TriangleMesh mesh, const Vec3& stretch);

/// The colours of a mesh's vertices at the places of it that are nearest to points; empty without any.
/// @param mesh  in the points' coordinates.
[[nodiscard]] std::function<std::vector<Rgb>(const Points& natural)> colors_of(
    const std::shared_ptr<const TriangleMesh>& mesh);

}  // namespace aerogram::planner
