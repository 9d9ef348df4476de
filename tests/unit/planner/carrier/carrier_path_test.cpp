#include "planner/carrier/carrier_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "carried.hpp"
#include "geo/random.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

using test::planes;
using ::testing::HasSubstr;

TEST(CarrierPath, StraightRouteIsItsLine) {
    const CarrierPath path = CarrierPath::through(planes(test::kStraightRoute)).value();
    EXPECT_DOUBLE_EQ(path.length_m(), 1200.0);
    EXPECT_NEAR(glm::length(path.at(500.0) - Vec3(200, 0, 80)), 0.0, 1e-9);
    EXPECT_NEAR(path.yaw_rad(10.0), -0.5 * kPi, 1e-12);
    EXPECT_NEAR(glm::length(path.at(5000.0) - Vec3(900, 0, 80)), 0.0, 1e-9);
}

TEST(CarrierPath, WaypointOnTheLineChangesNothing) {
    const CarrierPath path =
        CarrierPath::through(planes("waypoints_m = [[0, 0, 80], [70, 0, 80], [200, 0, 80]]\n")).value();
    EXPECT_NEAR(path.length_m(), 200.0, 1e-9);
}

TEST(CarrierPath, CornerIsCutOnItsInside) {
    const CarrierPath path = CarrierPath::through(planes(test::kCornerRoute)).value();
    EXPECT_LT(path.length_m(), 1200.0);
    EXPECT_GT(path.length_m(), 600.0 * std::sqrt(2.0));
    // The corner lies on its axis of symmetry.
    const Vec3 middle = path.at(0.5 * path.length_m());
    EXPECT_NEAR(middle.x - 300.0, -middle.y, 1e-8);
    EXPECT_LT(middle.x, 299.0);
}

// Properties 1 to 3 on random routes: ends, unit speed, curvature and its rise within half of the limits.
TEST(CarrierPath, Property1To3_EndsSpeedCurvatureAndSlopeOfRandomRoutes) {
    constexpr std::uint64_t kSeed = 20;
    SCOPED_TRACE(kSeed);
    Random random(kSeed);
    int flown = 0;
    for (int round = 0; round < 40; ++round) {
        Mission mission = planes(test::kStraightRoute);
        Points& places = mission.carrier->waypoints_m;
        places.assign(1, Vec3{random.between(-100, 100), random.between(-100, 100), random.between(60, 120)});
        const std::uint64_t count = 2 + random.below(4);
        double yaw = random.between(-kPi, kPi);
        while (places.size() < count) {
            yaw += random.between(-2.5, 2.5);
            const double way_m = random.between(300, 900);
            places.push_back(places.back() +
                             Vec3{-way_m * std::sin(yaw), way_m * std::cos(yaw), random.between(-30, 30)});
        }
        const auto found = CarrierPath::through(mission);
        if (!found) continue;  // too short for its turns
        ++flown;
        EXPECT_NEAR(glm::length(found->at(0.0) - places.front()), 0.0, 1e-9);
        EXPECT_NEAR(glm::length(found->at(found->length_m()) - places.back()), 0.0, 1e-6);
        double least = 1e9, most = -1e9;  // slopes of the lines; corners that are cut make them steeper
        for (std::size_t w = 1; w < places.size(); ++w) {
            const Vec3 way = places[w] - places[w - 1];
            const double slope = way.z / glm::length(Vec2(way));
            least = std::min({least, slope, 2.5 * slope});
            most = std::max({most, slope, 2.5 * slope});
        }
        const double v = mission.carrier->speed_mps, step = 0.01;
        for (double s = 2.0 * step; s < found->length_m() - 2.0 * step; s += 1.37) {
            const Vec2 before = found->direction(s - step), here = found->direction(s),
                       after = found->direction(s + step);
            EXPECT_NEAR(glm::length(here), 1.0, 1e-12);
            const Vec3 way = (found->at(s + step) - found->at(s - step)) / (2.0 * step);
            EXPECT_NEAR(glm::length(Vec2(way) - here), 0.0, 1e-5);
            EXPECT_GE(way.z, least - 1e-6);
            EXPECT_LE(way.z, most + 1e-6);
            const double bend = glm::length(after - before) / (2.0 * step);
            EXPECT_LE(v * v * bend, 0.5 * mission.limits.acceleration_mps2 * 1.001);
            EXPECT_LE(degrees(v * bend), 0.5 * mission.limits.plane->turn_rate_dps * 1.001);
            const double rise = std::abs(glm::length(after - here) - glm::length(here - before)) / (step * step);
            EXPECT_LE(v * v * v * rise, 0.5 * mission.limits.jerk_mps3 * 1.02);
            const double sag = (found->at(s + step).z - 2.0 * found->at(s).z + found->at(s - step).z) / (step * step);
            EXPECT_LE(v * v * std::abs(sag), 0.25 * mission.limits.acceleration_mps2 * 1.02);
        }
    }
    EXPECT_GE(flown, 15);
}

TEST(CarrierPath, TooShortForItsTurnsIsRefusedWithLengths) {
    const auto path = CarrierPath::through(planes("waypoints_m = [[0, 0, 80], [50, 0, 80], [50, 500, 80]]\n"));
    ASSERT_FALSE(path.ok());
    EXPECT_EQ(path.error().code, ErrorCode::infeasible);
    EXPECT_THAT(path.error().message, HasSubstr("from waypoint 1 to 2 it is 50.0 m; its turns at 18 m/s need "));
}

TEST(CarrierPath, TurningBackIsRefused) {
    const auto path = CarrierPath::through(planes("waypoints_m = [[0, 0, 80], [500, 0, 80], [0, 0, 80]]\n"));
    ASSERT_FALSE(path.ok());
    EXPECT_THAT(path.error().message, HasSubstr("turns back on itself at waypoint 2"));
}

}  // namespace
}  // namespace aerogram::planner
