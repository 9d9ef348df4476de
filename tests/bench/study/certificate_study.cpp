// How close do drones come, in continuous time, and is an act within its limits: CPU seconds of the straight act's
// bound, of a lattice's, and of the whole certificate of that lattice.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "geo/units.hpp"
#include "planner/assignment/assignment.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/profile.hpp"
#include "tests/bench/study/instances.hpp"
#include "tests/bench/study/study.hpp"

namespace aerogram::study {
namespace {

using namespace planner;

constexpr double kBeyond_m = 2.0 * kSpacing_m;

Straight matched(const std::string& name, std::size_t n, std::size_t intervals) {
    const Instance instance = make_instance(name, n);
    const auto match = assign_shortest(instance.from_m, instance.to_m, {}, SeparationMetric{}, aerogram::Run{}).value();
    Straight straight{instance.from_m, Points(n), profile_rows(ProfileKind::minimum_jerk, intervals + 3)};
    for (std::size_t d = 0; d < n; ++d) straight.to_m[d] = instance.to_m[match.slot_of[d].value];
    for (std::size_t d = 0; d < n; ++d) {
        straight.from_m[d].z += 10.0;
        straight.to_m[d].z += 10.0;
    }
    return straight;
}

/// The straight act on a detour of up to half a metre each, as a projection would leave it.
Lattice bent(const Straight& straight) {
    const Motion motion = straight;
    Lattice lattice{straight.from_m.size(), {}};
    lattice.points_m.reserve(lattice.drones * straight.profile.size());
    for (std::size_t k = 0; k < straight.profile.size(); ++k) {
        const double s = straight.profile[k], size_m = 8.0 * s * s * (1.0 - s) * (1.0 - s);
        for (std::size_t d = 0; d < lattice.drones; ++d) {
            const Vec3& f = straight.from_m[d];
            lattice.points_m.push_back(control_point(motion, k, d) +
                                       size_m * Vec3{std::sin(0.11 * f.x + 0.2 * f.z), std::cos(0.13 * f.y + 0.1 * f.x),
                                                     0.6 * std::sin(0.17 * f.z + 0.05 * f.y)});
        }
    }
    return lattice;
}

/// What it names is there, and nothing sampled is closer than it claims.
void check(const Motion& motion, const SeparationBound& bound, std::size_t samples) {
    const Act act{"", ActRole::transit, Timing::free, 0, 1000, motion};
    Points now(drone_count(motion));
    for (std::size_t s = 0; s <= samples; ++s) {
        positions(act, static_cast<double>(s) / static_cast<double>(samples), now);
        if (smallest_spacing_m(now) < bound.lower_bound_m) throw std::runtime_error("a sample is below the bound");
    }
    if (!bound.closest) return;
    const auto at = [&](DroneId drone) { return kinematics(act, drone, bound.closest->time_s).position_m; };
    const double there_m = glm::length(at(bound.closest->second) - at(bound.closest->first));
    if (std::abs(there_m - bound.closest->distance_m) > 1e-6) throw std::runtime_error("the witness is not there");
    if (bound.lower_bound_m < there_m - 1e-4) throw std::runtime_error("the bound is loose");
}

/// Positions at the knots: INTERVALS rows of N points, three float64 each, for the peer.
void write_samples(const Motion& motion, const std::string& path) {
    const std::size_t intervals = interval_count(motion);
    const Act act{"", ActRole::transit, Timing::free, 0, 1000, motion};
    std::ofstream file(path, std::ios::binary);
    Points now(drone_count(motion));
    for (std::size_t m = 0; m < intervals; ++m) {
        positions(act, static_cast<double>(m) / static_cast<double>(intervals), now);
        file.write(reinterpret_cast<const char*>(now.data()), static_cast<std::streamsize>(now.size() * sizeof now[0]));
    }
    if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

/// A fence, an audience and a mast around whatever the act is.
Surroundings around(const Straight& straight) {
    Surroundings result{geo::ShowFrame({{35.6586, 139.7454, 40.0}, 20.0, std::nullopt}), {}, straight.from_m, {}};
    double far_m = 0.0;
    for (const Points* points : {&straight.from_m, &straight.to_m})
        for (const Vec3& p : *points) far_m = std::max({far_m, std::abs(p.x), std::abs(p.y)});
    for (Vec3& pad : result.pads_m) pad.z = 0.0;
    result.limits.min_separation_m = 1.0;
    result.limits.ceiling_m = 1000.0;
    const double f = far_m + 20.0;
    result.airspace.geofence_m = {{-f, -f}, {f, -f}, {f, f}, {-f, f}};
    result.airspace.audience_m = {{{-40, -f}, {40, -f}, {40, -f + 10}, {-40, -f + 10}}};
    result.airspace.obstacles = {{"mast", geo::Cylinder{{f - 5, f - 5}, 2.0}, 0.0, 25.0}};
    return result;
}

Json certificate(const Arguments& arguments) {
    const std::string& name = arguments.word(0);
    const std::size_t n = arguments.count(1), intervals = arguments.count(2);
    const auto runs = static_cast<std::size_t>(arguments.number("runs", 3));
    aerogram::Run run;
    run.threads = static_cast<unsigned>(arguments.number("threads", 1));
    const Straight straight = matched(name, n, intervals);
    const Motion lattice = bent(straight);
    SeparationBound of_straight, of_lattice;
    const double straight_s =
        median_cpu_s(runs, [&] { of_straight = bound_separation(straight, 1.0, {}, kBeyond_m, run).value(); });
    const double lattice_s =
        median_cpu_s(runs, [&] { of_lattice = bound_separation(lattice, 1.0, {}, kBeyond_m, run).value(); });
    check(straight, of_straight, 20);
    check(lattice, of_lattice, 20);
    const Surroundings surroundings = around(straight);
    const Act act{
        "", ActRole::transit, Timing::free, 0, shortest_duration(lattice, surroundings.limits).duration_ms, lattice};
    ActCertificate judged;
    const double certify_s = median_cpu_s(runs, [&] { judged = certify(act, surroundings, run).value(); });
    if (judged.separation.lower_bound_m != of_lattice.lower_bound_m) throw std::runtime_error("two bounds of one act");
    const std::string samples = arguments.option("samples", "");
    if (!samples.empty()) write_samples(lattice, samples);
    return Json{}
        .add("instance", name)
        .add("n", static_cast<double>(n))
        .add("intervals", static_cast<double>(intervals))
        .add("straight_m", of_straight.lower_bound_m)
        .add("straight_cpu_s", straight_s)
        .add("lattice_m", of_lattice.lower_bound_m)
        .add("lattice_cpu_s", lattice_s)
        .add("certified", judged.certified())
        .add("certify_cpu_s", certify_s);
}

const Study kCertificate{"certificate", "INSTANCE N INTERVALS [--runs 3] [--threads 1] [--samples FILE]",
                         "sheet-sphere 60 40 --runs 1", certificate};

}  // namespace
}  // namespace aerogram::study
