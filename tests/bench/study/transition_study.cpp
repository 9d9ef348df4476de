// One transition of the whole fleet: assigned, separated, certified. CPU seconds of each part, and what came out,
// against the raw act (straight lines, or lines whose rows leave one after the other).
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/assignment/assignment.hpp"
#include "planner/motion/profile.hpp"
#include "planner/motion/timing.hpp"
#include "planner/separation/projection.hpp"
#include "tests/bench/study/instances.hpp"
#include "tests/bench/study/study.hpp"

namespace aerogram::study {
namespace {

using namespace planner;

constexpr std::size_t kRows = 63;
constexpr double kWanted = 0.95;  ///< of the formation spacing

Points matched(const Instance& instance) {
    const auto found = assign_shortest(instance.from_m, instance.to_m, MatchRules{}, SeparationMetric{}, Run{}).value();
    Points by_drone(instance.to_m.size());
    for (std::size_t d = 0; d < by_drone.size(); ++d) by_drone[d] = instance.to_m[found.slot_of[d].value];
    return by_drone;
}

/// How late each drone leaves, share of the whole stagger: by its row in the first formation.
std::vector<double> lateness(const Points& from_m) {
    const auto by_height = std::ranges::minmax(from_m, {}, &Vec3::z),
               by_depth = std::ranges::minmax(from_m, {}, &Vec3::y);
    const double height_m = by_height.max.z - by_height.min.z, depth_m = by_depth.max.y - by_depth.min.y;
    std::vector<double> late;
    for (const Vec3& p : from_m) {
        late.push_back(height_m > depth_m ? (p.z - by_height.min.z) / height_m
                                          : (p.y - by_depth.min.y) / std::max(depth_m, 1e-9));
    }
    return late;
}

Lattice raw_lattice(const Points& from_m, const Points& to_m, double flight_s, double stagger_s) {
    const std::size_t n = from_m.size();
    const auto late = lateness(from_m);
    Lattice lattice{n, Points(kRows * n)};
    for (std::size_t k = 0; k < kRows; ++k) {
        const double t_s = (static_cast<double>(k) - 1.0) / static_cast<double>(kRows - 3) * (flight_s + stagger_s);
        for (std::size_t i = 0; i < n; ++i) {
            double share =
                profile_value(ProfileKind::minimum_jerk, std::clamp((t_s - stagger_s * late[i]) / flight_s, 0.0, 1.0));
            if (k < 3) share = 0.0;
            if (k + 3 >= kRows) share = 1.0;
            lattice.at(k, i) = (1.0 - share) * from_m[i] + share * to_m[i];
        }
    }
    return lattice;
}

/// Flown length over the raw act's, by four chords a knot interval.
double path_ratio(const Motion& motion, const Motion& raw) {
    const auto length_m = [](const Motion& m) {
        const std::size_t steps = 4 * interval_count(m);
        const Act act{"", ActRole::transit, Timing::free, 0, static_cast<Millis>(1000 * steps), m};
        Points before = start_positions(m), now(before.size());
        double sum_m = 0.0;
        for (std::size_t s = 1; s <= steps; ++s) {
            positions(act, static_cast<double>(s), now);
            for (std::size_t i = 0; i < now.size(); ++i) sum_m += glm::length(now[i] - before[i]);
            std::swap(before, now);
        }
        return sum_m;
    };
    return length_m(motion) / length_m(raw);
}

struct Outcome {
    double assign_s = 0.0, separate_s = 0.0, certify_s = 0.0;
    Lattice raw;
    Projected projected;
    double certified_m = 0.0;
};

Outcome run_transition(const std::string& name, std::size_t n, double stagger_s) {
    const Instance instance = make_instance(name, n);
    Outcome outcome;
    double start_s = cpu_s();
    const Points to_m = matched(instance);
    outcome.assign_s = cpu_s() - start_s;
    const Straight straight{instance.from_m, to_m, profile_rows(ProfileKind::minimum_jerk, kRows)};
    const double flight_s = 1e-3 * static_cast<double>(shortest_duration(straight, Limits{}).duration_ms);
    outcome.raw = raw_lattice(instance.from_m, to_m, flight_s, stagger_s);
    ProjectionTask task;
    task.required_m = kWanted * kSpacing_m;
    start_s = cpu_s();
    outcome.projected = project_separation(outcome.raw, task, Run{}).value();
    outcome.separate_s = cpu_s() - start_s;
    start_s = cpu_s();
    outcome.certified_m = bound_separation(outcome.projected.lattice, 1.0, task.metric, 2.0 * task.required_m, Run{})
                              .value()
                              .lower_bound_m;
    outcome.certify_s = cpu_s() - start_s;
    if (!outcome.projected.separated || outcome.certified_m < task.required_m - kSeparationTolerance_m) {
        throw std::runtime_error("not separated");
    }
    return outcome;
}

Json transition(const Arguments& arguments) {
    const std::string& name = arguments.word(0);
    const std::size_t n = arguments.count(1);
    const double stagger_s = arguments.number("stagger", 0.0);
    const Outcome outcome = run_transition(name, n, stagger_s);
    const auto duration_s = [](const Lattice& l) {
        return 1e-3 * static_cast<double>(shortest_duration(l, Limits{}).duration_ms);
    };
    const double raw_m = bound_separation(outcome.raw, 1.0, {}, 2.0 * kSpacing_m, Run{}).value().lower_bound_m;
    return Json{}
        .add("instance", name)
        .add("n", static_cast<double>(n))
        .add("stagger_s", stagger_s)
        .add("assign_s", outcome.assign_s)
        .add("separate_s", outcome.separate_s)  // its own certificate included
        .add("certify_s", outcome.certify_s)
        .add("total_s", outcome.assign_s + outcome.separate_s)
        .add("rounds", static_cast<double>(outcome.projected.rounds))
        .add("path_ratio", path_ratio(outcome.projected.lattice, outcome.raw))
        .add("raw_of_spacing", raw_m / kSpacing_m)
        .add("certified_of_spacing", outcome.certified_m / kSpacing_m)
        .add("acceleration_ratio",
             extremes(outcome.projected.lattice, 1.0).acceleration_mps2 / extremes(outcome.raw, 1.0).acceleration_mps2)
        .add("duration_ratio", duration_s(outcome.projected.lattice) / duration_s(outcome.raw));
}

/// The exponent p of cost = c·n^p, by least squares over the logarithms of 1,000 to 20,000 drones.
Json growth(const Arguments& arguments) {
    const std::string& name = arguments.word(0);
    const auto most = static_cast<std::size_t>(arguments.number("most", 20'000));
    double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const std::size_t share : {20U, 10U, 4U, 2U, 1U}) {
        const std::size_t n = most / share;
        const Outcome outcome = run_transition(name, n, arguments.number("stagger", 0.0));
        const double u = std::log(static_cast<double>(n)), v = std::log(outcome.assign_s + outcome.separate_s);
        count += 1.0;
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    return Json{}
        .add("instance", name)
        .add("most", static_cast<double>(most))
        .add("exponent", (count * xy - x * y) / (count * xx - x * x));
}

const Study kTransition{"transition", "INSTANCE N [--stagger SECONDS]", "sheet-sphere 100 --stagger 3", transition};
const Study kGrowth{"transition-growth", "INSTANCE [--most 20000] [--stagger SECONDS]", "random --most 200", growth};

}  // namespace
}  // namespace aerogram::study
