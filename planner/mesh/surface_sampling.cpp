#include <algorithm>

#include "geo/contract.hpp"
#include "planner/mesh/edge_points.hpp"
#include "planner/mesh/solid_sampling.hpp"
#include "planner/mesh/spread_apart.hpp"
#include "planner/mesh/surface_points.hpp"

namespace aerogram::planner {
namespace {

constexpr double kFacing = 0.75;      ///< edges nearer to each other than this share of a step are drawn alternately
constexpr double kCoincident = 1e-6;  ///< lines without length: nothing can slide apart
constexpr std::size_t kSlideRounds = 200;

}  // namespace

Points sample_surface(const TriangleMesh& mesh, std::size_t count, const DensityField& density, const Run& run) {
    AEROGRAM_REQUIRE(count >= 1);
    SurfacePoints on_skin(mesh, count, density, run);
    Points points = on_skin.points();
    const Ground ground{[&](std::size_t i) { return on_skin.freedom(i); },
                        [&](std::size_t i, const Vec3& wanted) { return on_skin.move(i, wanted); }};
    const std::vector<double> reach = on_skin.reaches();
    spread_apart(points, reach, ground, targets_for(points, reach), spread_rounds(count), run);
    return points;
}

Points sample_edges(const TriangleMesh& mesh, std::size_t count) {
    AEROGRAM_REQUIRE(count >= 1);
    EdgePoints on_edges(mesh);
    const double step = on_edges.place(count);
    Points points = on_edges.points();
    const std::vector<double> reach(count, step);
    const double nearest = smallest_share(points, reach);
    if (on_edges.lines() > count || nearest >= kFacing || nearest < kCoincident) return points;
    const Ground ground{[&](std::size_t i) { return on_edges.freedom(i); },
                        [&](std::size_t i, const Vec3& wanted) { return on_edges.move(i, wanted); }};
    spread_apart(points, reach, ground, {}, kSlideRounds, {});
    return points;
}

bool has_sharp_edges(const TriangleMesh& mesh) {
    return !EdgePoints(mesh).none();
}

}  // namespace aerogram::planner
