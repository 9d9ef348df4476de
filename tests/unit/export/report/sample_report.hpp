#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "export/report/report.hpp"

/// Reports as make_report fills them, made up by formula for tests of the pages: any number of drones, certified or
/// not.
namespace aerogram::exporter::sample {

struct Wishes {
    std::size_t drones = 10;
    double duration_s = 300.0;
    bool certified = true;
    std::string title = "The end";
};

inline double wave(double t, double period_s) {
    return 0.5 - 0.5 * std::cos(2.0 * 3.14159265358979 * t / period_s);
}

inline ReportRule rule(const char* name, const char* title, const char* unit, bool at_least, double limit, double worst,
                       std::vector<std::size_t> drones) {
    ReportRule r{name, title, unit, at_least, limit, worst, 0.0, at_least ? worst - limit : limit - worst,
                 {},   {},    {},   true};
    r.drones = std::move(drones);
    r.held = r.margin >= 0.0;
    if (!r.drones.empty()) r.time_s = 31.7 + worst;
    if (!r.drones.empty()) r.place_m = Vec3(12.25 - worst, -4.0 + limit, 33.125);
    return r;
}

inline std::vector<ReportRule> rules(const Wishes& w) {
    const std::size_t n = w.drones;
    std::vector<ReportRule> all;
    all.push_back(rule("separation", "Separation of any two drones", "m", true, 1.5, w.certified ? 1.6334 : 1.4996,
                       {n / 3, n - 1}));
    all.push_back(
        rule("speed_horizontal", "Horizontal speed", "m/s", false, 5.0, w.certified ? 4.871 : 5.8342, {n / 2}));
    all.push_back(rule("speed_up", "Climbing speed", "m/s", false, 2.5, 2.3117, {n / 4 + 1}));
    all.push_back(rule("speed_down", "Sinking speed", "m/s", false, 2.0, 1.9988, {n}));
    all.push_back(rule("acceleration", "Acceleration", "m/s²", false, 2.0, 1.8761, {n / 2}));
    all.push_back(rule("velocity_jump", "Jumps of velocity", "m/s", false, 0.01, 0.0, {}));
    all.push_back(rule("position_jump", "Jumps of position", "m", false, 0.001, 0.0, {}));
    all.push_back(rule("altitude_max", "Altitude above own home", "m", false, 120.0, 86.4567, {n}));
    all.push_back(rule("altitude_min", "Lowest altitude above own home", "m", true, 0.0, 0.0, {1}));
    all.push_back(
        rule("altitude_min_navigation", "Sideways below the navigation altitude", "m", false, 0.1, 0.0123, {2}));
    all.push_back(rule("geofence", "Distance to the geofence, inside", "m", true, 0.0, 12.4471, {n}));
    all.push_back(rule("audience", "Distance to the audience", "m", true, 0.0, 31.3333, {1}));
    all.push_back(rule("obstacles", "Distance to obstacles", "m", true, 2.0, 6.7519, {n / 2}));
    all.push_back(rule("pads", "Start and end at the own pad", "m", false, 0.05, 0.0004, {3}));
    all.push_back(rule("endurance", "Duration", "s", false, 900.0, w.duration_s, {}));
    all[4].allowance = 0.05;
    all[7].allowance = 0.001;
    return all;
}

inline void fill_over_time(Report& r, const Wishes& w) {
    const std::size_t steps = static_cast<std::size_t>(w.duration_s) * 2 + 1;
    const double end = w.duration_s;
    ReportSeries highest{"Highest altitude", "m", {}, 120.0, {}}, lowest{"Lowest altitude in flight", "m", {}, {}, 2.5};
    ReportSeries across{"Horizontal speed", "m/s", {}, 5.0, {}}, up{"Climbing speed", "m/s", {}, 2.5, {}},
        down{"Sinking speed", "m/s", {}, 2.0, {}};
    ReportSeries acceleration{"Acceleration", "m/s²", {}, 2.0, {}}, jerk{"Jerk", "m/s³", {}, 8.0, {}};
    for (std::size_t i = 0; i < steps; ++i) {
        const double t = end * static_cast<double>(i) / static_cast<double>(steps - 1),
                     aloft = std::min({t / 20.0, 1.0, (end - t) / 20.0});
        r.times_s.push_back(t);
        highest.values.push_back(aloft * (55.0 + 31.4567 * wave(t, 110.0)));
        lowest.values.push_back(aloft * (12.0 + 6.0 * wave(t, 75.0)));
        across.values.push_back(aloft * (w.certified ? 4.871 : 5.8342) * wave(t, 37.0));
        up.values.push_back(2.3117 * wave(t + 7.0, 53.0));
        down.values.push_back(1.9988 * wave(t + 29.0, 53.0));
        acceleration.values.push_back(1.8761 * wave(t, 18.5));
        jerk.values.push_back(6.25 * wave(t, 9.25));
        r.nearest_m.push_back(1.6334 + 1.9 * wave(t, 61.0) - (w.certified ? 0.0 : 0.1338));
    }
    r.series = {highest, lowest, across, up, down, acceleration, jerk};
    for (std::size_t i = 0; i < 48; ++i)
        r.histogram.push_back(
            i < 6 ? 0
                  : static_cast<std::size_t>(4000.0 * static_cast<double>(w.drones) *
                                             std::exp(-0.02 * std::pow(static_cast<double>(i) - 11.0, 2))));
    const char* names[] = {"T", "H", "E", "a rather long name of a formation", "N", "D"};
    for (std::size_t i = 0; i < 6; ++i) {
        const double from = end * (0.1 + 0.14 * static_cast<double>(i));
        r.keyframes.push_back({names[i],
                               static_cast<Millis>(1e3 * from),
                               static_cast<Millis>(1e3 * (from + (i == 3 ? 0.0 : 0.06 * end))),
                               {}});
    }
}

inline void fill_pairs(Report& r, const Wishes& w) {
    for (std::size_t i = 0; i < 20; ++i) {
        const double x = static_cast<double>(i);
        ReportEncounter e{1 + (i * 7919) % w.drones,
                          1 + (i * 104729 + 3) % w.drones,
                          20.0 + 11.7 * x,
                          r.min_separation_m + 0.0413 * x * x,
                          1.2 + 0.05 * x,
                          0.4 + 0.02 * x,
                          {x - 9.5, 30.0 - 2.2 * x, 40.0 + x}};
        r.encounters.push_back(e);
        e.horizontal_m = 0.031 * x;
        e.vertical_m = 3.0 + 0.4 * x;
        if (i < 9) r.alignments.push_back(e);
    }
    r.alignment_radius_m = 0.75;
    r.alignment_height_m = 8.0;
}

inline void fill_places(Report& r, const Wishes& w) {
    const std::size_t side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(w.drones))));
    const double half = std::max(20.0, static_cast<double>(side) * 1.1);
    r.airspace.geofence_m = {
        {-half - 60, -40}, {half + 75, -40}, {half + 60, 2 * half + 60}, {-half - 60, 2 * half + 45}};
    r.airspace.audience_m = {{{-half, -95}, {half, -90}, {half, -70}, {-half, -70}}};
    r.airspace.obstacles = {{"church tower", geo::Cylinder{{-half - 35, 20}, 6.0}, 0.0, 48.0},
                            {"light mast, east side of the field",
                             geo::Prism{{{half + 28, 5}, {half + 32, 5}, {half + 32, 9}, {half + 28, 9}}}, 0.0, 22.0}};
    r.volumes.flight_m = {{-half - 20, -8}, {half + 20, -8}, {half + 24, 2 * half}, {-half - 20, 2 * half + 6}};
    r.volumes.contingency_m = {
        {-half - 34, -22}, {half + 34, -22}, {half + 38, 2 * half + 14}, {-half - 34, 2 * half + 20}};
    r.volumes.ground_risk_m = {
        {-half - 135, -122}, {half + 135, -122}, {half + 139, 2 * half + 115}, {-half - 135, 2 * half + 121}};
    r.volumes.flight_height_m = 86.5;
    r.volumes.contingency_height_m = 100.1;
    r.volumes.contingency_m_wide = 13.5;
    r.volumes.ground_risk_m_wide = 100.1;
    r.volumes.speed_mps = 5.0;
    for (std::size_t i = 0; i < w.drones; ++i) {
        const Vec3 home(2.2 * (static_cast<double>(i % side) - 0.5 * static_cast<double>(side)),
                        2.2 * static_cast<double>(i / side), 0.02 * static_cast<double>(i % 7));
        r.homes_m.push_back(home);
        const double wave_s = w.drones > 200 ? 1.5 * static_cast<double>(i / side) : 0.8 * static_cast<double>(i);
        r.turns.push_back({i + 1, wave_s, w.duration_s - 0.5 * wave_s, home, home});
        if (i % (w.drones / 200 + 1) != 0) continue;
        Points way;
        for (int k = 0; k <= 120; ++k) {
            const double t = k / 120.0, a = 6.283 * t * (1.0 + static_cast<double>(i % 5)) + static_cast<double>(i),
                         lift = std::min({1.0, 9 * t, 9 - 9 * t});
            way.push_back(home + lift * Vec3(18.0 * std::sin(a), 12.0 * std::cos(a),
                                             40.0 + 25.0 * std::sin(a) + static_cast<double>(i % 13)));
        }
        r.tracks_m.push_back(way);
    }
}

