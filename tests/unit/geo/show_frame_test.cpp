#include "geo/show_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::geo {
namespace {

constexpr double kEquatorialRadius_m = 6378137.0;
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);

/// Earth-centred coordinates by the textbook closed form (the oracle: nothing of GeographicLib in it).
Vec3 earth_centred(const Geodetic& g) {
    const double lat = radians(g.latitude_deg), lon = radians(g.longitude_deg);
    const double n = kEquatorialRadius_m / std::sqrt(1.0 - kEccentricity2 * std::sin(lat) * std::sin(lat));
    return {(n + g.height_m) * std::cos(lat) * std::cos(lon), (n + g.height_m) * std::cos(lat) * std::sin(lon),
            (n * (1.0 - kEccentricity2) + g.height_m) * std::sin(lat)};
}

/// Where a show point is, earth-centred, from the frame's definition: origin + x right + y forward + z up.
Vec3 earth_centred(const ShowOrigin& origin, const Vec3& p) {
    const double lat = radians(origin.ground.latitude_deg), lon = radians(origin.ground.longitude_deg);
    const double heading = radians(origin.heading_deg);
    const Vec3 east{-std::sin(lon), std::cos(lon), 0.0};
    const Vec3 north{-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)};
    const Vec3 up{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
    const Vec3 forward = std::sin(heading) * east + std::cos(heading) * north;
    const Vec3 right = std::cos(heading) * east - std::sin(heading) * north;
    return earth_centred(origin.ground) + p.x * right + p.y * forward + p.z * up;
}

std::vector<std::pair<const char*, ShowOrigin>> origins() {
    return {{"equator", {{0.0, 0.0, 0.0}, 0.0, {}}},
            {"60 north", {{60.0, 25.0, 20.0}, 33.0, {}}},
            {"date line", {{-17.5, 179.9999, 5.0}, 250.0, {}}},
            {"date line, other side", {{51.9, -179.9999, 5.0}, 359.5, {}}},
            {"southern hemisphere", {{-33.8568, 151.2153, 30.0}, -45.0, {}}},
            {"near the pole", {{89.5, 100.0, 0.0}, 180.0, {}}},
            {"Dead Sea", {{31.5, 35.5, -410.0}, 77.25, {}}},
            {"high plateau", {{35.6586, 139.7454, 4000.0}, 20.0, 36.7}}};
}

std::vector<Vec3> points(double reach_m, unsigned seed) {
    std::mt19937_64 random(seed);
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 * 2.0 - 1.0; };
    std::vector<Vec3> out{{0.0, 0.0, 0.0}, {reach_m, 0.0, 0.0}, {0.0, reach_m, 0.0}, {0.0, 0.0, reach_m / 10.0}};
    for (int i = 0; i < 200; ++i) {
        const double x = unit(), y = unit(), z = unit();
        out.emplace_back(x * reach_m, y * reach_m, z * reach_m / 100.0);
    }
    return out;
}

TEST(ShowFrame, AgreesWithEarthCentredClosedFormEverywhere) {
    for (const auto& [name, origin] : origins()) {
        SCOPED_TRACE(name);
        const ShowFrame frame(origin);
        for (const Vec3& p : points(2000.0, 1)) {
            const Geodetic place = frame.to_geodetic(p);
            // Earth-centred numbers are 6e6: their last digit is 1e-9.
            EXPECT_LT(glm::length(earth_centred(place) - earth_centred(origin, p)), 1e-8);
        }
    }
}

TEST(ShowFrame, Property1RoundTripWithin100Kilometres) {
    for (const auto& [name, origin] : origins()) {
        SCOPED_TRACE(name);
        const ShowFrame frame(origin);
        for (const Vec3& p : points(100e3, 2)) {
            EXPECT_LT(glm::length(frame.to_show(frame.to_geodetic(p)) - p), 1e-8) << p.x << ' ' << p.y << ' ' << p.z;
        }
    }
}

TEST(ShowFrame, Property2OriginMapsToZero) {
    for (const auto& [name, origin] : origins()) {
        SCOPED_TRACE(name);
        const ShowFrame frame(origin);
        EXPECT_LT(glm::length(frame.to_show(origin.ground)), 1e-8);
        const Geodetic place = frame.to_geodetic({0.0, 0.0, 0.0});
        EXPECT_NEAR(place.latitude_deg, origin.ground.latitude_deg, 1e-12);
        EXPECT_NEAR(place.longitude_deg, origin.ground.longitude_deg, 1e-11);
        EXPECT_NEAR(place.height_m, origin.ground.height_m, 1e-8);
    }
}

