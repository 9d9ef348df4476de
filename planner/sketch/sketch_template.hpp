#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sketch/sketch_region.hpp"

namespace aerogram::planner {

/// How densely a place of a sketch is to be filled, >= 0, relative to others (a brush); empty: alike everywhere.
using SketchDensity = std::function<double(const Vec2&)>;

struct TemplateOptions {
    std::optional<double> unit = std::nullopt;  ///< > 0, the sketch's unit; absent: automatic
    double p = 0.85;  ///< the p of equation 1: smaller means more of the agents on the boundary; (0, 1]
    SketchDensity density = {};
};

/// Highest density that counts, over the mean; its inverse is the lowest.
inline constexpr double kDensityContrast = 16.0;

/// The candidate places of a formation (paper 002, section 3.2): first those on the boundary, then the inside.
struct SketchTemplate {
    std::vector<Vec2> points;
    std::size_t boundary = 0;   ///< how many of the points are on the boundary
    double unit = 1.0;          ///< along the boundary
    double fill_unit = 1.0;     ///< of the lattice inside
    double inside_area = 0.0;   ///< of the lattice's places
    double mean_density = 0.0;  ///< over those; 0: they are spread evenly
    bool unit_changed = false;  ///< the unit asked for did not suit the number of agents
};

/// A template for exactly `count` agents: at most as many boundary points, and with the inside at least as many points.
///
/// The automatic unit is equation 1, p * rho / b, rho the length of the boundaries. Equation 2 is misprinted (its b²
/// and n² have positive coefficients, so b would be negative): with b' boundary points and f' points inside at any
/// small unit, a formation of b boundary points has (b / b')² f' = r² b² inside, r = sqrt(f') / b', as lengths grow
/// with 1/unit and areas with its square; so n = b + r² b² and b = (-1 + sqrt(1 + 4 r² n)) / (2 r²)
/// (boundary_count.hpp). r is measured on a first template and once more on one at the unit found, as places near the
/// boundary are left out and their share depends on the unit.
///
/// The paper leaves it to chance whether the template has places for all. Our rule: with fewer boundary points than
/// agents, the unit is made smaller until boundary and inside together hold them; a unit at which the boundary alone
/// has more points than there are agents is made larger; and where no unit does both (few agents, thin or no inside)
/// all agents stand on the boundary.
///
/// The paper's template is oversampled inside as much as the unit makes it (1 / p² and more), and what is not taken are
/// holes that relaxation, which acts on neighbours only, has to spread. Here the lattice inside is widened until it has
/// at most a tenth more places than there are agents for it, where that can be.
///
/// With a density the inside is a finer lattice of which a share is kept (error diffusion, Floyd and Steinberg 1976),
/// most where the density is highest; densities above kDensityContrast times the mean count as
/// that.
/// @param paths  as paths_of: at least one, of positive length. @param count  >= 1.
[[nodiscard]] SketchTemplate make_template(const SketchRegion& region, const std::vector<SketchPath>& paths,
                                           std::size_t count, const TemplateOptions& options);

}  // namespace aerogram::planner
