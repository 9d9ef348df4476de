#include "planner/leg_motion.hpp"

#include <algorithm>
#include <cmath>

#include "geo/units.hpp"
#include "planner/auto_choice.hpp"
#include "planner/leg_shape.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/separation/ladder.hpp"
#include "planner/separation/social_force.hpp"
#include "planner/transition/flow.hpp"
#include "planner/transition/straight.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kRows = 63, kFineRows = 103;  ///< control rows of an act: 60 and 100 knot intervals
constexpr std::size_t kFlowRowsPerLeg = 40, kLeastFlowRowsPerLeg = 12;
constexpr std::size_t kMostFlowRows = 10'000;
constexpr std::size_t kMostFlowLegs = 600;
constexpr double kStandsStill_m = 1e-6;
/// Sideways motion stays this far above the minimum navigation altitude where the projection moves it.
constexpr double kAboveFloor_m = 0.05;
/// The projection keeps this far from fences, audiences and obstacles, so that neither its tolerance nor the curve
/// between samples uses up the distance.
constexpr double kAirspaceMargin_m = 0.1;
constexpr double kMillisecond_s = 5e-4;  ///< durations are whole milliseconds
constexpr double kLimitsRoom = 1.006;
constexpr double kRowsPerWidth = 17.0;  ///< W = 63 / 17 knots (DESIGN.md 8), whatever the rows
constexpr double kMostLonger = 6.0;     ///< staggered acts have at most this many times the usual rows
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

/// Flown length over straight-line length, of flows from keyframe to keyframe, all drones together; 1 when nobody
/// moves.
/// @param met  knots at which keyframes are met, the last one included; empty: only at the end.
double path_ratio(const Motion& motion, const std::vector<std::size_t>& met) {
    constexpr int kPieces = 4;  // chords a knot interval
    const std::size_t n = drone_count(motion), intervals = interval_count(motion);
    if (!std::holds_alternative<Lattice>(motion)) return 1.0;
    const Act act{"", ActRole::transit, Timing::free, 0, static_cast<Millis>(1000 * intervals), motion};
    Points before = start_positions(motion), now(n);
    Points left = before;  // at the last keyframe
    double flown = 0.0, direct = 0.0;
    for (std::size_t step = 1; step <= intervals * kPieces; ++step) {
        positions(act, static_cast<double>(step) / kPieces, now);
        for (std::size_t i = 0; i < n; ++i) flown += glm::length(now[i] - before[i]);
        std::swap(before, now);
        const bool meets = step % kPieces == 0 && std::ranges::find(met, step / kPieces) != met.end();
        if (!meets && step < intervals * kPieces) continue;
        for (std::size_t i = 0; i < n; ++i) direct += glm::length(before[i] - left[i]);
        left = before;
    }
    return direct > kStandsStill_m * static_cast<double>(n) ? flown / direct : 1.0;
}

Result<Flow> flow_of(const Mission& mission, const Route& route, const Leg& leg, const Run& run) {
    std::vector<SpectralKeyframe> keyframes;
    const auto add = [&](const Points& by_drone_m) -> Status {
        auto keyframe = graph_keyframe(mission, route, by_drone_m, run);
        if (!keyframe) return keyframe.error();
        keyframes.push_back(std::move(*keyframe));
        return Done{};
    };
    if (auto done = add(leg.from_m); !done) return done.error();
    std::vector<FlowLeg> legs;
    for (std::size_t k = leg.first; k <= leg.last; ++k) {
        if (auto done = add(route.stops[k].by_drone_m); !done) return done.error();
        const Arrive& how = mission.keyframes[k].arrive;
        legs.push_back({how.flow, how.duration_s});
    }
    if (legs.size() > kMostFlowLegs)
        return Error{ErrorCode::invalid_input,
                     mission.at(leg.how.line, keyframe_key(mission, leg.last) + ".arrive: a flow of " +
                                                  std::to_string(legs.size()) + " keyframes; at most " +
                                                  std::to_string(kMostFlowLegs) + ": hold one of them for a moment")};
    const std::size_t rows = std::clamp(kMostFlowRows / legs.size(), kLeastFlowRowsPerLeg, kFlowRowsPerLeg);
    return flow_transition(keyframes, legs, leg.how.spectral, rows, run);
}

std::string joined(const std::vector<std::string>& rungs) {
    std::string out;
    for (const std::string& rung : rungs) out += (out.empty() ? "" : "; ") + rung;
    return out;
}

/// One leg on its way from shape to separated motion.
class Planner {
  public:
    Planner(const Mission& mission, const Route& route, const Leg& leg, Method method, const Run& run)
        : mission_(mission), route_(route), leg_(leg), method_(method), run_(run) {
        result_.wanted_s = leg.how.duration_s;
        result_.report.method = name_of(method);
        result_.report.required_separation_m = required_separation_m(mission, leg);
    }

    Result<LegMotion> fly_straight() {
        result_.motion = straight_lines();
        return finished();
    }

