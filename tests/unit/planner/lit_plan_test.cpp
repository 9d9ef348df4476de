#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/units.hpp"
#include "planner/light/light_time.hpp"
#include "planner/plan.hpp"
#include "small_shows.hpp"

namespace aerogram::planner {
namespace {

using namespace test;

constexpr double kNear = 1.0 / 512.0 + 1e-9;

FlightPlan planned(const Mission& mission, unsigned threads = 1) {
    auto plan = planner::plan(mission, {}, aerogram::Run{{}, nullptr, threads});
    return std::move(plan).value();
}

double apart(const Rgb& a, const Rgb& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Red at the low end of a keyframe's slots along an axis, blue at the other; the keyframe as it was planned.
void expect_gradient(const FlightPlan& plan, const PlannedKeyframe& keyframe, const Vec3& axis, double t_s) {
    double low = 1e300, high = -1e300;
    for (const Vec3& p : keyframe.formation_m) {
        low = std::min(low, glm::dot(p, axis));
        high = std::max(high, glm::dot(p, axis));
    }
    for (std::size_t d = 0; d < plan.drones(); ++d) {
        const double share = (glm::dot(keyframe.formation_m[keyframe.slot_of[d].value], axis) - low) / (high - low);
        const Rgb seen = sample(plan, DroneId(d), t_s).color;
        EXPECT_LE(apart(seen, mix(Rgb{1, 0, 0}, Rgb{0, 0, 1}, share)), kNear) << t_s << ' ' << d;
    }
}

const std::string kGradient = "effect = \"gradient\"\ncolors = [\"#f00\", \"#00f\"]\n";

TEST(LitPlan, LightsOfAKeyframeMoveWithItsSpin) {
    const FlightPlan plan = planned(show_of(keyframe("a", "circle", "hold_s = 12\nmotion = { spin_deg = 90 }") +
                                            "[[light]]\nkeyframe = \"a\"\n" + kGradient));
    const PlannedKeyframe& a = plan.keyframes[0];
    for (const double into_s : {0.02, 4.0, 8.0, 11.9})  // lights begin on ticks
        expect_gradient(plan, a, {1, 0, 0}, seconds_from_ms(a.stands_from_ms) + into_s);
}

TEST(LitPlan, LightsOfTheShowDoNot) {
    const FlightPlan plan = planned(show_of(keyframe("a", "line", "hold_s = 12\nmotion = { spin_deg = 180 }") +
                                            "[[light]]\nvolume = { center_m = [-50, 0, 40], size_m = [98, 99, 99] }\n" +
                                            kGradient + "in_time = true\n"));
    const double from_s = seconds_from_ms(plan.keyframes[0].stands_from_ms);
    for (const double t_s : {from_s + 0.5, from_s + 11.5}) {
        for (std::size_t d = 0; d < plan.drones(); ++d) {
            const DroneState state = sample(plan, DroneId(d), t_s);
            EXPECT_EQ(apart(state.color, Rgb{1, 1, 1}) < kNear, state.motion.position_m.x > -1.0) << t_s << ' ' << d;
        }
    }
}

TEST(LitPlan, ClustersAreGroupsThatLightsCanBeMadeFor) {
    Mission mission = show_of("[[group]]\nname = \"all\"\ndrones = \"1-8\"\ncluster = { count = 2 }\n" +
                              keyframe("a", "line", "hold_s = 6"));
    Light light;
    light.effect = LightEffect::pulse;
    light.keyframe = "a";
    light.period_s = 4.0;
    light.colors.assign(1, Rgb{1, 0, 0});
    light.group = mission.groups[0].inside.front();
    mission.lights.push_back(light);
    const FlightPlan plan = planned(mission);
    std::size_t red = 0;
    for (std::size_t d = 0; d < 8; ++d)
        if (sample(plan, DroneId(d), seconds_from_ms(plan.keyframes[0].stands_from_ms) + 2.0).color.g < 0.1) ++red;
    EXPECT_GT(red, 0U);
    EXPECT_LT(red, 8U);
}

/// Formations that turn with their carrier: a light's axes are the mission's, not the ground's.
TEST(LitPlan, LightsRideAlong) {
    const std::string carrier =
        "[carrier]\nwaypoints_m = [[0, 10, 30], [60, 10, 30], [60, 50, 32]]\nspeed_mps = 2.5\nturn = true\n";
    const Mission mission = show_of(
        "[[keyframe]]\nname = \"a\"\nshape = \"line\"\nhold_s = 4\n"
        "[[keyframe]]\nname = \"b\"\nshape = \"line\"\nhold_s = 4\nrotate_deg = [0, 60, 0]\n" +
            carrier + "[[light]]\nkeyframe = \"b\"\n" + kGradient,
        6);
    const FlightPlan plan = planned(mission);
    const PlannedKeyframe& b = plan.keyframes[1];
    EXPECT_LT(b.turned_rad, -0.1);  // +y is the direction of flight, east at first
    const Vec3 axis{std::cos(b.turned_rad), std::sin(b.turned_rad), 0};
    expect_gradient(plan, b, axis, seconds_from_ms(b.stands_from_ms) + 2.0);
}

TEST(LitPlan, LightsShineOverKeyframesThatAFlowPasses) {
    const FlightPlan plan = planned(show_of(keyframe("a", "circle", kFlowOn) + keyframe("b", "helix", kFlowOn) +
                                            keyframe("c", "circle", kFlow) +
                                            "[[light]]\nkeyframe = \"b\"\nstart_s = -1\nduration_s = 2\n" + kGradient));
    const PlannedKeyframe& b = plan.keyframes[1];
    ASSERT_EQ(b.stands_from_ms, b.stands_to_ms);
    expect_gradient(plan, b, {1, 0, 0}, seconds_from_ms(b.stands_from_ms) - 0.5);
    expect_gradient(plan, b, {1, 0, 0}, seconds_from_ms(b.stands_from_ms) + 0.5);
}

/// Lamps of drones that had landed in the first wave shone until the last one began.
TEST(LitPlan, FromTheFirstWaveOfLandingsOnLampsAreDark) {
    const FlightPlan plan = planned(show_of("[limits]\nmin_separation_m = 4\n" + keyframe("a", "circle") +
                                            "[[light]]\neffect = \"pulse\"\nblend = \"add\"\n"));
    const auto first = std::ranges::find(plan.acts, ActRole::landing, &Act::role);
    ASSERT_NE(first, plan.acts.end());
    ASSERT_NE(first + 1, plan.acts.end()) << "one wave";
    EXPECT_EQ(lamp_time(plan.acts).to_ms, first->start_ms / 20 * 20);
    const double begin_s = seconds_from_ms(first->start_ms) + 0.01, end_s = seconds_from_ms(plan.duration_ms());
    for (double t_s = begin_s; t_s <= end_s; t_s += 0.1)
        for (std::size_t d = 0; d < plan.drones(); ++d) ASSERT_EQ(sample(plan, DroneId(d), t_s).color, Rgb{}) << t_s;
}

TEST(LitPlan, ThreadsChangeNothing) {
    const Mission mission = show_of(keyframe("a", "circle", "hold_s = 6") + keyframe("b", "helix") +
                                    "[[light]]\neffect = \"sparkle\"\nstart_s = 5\nshare = 0.5\n"
                                    "[[light]]\neffect = \"sweep\"\nkeyframe = \"a\"\nwidth_m = 3\n");
    const FlightPlan one = planned(mission, 1), two = planned(mission, 3);
    EXPECT_EQ(one.tracks, two.tracks);
    EXPECT_GT(one.tracks[0].lights.size(), 20U);
}

}  // namespace
}  // namespace aerogram::planner
