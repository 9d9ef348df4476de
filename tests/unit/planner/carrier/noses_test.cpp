#include "planner/carrier/noses.hpp"

#include <gtest/gtest.h>

#include "carried.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

TEST(Noses, PointAlongTheFlightRoundACorner) {
    const Mission mission = test::planes(test::kCornerRoute);
    const Ride out =
        ride(mission, test::in_order({test::hold("a", test::row(mission, 15), 50000)}), aerogram::Run{}).value();
    const std::vector<YawKey> keys = noses_forward(out.acts, DroneId(0));
    EXPECT_LT(keys.size(), 60U);  // few on the straight lines
    EXPECT_NEAR(keys.front().yaw_rad, -0.5 * kPi, 1e-9);
    EXPECT_NEAR(keys.back().yaw_rad, 0.0, 1e-6);
    EXPECT_EQ(keys.back().time_ms, 50000);
    for (double t = 0.0; t < 50.0; t += 0.2) {
        const Vec3 v = kinematics(out.acts[0], DroneId(0), t).velocity_mps;
        EXPECT_NEAR(yaw_at(keys, t), std::atan2(-v.x, v.y), radians(0.5)) << t;
    }
}

TEST(Noses, YawGoesOnBeyondHalfATurn) {
    const Mission mission =
        test::planes("waypoints_m = [[0, 0, 80], [500, 0, 80], [500, 500, 80], [0, 500, 80], [0, -500, 80]]\n");
    const Ride out =
        ride(mission, test::in_order({test::hold("a", test::row(mission, 15), 110000)}), aerogram::Run{}).value();
    const std::vector<YawKey> keys = noses_forward(out.acts, DroneId(1));
    for (std::size_t k = 1; k < keys.size(); ++k) EXPECT_LT(std::abs(keys[k].yaw_rad - keys[k - 1].yaw_rad), 2.0);
    EXPECT_NEAR(keys.back().yaw_rad, kPi, 1e-6);  // from -90 degrees by +90 three times
}

TEST(Noses, ADroneThatStandsKeepsItsDirection) {
    const Act still{"a", ActRole::hold, Timing::fixed, 0, 1000, Hold{{Vec3{1, 2, 3}}}};
    for (const YawKey& key : noses_forward(std::vector{still}, DroneId(0))) EXPECT_EQ(key.yaw_rad, 0.0);
}

}  // namespace
}  // namespace aerogram::planner
