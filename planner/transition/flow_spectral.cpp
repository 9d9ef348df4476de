#include "planner/transition/flow_spectral.hpp"

#include <utility>

#include "geo/contract.hpp"
#include "planner/transition/columns.hpp"
#include "planner/transition/matching.hpp"

namespace aerogram::planner {

using dense::Op;

Result<SpectralFlow> SpectralFlow::through(std::span<const SpectralKeyframe> keyframes, std::vector<CatmullRomLeg> legs,
                                           const SpectralOptions& options, const Run& run) {
    AEROGRAM_REQUIRE(keyframes.size() == legs.size() + 1, keyframes.size(), legs.size());
    SpectralFlow flow;
    flow.legs_ = std::move(legs);
    flow.inflate_ = options.inflate;
    std::vector<Points> formations;
    Eigenbasis basis;
    for (std::size_t j = 0; j < keyframes.size(); ++j) {
        if (run.stopped()) return stopped_error();
        const SpectralKeyframe& k = keyframes[j];
        AEROGRAM_REQUIRE(k.graph.n == k.positions_m.size(), k.graph.n, k.positions_m.size());
        Keyframe here;
        here.middle_m = barycentre(k.positions_m);
        formations.push_back(centred(k.positions_m, here.middle_m));
        here.size_m = frobenius(formations.back());
        Eigenbasis own = laplacian_eigenbasis(k.graph);
        if (j == 0) {
            here.modes = own.modes;
        } else {
            // Only the first keyframe's eigenspaces may still be turned: all later bases are already somebody's target.
            Keyframe& last = flow.keyframes_.back();
            MatchedBases matched = matched_bases(
                std::move(last.modes), j == 1 ? basis.spaces : std::vector<Eigenspace>{}, own, options.reorder);
            last.modes = std::move(matched.source);
            here.modes = std::move(matched.target);
            PlaneRotation rotation(matched.turn);
            dense::Matrix shapes = dense::product(last.modes, Op::plain, rotation.axes());
            const Turn turn = alignment_turn(formations[j - 1], formations[j], options.align).inverse();
            flow.steps_.push_back({std::move(rotation), std::move(shapes), turn});
        }
        flow.keyframes_.push_back(std::move(here));
        basis = std::move(own);
        run.report("spectral flow", static_cast<double>(j + 1) / static_cast<double>(keyframes.size()));
    }
    for (std::size_t j = 0; j < keyframes.size(); ++j) {
        for (Vec3& p : formations[j]) {
            for (std::size_t s = j; s-- > 0;) p = turned(flow.steps_[s].turn, -1.0, p);
        }
        flow.keyframes_[j].coefficients_m = coefficients(flow.keyframes_[j].modes, formations[j]);
    }
    return flow;
}

/// R^exponent applied to a shape in drone space.
void SpectralFlow::turn_shape(const Step& step, double exponent, std::span<double> placed) const {
    std::vector<double> along(3 * step.shapes.columns);
    dense::multiply(step.shapes, Op::transposed, placed, 3, along);
    step.rotation.turn_coordinates(exponent, along, 3);
    dense::multiply(step.shapes, Op::plain, along, 3, placed);
}

void SpectralFlow::at(std::size_t leg_index, double share, std::span<Vec3> out) const {
    const CatmullRomLeg& leg = legs_[leg_index];
    const CatmullRomWeights c = catmull_rom_weights(leg, share);
    const Keyframe &before = keyframes_[leg.before], &from = keyframes_[leg.from], &to = keyframes_[leg.to],
                   &after = keyframes_[leg.after];
    const std::size_t modes = before.coefficients_m.size();
    AEROGRAM_REQUIRE(out.size() == before.modes.rows, out.size(), before.modes.rows);
    std::vector<double> amounts(3 * modes), placed(3 * out.size());
    for (std::size_t k = 0; k < modes; ++k) {
        set_column_point(
            amounts, k,
            c.blend(before.coefficients_m[k], from.coefficients_m[k], to.coefficients_m[k], after.coefficients_m[k]));
    }
    double scale = 1.0;
    if (inflate_) {
        const double size_m = frobenius(amounts), smooth = share * share * (3.0 - 2.0 * share);
        if (size_m > 0.0) scale = ((1.0 - smooth) * from.size_m + smooth * to.size_m) / size_m;
    }
    dense::multiply(before.modes, Op::plain, amounts, 3, placed);
    const double begun = c.to + c.after;  // the cumulative weight of the step along this leg
    if (leg.before != leg.from) turn_shape(steps_[leg.before], c.from + begun, placed);
    turn_shape(steps_[leg.from], begun, placed);
    if (leg.after != leg.to) turn_shape(steps_[leg.to], c.after, placed);

    const Vec3 middle = c.blend(before.middle_m, from.middle_m, to.middle_m, after.middle_m);
    for (std::size_t i = 0; i < out.size(); ++i) {
        Vec3 p = scale * column_point(placed, i);
        for (std::size_t s = 0; s < leg.before; ++s) p = turned(steps_[s].turn, 1.0, p);
        if (leg.before != leg.from) p = turned(steps_[leg.before].turn, c.from + begun, p);
        p = turned(steps_[leg.from].turn, begun, p);
        if (leg.after != leg.to) p = turned(steps_[leg.to].turn, c.after, p);
        out[i] = middle + p;
    }
}

}  // namespace aerogram::planner
