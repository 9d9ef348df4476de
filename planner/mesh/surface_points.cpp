#include "planner/mesh/surface_points.hpp"

#include <algorithm>
#include <cmath>

#include "planner/mesh/cloud.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kLloydRounds = 14;
constexpr double kHexagon = 0.8660254037844386;   ///< area of a lattice's cell at spacing 1
constexpr double kReached = 0.93;                 ///< share of the lattice's spacing that relaxed points reach
constexpr double kSparsest = 0.04;                ///< share of the mean density below which points are no farther apart
constexpr std::size_t kFew = 40;                  ///< so few points may all stand on edges
constexpr double kOnEdges = 0.75, kOnTips = 0.5;  ///< shares of more points that may: else facets are a round thing's

}  // namespace

SurfacePoints::SurfacePoints(const TriangleMesh& mesh, std::size_t count, const DensityField& density, const Run& run)
    : walk_(mesh), edges_(mesh), density_(density) {
    const Cloud cloud = cloud_of(mesh, pieces_for(count), density);
    mean_ = cloud.mass / cloud.size;
    if (!density) place_on_edges(cloud.size, count);
    points_ = edges_.points();
    const std::size_t fixed = points_.size();
    for (const Vec3& p : points_) places_.push_back({p, 0});
    for (const std::size_t k : spread_by_mass(cloud, count - fixed)) {
        places_.push_back({cloud.pieces[k].at, cloud.pieces[k].of});
        points_.push_back(places_.back().at);
    }
    if (fixed == count) return;
    const auto settle = [&](std::size_t i, const Vec3& centre, const Cloud::Piece& piece) {
        return (places_[i] = walk_.towards({piece.at, piece.of}, centre)).at;
    };
    relax(points_, fixed, cloud, kLloydRounds, settle, run);
}

void SurfacePoints::place_on_edges(double area, std::size_t count) {
    const double step = kReached * std::sqrt(area / (kHexagon * static_cast<double>(count)));
    const auto at_most = [&](double share) {
        return count <= kFew ? count : static_cast<std::size_t>(share * static_cast<double>(count));
    };
    edges_.place_by_step(step, true, at_most(kOnEdges));
    if (edges_.points().empty()) edges_.place_by_step(step, false, at_most(kOnTips));
}

Freedom SurfacePoints::freedom(std::size_t i) const {
    if (i < edges_.points().size()) return edges_.freedom(i);
    return {Freedom::Kind::plane, walk_.normal(places_[i].triangle)};
}

Vec3 SurfacePoints::move(std::size_t i, const Vec3& wanted) {
    if (i < edges_.points().size()) return edges_.move(i, wanted);
    const SurfacePlace next = walk_.towards(places_[i], wanted);
    if (density_ && density_(next.at) < std::min(kSparsest * mean_, density_(places_[i].at))) return places_[i].at;
    places_[i] = next;
    return next.at;
}

std::vector<double> SurfacePoints::reaches() const {
    std::vector<double> out(points_.size(), 1.0);
    for (std::size_t i = 0; density_ && i < points_.size(); ++i)
        out[i] = 1.0 / std::sqrt(std::max(density_(points_[i]) / mean_, kSparsest));
    return out;
}

}  // namespace aerogram::planner