inline void fill_emergencies(Report& r, const Wishes& w) {
    r.emergency_model =
        "A drone that leaves brakes with 2.0 m/s² and holds; lands straight down at 1.5 m/s; returns by rising to 100 "
        "m in layers of 3.0 m, flying straight to its own pad at 4.0 m/s and landing. The others fly on as planned.";
    r.emergency_resolution_m = 0.05;
    for (std::size_t s = 0; s <= static_cast<std::size_t>(w.duration_s); ++s) {
        const double t = static_cast<double>(s);
        const auto near = [&](double least, double period) {
            return ReportApproach{least + 2.0 * wave(t, period), 1 + s % w.drones, 1 + (s + 5) % w.drones, t + 4.2};
        };
        ReportEmergency e{t,
                          near(0.21, 61.0),
                          near(0.73, 45.0),
                          near(1.31, 70.0),
                          near(1.55, 61.0),
                          near(1.51, 90.0),
                          near(1.62, 33.0)};
        if (s == 0) e.one_holds.distance_m.reset();
        r.emergencies.push_back(e);
    }
}

inline void fill_sensitivity(Report& r) {
    for (const int degrees : {-7, -5, -3, -1, 1, 3, 5, 7}) {
        const double size = std::abs(degrees);
        r.sensitivities.push_back(
            {"heading " + std::string(degrees < 0 ? "−" : "+") + std::to_string(std::abs(degrees)) + "°",
             12.4471 - 1.9 * size, 31.3333 - 1.2 * size, 6.7519 - 0.8 * size, 2.01 * size,
             12.4471 - 1.9 * size >= 0.0});
    }
    for (const char* way : {"north", "east", "south", "west"})
        for (const int metres : {1, 3, 5})
            r.sensitivities.push_back({"origin " + std::to_string(metres) + " m " + way, 12.4471 - metres,
                                       31.3333 - metres, 6.7519 - metres, static_cast<double>(metres), true});
}

