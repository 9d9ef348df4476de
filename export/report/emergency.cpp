#include "export/report/emergency.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "export/report/parts.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kMostLayers = 1000;

double fastest_mps(const Survey& all) {
    double fastest2 = 0.0;
    for (const Place& v : all.speeds) {
        const double z = static_cast<double>(v.z) * all.downwash;
        fastest2 = std::max(fastest2, static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y + z * z);
    }
    return std::sqrt(fastest2);
}

std::string words(const EmergencyModel& model, double downwash, double lowest_m, double layer_m) {
    std::array<char, 600> text{};
    std::snprintf(
        text.data(), text.size(),
        "hold: brakes with %.2f m/s² on a straight line and stays; land: holds until %.2f s after the alarm, then "
        "sinks "
        "straight down at %.2f m/s and stays on the ground (at the height of its own pad); return: holds until then, "
        "rises at %.2f m/s to %.2f m above the lowest pad (%zu layers %.2f m apart, drone k in layer (k - 1) mod %zu; "
        "whoever is higher stays so), flies straight to above its own pad at %.2f m/s, and sinks at %.2f m/s",
        model.acceleration_mps2, model.wait_s, model.land_mps * downwash, model.rise_mps * downwash, lowest_m,
        model.layers, layer_m, model.layers, model.return_mps, model.land_mps * downwash);
    return text.data();
}

/// What is reported: a lower bound.
ReportApproach approach(const OutgoingShow& show, const Found& found, double within_m) {
    if (!std::isfinite(found.distance)) return {};
    const auto& drones = show.facts().drones;
    return {std::max(0.0, found.distance - within_m), drones[found.first].number, drones[found.second].number,
            found.time_s};
}

}  // namespace

EmergencyModel emergency_model(const OutgoingFacts& facts, const Survey& all) {
    const Limits& limits = facts.limits;
    const planner::ReportWishes& wishes = facts.reporting;
    EmergencyModel model;
    model.acceleration_mps2 = limits.acceleration_mps2;
    const double step_s = all.step_s();
    model.wait_s = std::ceil(fastest_mps(all) / model.acceleration_mps2 / step_s - 1e-6) * step_s;
    model.land_mps = wishes.land_speed_mps.value_or(limits.speed_down_mps) / all.downwash;
    model.rise_mps = limits.speed_up_mps / all.downwash;
    model.return_mps = wishes.return_speed_mps.value_or(limits.speed_horizontal_mps);
    const double layer_m = wishes.return_layer_m.value_or(planned_separation_m(limits) * all.downwash);
    double ground_m = facts.drones.front().home_m.z, highest = wide(all.places.front()).z;
    for (const OutgoingDrone& d : facts.drones) ground_m = std::min(ground_m, d.home_m.z);
    for (const Place& p : all.places) highest = std::max(highest, static_cast<double>(p.z));
    const double highest_m = all.from_metric({0.0, 0.0, highest}).z - ground_m;
    const double lowest_m =
        wishes.return_altitude_m.value_or(std::min(highest_m + layer_m, std::max(highest_m, limits.ceiling_m)));
    const double room_m = limits.ceiling_m - lowest_m;
    const double fit = room_m > 0.0 && layer_m > 0.0 ? std::floor(room_m / layer_m + 1e-9) : 0.0;
    model.layers = 1 + std::min({static_cast<std::size_t>(fit), facts.drones.size() - 1, kMostLayers - 1});
    model.lowest_layer = all.to_metric({0.0, 0.0, ground_m + lowest_m}).z;
    model.layer = layer_m / all.downwash;
    model.words = words(model, all.downwash, lowest_m, layer_m);
    return model;
}

Vec3 Stop::at(double after_s) const {
    if (after_s >= brake_s) return hold;
    return from + speed_mps * (after_s - after_s * after_s / (2.0 * brake_s));
}

Stop stop_of(const Survey& all, const EmergencyModel& model, std::size_t drone, std::size_t second) {
    Stop stop;
    stop.from = wide(all.place(drone, second * all.steps_a_second));
    stop.in_air = all.stance(drone, static_cast<double>(second)) != Stance::on_pad;
    if (!stop.in_air) {
        stop.hold = stop.from;
        stop.stance = Stance::on_pad;
        return stop;
    }
    stop.speed_mps = all.speed(drone, second);
    const Vec3 v = stop.speed_mps;
    stop.brake_s = glm::length(Vec3{v.x, v.y, v.z * all.downwash}) / model.acceleration_mps2;
    stop.hold = stop.from + 0.5 * stop.brake_s * v;
    for (const std::optional<Vec3>& place : all.drones[drone].places) {
        if (!place) continue;
        const Vec3 pad = all.to_metric(*place);
        if (std::hypot(stop.hold.x - pad.x, stop.hold.y - pad.y) <= kStraightAbove_m + all.missed_m)
            stop.stance = Stance::above_pad;
    }
    return stop;
}

double missed_braking_m(const EmergencyModel& model, double step_s) {
    return model.acceleration_mps2 * step_s * step_s / 8.0;
}

double resolution_m(const Survey& all, const EmergencyModel& model) {
    return 2.0 * all.missed_m + missed_braking_m(model, all.step_s());
}

Vec3 home_of(const Survey& all, std::size_t drone) {
    return all.to_metric(all.drones[drone].turn.home_m);
}

double ground_z(const Survey& all, std::size_t drone) {
    return home_of(all, drone).z;
}

Way way_home(const Survey& all, const EmergencyModel& model, std::size_t drone, const Stop& stop) {
    Way way;
    way.hold = stop.hold;
    way.home = home_of(all, drone);
    way.high = {stop.hold.x, stop.hold.y, std::max(stop.hold.z, model.return_z(drone))};
    way.above_home = {way.home.x, way.home.y, way.high.z};
    way.rise_s = model.wait_s;
    way.cross_s = way.rise_s + (way.high.z - way.hold.z) / model.rise_mps;
    way.sink_s = way.cross_s + glm::length(way.above_home - way.high) / model.return_mps;
    way.home_s = way.sink_s + std::max(0.0, way.high.z - way.home.z) / model.land_mps;
    return way;
}

void report_emergencies(const OutgoingShow& show, const Survey& all, const Run& run, Report& report) {
    if (show.facts().limits.plane) {
        report.emergency_model = "planes cannot hold their place: no emergency table";
        return;
    }
    const EmergencyModel model = emergency_model(show.facts(), all);
    report.emergency_model = model.words;
    report.emergency_resolution_m = resolution_m(all, model);
    const std::vector<Manoeuvres> one = one_leaves(all, model, run), together = all_leave(all, model, run);
    const double within_m = report.emergency_resolution_m;
    for (std::size_t s = 0; s < all.seconds; ++s) {
        report.emergencies.push_back(
            {static_cast<double>(s), approach(show, one[s].hold, within_m), approach(show, one[s].land, within_m),
             approach(show, one[s].back, within_m), approach(show, together[s].hold, within_m),
             approach(show, together[s].land, within_m), approach(show, together[s].back, within_m)});
    }
}

}  // namespace aerogram::exporter
