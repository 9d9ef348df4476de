#include <cmath>

#include "export/outgoing/facts_json.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kFarthest_m = 1e8, kAny = 1e6, kLongest_s = 604'800.0;
constexpr std::size_t kMostCorners = 2'000;

geo::Polygon polygon(const JsonNode& node) {
    geo::Polygon outline;
    const std::size_t corners = node.size();
    if (corners > kMostCorners) node.fail("has too many corners");
    for (std::size_t k = 0; k < corners && !node.problem().found(); ++k) {
        const JsonNode corner = node.at(k);
        outline.emplace_back(corner.at(0).number(-kFarthest_m, kFarthest_m),
                             corner.at(1).number(-kFarthest_m, kFarthest_m));
    }
    if (!outline.empty() && outline.size() < 3) node.fail("needs at least three corners");
    if (outline.size() >= 3 && !geo::is_simple(outline)) node.fail("crosses or touches itself");
    return outline;
}

geo::Obstacle obstacle(const JsonNode& node) {
    geo::Obstacle result;
    result.name = node["name"].text();
    result.base_m = node["base_m"].number(-kFarthest_m, kFarthest_m);
    result.height_m = node["height_m"].number(0.0, kFarthest_m);
    if (const auto outline = node.find("outline_m")) {
        result.shape = geo::Prism{polygon(*outline)};
        if (outline->size() == 0) outline->fail("needs at least three corners");
    } else {
        const JsonNode center = node["center_m"];
        result.shape = geo::Cylinder{
            {center.at(0).number(-kFarthest_m, kFarthest_m), center.at(1).number(-kFarthest_m, kFarthest_m)},
            node["radius_m"].number(0.0, kFarthest_m)};
    }
    return result;
}

geo::Airspace airspace(const JsonNode& node) {
    geo::Airspace air;
    air.geofence_m = polygon(node["geofence_m"]);
    const JsonNode audience = node["audience_m"], obstacles = node["obstacles"];
    for (std::size_t k = 0; k < audience.size() && !node.problem().found(); ++k) {
        air.audience_m.push_back(polygon(audience.at(k)));
        if (audience.at(k).size() == 0) audience.at(k).fail("needs at least three corners");
    }
    for (std::size_t k = 0; k < obstacles.size() && !node.problem().found(); ++k)
        air.obstacles.push_back(obstacle(obstacles.at(k)));
    return air;
}

Limits limits(const JsonNode& node) {
    Limits l;
    l.min_separation_m = node["min_separation_m"].number(0.0, kAny);
    l.formation_spacing_m = node["formation_spacing_m"].number(0.0, kAny);
    l.downwash = node["downwash"].number(1.0, kAny);
    l.export_margin_m = node["export_margin_m"].number(0.0, kAny);
    l.speed_horizontal_mps = node["speed_horizontal_mps"].number(0.0, kAny);
    l.speed_up_mps = node["speed_up_mps"].number(0.0, kAny);
    l.speed_down_mps = node["speed_down_mps"].number(0.0, kAny);
    l.acceleration_mps2 = node["acceleration_mps2"].number(0.0, kAny);
    l.jerk_mps3 = node["jerk_mps3"].number(0.0, kAny);
    l.min_navigation_altitude_m = node["min_navigation_altitude_m"].number(0.0, kAny);
    l.ceiling_m = node["ceiling_m"].number(0.0, kAny);
    if (const auto plane = node.find("plane")) {
        PlaneLimits p;
        p.airspeed_min_mps = (*plane)["airspeed_min_mps"].number(0.0, kAny);
        p.airspeed_max_mps = (*plane)["airspeed_max_mps"].number(0.0, kAny);
        p.turn_rate_dps = (*plane)["turn_rate_dps"].number(0.0, kAny);
        p.climb_mps = (*plane)["climb_mps"].number(0.0, kAny);
        p.sink_mps = (*plane)["sink_mps"].number(0.0, kAny);
        l.plane = p;
    }
    return l;
}

geo::ShowOrigin origin(const JsonNode& node) {
    geo::ShowOrigin result;
    result.ground.latitude_deg = node["latitude_deg"].number(-90.0, 90.0);
    result.ground.longitude_deg = node["longitude_deg"].number(-180.0, 180.0);
    result.ground.height_m = node["height_m"].number(-20'000.0, 20'000.0);
    result.heading_deg = node["heading_deg"].number(-kAny, kAny);
    if (const auto undulation = node.find("geoid_undulation_m"))
        result.geoid_undulation_m = undulation->number(-200.0, 200.0);
    return result;
}

std::string hash(const JsonNode& node) {
    std::string text = node.text();
    if (text.size() != 64 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
        node.fail("must be 64 lower-case hex digits");
    return text;
}

}  // namespace

void read_facts(const JsonNode& facts, RecordedShow& show) {
    if (const auto title = facts.find("title")) show.title = title->text();
    if (const auto text = facts.find("show_hash")) show.show_hash = hash(*text);
    if (const auto certified = facts.find("certified")) show.certified = certified->flag();
    if (const auto endurance = facts.find("endurance_s")) show.endurance_s = endurance->number(0.0, kLongest_s);
    if (const auto place = facts.find("origin")) show.origin = origin(*place);
    if (const auto node = facts.find("limits")) show.limits = limits(*node);
    if (const auto air = facts.find("airspace")) show.airspace = airspace(*air);
    if (const auto cues = facts.find("cues")) {
        for (std::size_t k = 0; k < cues->size() && !facts.problem().found(); ++k)
            show.cues.push_back({std::llround(1000.0 * cues->at(k)["time_s"].number(-kLongest_s, kLongest_s)),
                                 cues->at(k)["name"].text()});
    }
}

}  // namespace aerogram::exporter
