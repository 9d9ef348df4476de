#pragma once
#include <memory>
#include <span>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "geo/vec3.hpp"
#include "planner/adjacency/adjacency.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// A keyframe as a spectral transition sees it: where each DRONE is and who its neighbours are there.
struct SpectralKeyframe {
    Points positions_m;    ///< n >= 1, by drone
    AdjacencyGraph graph;  ///< n individuals; may be disconnected
};

/// Spectral formation interpolation between two keyframes: the Laplacian eigenbasis turns by R^t, its coefficients go
/// by norm and slerp, the barycentre goes straight, the alignment is undone by one slerp. Source: Takahashi et al.
/// 2009, sections 3, 4.2, 4.5; where we differ: DESIGN.md 7 (Procrustes inside eigenspaces, sign rule, R^t by planes,
/// Kabsch alignment, optimal reordering). Properties: (1) at(0), at(1) are the keyframes to 1e-9 m (2) R^1 = T Sᵀ to
/// 1e-10, (R^½)² = R (3) a rigid motion of both keyframes moves the result rigidly, unless a half turn has to go about
/// a show axis because the formation is a line or has no thinnest direction (alignment.hpp, coefficient_path.hpp) (4)
/// RMS² = Σ((1-t) r_S + t r_T)²/n to 1e-9, unless inflate (5) n = 1, 2, 3, collinear, coplanar, disconnected graphs,
/// repeated eigenvalues all work (6) deterministic.
class SpectralTransition {
  public:
    /// Errors: stopped.
    static Result<SpectralTransition> between(const SpectralKeyframe& source, const SpectralKeyframe& target,
                                              const SpectralOptions& options, const Run& run);
    SpectralTransition(SpectralTransition&&) noexcept;
    SpectralTransition& operator=(SpectralTransition&&) noexcept;
    ~SpectralTransition();

    /// Positions by drone at share t in [0, 1]. @param out  n places. Two n×n by n×3 products.
    void at(double t, std::span<Vec3> out) const;
    /// R^t as a dense n×n matrix, column-major (tests and studies).
    [[nodiscard]] std::vector<double> rotation_power(double t) const;

  private:
    struct Impl;
    explicit SpectralTransition(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace aerogram::planner