    Result<LegMotion> fly(const LegShape& shape) {
        const bool lines = method_ == Method::straight && leg_.how.groups.empty();
        if (leg_.how.stagger_s > 0.0 && lines) return fly_staggered(shape);
        if (lines && leg_.how.separation == SeparationMethod::none) return fly_straight();
        if (lines && in_open_air()) {
            auto safe = straight_is_safe();
            if (!safe) return safe.error();
            if (*safe) return fly_straight();
        }
        return in_time(leg_.how.duration_s, [&](std::optional<double> duration_s) -> Status {
            if (auto done = separate_shape(shape, 0.0, duration_s); !done) return done.error();
            if (lines && result_.report.separation_by.empty()) result_.motion = straight_lines();  // nothing in the way
            return Done{};
        });
    }

    Result<LegMotion> fly(const Flow& flow) {
        result_.keyframe_knots.assign(flow.keyframe_knots.begin() + 1, flow.keyframe_knots.end());
        std::optional<double> sum_s = 0.0;  // a flow's legs have durations all together or as shares
        for (std::size_t k = leg_.first; k <= leg_.last; ++k) {
            const auto& duration_s = mission_.keyframes[k].arrive.duration_s;
            sum_s = sum_s && duration_s ? std::optional(*sum_s + *duration_s) : std::nullopt;
        }
        result_.wanted_s = sum_s;
        result_.motion = flow.lattice;
        if (leg_.how.separation == SeparationMethod::none) return finished();
        return in_time(sum_s, [&](std::optional<double> duration_s) -> Status {
            LadderTask task = ladder(flow.lattice, duration_s);
            task.projection.held_knots.assign(flow.keyframe_knots.begin() + 1, flow.keyframe_knots.end() - 1);
            task.rows = flow.lattice.rows();
            task.fine_rows = 0;
            task.raw = [&flow](std::size_t) { return Result<Lattice>(flow.lattice); };
            return climb(task);
        });
    }

  private:
    /// Separates in the shortest time first, which is the one that messages name; where the designer wants it faster,
    /// once more with the limits of that duration, and keeps what is fast enough.
    template <class Separate>
    Result<LegMotion> in_time(std::optional<double> wanted_s, const Separate& separate) {
        if (auto done = separate(std::nullopt); !done) return done.error();
        auto free = finished();
        if (!wanted_s || !free || seconds_from_ms(free->shortest.duration_ms) <= *wanted_s + kMillisecond_s)
            return free;
        result_ = *free;
        result_.report.separation_by.clear();
        if (auto done = separate(wanted_s); !done) return done.error();
        auto faster = finished();
        const bool in_time = faster && seconds_from_ms(faster->shortest.duration_ms) <= *wanted_s + kMillisecond_s;
        return in_time ? std::move(faster) : std::move(free);
    }

    double required_m() const { return result_.report.required_separation_m; }
    SeparationMetric metric() const { return {mission_.limits.downwash}; }
    Straight straight_lines() const { return straight_transition(leg_.from_m, leg_.to_m, leg_.how.profile, kRows); }
    /// The route of a carrier is not where its legs are planned: fences and obstacles are judged on the ride.
    bool in_open_air() const {
        const geo::Airspace& air = mission_.airspace;
        return mission_.carrier || (air.geofence_m.empty() && air.audience_m.empty() && air.obstacles.empty());
    }
    bool is_freely_matched() const {
        return leg_.arrives && leg_.how.assign == Assign::shortest && leg_.how.pins.empty() && leg_.how.forbid.empty();
    }

    Result<bool> straight_is_safe() const {
        auto bound = bound_separation(straight_lines(), 1.0, metric(), 2.0 * required_m(), run_);
        if (!bound) return bound.error();
        return keeps(*bound, required_m());
    }

    /// What the ladder needs to know but for how to get the motion.
    LadderTask ladder(const Lattice& raw, std::optional<double> duration_s) const {
        const Band band = band_of(mission_, leg_);
        LadderTask task;
        ProjectionTask& p = task.projection;
        p.required_m = required_m();
        p.metric = metric();
        p.floor_z_m = band.floor_z_m;
        p.ceiling_z_m = band.ceiling_z_m;
        p.seed = mission_.seed;
        p.samples_per_interval = leg_.pairwise && method_ == Method::straight ? 1 : 2;
        const double least_s = seconds_from_ms(shortest_duration(raw, mission_.limits).duration_ms);
        // The projection holds limits to half a percent: a given duration leaves that much.
        const double time_s = duration_s ? *duration_s / kLimitsRoom : least_s;
        p.motion = MotionLimits{mission_.limits, time_s / static_cast<double>(raw.rows() - 3)};
        if (!(p.motion->step_s > 0.0)) p.motion.reset();  // nobody moves
        if (!in_open_air()) p.airspace = mission_.airspace;
        p.airspace_margin_m = kAirspaceMargin_m;
        task.rows = rows_;
        task.fine_rows = rows_ * kFineRows / kRows;
        p.smoothing_knots = static_cast<double>(kRows) / kRowsPerWidth;
        task.may_stretch = !duration_s;
        return task;
    }

