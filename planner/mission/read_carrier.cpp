#include <cmath>

#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

constexpr double kClosestWaypoints_m = 1.0, kFarthest_m = 100'000.0;
constexpr double kLowestBound_mps = 0.01;

// A list of [x, y, z]; empty when it is not one.
Points triples_of(const TomlValue& value) {
    Points out;
    const auto* array = std::get_if<TomlArray>(&value.data);
    if (!array) return {};
    for (const TomlValue& item : *array) {
        const auto* triple = std::get_if<TomlArray>(&item.data);
        if (!triple || triple->size() != 3) return {};
        Vec3 p{};
        for (int axis = 0; axis < 3; ++axis) {
            const auto coordinate = finite_number((*triple)[static_cast<std::size_t>(axis)]);
            if (!coordinate || std::abs(*coordinate) > kFarthest_m) return {};
            p[axis] = *coordinate;
        }
        out.push_back(p);
    }
    return out;
}

Points read_waypoints(TableReader& in) {
    if (!in.need("waypoints_m", "write waypoints_m = [[-300, 0, 80], [300, 0, 80]]")) return {};
    const TomlValue* value = in.find("waypoints_m");
    if (!value) return {};
    Points waypoints = triples_of(*value);
    if (waypoints.size() < 2) {
        in.bad("waypoints_m", "must be a list of >= 2 places [x, y, z] in metres, each within 100000");
        return {};
    }
    for (std::size_t w = 1; w < waypoints.size(); ++w) {
        if (glm::length(Vec2(waypoints[w]) - Vec2(waypoints[w - 1])) >= kClosestWaypoints_m) continue;
        in.bad("waypoints_m", "waypoints " + std::to_string(w) + " and " + std::to_string(w + 1) +
                                  " must be >= " + shown(kClosestWaypoints_m) + " m apart, seen from above");
        return {};
    }
    return waypoints;
}

// What the carrier alone may do; the formations' own movements come on top when the show is planned.
void check_speed(TableReader& in, const Carrier& carrier, const Limits& l) {
    if (l.plane) {
        if (carrier.speed_mps <= l.plane->airspeed_min_mps || carrier.speed_mps >= l.plane->airspeed_max_mps) {
            in.bad("speed_mps", "must be between limits.airspeed_min_mps = " + shown(l.plane->airspeed_min_mps) +
                                    " and limits.airspeed_max_mps = " + shown(l.plane->airspeed_max_mps));
            return;
        }
    } else if (carrier.speed_mps >= l.speed_horizontal_mps) {
        in.bad("speed_mps", "must be < limits.speed_horizontal_mps, which is " + shown(l.speed_horizontal_mps));
        return;
    }
    const double up_mps = l.plane ? l.plane->climb_mps : l.speed_up_mps;
    const double down_mps = l.plane ? l.plane->sink_mps : l.speed_down_mps;
    for (std::size_t w = 1; w < carrier.waypoints_m.size(); ++w) {
        const Vec3 way = carrier.waypoints_m[w] - carrier.waypoints_m[w - 1];
        const double climb_mps = carrier.speed_mps * way.z / glm::length(Vec2(way));
        if (climb_mps < up_mps && -climb_mps < down_mps) continue;
        const bool up = climb_mps > 0.0;
        const std::string limit = l.plane ? (up ? "climb_mps" : "sink_mps") : (up ? "speed_up_mps" : "speed_down_mps");
        in.bad("waypoints_m", "from waypoint " + std::to_string(w) + " to " + std::to_string(w + 1) + " the route " +
                                  (up ? "climbs" : "sinks") + " at " +
                                  shown(std::round(std::abs(climb_mps) * 100.0) / 100.0) + " m/s; must be < limits." +
                                  limit + " = " + shown(up ? up_mps : down_mps));
        return;
    }
}

}  // namespace

void read_carrier(TableReader& root, Mission& mission) {
    auto in = root.table("carrier");
    if (!in) {
        if (mission.fleet.vehicle == Vehicle::plane && !root.has("carrier")) {
            root.problems().add(mission.fleet.line,
                                "fleet.vehicle = \"plane\": planes cannot stand still; write [carrier] with the route "
                                "that the show rides along");
        }
        return;
    }
    Carrier carrier;
    carrier.line = in->line();
    carrier.waypoints_m = read_waypoints(*in);
    in->need("speed_mps", "write the speed along the route in metres a second");
    const auto speed_mps = in->number("speed_mps", {kLowestBound_mps, 100.0});
    carrier.speed_mps = speed_mps.value_or(0.0);
    carrier.turn = in->flag("turn").value_or(carrier.turn);
    if (speed_mps) check_speed(*in, carrier, mission.limits);
    in->finish();
    mission.carrier = std::move(carrier);
}

}  // namespace aerogram::planner
