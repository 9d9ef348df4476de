#include <optional>
#include <utility>

#include "geo/contract.hpp"
#include "planner/formation/solid_figure.hpp"
#include "planner/mesh/solids.hpp"

namespace aerogram::planner {
namespace {

std::optional<TriangleMesh> mesh_of(const ShapeSource& source) {
    switch (source.kind) {
        case ShapeKind::sphere:
            return sphere_mesh();
        case ShapeKind::dome:
            return dome_mesh(source.solid_style != SolidStyle::surface);
        case ShapeKind::cube:
            return cube_mesh();
        case ShapeKind::torus:
            return torus_mesh(source.inner);
        case ShapeKind::cylinder:
            return cylinder_mesh();
        case ShapeKind::cone:
            return cone_mesh();
        default:
            return std::nullopt;
    }
}

}  // namespace

Result<Figure> solid_shape_figure(const PartRef& ref, const ShapeSource& source, const Run& run) {
    auto mesh = mesh_of(source);
    AEROGRAM_REQUIRE(mesh, static_cast<int>(source.kind));
    return solid_figure(ref, std::move(*mesh), source.solid_style, run);
}

}  // namespace aerogram::planner
