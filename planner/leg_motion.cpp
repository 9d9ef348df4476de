#include "planner/leg_motion.hpp"

#include <algorithm>

#include "geo/units.hpp"
#include "planner/auto_choice.hpp"
#include "planner/leg_shape.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/separation/projection.hpp"
#include "planner/transition/flow.hpp"
#include "planner/transition/straight.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kRows = 63, kFineRows = 103;  ///< control rows of an act: 60 and 100 knot intervals
constexpr std::size_t kFlowRowsPerLeg = 40;
/// Sideways motion stays this far above the minimum navigation altitude where the projection moves it.
constexpr double kAboveFloor_m = 0.05;
/// A staggered act's duration is found in at most so many rounds, each that much longer than what the last one needed.
constexpr int kStaggerRounds = 8;
constexpr double kStaggerRoom = 1.01;

/// The band of heights that a leg's interior may use.
struct Band {
    double floor_z_m = 0.0, ceiling_z_m = 0.0;
};
Band band_of(const Mission& mission, const Leg& leg) {
    const auto by_z = [](const Vec3& a, const Vec3& b) { return a.z < b.z; };
    const auto [pad_low, pad_high] =
        std::minmax_element(mission.fleet.pads_m.begin(), mission.fleet.pads_m.end(), by_z);
    const auto [from_low, from_high] = std::minmax_element(leg.from_m.begin(), leg.from_m.end(), by_z);
    const auto [to_low, to_high] = std::minmax_element(leg.to_m.begin(), leg.to_m.end(), by_z);
    return {std::min({pad_high->z + mission.limits.min_navigation_altitude_m + kAboveFloor_m, from_low->z, to_low->z}),
            std::max({pad_low->z + mission.limits.ceiling_m - kAboveFloor_m, from_high->z, to_high->z})};
}

/// Flown length over straight-line length, all drones together; 1 when nobody moves.
double path_ratio(const Motion& motion) {
    constexpr int kPieces = 4;  // chords a knot interval
    const std::size_t n = drone_count(motion), intervals = interval_count(motion);
    if (!std::holds_alternative<Lattice>(motion)) return 1.0;
    const Act act{"", ActRole::transit, Timing::free, 0, static_cast<Millis>(1000 * intervals), motion};
    Points before = start_positions(motion), now(n);
    const Points from = before, to = end_positions(motion);
    double flown = 0.0, direct = 0.0;
    for (std::size_t step = 1; step <= intervals * kPieces; ++step) {
        positions(act, static_cast<double>(step) / kPieces, now);
        for (std::size_t i = 0; i < n; ++i) flown += glm::length(now[i] - before[i]);
        std::swap(before, now);
    }
    for (std::size_t i = 0; i < n; ++i) direct += glm::length(to[i] - from[i]);
    return direct > 0.0 ? flown / direct : 1.0;
}

Result<Flow> flow_of(const Mission& mission, const Route& route, const Leg& leg, const Run& run) {
    std::vector<SpectralKeyframe> keyframes{graph_keyframe(mission, route, leg.from_m)};
    std::vector<FlowLeg> legs;
    for (std::size_t k = leg.first; k <= leg.last; ++k) {
        keyframes.push_back(graph_keyframe(mission, route, route.stops[k].by_drone_m));
        const Arrive& how = mission.keyframes[k].arrive;
        legs.push_back({how.flow, how.duration_s});
    }
    return flow_transition(keyframes, legs, leg.how.spectral, kFlowRowsPerLeg, run);
}

/// One leg on its way from shape to separated motion.
class Planner {
  public:
    Planner(const Mission& mission, const Leg& leg, const Run& run)
        : mission_(mission), leg_(leg), run_(run), required_m_(required_separation_m(mission, leg)) {
        result_.wanted_s = leg.how.duration_s;
        result_.report.required_separation_m = required_m_;
    }

    Result<LegMotion> fly_straight_up_or_down() {
        result_.report.method = name_of(Method::straight);
        result_.motion = straight_transition(leg_.from_m, leg_.to_m, leg_.how.profile, kRows);
        return finished();
    }

    Result<LegMotion> fly(const LegShape& shape, Method method) {
        result_.report.method = name_of(method);
        const bool lines = method == Method::straight && leg_.how.groups.empty();
        if (leg_.how.stagger_s > 0.0 && lines) return fly_staggered(shape);
        if (lines) {
            auto safe = straight_is_safe();
            if (!safe) return safe.error();
            if (*safe || leg_.how.separation == SeparationMethod::none) return fly_straight_up_or_down();
        }
        if (auto done = separate(shape, 0.0); !done) return done.error();
        return finished();
    }

    Result<LegMotion> fly(const Flow& flow, const std::vector<Keyframe>& keyframes) {
        result_.report.method = name_of(Method::flow);
        result_.motion = flow.lattice;
        result_.keyframe_knots.assign(flow.keyframe_knots.begin() + 1, flow.keyframe_knots.end());
        std::optional<double> sum_s = 0.0;  // a flow's legs have durations all together or as shares
        for (std::size_t k = leg_.first; k <= leg_.last; ++k) {
            const auto& duration_s = keyframes[k].arrive.duration_s;
            sum_s = sum_s && duration_s ? std::optional(*sum_s + *duration_s) : std::nullopt;
        }
        result_.wanted_s = sum_s;
        if (leg_.how.separation == SeparationMethod::none) return finished();
        const std::vector<std::size_t> held(flow.keyframe_knots.begin() + 1, flow.keyframe_knots.end() - 1);
        for (const bool wide : {false, true}) {
            auto projected = project(flow.lattice, held, wide);
            if (!projected) return projected.error();
            if (take(std::move(*projected), wide ? "projection, wide filter" : "projection")) break;
        }
        return finished();
    }

