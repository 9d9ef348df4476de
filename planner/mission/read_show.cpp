#include <algorithm>
#include <array>
#include <cmath>

#include "planner/mission/presets.hpp"
#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

constexpr double kLightRate_hz = 25.0;

enum class Datum { ellipsoid, amsl };

void read_origin(TableReader& show, Mission& mission) {
    const auto undulation_m = show.number("geoid_undulation_m", {-150.0, 150.0});
    mission.origin.geoid_undulation_m = undulation_m;
    if (!show.need("origin", "write origin = { latitude_deg = 35.6586, longitude_deg = 139.7454, height_m = 40 }"))
        return;
    auto origin = show.table("origin");
    if (!origin) return;
    geo::Geodetic& ground = mission.origin.ground;
    origin->need("latitude_deg", "write the latitude of show (0, 0, 0) in degrees, north positive");
    origin->need("longitude_deg", "write the longitude of show (0, 0, 0) in degrees, east positive");
    origin->need("height_m", "write the ground's height in metres; datum says above what");
    ground.latitude_deg = origin->number("latitude_deg", {-90.0, 90.0}).value_or(0.0);
    ground.longitude_deg = origin->number("longitude_deg", {-180.0, 180.0}).value_or(0.0);
    ground.height_m = origin->number("height_m", {-500.0, 9000.0}).value_or(0.0);
    mission.origin.heading_deg = origin->number("heading_deg", {-360.0, 360.0}).value_or(0.0);
    const auto datum = origin->choice<Datum>("datum", {{"ellipsoid", Datum::ellipsoid}, {"amsl", Datum::amsl}});
    if (datum == Datum::amsl) {
        if (undulation_m) {
            ground.height_m += *undulation_m;
        } else if (!show.has("geoid_undulation_m")) {
            origin->bad("datum", "needs show.geoid_undulation_m, the ellipsoid's height minus AMSL at the origin");
        }
    }
    origin->finish();
}

// [fleet] vehicle is read after the limits, which depend on it.
bool names_planes(TableReader& root) {
    const TomlValue* fleet = root.find("fleet");
    const auto* table = fleet ? std::get_if<TomlTable>(&fleet->data) : nullptr;
    if (!table) return false;
    return std::any_of(table->begin(), table->end(), [](const TomlEntry& entry) {
        const auto* word = std::get_if<std::string>(&entry.value.data);
        return entry.key == "vehicle" && word && *word == "plane";
    });
}

Preset read_preset(TableReader& limits, bool planes) {
    const auto preset = limits.choice<Preset>("preset", {{"dense", Preset::dense},
                                                         {"standard", Preset::standard},
                                                         {"conservative", Preset::conservative},
                                                         {"indoor", Preset::indoor},
                                                         {"airplane", Preset::airplane}});
    const Preset usual = planes ? Preset::airplane : Preset::standard;
    if (!preset || (*preset == Preset::airplane) == planes) return preset.value_or(usual);
    limits.bad("preset",
               planes ? "must be \"airplane\" for fleet.vehicle = \"plane\"" : "needs fleet.vehicle = \"plane\"");
    return usual;
}

// Speeds of copters or of planes; the others' keys are refused.
void read_speeds(TableReader& limits, Limits& l) {
    constexpr std::array<std::string_view, 3> kCopter{"speed_horizontal_mps", "speed_up_mps", "speed_down_mps"};
    constexpr std::array<std::string_view, 5> kPlane{"airspeed_min_mps", "airspeed_max_mps", "turn_rate_dps",
                                                     "climb_mps", "sink_mps"};
    const auto set = [&](std::string_view key, double& value, const Range& range) {
        value = limits.number(key, range).value_or(value);
    };
    if (!l.plane) {
        set(kCopter[0], l.speed_horizontal_mps, more_than(0.0, 100.0));
        set(kCopter[1], l.speed_up_mps, more_than(0.0, 100.0));
        set(kCopter[2], l.speed_down_mps, more_than(0.0, 100.0));
        limits.misplaced(kPlane, "needs fleet.vehicle = \"plane\"");
        return;
    }
    PlaneLimits& p = *l.plane;
    set(kPlane[0], p.airspeed_min_mps, more_than(0.0, 100.0));
    set(kPlane[1], p.airspeed_max_mps, more_than(0.0, 200.0));
    set(kPlane[2], p.turn_rate_dps, more_than(0.0, 360.0));
    set(kPlane[3], p.climb_mps, more_than(0.0, 100.0));
    set(kPlane[4], p.sink_mps, more_than(0.0, 100.0));
    limits.misplaced(kCopter, "is for copters; planes have airspeed_max_mps, climb_mps and sink_mps");
    if (p.airspeed_max_mps <= p.airspeed_min_mps) {
        const std::string_view key = limits.has("airspeed_max_mps") ? "airspeed_max_mps" : "airspeed_min_mps";
        limits.bad(key, key == kPlane[1] ? "must be > airspeed_min_mps, which is " + shown(p.airspeed_min_mps)
                                         : "must be < airspeed_max_mps, which is " + shown(p.airspeed_max_mps));
    }
}

}  // namespace

