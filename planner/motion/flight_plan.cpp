#include "planner/motion/flight_plan.hpp"

#include <algorithm>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {

std::size_t act_at(const FlightPlan& plan, double t_s) {
    AEROGRAM_REQUIRE(!plan.acts.empty());
    const auto after = std::upper_bound(plan.acts.begin(), plan.acts.end(), t_s,
                                        [](double t, const Act& act) { return t < seconds_from_ms(act.start_ms); });
    return after == plan.acts.begin() ? 0 : static_cast<std::size_t>(after - plan.acts.begin()) - 1;
}

DroneState sample(const FlightPlan& plan, DroneId drone, double t_s) {
    AEROGRAM_REQUIRE(drone.value < plan.drones(), drone.value);
    const Act& act = plan.acts[act_at(plan, t_s)];
    const Tracks& tracks = plan.tracks[drone.value];
    return {kinematics(act, drone, t_s - seconds_from_ms(act.start_ms)), yaw_at(tracks.yaw, t_s),
            light_at(tracks.lights, t_s)};
}

void sample(const FlightPlan& plan, double t_s, std::span<DroneState> out) {
    AEROGRAM_REQUIRE(out.size() == plan.drones(), out.size());
    const Act& act = plan.acts[act_at(plan, t_s)];
    const double local_t_s = t_s - seconds_from_ms(act.start_ms);
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = {kinematics(act, DroneId(i), local_t_s), yaw_at(plan.tracks[i].yaw, t_s),
                  light_at(plan.tracks[i].lights, t_s)};
    }
}

}  // namespace aerogram::planner
