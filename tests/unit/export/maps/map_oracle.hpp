#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "geo/units.hpp"
#include "planner/motion/flight_plan.hpp"
#include "tests/unit/export/fixed_show.hpp"

/// What map files are checked against: textbook geodesy written here, and the plan itself.
namespace aerogram::exporter::oracle {

inline Vec3 earth_centred(double longitude_deg, double latitude_deg, double height_m) {
    constexpr double kRadius_m = 6'378'137.0, kFlattening = 1.0 / 298.257223563;
    constexpr double kSquare = kFlattening * (2.0 - kFlattening);
    const double lat = radians(latitude_deg), lon = radians(longitude_deg);
    const double n = kRadius_m / std::sqrt(1.0 - kSquare * std::sin(lat) * std::sin(lat));
    return {(n + height_m) * std::cos(lat) * std::cos(lon), (n + height_m) * std::cos(lat) * std::sin(lon),
            (n * (1.0 - kSquare) + height_m) * std::sin(lat)};
}

/// Show frame of a place. @param place  longitude, latitude, metres above the ellipsoid.
inline Vec3 to_show(const geo::ShowOrigin& origin, const Vec3& place) {
    const geo::Geodetic& o = origin.ground;
    const Vec3 d =
        earth_centred(place.x, place.y, place.z) - earth_centred(o.longitude_deg, o.latitude_deg, o.height_m);
    const double lat = radians(o.latitude_deg), lon = radians(o.longitude_deg), turn = radians(origin.heading_deg);
    const double east = -std::sin(lon) * d.x + std::cos(lon) * d.y;
    const double across = std::cos(lon) * d.x + std::sin(lon) * d.y;
    const double north = -std::sin(lat) * across + std::cos(lat) * d.z;
    const double up = std::cos(lat) * across + std::sin(lat) * d.z;
    return {std::cos(turn) * east - std::sin(turn) * north, std::sin(turn) * east + std::cos(turn) * north, up};
}

/// A plan anywhere on the globe.
inline planner::FlightPlan show_at(double latitude_deg, double longitude_deg) {
    planner::FlightPlan plan = fixed::show();
    plan.origin.ground = {latitude_deg, longitude_deg, 40.0};
    return plan;
}

/// Every drone is where the plan has it: within fit and rounding at all times, within rounding at corners.
inline void expect_flown(const RecordedShow& show, const planner::FlightPlan& plan) {
    ASSERT_EQ(show.drones.size(), plan.drones());
    ASSERT_TRUE(well_formed(show).ok());
    EXPECT_DOUBLE_EQ(show.duration_s, seconds_from_ms(plan.duration_ms()));
    const double rounded_m = show.rounding.position_m + 1e-7;
    for (std::size_t i = 0; i < show.drones.size(); ++i) {
        for (Millis t = 0; t <= plan.duration_ms(); t += 7) {
            const Vec3 exact = planner::sample(plan, DroneId(i), seconds_from_ms(t)).motion.position_m;
            ASSERT_LE(glm::length(position_at(show.drones[i], seconds_from_ms(t)) - exact),
                      show.rounding.fit_m + std::sqrt(3.0) * rounded_m)
                << i << " at " << t;
        }
        for (const Piece& piece : show.drones[i].pieces) {
            const Vec3 miss = position_at(show.drones[i], piece.start_s) -
                              planner::sample(plan, DroneId(i), piece.start_s).motion.position_m;
            for (const double off : {miss.x, miss.y, miss.z}) ASSERT_LE(std::abs(off), rounded_m);
        }
        EXPECT_EQ(show.drones[i].home_m, plan.pads_m[i]);
        EXPECT_EQ(show.drones[i].land_m, plan.pads_m[i]);
    }
}

/// The numbers behind each `before` up to `after`.
inline std::vector<std::vector<double>> numbers_between(const std::string& text, const std::string& before,
                                                        const std::string& after) {
    std::vector<std::vector<double>> found;
    for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at)) {
        at += before.size();
        const std::string inside = text.substr(at, text.find(after, at) - at);
        found.emplace_back();
        for (const char* c = inside.c_str(); *c != '\0';) {
            char* end = nullptr;
            const double number = std::strtod(c, &end);
            if (end != c) found.back().push_back(number);
            c = end == c ? c + 1 : end;
        }
    }
    return found;
}

}  // namespace aerogram::exporter::oracle
