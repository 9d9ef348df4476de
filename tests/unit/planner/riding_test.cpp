#include "planner/riding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/mission/mission_reader.hpp"
#include "planner/plan.hpp"

namespace aerogram::planner {
namespace {

using ::testing::HasSubstr;

/// @param fleet  more keys of [fleet]. @param keyframes  and [carrier].
Mission riding(const std::string& fleet, const std::string& keyframes, const std::string& limits = "") {
    const std::string head =
        "[show]\nname = \"riding\"\norigin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = 400 }\n"
        "geoid_undulation_m = 48.9\n[fleet]\ndrones = 6\npads = { rows = 2, columns = 3, spacing_m = 10 }\n";
    return parse_mission(head + fleet + "[limits]\n" + limits + keyframes, "riding.toml").value();
}

const std::string kPlanes = "vehicle = \"plane\"\n";
const std::string kLine = "[[keyframe]]\nname = \"line\"\nshape = \"line\"\n";
const std::string kCircle = "[[keyframe]]\nname = \"circle\"\nshape = \"circle\"\n";
const std::string kRace =
    "[carrier]\nwaypoints_m = [[-300, 0, 80], [300, 0, 80], [300, 300, 90], [-600, 300, 90]]\nspeed_mps = 18\n";
const std::string kWalk = "[carrier]\nwaypoints_m = [[0, 10, 30], [60, 10, 30], [60, 50, 32]]\nspeed_mps = 2.5\n";

TEST(PlanRiding, PlanesBeginAndEndInFlightWithTheirNosesForward) {
    const auto plan = planner::plan(riding(kPlanes, kLine + kCircle + kRace), {}, aerogram::Run{});
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    ASSERT_EQ(plan->acts.size(), 3U);
    EXPECT_EQ(plan->acts[0].name, "line");
    EXPECT_EQ(plan->acts[0].start_ms, 0);
    EXPECT_TRUE(plan->certificate.certified());
    for (const double t : {0.0, 7.0, 1e-3 * static_cast<double>(plan->duration_ms())}) {
        const DroneState state = sample(*plan, DroneId(2), t);
        const Vec3 v = state.motion.velocity_mps;
        EXPECT_GT(glm::length(v), 12.0);
        EXPECT_NEAR(std::remainder(state.yaw_rad - std::atan2(-v.x, v.y), 6.283185307179586), 0.0, 0.01);
    }
    for (const ActCertificate& act : plan->certificate.acts) ASSERT_TRUE(act.plane);
    // The keyframes' places are those of their beginning.
    const PlannedKeyframe& circle = plan->keyframes[1];
    const Vec3 there = sample(*plan, DroneId(4), 1e-3 * static_cast<double>(circle.stands_from_ms)).motion.position_m;
    EXPECT_NEAR(glm::length(there - circle.formation_m[circle.slot_of[4].value]), 0.0, 1e-6);
}

TEST(PlanRiding, CoptersTakeOffRideAndReturnHome) {
    const auto plan = planner::plan(riding("", kLine + kCircle + kWalk), {}, aerogram::Run{});
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    EXPECT_EQ(plan->acts.front().role, ActRole::takeoff);
    EXPECT_EQ(plan->acts.back().role, ActRole::landing);
    Millis end_ms = 0;
    for (std::size_t a = 0; a < plan->acts.size(); ++a) {
        EXPECT_EQ(plan->acts[a].start_ms, end_ms);
        end_ms = plan->acts[a].end_ms();
        if (a == 0) continue;
        for (std::size_t d = 0; d < 6; ++d) {
            const Kinematics before = kinematics(plan->acts[a - 1], DroneId(d), 1e9),
                             after = kinematics(plan->acts[a], DroneId(d), 0);
            EXPECT_NEAR(glm::length(before.position_m - after.position_m), 0.0, 1e-6) << plan->acts[a].name;
            EXPECT_NEAR(glm::length(before.velocity_mps - after.velocity_mps), 0.0, 1e-6) << plan->acts[a].name;
        }
    }
    for (std::size_t d = 0; d < 6; ++d)
        EXPECT_NEAR(glm::length(sample(*plan, DroneId(d), 1e6).motion.position_m - plan->pads_m[d]), 0.0, 1e-9);
}

TEST(PlanRiding, FormationStandsAtItsTime) {
    const auto plan = planner::plan(riding(kPlanes, kLine + kCircle + "at_s = 24.5\n" + kRace), {}, aerogram::Run{});
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    EXPECT_EQ(plan->keyframes[1].stands_from_ms, 24500);
}

TEST(PlanRiding, ADurationTooShortForTheGroundIsRefusedWithTheShortest) {
    const auto plan =
        planner::plan(riding(kPlanes, kLine + kCircle + "size_m = [90, 90]\narrive = { duration_s = 5 }\n" + kRace), {},
                      aerogram::Run{});
    ASSERT_FALSE(plan.ok());
    EXPECT_THAT(plan.error().message, HasSubstr("keyframe[2].arrive.duration_s = 5: must be >= "));
}

TEST(PlanRiding, PlanesNeedAFirstFormationThatIsHeldFromTheBeginning) {
    const auto late = planner::plan(riding(kPlanes, kLine + "at_s = 3\n" + kCircle + kRace), {}, aerogram::Run{});
    ASSERT_FALSE(late.ok());
    EXPECT_THAT(late.error().message, HasSubstr("keyframe[1].at_s: planes begin the show in the first keyframe"));
}

TEST(PlanRiding, ARouteTooShortForTheShowIsRefused) {
    const auto plan = planner::plan(
        riding(kPlanes, kLine + kCircle + "[carrier]\nwaypoints_m = [[0, 0, 80], [100, 0, 80]]\nspeed_mps = 18\n"), {},
        aerogram::Run{});
    ASSERT_FALSE(plan.ok());
    EXPECT_THAT(plan.error().message, HasSubstr("riding.toml:"));
    EXPECT_THAT(plan.error().message, HasSubstr("the route is 100.0 m long"));
}

}  // namespace
}  // namespace aerogram::planner
