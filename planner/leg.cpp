#include "planner/leg.hpp"

#include <algorithm>
#include <numeric>

#include "geo/contract.hpp"
#include "planner/adjacency/adjacency.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/profile.hpp"
#include "planner/separation/projection.hpp"
#include "planner/transition/flow.hpp"
#include "planner/transition/spectral.hpp"
#include "planner/transition/straight.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kRows = 63, kFineRows = 103;  ///< control rows of an act: 60 and 100 knot intervals
constexpr std::size_t kFlowRowsPerLeg = 40;
/// Sideways motion stays this far above the minimum navigation altitude where the projection moves it.
constexpr double kAboveFloor_m = 0.05;

SpectralKeyframe spectral_keyframe(const Mission& mission, const Points& by_drone_m) {
    return {by_drone_m,
            edited_adjacency(delaunay_adjacency(by_drone_m), by_drone_m, mission.groups, mission.adjacency)};
}

Lattice lattice_of(const Straight& straight) {
    Lattice lattice{straight.from_m.size(), {}};
    const Motion motion = straight;
    for (std::size_t k = 0; k < straight.profile.size(); ++k) {
        for (std::size_t i = 0; i < lattice.drones; ++i) lattice.points_m.push_back(control_point(motion, k, i));
    }
    return lattice;
}

Result<Lattice> spectral_lattice(const Mission& mission, const Leg& leg, std::size_t rows, const Run& run) {
    auto transition = SpectralTransition::between(spectral_keyframe(mission, leg.from_m),
                                                  spectral_keyframe(mission, leg.to_m), leg.how.spectral, run);
    if (!transition) return transition.error();
    const std::size_t n = leg.from_m.size(), knots = rows - 2;
    Points samples(knots * n);
    for (std::size_t m = 0; m < knots; ++m) {
        if (run.stopped()) return stopped_error();
        const double u = static_cast<double>(m) / static_cast<double>(knots - 1);
        transition->at(profile_value(leg.how.profile, u), std::span(samples).subspan(m * n, n));
    }
    return lattice_through(samples, n);
}

Result<Flow> flow_of(const Mission& mission, const Route& route, const Leg& leg, const Run& run) {
    std::vector<SpectralKeyframe> keyframes{spectral_keyframe(mission, leg.from_m)};
    std::vector<FlowLeg> legs;
    for (std::size_t k = leg.first; k <= leg.last; ++k) {
        keyframes.push_back(spectral_keyframe(mission, route.stops[k].by_drone_m));
        const Arrive& how = mission.keyframes[k].arrive;
        legs.push_back({how.flow, how.duration_s});
    }
    return flow_transition(keyframes, legs, leg.how.spectral, kFlowRowsPerLeg, run);
}

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

/// The separation ladder for one leg.
class Separator {
  public:
    Separator(const Mission& mission, const Leg& leg, const Run& run)
        : mission_(mission),
          leg_(leg),
          run_(run),
          metric_{mission.limits.downwash},
          required_m_(planned_separation_m(mission.limits)) {}

    Result<bool> is_separated(const Motion& motion) const {
        auto bound = bound_separation(motion, 1.0, metric_, 2.0 * required_m_, run_);
        if (!bound) return bound.error();
        return keeps(*bound, required_m_);
    }

    Result<Projected> project(const Lattice& lattice, std::vector<std::size_t> held_knots, bool wide) const {
        const Band band = band_of(mission_, leg_);
        ProjectionTask task;
        task.required_m = required_m_;
        task.metric = metric_;
        task.floor_z_m = band.floor_z_m;
        task.ceiling_z_m = band.ceiling_z_m;
        task.seed = mission_.seed;
        task.held_knots = std::move(held_knots);
        task.samples_per_interval = leg_.pairwise && !wide ? 1 : 2;
        if (wide) task.smoothing_knots = static_cast<double>(lattice.rows()) / 10.0;
        return project_separation(lattice, task, run_);
    }

  private:
    const Mission& mission_;
    const Leg& leg_;
    const Run& run_;
    SeparationMetric metric_;
    double required_m_;
};

Result<Lattice> raw_lattice(const Mission& mission, const Leg& leg, std::size_t rows, const Run& run) {
    if (leg.how.method == Method::spectral) return spectral_lattice(mission, leg, rows, run);
    return lattice_of(straight_transition(leg.from_m, leg.to_m, leg.how.profile, rows));
}

void take(LegMotion& result, Projected&& projected, const char* by) {
    result.report.separation_rounds += projected.rounds;
    result.report.separation_by = projected.rounds == 0 && result.report.separation_by.empty() ? "" : by;
    result.motion = std::move(projected.lattice);
}

Status separate_flow(const Mission& mission, const Leg& leg, const Flow& flow, const Run& run, LegMotion& result) {
    result.motion = flow.lattice;
    result.keyframe_knots.assign(flow.keyframe_knots.begin() + 1, flow.keyframe_knots.end());
    if (leg.how.separation == SeparationMethod::none) return Done{};
    std::vector<std::size_t> held(flow.keyframe_knots.begin() + 1, flow.keyframe_knots.end() - 1);
    const Separator separator(mission, leg, run);
    auto projected = separator.project(flow.lattice, held, false);
    if (!projected) return projected.error();
    if (projected->separated) {
        take(result, std::move(*projected), "projection");
        return Done{};
    }
    result.report.separation_rounds += projected->rounds;
    projected = separator.project(flow.lattice, held, true);
    if (!projected) return projected.error();
    take(result, std::move(*projected), "projection, wide filter");
    return Done{};
}

