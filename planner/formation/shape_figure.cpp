#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/units.hpp"
#include "planner/formation/area_figure.hpp"
#include "planner/formation/figure.hpp"
#include "planner/formation/wave_figure.hpp"
#include "planner/mesh/solid_sampling.hpp"
#include "planner/mesh/solids.hpp"
#include "planner/sampling/area_shapes.hpp"
#include "planner/sampling/curve.hpp"
#include "planner/sampling/sphere_points.hpp"

namespace aerogram::planner {
namespace {

double real(std::size_t n) {
    return static_cast<double>(n);
}

/// Along x, left to right.
Figure line_figure(std::size_t drones) {
    const double length = drones > 1 ? 1.0 : 0.0;
    return {.extent = {length, 0.0, 0.0}, .points = [drones](const Vec3& scale) {
                Points points;
                for (std::size_t i = 0; i < drones; ++i) {
                    const double share = drones > 1 ? real(i) / real(drones - 1) - 0.5 : 0.0;
                    points.emplace_back(share * scale.x, 0.0, 0.0);
                }
                return points;
            }};
}

struct GridShape {
    std::size_t rows = 1, columns = 1;
};

/// The grid whose spacings across and up are most alike in a box of the given width/height; of equals the fullest.
GridShape best_grid(std::size_t drones, double aspect) {
    GridShape best;
    double best_cost = 1e300;
    for (std::size_t columns = 1; columns <= drones; ++columns) {
        const std::size_t rows = (drones + columns - 1) / columns;
        if ((drones + rows - 1) / rows != columns) continue;  // the same rows with fewer columns hold them as well
        const double width = std::max(real(columns - 1), 0.5), height = std::max(real(rows - 1), 0.5);
        const double empty = real(rows * columns - drones) / real(drones);
        const double cost = std::abs(std::log(width / height / aspect)) + 1e-6 * empty;
        if (cost < best_cost) {
            best_cost = cost;
            best = {rows, columns};
        }
    }
    return best;
}

Result<GridShape> grid_shape(const PartRef& ref, const ShapeSource& source) {
    const std::size_t drones = ref.part.drones;
    const Size& size = ref.part.size;
    if (!source.rows && !source.columns) {
        const bool box = size.width_m && size.height_m && *size.width_m > 0.0 && *size.height_m > 0.0;
        return best_grid(drones, box ? *size.width_m / *size.height_m : 1.0);
    }
    const auto ceil_divide = [](std::size_t a, std::size_t b) { return (a + b - 1) / b; };
    GridShape grid;
    grid.columns = source.columns ? *source.columns : ceil_divide(drones, *source.rows);
    grid.rows = source.rows ? *source.rows : ceil_divide(drones, *source.columns);
    const std::size_t needed_rows = ceil_divide(drones, grid.columns);
    if (needed_rows == grid.rows) return grid;
    return ref.error(": a grid of rows = " + std::to_string(grid.rows) + ", columns = " + std::to_string(grid.columns) +
                     " does not suit " + std::to_string(drones) + " drones; columns = " + std::to_string(grid.columns) +
                     " needs rows = " + std::to_string(needed_rows));
}

/// Upright, top row first, each row left to right, an incomplete last row centred.
Figure grid_figure(GridShape grid, std::size_t drones) {
    return {.extent = {real(grid.columns - 1), 0.0, real(grid.rows - 1)}, .points = [grid, drones](const Vec3& scale) {
                Points points;
                for (std::size_t i = 0; i < drones; ++i) {
                    const std::size_t row = i / grid.columns;
                    const std::size_t in_row = std::min(grid.columns, drones - row * grid.columns);
                    const double x = real(i % grid.columns) - 0.5 * real(in_row - 1);
                    points.emplace_back(x * scale.x, 0.0, (0.5 * real(grid.rows - 1) - real(row)) * scale.z);
                }
                return points;
            }};
}

/// Upright, from the top clockwise as the audience sees it.
Figure circle_figure(std::size_t drones) {
    return {.extent = {1.0, 0.0, 1.0}, .points = [drones](const Vec3& scale) {
                const auto curve = [&scale](double t) {
                    return Vec3(0.5 * scale.x * std::sin(2.0 * kPi * t), 0.0, 0.5 * scale.z * std::cos(2.0 * kPi * t));
                };
                if (scale.x != scale.z) return equally_spaced(curve, drones, true);
                Points points;
                for (std::size_t i = 0; i < drones; ++i) points.push_back(curve(real(i) / real(drones)));
                return points;
            }};
}

/// Around the z axis from the bottom up, counter-clockwise seen from above, beginning on the right (+x).
Figure helix_figure(std::size_t drones, double turns) {
    return {.extent = {1.0, 1.0, 1.0}, .points = [drones, turns](const Vec3& scale) {
                const auto curve = [&scale, turns](double t) {
                    const double angle = 2.0 * kPi * turns * t;
                    return scale * Vec3(0.5 * std::cos(angle), 0.5 * std::sin(angle), t - 0.5);
                };
                if (scale.x != scale.y) return equally_spaced(curve, drones, false);
                Points points;
                for (std::size_t i = 0; i < drones; ++i) {
                    points.push_back(curve(drones > 1 ? real(i) / real(drones - 1) : 0.0));
                }
                return points;
            }};
}

/// Archimedes', upright, from the middle out to the top, clockwise as the audience sees it.
Figure spiral_figure(std::size_t drones, double turns) {
    const auto curve = [turns](double t) {
        const double angle = 2.0 * kPi * turns * (t - 1.0);
        return 0.5 * t * Vec3(std::sin(angle), 0.0, std::cos(angle));
    };
    const auto steps = 4096 + static_cast<std::size_t>(256.0 * turns);
    Vec3 low{}, high{};
    for (std::size_t i = 0; i <= steps; ++i) {
        const Vec3 p = curve(real(i) / real(steps));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const Vec3 middle = 0.5 * (low + high);
    return {.extent = high - low, .points = [curve, middle, steps, drones](const Vec3& scale) {
                return equally_spaced([&](double t) { return scale * (curve(t) - middle); }, drones, false, steps);
            }};
}

Figure sphere_figure(std::size_t drones, const Run& run) {
    return {.extent = {1.0, 1.0, 1.0},
            .points = [drones, run](const Vec3& scale) { return spread_on_ellipsoid(0.5 * scale, drones, run); },
            .coverage =
                [](const Vec3& scale, const Points& points) {
                    TriangleMesh mesh = sphere_mesh();
                    for (Vec3& p : mesh.vertices) p *= scale;
                    return mean_distance(mesh, points);
                }};
}

}  // namespace

Result<Figure> shape_figure(const PartRef& ref, const ShapeSource& source, const Run& run) {
    const std::size_t drones = ref.part.drones;
    switch (source.kind) {
        case ShapeKind::line:
            return line_figure(drones);
        case ShapeKind::circle:
            return circle_figure(drones);
        case ShapeKind::sphere:
            if (source.solid_style != SolidStyle::surface || !ref.part.density.even())
                return solid_shape_figure(ref, source, run);
            return sphere_figure(drones, run);
        case ShapeKind::spiral:
            return spiral_figure(drones, source.turns);
        case ShapeKind::wave:
            return wave_figure(drones, source.waves, run);
        case ShapeKind::helix:
            return helix_figure(drones, source.turns);
        case ShapeKind::disc:
            return area_figure(ref, disc_region(), source.area_style, source.outline_share, run);
        case ShapeKind::ring:
            return area_figure(ref, ring_region(source.inner), source.area_style, source.outline_share, run);
        case ShapeKind::square:
            return area_figure(ref, square_region(), source.area_style, source.outline_share, run);
        case ShapeKind::polygon:
            return area_figure(ref, polygon_region(source.sides), source.area_style, source.outline_share, run);
        case ShapeKind::star:
            return area_figure(ref, star_region(source.sides, source.inner), source.area_style, source.outline_share,
                               run);
        case ShapeKind::heart:
            return area_figure(ref, heart_region(), source.area_style, source.outline_share, run);
        case ShapeKind::grid:
            break;
        case ShapeKind::dome:
        case ShapeKind::cube:
        case ShapeKind::torus:
        case ShapeKind::cylinder:
        case ShapeKind::cone:
            return solid_shape_figure(ref, source, run);
    }
    const auto grid = grid_shape(ref, source);
    if (!grid) return grid.error();
    return grid_figure(*grid, drones);
}

}  // namespace aerogram::planner