  private:
    Result<bool> straight_is_safe() const {
        const Straight lines = straight_transition(leg_.from_m, leg_.to_m, leg_.how.profile, kRows);
        auto bound = bound_separation(lines, 1.0, {mission_.limits.downwash}, 2.0 * required_m_, run_);
        if (!bound) return bound.error();
        return keeps(*bound, required_m_);
    }

    Result<Projected> project(const Lattice& lattice, std::vector<std::size_t> held_knots, bool wide) const {
        const Band band = band_of(mission_, leg_);
        ProjectionTask task;
        task.required_m = required_m_;
        task.metric = {mission_.limits.downwash};
        task.floor_z_m = band.floor_z_m;
        task.ceiling_z_m = band.ceiling_z_m;
        task.seed = mission_.seed;
        task.held_knots = std::move(held_knots);
        task.samples_per_interval = leg_.pairwise && !wide ? 1 : 2;
        if (wide) task.smoothing_knots = static_cast<double>(lattice.rows()) / 10.0;
        return project_separation(lattice, task, run_);
    }

    /// Keeps a projection's outcome; true when it separated.
    bool take(Projected&& projected, const char* by) {
        result_.report.separation_rounds += projected.rounds;
        if (result_.report.separation_rounds > 0) result_.report.separation_by = by;
        result_.separated = projected.separated;
        result_.motion = std::move(projected.lattice);
        return projected.separated;
    }

    Status separate(const LegShape& shape, double stagger_share) {
        result_.motion = shape.lattice(kRows, stagger_share);
        if (leg_.how.separation == SeparationMethod::none) return Done{};
        auto projected = project(std::get<Lattice>(result_.motion), {}, false);
        if (!projected) return projected.error();
        if (take(std::move(*projected), "projection")) return Done{};
        auto wide = project(shape.lattice(kFineRows, stagger_share), {}, true);
        if (!wide) return wide.error();
        if (take(std::move(*wide), "projection, finer lattice and wide filter")) return Done{};
        const bool free_matching = leg_.how.assign == Assign::shortest && leg_.how.pins.empty() &&
                                   leg_.how.forbid.empty() && stagger_share == 0.0;
        auto safe = straight_is_safe();
        if (!safe) return safe.error();
        if (!free_matching || !*safe) return Done{};
        result_.motion = straight_transition(leg_.from_m, leg_.to_m, leg_.how.profile, kRows);
        result_.separated = true;
        result_.report.separation_by =
            "straight lines, because the projection did not separate the " + result_.report.method + " paths";
        return Done{};
    }

    /// Starts spread over stagger_s: the geometry depends on the duration, so the duration is found first.
    Result<LegMotion> fly_staggered(const LegShape& shape) {
        const Motion together = straight_transition(leg_.from_m, leg_.to_m, leg_.how.profile, kRows);
        const double stagger_s = leg_.how.stagger_s;
        double duration_s = stagger_s + seconds_from_ms(shortest_duration(together, mission_.limits).duration_ms);
        if (duration_s <= stagger_s) return fly_straight_up_or_down();  // nobody moves
        if (leg_.how.duration_s) duration_s = std::max(duration_s, *leg_.how.duration_s);
        for (int round = 0;; ++round) {
            result_.report.separation_rounds = 0;
            if (auto done = separate(shape, stagger_s / duration_s); !done) return done.error();
            const double needed_s = seconds_from_ms(shortest_duration(result_.motion, mission_.limits).duration_ms);
            if (needed_s <= duration_s || round == kStaggerRounds) break;
            duration_s = kStaggerRoom * needed_s;
        }
        Result<LegMotion> out = finished();
        out->shortest.duration_ms = static_cast<Millis>(std::ceil(duration_s * 1000.0));
        out->fixed = true;
        if (!out->wanted_s) out->wanted_s = seconds_from_ms(out->shortest.duration_ms);
        return out;
    }

    Result<LegMotion> finished() {
        result_.shortest = shortest_duration(result_.motion, mission_.limits);
        result_.report.path_ratio = path_ratio(result_.motion);
        return std::move(result_);
    }

    const Mission& mission_;
    const Leg& leg_;
    const Run& run_;
    double required_m_;
    LegMotion result_;
};

}  // namespace

const char* name_of(Method method) {
    switch (method) {
        case Method::straight:
            return "straight";
        case Method::spectral:
            return "spectral";
        case Method::rigid:
            return "rigid";
        case Method::automatic:
            return "auto";
        case Method::flow:
            break;
    }
    return "flow";
}

Result<LegMotion> plan_leg_by(const Mission& mission, const Route& route, const Leg& leg, Method method,
                              const Run& run) {
    auto shape = LegShape::of(mission, route, leg, method, run);
    if (!shape) return shape.error();
    return Planner(mission, leg, run).fly(*shape, method);
}

Result<LegMotion> plan_leg(const Mission& mission, const Route& route, const Leg& leg, const Run& run) {
    if (leg.role == ActRole::takeoff || leg.role == ActRole::landing)
        return Planner(mission, leg, run).fly_straight_up_or_down();
    if (leg.how.method == Method::automatic) return choose_motion(mission, route, leg, run);
    if (leg.how.method != Method::flow) return plan_leg_by(mission, route, leg, leg.how.method, run);
    auto flow = flow_of(mission, route, leg, run);
    if (!flow) return flow.error();
    return Planner(mission, leg, run).fly(*flow, mission.keyframes);
}

}  // namespace aerogram::planner
