#pragma once
#include <memory>
#include <span>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "geo/vec3.hpp"
#include "planner/adjacency/adjacency.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// A keyframe as a spectral transition sees it: where each DRONE is and who its neighbours are there. Obstacles may be
/// vertices of the graph too, so that drones keep their clearance of them as they keep to one another (paper 000,
/// section 5.3): see obstacle_adjacency.
struct SpectralKeyframe {
    Points positions_m;    ///< n >= 1, by drone
    AdjacencyGraph graph;  ///< n individuals, then the fixed vertices; may be disconnected
    Points fixed_m = {};   ///< vertices that stay where they are: the same in both keyframes; none in flows
};

/// Up to this many individuals every mode turns; above, the kLowModes lowest ones (and what shares their eigenvalues).
inline constexpr std::size_t kFullBasis = 2500;
inline constexpr std::size_t kLowModes = 128;

/// Spectral formation interpolation between two keyframes: the Laplacian eigenbasis turns by R^t, its coefficients go
/// by norm and slerp, the barycentre goes straight, the alignment is undone by one slerp. Source: Takahashi et al.
/// 2009, sections 3, 4.2, 4.5; where we differ: DESIGN.md 7 (Procrustes inside eigenspaces, sign rule, R^t by planes,
/// Kabsch alignment, optimal reordering). Properties: (1) at(0), at(1) are the keyframes to 1e-9 m (2) R^1 = T Sᵀ to
/// 1e-10, (R^½)² = R (3) a rigid motion of both keyframes moves the result rigidly, unless a half turn has to go about
/// a show axis because the formation is a line or has no thinnest direction (alignment.hpp, coefficient_path.hpp) (4)
/// RMS² = Σ((1-t) r_S + t r_T)²/n to 1e-9, unless inflate (5) n = 1, 2, 3, collinear, coplanar, disconnected graphs,
/// repeated eigenvalues all work (6) deterministic.
/// Few modes of many: the rotation then acts inside the span of both keyframes' low modes and takes the one's to the
/// other's by the smallest turn (subspace_turn.hpp); what those modes do not tell of the formations, the detail, goes
/// straight in the same aligned frame. (7) with all modes that is the full transition to 1e-9 m; (4) then holds for the
/// modes' part alone.
/// Fixed vertices: the transition moves them along with everybody; by so much as each is off, its neighbours are moved
/// back with it, the shift spread over both graphs harmonically (harmonic_pull). One obstacle: the fleet is translated
/// so that it stands still. (8) drones that the graph does not join to an obstacle are not shifted, the ends stay, and
/// no shift is longer than the farthest obstacle's.
/// Cost, CPU seconds of one core: 2,500 individuals 23 to prepare, 0.016 a frame alone, 0.12 for 63 frames at once;
/// 10,000 with 128 modes 4 (grid to sphere) to 11 (to one long chain), then 0.05 for 63 frames.
class SpectralTransition {
  public:
    /// Errors: stopped.
    static Result<SpectralTransition> between(const SpectralKeyframe& source, const SpectralKeyframe& target,
                                              const SpectralOptions& options, const Run& run);
    /// The same with the lowest `modes` modes (whole eigenspaces: low_modes.hpp); n - 1 or more: all.
    static Result<SpectralTransition> with_modes(const SpectralKeyframe& source, const SpectralKeyframe& target,
                                                 const SpectralOptions& options, std::size_t modes, const Run& run);
    SpectralTransition(SpectralTransition&&) noexcept;
    SpectralTransition& operator=(SpectralTransition&&) noexcept;
    ~SpectralTransition();

    /// Positions by drone at share t in [0, 1]. @param out  n places. Two n×n by n×3 products.
    void at(double t, std::span<Vec3> out) const;
    /// The same for many instants, whose products are done together: several times faster. @param out  a row each.
    void sample(std::span<const double> shares, std::span<Vec3> out) const;
    /// R^t as a dense matrix over all individuals, column-major (tests and studies).
    [[nodiscard]] std::vector<double> rotation_power(double t) const;

  private:
    struct Impl;
    explicit SpectralTransition(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace aerogram::planner
