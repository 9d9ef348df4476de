#pragma once
#include <cstdint>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/separation/projection.hpp"

namespace aerogram::planner {

struct SocialForceTask {
    double required_m = 0.0;  ///< separation wished for, in the metric
    SeparationMetric metric;
    double floor_z_m = -1e9;   ///< control points that may move stay at or above
    double ceiling_z_m = 1e9;  ///< and at or below
    std::uint64_t seed = 1;    ///< of the fluctuations that break head-on symmetry
    int max_rounds = 6;        ///< simulations, each with repulsion twice as strong as the one before
};

/// Lets the drones follow their reference motion as pedestrians would who keep clear of each other: a driving force
/// towards where the reference will be, a repulsive force from each neighbour that grows as they approach (an ellipse
/// along their relative motion), simulated in time over a neighbour grid; the deviation is then smoothed and added to
/// the reference. Simulations with stronger repulsion follow until the separation holds; the best is returned.
/// Nothing is guaranteed: `separated` says whether it holds, else the projection may take over from the result.
/// @param reference  K >= 9 rows; its first and last three are kept.
/// Properties: (1) ends exact (2) a reference that is separated comes back unchanged (3) deterministic in seed (4)
/// never closer than the reference.
/// Errors: stopped. Cost: linear in drones at a given density, 10,000 drones: seconds a round.
/// Source: Takahashi et al. 2009, section 4.3; Helbing and Molnár 1995 with the relative motion of Johansson et al.
/// 2007. Where we differ: in the metric's space; no field of view; lengths and times are scaled so that a drone is a
/// person 0.6 m wide who walks at 1.34 m/s.
Result<Projected> ease_by_social_forces(const Lattice& reference, const SocialForceTask& task, const Run& run);

}  // namespace aerogram::planner