    /// Keeps what the ladder came to.
    Status climb(const LadderTask& task) {
        auto separation = planner::separate(task, run_);
        if (!separation) return separation.error();
        result_.report.separation_rounds += separation->rounds;
        std::string& by = result_.report.separation_by;
        const std::string rungs = joined(separation->rungs);
        by += (by.empty() || rungs.empty() ? "" : "; ") + rungs;
        result_.target_of = std::move(separation->target_of);
        result_.report.swapped = 0;
        for (std::size_t i = 0; i < result_.target_of.size(); ++i) result_.report.swapped += result_.target_of[i] != i;
        result_.motion = std::move(separation->motion);
        return Done{};
    }

    Status separate_shape(const LegShape& shape, double stagger_share, std::optional<double> duration_s) {
        result_.motion = shape.lattice(rows_, stagger_share);
        if (leg_.how.separation == SeparationMethod::none) return Done{};
        LadderTask task = ladder(std::get<Lattice>(result_.motion), duration_s);
        task.raw = [&, stagger_share](std::size_t rows) { return eased(shape.lattice(rows, stagger_share), task); };
        if (leg_.may_swap && stagger_share == 0.0) {
            task.swapped = [&](std::size_t rows, std::span<const std::uint32_t> target_of) -> Result<Lattice> {
                Leg leg = leg_;
                for (std::size_t i = 0; i < target_of.size(); ++i) leg.to_m[i] = leg_.to_m[target_of[i]];
                auto other = LegShape::of(mission_, route_, leg, method_, run_);
                if (!other) return other.error();
                return other->lattice(rows);
            };
        }
        if (is_freely_matched() && stagger_share == 0.0) task.straight = straight_lines();
        return climb(task);
    }

    /// separation = "social_force": the forces first; the ladder takes over from where they got to.
    Result<Lattice> eased(Lattice raw, const LadderTask& task) {
        if (leg_.how.separation != SeparationMethod::social_force) return raw;
        SocialForceTask forces;
        forces.required_m = required_m();
        forces.metric = metric();
        forces.floor_z_m = task.projection.floor_z_m;
        forces.ceiling_z_m = task.projection.ceiling_z_m;
        forces.seed = mission_.seed;
        auto out = ease_by_social_forces(raw, forces, run_);
        if (!out) return out.error();
        result_.report.separation_rounds += out->rounds;
        if (out->rounds > 0) result_.report.separation_by = "social forces";
        return std::move(out->lattice);
    }

    /// Starts spread over stagger_s: the geometry depends on the duration, so the duration is found first.
    Result<LegMotion> fly_staggered(const LegShape& shape) {
        const double stagger_s = leg_.how.stagger_s;
        const Millis together_ms = shortest_duration(straight_lines(), mission_.limits).duration_ms;
        if (together_ms == 0) return fly_straight();  // nobody moves
        double duration_s = std::max(stagger_s + seconds_from_ms(together_ms), leg_.how.duration_s.value_or(0.0));
        for (int round = 0;; ++round) {
            result_.report.separation_rounds = 0;
            result_.report.separation_by.clear();
            // As many rows for each drone's own flight as an unstaggered one has.
            const double longer = duration_s / seconds_from_ms(together_ms);
            rows_ = 3 + static_cast<std::size_t>(std::min(kMostLonger, longer) * static_cast<double>(kRows - 3));
            if (auto done = separate_shape(shape, stagger_s / duration_s, duration_s); !done) return done.error();
            const double needed_s = seconds_from_ms(shortest_duration(result_.motion, mission_.limits).duration_ms);
            if (needed_s <= duration_s || round == kStaggerRounds) break;
            duration_s = kStaggerRoom * needed_s;
        }
        Result<LegMotion> out = finished();
        out->shortest.duration_ms =
            std::max(out->shortest.duration_ms, static_cast<Millis>(std::ceil(duration_s * 1000.0 - 1e-6)));
        out->fixed = true;
        if (!out->wanted_s) out->wanted_s = seconds_from_ms(out->shortest.duration_ms);
        return out;
    }

    Result<LegMotion> finished() {
        result_.shortest = shortest_duration(result_.motion, mission_.limits);
        result_.report.path_ratio = path_ratio(result_.motion, result_.keyframe_knots);
        return std::move(result_);
    }

    const Mission& mission_;
    const Route& route_;
    const Leg& leg_;
    Method method_;
    const Run& run_;
    std::size_t rows_ = kRows;
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
        case Method::steered:
            return "steered";
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
    return Planner(mission, route, leg, method, run).fly(*shape);
}

Result<LegMotion> plan_leg(const Mission& mission, const Route& route, const Leg& leg, const Run& run) {
    if (leg.role == ActRole::takeoff || leg.role == ActRole::landing)
        return Planner(mission, route, leg, Method::straight, run).fly_straight();
    if (leg.how.method == Method::automatic) return choose_motion(mission, route, leg, run);
    if (leg.how.method != Method::flow) return plan_leg_by(mission, route, leg, leg.how.method, run);
    auto flow = flow_of(mission, route, leg, run);
    if (!flow) return flow.error();
    return Planner(mission, route, leg, Method::flow, run).fly(*flow);
}

}  // namespace aerogram::planner
