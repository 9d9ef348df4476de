#pragma once
#include <span>
#include <vector>

#include "planner/transition/alignment.hpp"
#include "planner/transition/catmull_rom.hpp"
#include "planner/transition/plane_rotation.hpp"
#include "planner/transition/spectral.hpp"

namespace aerogram::planner {

/// Spectral interpolation through several keyframes in the cumulative form: with R_j from keyframe j's basis to j + 1's
/// and the weights c of equation 5, on the leg from keyframe f with neighbours b and a, M = R_to^{c_a} R_from^{c_to +
/// c_a} R_b^{c_from + c_to + c_a} M_b; bases before b are passed for good (exponent 1), those after a not begun
/// (exponent 0). Orientations go by the same form with the alignment turns. Coefficients are blended as 3-vectors in
/// the aligned frame: unlike norms and directions on great circles, which turn a corner at every keyframe, they stay
/// smooth through the keyframes and have no undefined direction; the alignment keeps matched coefficients close in
/// direction, so little norm is lost (and `inflate` restores it, by a smooth step between the keyframes' sizes).
/// Properties: (1) keyframes are met to 1e-9 m at share 0 and 1 (2) position and velocity over leg + share are
/// continuous where a keyframe is passed (3) rigid motions commute. Source: Takahashi et al. 2009, section 4.1, whose
/// product of powers jumps in velocity at keyframes; DESIGN.md 7.8.
class SpectralFlow {
  public:
    /// Errors: stopped.
    static Result<SpectralFlow> through(std::span<const SpectralKeyframe> keyframes, std::vector<CatmullRomLeg> legs,
                                        const SpectralOptions& options, const Run& run);

    /// Positions at a share of a leg. @param out  n places. Up to three turns: six n×n by n×3 products.
    void at(std::size_t leg, double share, std::span<Vec3> out) const;

  private:
    struct Keyframe {
        Vec3 middle_m{};
        dense::Matrix modes;    ///< matched to the keyframe before
        Points coefficients_m;  ///< in the first keyframe's orientation
        double size_m = 0.0;    ///< RMS √n
    };
    struct Step {                ///< from keyframe j to j + 1
        PlaneRotation rotation;  ///< in the modes of keyframe j
        dense::Matrix shapes;    ///< modes of j times the rotation's axes
        Turn turn;               ///< of the formation's orientation
    };
    void turn_shape(const Step& step, double exponent, std::span<double> placed) const;

    std::vector<CatmullRomLeg> legs_;
    std::vector<Keyframe> keyframes_;
    std::vector<Step> steps_;
    bool inflate_ = false;
};

}  // namespace aerogram::planner
