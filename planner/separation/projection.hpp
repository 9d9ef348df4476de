#pragma once
#include <cstdint>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/motion/act.hpp"

namespace aerogram::planner {

struct ProjectionTask {
    double required_m = 0.0;  ///< separation to reach, in the metric
    SeparationMetric metric;
    double floor_z_m = -1e9;   ///< control points stay at or above, ends excepted
    double ceiling_z_m = 1e9;  ///< and at or below
    std::uint64_t seed = 1;    ///< of the noise that breaks head-on symmetry
    int max_rounds = 400;
    double smoothing_knots = 0.0;          ///< W, width over which a correction spreads; 0: rows / 17
    std::size_t samples_per_interval = 1;  ///< chords a knot interval: 1 for matched maps, 2 otherwise
    /// Inner knots (3..K-6) whose positions stay as they are: the keyframes that a flow passes. Velocities there may
    /// change; the band does not apply to the three rows that carry one.
    std::vector<std::size_t> held_knots;
};
struct Projected {
    Lattice lattice;
    int rounds = 0;
    double lower_bound_m = 0.0;  ///< bound_separation of the result
    bool separated = false;      ///< keeps(lower_bound_m, required) and all free rows are in the band
};

/// Moves control points as little and as smoothly as it can until no two drones come closer than required: Sobolev
/// space-time projection (DESIGN.md 8). The first and last three rows never move.
/// Corrections push apart, at the chords' closest approach, the pairs that come too close, and are spread over W knots
/// of time by (I + W⁴ D₂ᵀD₂)⁻¹, so that the motion stays as smooth as it was. Properties: (1) endpoints exact (2) an
/// already separated input comes back unchanged (3) deterministic in seed. Errors: stopped.
Result<Projected> project_separation(const Lattice& input, const ProjectionTask& task, const Run& run);

}  // namespace aerogram::planner
