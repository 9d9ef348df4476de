#include "planner/transition/spectral.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "geo/contract.hpp"
#include "planner/transition/alignment.hpp"
#include "planner/transition/coefficient_path.hpp"
#include "planner/transition/columns.hpp"
#include "planner/transition/harmonic_pull.hpp"
#include "planner/transition/low_modes.hpp"
#include "planner/transition/matching.hpp"
#include "planner/transition/plane_rotation.hpp"
#include "planner/transition/subspace_turn.hpp"

namespace aerogram::planner {
namespace {

using dense::Matrix;
using dense::Op;

/// Coefficients below this share of the formation's size (RMS times √n) count as 0.
constexpr double kZeroCoefficient = 1e-11;
constexpr const char* kStage = "spectral transition";

constexpr std::size_t kInstantsAtOnce = 64;

void check(const SpectralKeyframe& keyframe) {
    AEROGRAM_REQUIRE(!keyframe.positions_m.empty());
    AEROGRAM_REQUIRE(keyframe.graph.n == keyframe.positions_m.size() + keyframe.fixed_m.size(), keyframe.graph.n,
                     keyframe.positions_m.size(), keyframe.fixed_m.size());
    for (const Vec3& p : keyframe.positions_m) AEROGRAM_REQUIRE(is_finite(p), p.x, p.y, p.z);
}

Points individuals(const SpectralKeyframe& keyframe) {
    Points all = keyframe.positions_m;
    all.insert(all.end(), keyframe.fixed_m.begin(), keyframe.fixed_m.end());
    return all;
}

struct Bases {
    Matrix source, target;  // matched modes
    SubspaceTurn turn;
};

/// Errors: stopped.
Result<Bases> bases_of(const AdjacencyGraph& source, const AdjacencyGraph& target, Reorder reorder, std::size_t modes,
                       const Run& run) {
    const bool all = modes + 1 >= source.n;
    const auto basis = [&](const AdjacencyGraph& graph) -> Result<Eigenbasis> {
        if (run.stopped()) return stopped_error();
        if (all) return laplacian_eigenbasis(graph);
        return low_eigenbasis(graph, modes, run);
    };
    auto from = basis(source);
    if (!from) return from.error();
    run.report(kStage, 0.2);
    auto to = basis(target);
    if (!to) return to.error();
    run.report(kStage, 0.4);
    const std::size_t common = std::min(from->modes.columns, to->modes.columns);
    if (from->modes.columns > common) *from = reduced_basis(*from, common, *to);
    if (to->modes.columns > common) *to = reduced_basis(*to, common, *from);
    MatchedBases matched = matched_bases(std::move(from->modes), from->spaces, *to, reorder);
    if (run.stopped()) return stopped_error();
    run.report(kStage, 0.7);
    SubspaceTurn turn = all ? SubspaceTurn{matched.source, std::move(matched.turn)}
                            : subspace_turn(matched.source, matched.target, matched.turn);
    return Bases{std::move(matched.source), std::move(matched.target), std::move(turn)};
}

}  // namespace

/// B: orthonormal columns, S first; A = Bᵀ R B = Z rot(angles) Zᵀ. Then R = B A Bᵀ (+ the identity beside B) and
/// Rᵗ S = (B Z) rot(t angles) Zᵀ.
struct SpectralTransition::Impl {
    std::size_t n = 0, drones = 0;       // individuals: drones, then fixed vertices
    Vec3 from_m{}, to_m{};               // barycentres
    Turn undone;                         // from the aligned to the real target orientation
    PlaneRotation rotation;              // A
    Matrix shapes;                       // B Z
    std::vector<CoefficientPath> paths;  // one a mode
    Points from_rest_m, to_rest_m;       // what the modes leave, aligned
    double from_size_m = 0.0, to_size_m = 0.0;
    bool inflate = false;
    Points fixed_m;
    Matrix pull;

    /// The modes' part at some instants: columns, three an instant, all individuals; barycentre 0, aligned.
    [[nodiscard]] std::vector<double> modes_at(std::span<const double> shares) const {
        const std::size_t d = shapes.columns, count = shares.size();
        std::vector<double> amounts(3 * d * count, 0.0), along(3 * d * count), placed(3 * n * count);
        for (std::size_t s = 0; s < count; ++s) {
            const std::span<double> mine = std::span(amounts).subspan(3 * d * s, 3 * d);
            for (std::size_t k = 0; k < paths.size(); ++k) set_column_point(mine, k, paths[k].at(shares[s]));
        }
        dense::multiply(rotation.axes(), Op::transposed, amounts, 3 * count, along);
        for (std::size_t s = 0; s < count; ++s) {
            rotation.turn_coordinates(shares[s], std::span(along).subspan(3 * d * s, 3 * d), 3);
        }
        dense::multiply(shapes, Op::plain, along, 3 * count, placed);
        return placed;
    }