void read_show(TableReader& root, Mission& mission) {
    if (!root.need("show", "write [show] with a name and an origin")) return;
    auto show = root.table("show");
    if (!show) return;
    show->need("name", "write name = \"THE END\"");
    mission.name = show->name("name").value_or("");
    mission.seed =
        static_cast<std::uint64_t>(show->integer("seed", 0, std::numeric_limits<std::int64_t>::max()).value_or(1));
    read_origin(*show, mission);
    mission.audio = show->file("audio", "an audio file beside the mission");
    mission.objective = show->choice<Objective>("objective", {{"shortest", Objective::shortest},
                                                              {"together", Objective::together},
                                                              {"smooth", Objective::smooth}})
                            .value_or(mission.objective);
    mission.seat_m = show->vec3("seat_m");
    show->finish();
}

void read_limits(TableReader& root, Mission& mission) {
    const TomlTable none;
    auto in = root.table("limits");
    TableReader reader = in ? *in : TableReader(none, root.line(), "limits", root.problems());
    const bool planes = names_planes(root);
    Limits& l = mission.limits;
    l = preset_limits(read_preset(reader, planes));
    const auto set = [&](std::string_view key, double& value, const Range& range) {
        value = reader.number(key, range).value_or(value);
    };
    set("min_separation_m", l.min_separation_m, at_least(0.1, 100.0));
    set("export_margin_m", l.export_margin_m, at_least(0.0, 1.0));
    set("downwash", l.downwash, at_least(1.0, 10.0));
    if (reader.has("min_separation_m"))
        l.formation_spacing_m = default_spacing_m(planned_separation_m(l), l.formation_spacing_m);
    const auto spacing_m = reader.number("formation_spacing_m", more_than(0.0, 1000.0));
    if (spacing_m && *spacing_m < planned_separation_m(l)) {
        reader.bad("formation_spacing_m",
                   "must be >= " + shown(planned_separation_m(l)) + ", min_separation_m plus export_margin_m");
    }
    l.formation_spacing_m = spacing_m.value_or(l.formation_spacing_m);
    read_speeds(reader, l);
    set("acceleration_mps2", l.acceleration_mps2, more_than(0.0, 100.0));
    l.jerk_mps3 = default_jerk_mps3(l.acceleration_mps2, planes);
    set("jerk_mps3", l.jerk_mps3, more_than(0.0, 10000.0));
    set("min_navigation_altitude_m", l.min_navigation_altitude_m, at_least(0.0, 1000.0));
    const double before_m = l.ceiling_m;
    set("ceiling_m", l.ceiling_m, more_than(0.0, 10000.0));
    if (l.ceiling_m <= l.min_navigation_altitude_m) {
        const bool theirs = reader.has("ceiling_m") && l.ceiling_m != before_m;
        reader.bad(theirs ? "ceiling_m" : "min_navigation_altitude_m",
                   theirs ? "must be > min_navigation_altitude_m, which is " + shown(l.min_navigation_altitude_m)
                          : "must be < ceiling_m, which is " + shown(l.ceiling_m));
    }
    reader.finish();
}

void read_lights(TableReader& root, Mission& mission) {
    auto lights = root.table("lights");
    if (!lights) return;
    mission.light_rate_hz = lights->number("rate_hz", {1.0, 50.0}).value_or(mission.light_rate_hz);
    if (mission.light_rate_hz != kLightRate_hz) lights->later("rate_hz", "exports choose their own rates");
    lights->finish();
}

}  // namespace aerogram::planner
