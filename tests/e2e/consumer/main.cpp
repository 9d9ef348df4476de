// Plans the mission named on the command line and samples the show: everything in it comes from the installed headers.
// Exits 0 only when every drone starts and ends on its pad and no two are closer than the certificate says.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <limits>
#include <vector>

#include <planner/mission/mission_reader.hpp>
#include <planner/motion/flight_plan.hpp>
#include <planner/plan.hpp>

namespace {

using aerogram::planner::DroneState;
using aerogram::planner::FlightPlan;

double farthest_from_pad_m(const FlightPlan& plan, double t_s) {
    std::vector<DroneState> fleet(plan.drones());
    sample(plan, t_s, fleet);
    double farthest_m = 0.0;
    for (std::size_t i = 0; i < fleet.size(); ++i) {
        farthest_m = std::max(farthest_m, glm::distance(fleet[i].motion.position_m, plan.pads_m[i]));
    }
    return farthest_m;
}

double closest_m(const FlightPlan& plan, double t_s) {
    std::vector<DroneState> fleet(plan.drones());
    sample(plan, t_s, fleet);
    const aerogram::SeparationMetric metric{plan.limits.downwash};
    double best_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < fleet.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            best_m = std::min(best_m, metric.distance(fleet[i].motion.position_m, fleet[j].motion.position_m));
        }
    }
    return best_m;
}

int fail(const char* what, double value) {
    std::fprintf(stderr, "consumer: %s: %.9f\n", what, value);
    return 1;
}

int check(const char* mission_file) {
    const auto mission = aerogram::planner::read_mission(mission_file);
    if (!mission) {
        std::fprintf(stderr, "%s\n", mission.error().message.c_str());
        return 2;
    }
    const auto plan = aerogram::planner::plan(*mission, {}, {});
    if (!plan) {
        std::fprintf(stderr, "%s\n", plan.error().message.c_str());
        return 1;
    }
    const double end_s = static_cast<double>(plan->duration_ms()) / 1000.0;
    if (!plan->certificate.certified()) return fail("not certified, separation", plan->certificate.min_separation_m());
    if (farthest_from_pad_m(*plan, 0.0) > 1e-9) return fail("starts off its pad by", farthest_from_pad_m(*plan, 0.0));
    if (farthest_from_pad_m(*plan, end_s) > 1e-9)
        return fail("lands off its pad by", farthest_from_pad_m(*plan, end_s));
    if (farthest_from_pad_m(*plan, end_s / 2.0) < 1.0) return fail("nobody flies at", end_s / 2.0);
    constexpr int kSamples = 500;
    for (int k = 0; k <= kSamples; ++k) {
        const double t_s = end_s * k / kSamples;
        const bool grounded = farthest_from_pad_m(*plan, t_s) < 1e-9;
        if (!grounded && closest_m(*plan, t_s) < plan->limits.min_separation_m) return fail("too close at", t_s);
    }
    std::printf("%zu drones, %.3f s, certified at %.3f m\n", plan->drones(), end_s,
                plan->certificate.min_separation_m());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: consumer MISSION\n");
        return 2;
    }
    try {
        return check(argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "consumer: %s\n", error.what());
        return 1;
    }
}