inline void fill_formats(Report& r, const Wishes& w) {
    const auto add = [&](const char* name, const char* timing, std::size_t files, double error_m) {
        r.formats.push_back({name, timing, "", files, r.min_separation_m - 1.5 * error_m, error_m, {}, true});
    };
    add("trajectories", "exact", 1, 0.0);
    add("skyc", "exact", w.drones / 5000 + 1, 0.0021);
    add("skyb", "exact", w.drones, 0.0019);
    add("csv", "linear: 4 positions a second", 1, 0.0142);
    add("kml", "linear", 1, 0.0117);
    r.formats.push_back({"waypoints", "none: separation not claimed", "", w.drones, {}, 0.005, {}, true});
    r.formats.push_back({"plan", "", "a board of 650 items cannot hold 812 items of drone 17", 0, {}, 0.0, {}, true});
    if (!w.certified) {
        r.formats.push_back({"vviz",
                             "linear",
                             "",
                             1,
                             1.31,
                             0.02,
                             {"separation 1.310 m of drones 3 and 7 at 31.7 s is below the limit of 1.5 m"},
                             false});
    }
}

inline Report report(const Wishes& w) {
    Report r;
    r.title = w.title;
    r.show_hash = "3f79bb7b435b05321651daefd374cdc681dc06faa65e374e38337b88ca046dea";
    r.program = "Aerogram";
    r.version = "0.1.0";
    r.certified = w.certified;
    if (!w.certified)
        r.reasons = {
            "separation: 1.4996 m between drones " + std::to_string(w.drones / 3) + " and " +
                std::to_string(w.drones - 1) + " at 33.2 s; at least 1.5 m is needed",
            "speed_horizontal: 5.8342 m/s of drone " + std::to_string(w.drones / 2) + "; at most 5 m/s is allowed"};
    r.profile = std::to_string(w.drones) + " copters, preset standard, separation 1.5 m, spacing 2.2 m in formations";
    r.drones = w.drones;
    r.duration_s = w.duration_s;
    r.wind_mps = 8.0;
    r.endurance_s = 900.0;
    r.origin = geo::ShowOrigin{{47.2634512, 11.3945678, 581.25}, 37.5, 47.9};
    r.min_separation_m = w.certified ? 1.6334 : 1.4996;
    r.rules = rules(w);
    fill_over_time(r, w);
    fill_pairs(r, w);
    fill_places(r, w);
    r.energy = {0.37,
                0.6182,
                w.drones / 2,
                0.3818,
                "Hovering uses one second of endurance a second; climbing more, by the thrust it takes.",
                0.15,
                true};
    fill_emergencies(r, w);
    fill_sensitivity(r);
    r.lights = {w.drones * 42, 12.0, 4.0, w.certified ? 0.5 : 3.4, 71.2, !w.certified};
    fill_formats(r, w);
    return r;
}

/// What pad_sheet needs of the same show.
inline OutgoingFacts facts(const Report& r) {
    OutgoingFacts facts;
    facts.title = r.title;
    facts.origin = r.origin;
    facts.fleet = r.drones;
    for (std::size_t i = 0; i < r.drones; ++i)
        facts.drones.push_back({drone_name(i + 1, r.drones), i + 1, r.homes_m[i], r.homes_m[i]});
    return facts;
}

}  // namespace aerogram::exporter::sample
