#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/adjacency/obstacle_vertices.hpp"
#include "planner/leg.hpp"
#include "planner/transition/interpolation.hpp"
#include "planner/transition/spectral.hpp"

namespace aerogram::planner {

/// A leg's path as its method draws it, before anybody is kept apart: computed once, then sampled at any resolution.
class LegShape {
  public:
    /// @param method  straight, spectral, rigid or steered; the leg's groups move in their own ways inside it.
    /// Errors: invalid_input when groups of the arrival overlap; those of graph_keyframe; stopped.
    static Result<LegShape> of(const Mission& mission, const Route& route, const Leg& leg, Method method,
                               const Run& run);

    /// @param rows  control rows, >= 9.  @param stagger_share  the last drones start this share of the act's duration
    /// after the first; 0 unless the shape is straight.
    [[nodiscard]] Lattice lattice(std::size_t rows, double stagger_share = 0.0) const;

  private:
    LegShape() = default;
    [[nodiscard]] Lattice straight(std::size_t rows, double stagger_share) const;

    Points from_m_, to_m_;
    ProfileKind profile_ = ProfileKind::minimum_jerk;
    std::vector<double> delay_;                   ///< by drone, [0, 1]: whose turn it is when starts are staggered
    std::optional<Interpolation> interpolation_;  ///< absent: straight lines
};

/// A place as transitions see it: where each drone is, and who its neighbours are there after the designer's edits.
/// Nobody is a neighbour through an obstacle of the airspace (obstacle_walls.hpp), unless an edit joins them.
/// @param obstacles  those that are vertices too. On a carrier there are none: they stand in the ground frame.
/// Errors: those of adjacency_around.
Result<SpectralKeyframe> graph_keyframe(const Mission& mission, const Route& route, const Points& by_drone_m,
                                        const Run& run, std::span<const ObstacleVertex> obstacles = {});

}  // namespace aerogram::planner