    /// Drones are moved back as their obstacles are.
    void hold_fixed(std::span<Vec3> all) const {
        for (std::size_t f = 0; f < fixed_m.size(); ++f) {
            const Vec3 shift = fixed_m[f] - all[drones + f];
            for (std::size_t i = 0; i < drones; ++i) all[i] += pull(i, f) * shift;
        }
    }
};

SpectralTransition::SpectralTransition(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
}
SpectralTransition::SpectralTransition(SpectralTransition&&) noexcept = default;
SpectralTransition& SpectralTransition::operator=(SpectralTransition&&) noexcept = default;
SpectralTransition::~SpectralTransition() = default;

Result<SpectralTransition> SpectralTransition::between(const SpectralKeyframe& source, const SpectralKeyframe& target,
                                                       const SpectralOptions& options, const Run& run) {
    const std::size_t n = source.graph.n;
    return with_modes(source, target, options, n <= kFullBasis ? n : kLowModes, run);
}

Result<SpectralTransition> SpectralTransition::with_modes(const SpectralKeyframe& source,
                                                          const SpectralKeyframe& target,
                                                          const SpectralOptions& options, std::size_t modes,
                                                          const Run& run) {
    check(source);
    check(target);
    const std::size_t n = source.graph.n, drones = source.positions_m.size();
    AEROGRAM_REQUIRE(target.positions_m.size() == drones && target.graph.n == n, n, target.graph.n, drones,
                     target.positions_m.size());
    AEROGRAM_REQUIRE(source.fixed_m == target.fixed_m);
    auto bases = bases_of(source.graph, target.graph, options.reorder, modes, run);
    if (!bases) return bases.error();

    PlaneRotation rotation(bases->turn.turn);
    Matrix shapes = dense::product(bases->turn.basis, Op::plain, rotation.axes());
    auto impl = std::make_unique<Impl>(Impl{.n = n,
                                            .drones = drones,
                                            .from_m = barycentre(individuals(source)),
                                            .to_m = barycentre(individuals(target)),
                                            .undone = {},
                                            .rotation = std::move(rotation),
                                            .shapes = std::move(shapes),
                                            .paths = {},
                                            .from_rest_m = {},
                                            .to_rest_m = {},
                                            .from_size_m = 0.0,
                                            .to_size_m = 0.0,
                                            .inflate = options.inflate,
                                            .fixed_m = source.fixed_m,
                                            .pull = harmonic_pull(source.graph, target.graph, drones)});
    impl->from_rest_m = centred(individuals(source), impl->from_m);
    impl->to_rest_m = centred(individuals(target), impl->to_m);
    const Turn aligning = alignment_turn(impl->from_rest_m, impl->to_rest_m, options.align);
    for (Vec3& p : impl->to_rest_m) p = turned(aligning, 1.0, p);
    impl->undone = aligning.inverse();
    impl->from_size_m = frobenius(impl->from_rest_m);
    impl->to_size_m = frobenius(impl->to_rest_m);

    const Points from_modes = coefficients(bases->source, impl->from_rest_m),
                 to_modes = coefficients(bases->target, impl->to_rest_m);
    const Vec3 axis = thinnest_axis(impl->from_rest_m);
    const double zero_m = kZeroCoefficient * std::max(impl->from_size_m, impl->to_size_m);
    impl->paths.reserve(from_modes.size());
    for (std::size_t k = 0; k < from_modes.size(); ++k) {
        impl->paths.emplace_back(from_modes[k], to_modes[k], axis, zero_m);
    }
    const std::vector<double> ends = impl->modes_at(std::array{0.0, 1.0});
    for (std::size_t i = 0; i < n; ++i) {
        impl->from_rest_m[i] -= column_point(std::span(ends).first(3 * n), i);
        impl->to_rest_m[i] -= column_point(std::span(ends).last(3 * n), i);
    }
    run.report(kStage, 1.0);
    return SpectralTransition(std::move(impl));
}

void SpectralTransition::at(double t, std::span<Vec3> out) const {
    sample(std::span(&t, 1), out);
}

void SpectralTransition::sample(std::span<const double> shares, std::span<Vec3> out) const {
    const Impl& s = *impl_;
    AEROGRAM_REQUIRE(out.size() == shares.size() * s.drones, out.size(), shares.size(), s.drones);
    Points all(s.n);
    for (std::size_t first = 0; first < shares.size(); first += kInstantsAtOnce) {
        const auto some = shares.subspan(first, std::min(kInstantsAtOnce, shares.size() - first));
        const std::vector<double> placed = s.modes_at(some);
        for (std::size_t r = 0; r < some.size(); ++r) {
            const double t = some[r];
            const auto columns = std::span(placed).subspan(3 * s.n * r, 3 * s.n);
            for (std::size_t i = 0; i < s.n; ++i) {
                all[i] = column_point(columns, i) + (1.0 - t) * s.from_rest_m[i] + t * s.to_rest_m[i];
            }
            double scale = 1.0;
            if (s.inflate) {
                const double size_m = frobenius(all);
                if (size_m > 0.0) scale = ((1.0 - t) * s.from_size_m + t * s.to_size_m) / size_m;
            }
            const Vec3 middle = (1.0 - t) * s.from_m + t * s.to_m;
            for (Vec3& p : all) p = middle + turned(s.undone, t, scale * p);
            s.hold_fixed(all);
            std::copy_n(all.begin(), s.drones, out.begin() + static_cast<std::ptrdiff_t>((first + r) * s.drones));
        }
    }
}

std::vector<double> SpectralTransition::rotation_power(double t) const {
    const Impl& s = *impl_;
    Matrix rows(s.shapes.columns, s.n);  // (B Z)ᵀ
    for (std::size_t i = 0; i < s.n; ++i) {
        for (std::size_t k = 0; k < rows.rows; ++k) rows(k, i) = s.shapes(i, k);
    }
    const std::vector<double> before = rows.values;
    s.rotation.turn_coordinates(t, rows.values, s.n);
    for (std::size_t i = 0; i < before.size(); ++i) rows.values[i] -= before[i];
    Matrix power = dense::product(s.shapes, Op::plain, rows);
    for (std::size_t i = 0; i < s.n; ++i) power(i, i) += 1.0;  // what is square to B stays
    return std::move(power.values);
}

}  // namespace aerogram::planner
