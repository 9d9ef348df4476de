#pragma once
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/transition/interpolation.hpp"
#include "planner/transition/spectral.hpp"

namespace aerogram::planner {

/// As-rigid-as-possible transition between two keyframes: groups turn, swap and swing as bodies (DESIGN.md 7, rigid).
/// Union of the two graphs, weights as edited. Per vertex the best rotation R_i of its one-ring from source to target;
/// each edge goes in its vertex' frame linearly from e_S to R_iᵀ e_T and is turned by slerp(I, R_i, t); the mean of its
/// two ends' predictions is the edge wished for; positions solve one weighted graph-Laplacian system (CHOLMOD: factored
/// once, three right-hand sides an instant) about the straight-moving barycentre.
/// Properties: (1) t = 0 and 1 are the keyframes to 1e-9 m (2) a rigid motion of the whole fleet is flown rigidly (3)
/// rigid motions commute (4) n = 1, 2, 3, collinear, coplanar and disconnected graphs work (5) deterministic.
/// Errors: stopped.
Result<Interpolation> rigid_transition(const SpectralKeyframe& source, const SpectralKeyframe& target, const Run& run);

}  // namespace aerogram::planner
