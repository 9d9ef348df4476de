#pragma once
#include <span>
#include <vector>

#include "planner/transition/rigid_graph.hpp"
#include "planner/transition/turn.hpp"

namespace aerogram::planner {

/// How each individual's surroundings turn from the source to the target: the rotation that fits the directions to its
/// neighbours best, joined to its neighbours' rotations so that what a flat or straight ring leaves open follows them
/// (a half turn of a lone line goes about the thinnest axis of the source). Angles are in [0, 2 pi]: each turn is
/// written with the branch nearest to those of its neighbours, found by a walk over the graph that takes the smallest
/// difference first. A component's walk begins at its smallest angle; a beginning beyond 2/3 pi takes the way that
/// turns least as seen from the ground, where the fleet as a whole turns by `fleet` at the same time.
/// @param source_m, target_m  by individual; the turn of the whole fleet already taken out of the target.
/// Properties: (1) equal keyframes give angles of 0 to rounding error (2) a component moved rigidly has one turn
/// (3) permuting individuals permutes turns (generic input).
[[nodiscard]] std::vector<Turn> ring_turns(const RingGraph& graph, std::span<const Vec3> source_m,
                                           std::span<const Vec3> target_m, const Turn& fleet);

}  // namespace aerogram::planner
