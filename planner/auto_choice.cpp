#include "planner/auto_choice.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "geo/units.hpp"
#include "planner/adjacency/adjacency.hpp"
#include "planner/leg_shape.hpp"
#include "planner/motion/certificate.hpp"

namespace aerogram::planner {
namespace {

constexpr Method kCandidates[] = {Method::straight, Method::rigid, Method::spectral};
/// Spectral motion of more drones than this takes longer than a choice is worth; ask for it by name.
constexpr std::size_t kMostSpectralDrones = 1000;
constexpr double kClearlyBetter = 1e-3;
constexpr int kInstants = 21;
constexpr double kStandsStill_m = 1e-6;

/// The neighbours at either end of a leg.
Result<std::vector<Edge>> neighbours(const Mission& mission, const Route& route, const Leg& leg, const Run& run) {
    const auto from = graph_keyframe(mission, route, leg.from_m, run);
    if (!from) return from.error();
    const auto to = graph_keyframe(mission, route, leg.to_m, run);
    if (!to) return to.error();
    std::vector<Edge> edges = from->graph.edges;
    edges.insert(edges.end(), to->graph.edges.begin(), to->graph.edges.end());
    const auto ends = [](const Edge& e) { return std::pair(e.a, e.b); };
    std::ranges::sort(edges, {}, ends);
    const auto twice = std::ranges::unique(edges, {}, ends);
    edges.erase(twice.begin(), twice.end());
    return edges;
}

/// The leg flown in its shortest time.
Act act_of(const Leg& leg, const LegMotion& motion) {
    return {leg.name, leg.role, Timing::free, 0, std::max<Millis>(1, motion.shortest.duration_ms), motion.motion};
}

double edge_distortion(const std::vector<Edge>& edges, const Act& act, const Leg& leg) {
    double sum = 0.0, counted = 0.0;
    Points now(leg.from_m.size());
    const double total_s = seconds_from_ms(act.duration_ms);
    for (int k = 1; k + 1 < kInstants; ++k) {
        const double u = static_cast<double>(k) / (kInstants - 1);
        positions(act, u * total_s, now);
        // The share of the way at this share of the time, for the wished lengths: that of the fleet as a whole.
        double way = 0.0, gone = 0.0;
        for (std::size_t i = 0; i < now.size(); ++i) {
            const Vec3 straight = leg.to_m[i] - leg.from_m[i];
            way += glm::dot(straight, straight);
            gone += glm::dot(now[i] - leg.from_m[i], straight);
        }
        const double s = way > 0.0 ? std::clamp(gone / way, 0.0, 1.0) : u;
        for (const Edge& e : edges) {
            const double before = glm::length(leg.from_m[e.b] - leg.from_m[e.a]);
            const double after = glm::length(leg.to_m[e.b] - leg.to_m[e.a]);
            const double wished = (1.0 - s) * before + s * after;
            if (wished <= kStandsStill_m) continue;
            sum += std::abs(glm::length(now[e.b] - now[e.a]) - wished) / wished;
            counted += 1.0;
        }
    }
    return counted > 0.0 ? sum / counted : 0.0;
}

/// ∫|jerk|² of a uniform cubic B-spline is a sum: jerk is constant on each interval.
double dimensionless_jerk(const Act& act, const Leg& leg) {
    const double h = knot_step_s(act), total_s = seconds_from_ms(act.duration_ms);
    double sum = 0.0;
    std::size_t movers = 0;
    for (std::size_t i = 0; i < leg.from_m.size(); ++i) {
        const double way = glm::length(leg.to_m[i] - leg.from_m[i]);
        if (way <= kStandsStill_m) continue;
        ++movers;
        double squared = 0.0;
        for (std::size_t m = 0; m < interval_count(act.motion); ++m) {
            const auto row = [&](std::size_t k) { return control_point(act.motion, m + k, i); };
            const Vec3 jerk = (row(3) - 3.0 * row(2) + 3.0 * row(1) - row(0)) / (h * h * h);
            squared += glm::dot(jerk, jerk) * h;
        }
        sum += squared * std::pow(total_s, 5) / (way * way);
    }
    return movers > 0 ? sum / static_cast<double>(movers) : 0.0;
}

/// Whether the leg, flown in its shortest time, holds every limit.
Result<bool> is_certified(const Mission& mission, const Leg& leg, const LegMotion& motion, const Run& run) {
    if (motion.shortest.duration_ms == 0) return true;
    const Surroundings surroundings{geo::ShowFrame(mission.origin), mission.airspace, mission.fleet.pads_m,
                                    mission.limits};
    auto certificate = certify(act_of(leg, motion), surroundings, run, motion.report.required_separation_m);
    if (!certificate) return certificate.error();
    return certificate->certified();
}

/// True when a is clearly better than b by the objective.
bool better(Objective objective, const Merits& a, const Merits& b) {
    const auto clearly = [](double x, double y) { return x < y * (1.0 - kClearlyBetter); };
    switch (objective) {
        case Objective::together:
            return clearly(a.edge_distortion, b.edge_distortion);
        case Objective::smooth:
            return clearly(a.jerk, b.jerk);
        case Objective::shortest:
            break;
    }
    return clearly(a.duration_s, b.duration_s) ||
           (!clearly(b.duration_s, a.duration_s) && clearly(a.path_ratio, b.path_ratio));
}

std::string told(Method method, const Merits& m, bool certified) {
    std::ostringstream text;
    text << name_of(method) << (certified ? " " : " (not certified) ") << std::fixed << std::setprecision(2)
         << m.duration_s << " s, path " << std::setprecision(4) << m.path_ratio << ", edges " << std::setprecision(2)
         << 100.0 * m.edge_distortion << " %, jerk " << std::setprecision(0) << m.jerk;
    return text.str();
}

const char* name_of(Objective objective) {
    switch (objective) {
        case Objective::shortest:
            return "shortest";
        case Objective::together:
            return "together";
        case Objective::smooth:
            break;
    }
    return "smooth";
}

}  // namespace

Result<Merits> merits_of(const Mission& mission, const Route& route, const Leg& leg, const LegMotion& motion,
                         const Run& run) {
    const auto edges = neighbours(mission, route, leg, run);
    if (!edges) return edges.error();
    const Act act = act_of(leg, motion);
    return Merits{seconds_from_ms(motion.shortest.duration_ms), motion.report.path_ratio,
                  edge_distortion(*edges, act, leg), dimensionless_jerk(act, leg)};
}

Result<LegMotion> choose_motion(const Mission& mission, const Route& route, const Leg& leg, const Run& run) {
    std::optional<LegMotion> best;
    Merits best_merits;
    bool best_certified = false;
    Method best_method = Method::straight;
    std::string reason = std::string("objective ") + name_of(mission.objective) + ": ";
    for (const Method method : kCandidates) {
        if (method == Method::spectral && leg.from_m.size() > kMostSpectralDrones) {
            reason += "; spectral not tried above " + std::to_string(kMostSpectralDrones) + " drones";
            continue;
        }
        auto motion = plan_leg_by(mission, route, leg, method, run);
        if (!motion) return motion.error();
        auto certified = is_certified(mission, leg, *motion, run);
        if (!certified) return certified.error();
        const auto merits = merits_of(mission, route, leg, *motion, run);
        if (!merits) return merits.error();
        reason += (method == kCandidates[0] ? "" : "; ") + told(method, *merits, *certified);
        const bool wins = !best || (*certified && (!best_certified || better(mission.objective, *merits, best_merits)));
        if (!wins) continue;
        best_certified = *certified;
        best = std::move(*motion);
        best_merits = *merits;
        best_method = method;
    }
    best->report.method = std::string("auto: ") + name_of(best_method);
    best->report.chosen_because = reason;
    return std::move(*best);
}

}  // namespace aerogram::planner
