#include "planner/transition/spectral.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geo/contract.hpp"
#include "planner/transition/alignment.hpp"
#include "planner/transition/coefficient_path.hpp"
#include "planner/transition/columns.hpp"
#include "planner/transition/matching.hpp"
#include "planner/transition/plane_rotation.hpp"

namespace aerogram::planner {
namespace {

using dense::Matrix;
using dense::Op;

/// Coefficients below this share of the formation's size (RMS times √n) count as 0.
constexpr double kZeroCoefficient = 1e-11;
constexpr const char* kStage = "spectral transition";

void check(const SpectralKeyframe& keyframe) {
    AEROGRAM_REQUIRE(!keyframe.positions_m.empty());
    AEROGRAM_REQUIRE(keyframe.graph.n == keyframe.positions_m.size(), keyframe.graph.n, keyframe.positions_m.size());
    for (const Vec3& p : keyframe.positions_m) AEROGRAM_REQUIRE(is_finite(p), p.x, p.y, p.z);
}

}  // namespace

/// S: source modes, A = Sᵀ T = Z rot(angles) Zᵀ. Then R = S A Sᵀ (+ the constant vector's part) and Rᵗ S = (S Z) rot(t
/// angles) Zᵀ.
struct SpectralTransition::Impl {
    std::size_t n = 0;
    Vec3 from_m{}, to_m{};               // barycentres
    Turn undone;                         // from the aligned to the real target orientation
    PlaneRotation rotation;              // A
    Matrix shapes;                       // S Z, n x (n - 1)
    std::vector<CoefficientPath> paths;  // one a mode
    double from_size_m = 0.0, to_size_m = 0.0;
    bool inflate = false;
};

SpectralTransition::SpectralTransition(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
}
SpectralTransition::SpectralTransition(SpectralTransition&&) noexcept = default;
SpectralTransition& SpectralTransition::operator=(SpectralTransition&&) noexcept = default;
SpectralTransition::~SpectralTransition() = default;

Result<SpectralTransition> SpectralTransition::between(const SpectralKeyframe& source, const SpectralKeyframe& target,
                                                       const SpectralOptions& options, const Run& run) {
    check(source);
    check(target);
    const std::size_t n = source.positions_m.size();
    AEROGRAM_REQUIRE(target.positions_m.size() == n, n, target.positions_m.size());
    if (run.stopped()) return stopped_error();
    const Eigenbasis source_basis = laplacian_eigenbasis(source.graph);
    if (run.stopped()) return stopped_error();
    run.report(kStage, 0.2);
    const Eigenbasis target_basis = laplacian_eigenbasis(target.graph);
    if (run.stopped()) return stopped_error();
    run.report(kStage, 0.4);
    const MatchedBases bases = matched_bases(source_basis.modes, source_basis.spaces, target_basis, options.reorder);
    if (run.stopped()) return stopped_error();
    run.report(kStage, 0.7);

    PlaneRotation rotation(bases.turn);
    Matrix shapes = dense::product(bases.source, Op::plain, rotation.axes());
    auto impl = std::make_unique<Impl>(Impl{n,
                                            barycentre(source.positions_m),
                                            barycentre(target.positions_m),
                                            {},
                                            std::move(rotation),
                                            std::move(shapes),
                                            {},
                                            0.0,
                                            0.0,
                                            options.inflate});
    const Points from = centred(source.positions_m, impl->from_m);
    Points to = centred(target.positions_m, impl->to_m);
    const Turn aligning = alignment_turn(from, to, options.align);
    for (Vec3& p : to) p = turned(aligning, 1.0, p);
    impl->undone = aligning.inverse();
    impl->from_size_m = frobenius(from);
    impl->to_size_m = frobenius(to);

    const Points from_modes = coefficients(bases.source, from), to_modes = coefficients(bases.target, to);
    const Vec3 axis = thinnest_axis(from);
    const double zero_m = kZeroCoefficient * std::max(impl->from_size_m, impl->to_size_m);
    impl->paths.reserve(from_modes.size());
    for (std::size_t k = 0; k < from_modes.size(); ++k) {
        impl->paths.emplace_back(from_modes[k], to_modes[k], axis, zero_m);
    }
    run.report(kStage, 1.0);
    return SpectralTransition(std::move(impl));
}

void SpectralTransition::at(double t, std::span<Vec3> out) const {
    const Impl& s = *impl_;
    AEROGRAM_REQUIRE(out.size() == s.n, out.size(), s.n);
    const std::size_t modes = s.paths.size();
    std::vector<double> amounts(3 * modes), along(3 * modes), placed(3 * s.n);
    for (std::size_t k = 0; k < modes; ++k) set_column_point(amounts, k, s.paths[k].at(t));
    double scale = 1.0;
    if (s.inflate) {
        const double size_m = frobenius(amounts);
        if (size_m > 0.0) scale = ((1.0 - t) * s.from_size_m + t * s.to_size_m) / size_m;
    }
    dense::multiply(s.rotation.axes(), Op::transposed, amounts, 3, along);
    s.rotation.turn_coordinates(t, along, 3);
    dense::multiply(s.shapes, Op::plain, along, 3, placed);
    const Vec3 middle = (1.0 - t) * s.from_m + t * s.to_m;
    for (std::size_t i = 0; i < s.n; ++i) {
        out[i] = middle + turned(s.undone, t, scale * column_point(placed, i));
    }
}

std::vector<double> SpectralTransition::rotation_power(double t) const {
    const Impl& s = *impl_;
    const std::size_t modes = s.paths.size();
    Matrix rows(modes, s.n);  // (S Z)ᵀ
    for (std::size_t i = 0; i < s.n; ++i) {
        for (std::size_t k = 0; k < modes; ++k) rows(k, i) = s.shapes(i, k);
    }
    s.rotation.turn_coordinates(t, rows.values, s.n);
    Matrix power = dense::product(s.shapes, Op::plain, rows);
    for (double& x : power.values) x += 1.0 / static_cast<double>(s.n);  // the constant vector stays
    return std::move(power.values);
}

}  // namespace aerogram::planner
