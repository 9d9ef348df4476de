#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"
#include "planner/mesh/cloud.hpp"
#include "planner/mesh/sharp_edges.hpp"
#include "planner/mesh/solid_sampling.hpp"
#include "planner/mesh/spread_apart.hpp"
#include "planner/mesh/surface_walk.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kLloydRounds = 14, kPushRounds = 160, kPushRoundsAtMost = 800;
constexpr std::size_t kPushWork = 800'000;  ///< points x rounds that may be spent when there are few points
constexpr double kSparsest = 0.04;          ///< share of the mean density below which points are no farther apart

}  // namespace

Points sample_surface(const TriangleMesh& mesh, std::size_t count, const DensityField& density, const Run& run) {
    AEROGRAM_REQUIRE(count >= 1);
    const Cloud cloud = cloud_of(mesh, pieces_for(count), density);
    const SurfaceWalk walk(mesh);
    std::vector<SurfacePlace> places;
    for (const std::size_t k : spread_by_mass(cloud, count)) places.push_back({cloud.pieces[k].at, cloud.pieces[k].of});
    Points points;
    for (const SurfacePlace& place : places) points.push_back(place.at);
    relax(
        points, 0, cloud, kLloydRounds,
        [&](std::size_t i, const Vec3& centre, const Cloud::Piece& piece) {
            return (places[i] = walk.towards({piece.at, piece.of}, centre)).at;
        },
        run);
    const double mean = cloud.mass / cloud.size;
    const auto reach_at = [&](const Vec3& p) {
        return density ? 1.0 / std::sqrt(std::max(density(p) / mean, kSparsest)) : 1.0;
    };
    std::vector<double> reach;
    for (const Vec3& p : points) reach.push_back(reach_at(p));
    const Ground ground{[&](std::size_t i) {
                            return Freedom{Freedom::Kind::plane, walk.normal(places[i].triangle)};
                        },
                        [&](std::size_t i, const Vec3& wanted) {
                            const SurfacePlace next = walk.towards(places[i], wanted);
                            if (density && density(next.at) < std::min(kSparsest * mean, density(places[i].at)))
                                return places[i].at;
                            places[i] = next;
                            return next.at;
                        }};
    spread_apart(points, reach, ground, std::clamp(kPushWork / count, kPushRounds, kPushRoundsAtMost), run);
    return points;
}

}  // namespace aerogram::planner
