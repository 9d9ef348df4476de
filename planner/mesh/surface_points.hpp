#pragma once
#include <cstddef>
#include <vector>

#include "planner/mesh/edge_points.hpp"
#include "planner/mesh/surface_walk.hpp"
#include "planner/sampling/density_field.hpp"

namespace aerogram::planner {

/// Points spread over a surface by Lloyd's relaxation, some on its sharp edges and corners; they can be moved along it.
class SurfacePoints {
  public:
    /// @param mesh, density  must outlive it.
    SurfacePoints(const TriangleMesh& mesh, std::size_t count, const DensityField& density, const Run& run);

    [[nodiscard]] const Points& points() const { return points_; }
    [[nodiscard]] Freedom freedom(std::size_t i) const;
    /// Nobody goes where the density wants nobody.
    Vec3 move(std::size_t i, const Vec3& wanted);
    /// The distances that points are to keep, relative to those where the density is the mean.
    [[nodiscard]] std::vector<double> reaches() const;

  private:
    /// The points on edges and corners, spaced as `count` points on all of the surface are.
    void place_on_edges(double area, std::size_t count);

    SurfaceWalk walk_;
    EdgePoints edges_;
    const DensityField& density_;
    double mean_ = 1.0;  ///< density
    Points points_;      ///< those on edges first
    std::vector<SurfacePlace> places_;
};

}  // namespace aerogram::planner
