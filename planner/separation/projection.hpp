#pragma once
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "geo/airspace.hpp"
#include "geo/limits.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/motion/act.hpp"
#include "planner/motion/certificate.hpp"

namespace aerogram::planner {

/// Speed and acceleration limits that hold when one knot interval takes step_s.
struct MotionLimits {
    Limits limits;
    double step_s = 0.0;
};

struct ProjectionTask {
    double required_m = 0.0;  ///< separation to reach, in the metric
    SeparationMetric metric;
    double floor_z_m = -1e9;   ///< control points stay at or above, ends excepted
    double ceiling_z_m = 1e9;  ///< and at or below
    std::uint64_t seed = 1;    ///< of the noise that breaks head-on symmetry
    int max_rounds = 400;
    double most_work = 300'000.0;  ///< before giving up: chord checks a drone (1-2 ms), of at least 2,000 drones
    double smoothing_knots = 0.0;  ///< W, width over which a correction spreads; 0: rows / 17
    std::size_t samples_per_interval = 1;  ///< chords a knot interval: 1 for matched maps, 2 otherwise
    /// Inner knots (3..K-6) whose positions stay as they are: the keyframes that a flow passes. Velocities there may
    /// change; the band does not apply to the three rows that carry one.
    std::vector<std::size_t> held_knots;
    /// Where given, the projection tries to hold these too, so that separating does not lengthen the act. Where it
    /// cannot have both it separates.
    std::optional<MotionLimits> motion;
    geo::Airspace airspace;          ///< fence, audience and obstacles that the interior keeps clear of
    double airspace_margin_m = 0.0;  ///< by this much, or as much as its own ends do
};

struct Projected {
    Lattice lattice;
    int rounds = 0;
    double lower_bound_m = 0.0;        ///< bound_separation of the result; 0 where it was given up too crowded to bound
    bool separated = false;            ///< keeps(lower_bound_m, required) and all free rows are in the band
    std::optional<Encounter> closest;  ///< time_s: share of the act
    bool limits_held = true;           ///< speed and acceleration, to 0.5 %
    bool airspace_held = true;         ///< on the chords; the certificate judges the curves
    /// Pairs (lattice's numbers, first < second) that are still too close; at most 4 a drone, closest time unknown.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> stuck;

    [[nodiscard]] bool holds_all() const { return separated && limits_held && airspace_held; }
};

/// Moves control points as little and as smoothly as it can until no two drones come closer than required and the
/// interior holds the other constraints: Sobolev space-time projection (DESIGN.md 8). The first and last three rows
/// never move, whether they rest or ride.
/// Corrections push apart, at the chords' closest approach, the pairs that come too close, and are spread over W knots
/// of time by (I + W⁴ D₂ᵀD₂)⁻¹, so that the motion stays as smooth as it was; limits, band and airspace push through
/// the same filter. A fleet that contracts to less room than it needs is first blown up there.
/// Properties: (1) endpoints exact (2) an input that holds everything comes back unchanged (3) deterministic in seed,
/// whatever the thread count. Errors: stopped.
/// Cost: 10,000 optimally matched drones 0.3-1.8 s, certificate included; near linear. Gives up when
/// 60 rounds bring no progress, or at most_work (20,000 drones: about half a minute).
Result<Projected> project_separation(const Lattice& input, const ProjectionTask& task, const Run& run);

}  // namespace aerogram::planner
