#include <algorithm>
#include <cmath>
#include <numbers>

#include "geo/contract.hpp"
#include "planner/mesh/cloud.hpp"
#include "planner/mesh/mesh_measure.hpp"
#include "planner/mesh/solid_sampling.hpp"
#include "planner/mesh/spread_apart.hpp"
#include "planner/mesh/surface_points.hpp"
#include "planner/mesh/volume_walk.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kLloydRounds = 12;
constexpr double kHexagon = 0.8660254037844386;   ///< area of a flat lattice's cell at spacing 1
constexpr double kOnSkin = 0.80, kInside = 0.85;  ///< shares of the densest packings' numbers that relaxed points reach
constexpr double kSkinDepth = 0.45;               ///< spacings deep is the layer that belongs to the skin's points
constexpr double kSparsest = 0.04;                ///< share of the mean density below which points are no farther apart

double area_of(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) sum += area_of(mesh, t);
    return sum;
}

/// How many of `count` points belong to the skin so that skin and inside have one spacing.
std::size_t count_on_skin(double area, double volume, std::size_t count) {
    if (count == 1) return 0;
    double low = 0.0,
           high = 4.0 * (std::cbrt(volume / static_cast<double>(count)) + std::sqrt(area / static_cast<double>(count)));
    double on_skin = 0.0;
    for (int step = 0; step < 60; ++step) {
        const double spacing = 0.5 * (low + high);
        on_skin = kOnSkin * area / (kHexagon * spacing * spacing);
        const double deep = std::max(volume - kSkinDepth * spacing * area, 0.0);
        const double inside = kInside * deep * std::numbers::sqrt2 / (spacing * spacing * spacing);
        (on_skin + inside > static_cast<double>(count) ? low : high) = spacing;
    }
    return std::min(static_cast<std::size_t>(std::lround(on_skin)), count);
}

/// The same field as points on a skin feel it, whose spacing is to be that of the points inside.
DensityField on_skin_of(const DensityField& density) {
    if (!density) return {};
    return [density](const Vec3& p) { return std::pow(density(p), 2.0 / 3.0); };
}

}  // namespace

Points sample_volume(const TetrahedralMesh& inside, std::size_t count, const DensityField& density, const Run& run) {
    AEROGRAM_REQUIRE(count >= 1);
    const Cloud cloud = cloud_of(inside, pieces_for(count), density);
    const VolumeWalk walk(inside);
    const TriangleMesh skin = walk.skin();
    const DensityField skin_density = on_skin_of(density);
    const std::size_t fixed = count_on_skin(area_of(skin), cloud.size, count);
    SurfacePoints on_skin(skin, std::max<std::size_t>(fixed, 1), skin_density, run);
    Points points(on_skin.points().begin(), on_skin.points().begin() + static_cast<std::ptrdiff_t>(fixed));

    std::vector<VolumePlace> places(fixed);
    for (const std::size_t k : spread_by_mass(cloud, count - fixed)) {
        places.push_back({cloud.pieces[k].at, cloud.pieces[k].of});
        points.push_back(places.back().at);
    }
    const auto settle = [&](std::size_t i, const Vec3& centre, const Cloud::Piece& piece) {
        return (places[i] = walk.towards({piece.at, piece.of}, centre)).at;
    };
    if (fixed < count) relax(points, fixed, cloud, kLloydRounds, settle, run);

    const double mean = cloud.mass / cloud.size;
    std::vector<double> reach(count, 1.0);
    for (std::size_t i = 0; density && i < count; ++i)
        reach[i] = 1.0 / std::cbrt(std::max(density(points[i]) / mean, kSparsest));
    const Ground ground{[&](std::size_t i) { return i < fixed ? on_skin.freedom(i) : Freedom{}; },
                        [&](std::size_t i, const Vec3& wanted) {
                            if (i < fixed) return on_skin.move(i, wanted);
                            const VolumePlace next = walk.towards(places[i], wanted);
                            const bool empty =
                                density && density(next.at) < std::min(kSparsest * mean, density(points[i]));
                            return empty ? places[i].at : (places[i] = next).at;
                        }};
    spread_apart(points, reach, ground, targets_for(points, reach), spread_rounds(count), run);
    return points;
}

}  // namespace aerogram::planner
