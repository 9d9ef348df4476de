#pragma once
#include "geo/limits.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/motion/act.hpp"

namespace aerogram::planner {

struct ProjectionTask {
    double required_m = 0.0;        ///< separation to reach, in the metric
    SeparationMetric metric;
    double floor_z_m = -1e9;        ///< control points stay at or above (endpoints excepted)
    double ceiling_z_m = 1e9;
    std::uint64_t seed = 1;         ///< of the noise that breaks head-on symmetry
    int max_rounds = 400;
    /// Knots (0..K-3) where position, velocity and acceleration must stay as they are (keyframes a flow passes).
    std::vector<std::size_t> pinned_knots;
    Limits limits;                  ///< curvature and speed peaks are kept near those of the input's shortest timing
};
struct Projected {
    Lattice lattice;
    int rounds = 0;
    bool separated = false;         ///< bound_separation of the result >= required
};

/// Moves control points as little and as smoothly as it can until no two drones come closer than required: Sobolev
/// space-time projection (DESIGN.md 8). The first and last three rows never move.
/// Properties: (1) endpoints exact (2) an already separated input comes back unchanged (3) deterministic in seed.
/// Errors: stopped.
Result<Projected> project_separation(const Lattice& input, const ProjectionTask& task, const Run& run);

}  // namespace aerogram::planner