TEST(ShowFrame, Property3ForwardAtHeading90GoesEast) {
    const ShowFrame frame({{0.0, 10.0, 0.0}, 90.0, {}});
    const Geodetic forward = frame.to_geodetic({0.0, 100.0, 0.0});
    EXPECT_EQ(forward.latitude_deg, 0.0);  // exactly: sine and cosine of whole right angles are exact
    EXPECT_GT(forward.longitude_deg, 10.0);
    const Geodetic right = frame.to_geodetic({100.0, 0.0, 0.0});
    EXPECT_LT(right.latitude_deg, 0.0);
    EXPECT_NEAR(right.longitude_deg, 10.0, 1e-12);
}

TEST(ShowFrame, ForwardAtHeading0GoesNorthAndRightGoesEast) {
    const ShowFrame frame({{45.0, 10.0, 0.0}, 0.0, {}});
    EXPECT_GT(frame.to_geodetic({0.0, 100.0, 0.0}).latitude_deg, 45.0);
    EXPECT_GT(frame.to_geodetic({100.0, 0.0, 0.0}).longitude_deg, 10.0);
}

TEST(ShowFrame, LongitudeWrapsAtTheDateLine) {
    const ShowFrame frame({{0.0, 179.9999, 0.0}, 0.0, {}});
    const Geodetic east = frame.to_geodetic({1000.0, 0.0, 0.0});
    EXPECT_LT(east.longitude_deg, -179.9);
    EXPECT_GE(east.longitude_deg, -180.0);
    EXPECT_NEAR(frame.to_show({0.0, east.longitude_deg + 360.0, east.height_m}).x, 1000.0, 1e-7);
}

TEST(ShowFrame, TangentPlaneRisesEightCentimetresAtOneKilometre) {
    const ShowFrame frame({{35.6586, 139.7454, 40.0}, 20.0, {}});
    // d²/2R with R between the ellipsoid's extreme radii of curvature.
    const double altitude_m = frame.altitude_above({0.0, 0.0, 0.0}, {0.0, 1000.0, 0.0});
    EXPECT_GT(altitude_m, 1e6 / (2.0 * 6400e3));
    EXPECT_LT(altitude_m, 1e6 / (2.0 * 6335e3));
    EXPECT_NEAR(altitude_m, 0.08, 0.002);
}

TEST(ShowFrame, AltitudeCountsFromTheGivenHome) {
    const ShowFrame frame({{-33.8568, 151.2153, 30.0}, 70.0, {}});
    EXPECT_NEAR(frame.altitude_above({0.0, 0.0, 2.0}, {0.0, 0.0, 42.0}), 40.0, 1e-8);
    EXPECT_NEAR(frame.altitude_above({500.0, 0.0, 0.0}, {500.0, 0.0, 40.0}), 40.0, 1e-6);
    EXPECT_NEAR(frame.altitude_above({3.0, 4.0, 5.0}, {3.0, 4.0, 5.0}), 0.0, 1e-9);
}

TEST(ShowFrame, AmslIsEllipsoidMinusUndulation) {
    const ShowFrame frame({{35.6586, 139.7454, 40.0}, 20.0, 36.7});
    const auto height = frame.amsl_m({0.0, 0.0, 10.0});
    ASSERT_TRUE(height.ok());
    EXPECT_NEAR(*height, 40.0 + 10.0 - 36.7, 1e-8);
}

TEST(ShowFrame, AmslWithoutUndulationIsRefused) {
    const ShowFrame frame({{35.6586, 139.7454, 40.0}, 20.0, {}});
    const auto height = frame.amsl_m({0.0, 0.0, 10.0});
    ASSERT_FALSE(height.ok());
    EXPECT_EQ(height.error().code, ErrorCode::invalid_input);
    EXPECT_NE(height.error().message.find("geoid_undulation_m"), std::string::npos);
}

TEST(ShowFrame, CopiesStandOnTheirOwn) {
    ShowFrame frame({{10.0, 20.0, 30.0}, 40.0, {}});
    const ShowFrame copy = frame;
    frame = ShowFrame({{-10.0, -20.0, 0.0}, 0.0, {}});
    EXPECT_EQ(copy.origin().ground.latitude_deg, 10.0);
    EXPECT_NEAR(copy.to_geodetic({}).latitude_deg, 10.0, 1e-12);
    EXPECT_NEAR(frame.to_geodetic({}).latitude_deg, -10.0, 1e-12);
}

TEST(ShowFrame, PlacesThatAreNoPlaceAreABug) {
    EXPECT_THROW(ShowFrame({{90.5, 0.0, 0.0}, 0.0, {}}), ContractViolation);
    EXPECT_THROW(ShowFrame({{std::nan(""), 0.0, 0.0}, 0.0, {}}), ContractViolation);
    EXPECT_THROW(ShowFrame({{0.0, 0.0, 0.0}, HUGE_VAL, {}}), ContractViolation);
}

}  // namespace
}  // namespace aerogram::geo