Status separate(const Mission& mission, const Leg& leg, const Run& run, LegMotion& result) {
    const Separator separator(mission, leg, run);
    const Straight straight = straight_transition(leg.from_m, leg.to_m, leg.how.profile, kRows);
    auto straight_is_safe = separator.is_separated(straight);
    if (!straight_is_safe) return straight_is_safe.error();
    const bool vertical = leg.role == ActRole::takeoff || leg.role == ActRole::landing;  // stays so, whatever comes
    if (vertical ||
        (leg.how.method == Method::straight && (*straight_is_safe || leg.how.separation == SeparationMethod::none))) {
        result.motion = straight;
        return Done{};
    }
    auto raw = raw_lattice(mission, leg, kRows, run);
    if (!raw) return raw.error();
    result.motion = *raw;
    if (leg.how.separation == SeparationMethod::none) return Done{};
    auto projected = separator.project(*raw, {}, false);
    if (!projected) return projected.error();
    if (projected->separated) {
        take(result, std::move(*projected), "projection");
        return Done{};
    }
    result.report.separation_rounds += projected->rounds;
    auto fine = raw_lattice(mission, leg, kFineRows, run);
    if (!fine) return fine.error();
    auto wide = separator.project(*fine, {}, true);
    if (!wide) return wide.error();
    const bool free_matching = leg.how.assign == Assign::shortest && leg.how.pins.empty();
    if (!wide->separated && free_matching && *straight_is_safe) {
        result.motion = straight;
        result.report.separation_rounds += wide->rounds;
        result.report.separation_by =
            "straight lines, because the projection did not separate the " + result.report.method + " paths";
        return Done{};
    }
    take(result, std::move(*wide), "projection, finer lattice and wide filter");
    return Done{};
}

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

}  // namespace

std::vector<Leg> legs_of(const Mission& mission, const Route& route) {
    std::vector<Leg> legs;
    const auto vertical = [&](const char* name, ActRole role, const Points& from_m, const Points& to_m) {
        Leg leg;
        leg.name = name;
        leg.role = role;
        leg.from_m = from_m;
        leg.to_m = to_m;
        leg.assignment = "own pad";
        return leg;
    };
    legs.push_back(vertical("take-off", ActRole::takeoff, mission.fleet.pads_m, route.lifted_m));
    const Points* here_m = &route.lifted_m;
    for (std::size_t k = 0; k < route.stops.size();) {
        Leg leg;
        leg.arrives = true;
        leg.first = leg.last = k;
        const auto flows = [&](std::size_t q) { return mission.keyframes[q].arrive.method == Method::flow; };
        while (flows(k) && leg.last + 1 < route.stops.size() && flows(leg.last + 1) &&
               mission.keyframes[leg.last].hold_s == 0.0) {
            ++leg.last;
        }
        const Stop& stop = route.stops[leg.last];
        leg.name = (leg.first == leg.last ? "to " : "flow to ") + stop.keyframe.name;
        leg.how = mission.keyframes[leg.last].arrive;
        leg.from_m = *here_m;
        leg.to_m = stop.by_drone_m;
        leg.assignment = stop.assignment;
        for (std::size_t q = leg.first; q <= leg.last; ++q) leg.pairwise = leg.pairwise && route.stops[q].pairwise;
        legs.push_back(std::move(leg));
        here_m = &stop.by_drone_m;
        k = legs.back().last + 1;
    }
    Leg back = vertical("return", ActRole::transit, *here_m, route.lifted_m);
    back.pairwise = false;
    back.how.profile = ProfileKind::s_curve;  // long and mostly downwards: a quarter faster than minimum jerk
    legs.push_back(std::move(back));
    legs.push_back(vertical("landing", ActRole::landing, route.lifted_m, mission.fleet.pads_m));
    return legs;
}

Result<LegMotion> plan_leg(const Mission& mission, const Route& route, const Leg& leg, const Run& run) {
    LegMotion result;
    result.report.method = name_of(leg.how.method);
    result.wanted_s = leg.how.duration_s;
    Status done = Done{};
    if (leg.how.method == Method::flow) {
        auto flow = flow_of(mission, route, leg, run);
        if (!flow) return flow.error();
        done = separate_flow(mission, leg, *flow, run, result);
        std::optional<double> sum_s = 0.0;  // a flow's legs have durations all together or as shares
        for (std::size_t k = leg.first; k <= leg.last; ++k) {
            const auto& duration_s = mission.keyframes[k].arrive.duration_s;
            sum_s = sum_s && duration_s ? std::optional(*sum_s + *duration_s) : std::nullopt;
        }
        result.wanted_s = sum_s;
    } else {
        done = separate(mission, leg, run, result);
    }
    if (!done) return done.error();
    result.shortest = shortest_duration(result.motion, mission.limits);
    result.report.path_ratio = path_ratio(result.motion);
    return result;
}

}  // namespace aerogram::planner
