#include "planner/motion/certificate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geo/random.hpp"
#include "planner/motion/profile.hpp"

namespace aerogram::planner {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The oracle: all pairs at `samples` instants.
double brute_force(const Act& act, const SeparationMetric& metric, int samples) {
    double least = 1e300;
    Points now(drone_count(act.motion));
    for (int s = 0; s <= samples; ++s) {
        positions(act, static_cast<double>(act.duration_ms) / 1000.0 * s / samples, now);
        for (std::size_t i = 0; i < now.size(); ++i) {
            for (std::size_t j = i + 1; j < now.size(); ++j) least = std::min(least, metric.distance(now[i], now[j]));
        }
    }
    return least;
}

Lattice wandering(std::size_t n, std::size_t knots, double box_m, Random& random) {
    Points samples(n * knots);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 center{random.between(-box_m, box_m), random.between(-box_m, box_m), random.between(5, 5 + box_m)};
        const Vec3 phase{random.between(0, 6), random.between(0, 6), random.between(0, 6)};
        for (std::size_t m = 0; m < knots; ++m) {
            const double a = 0.15 * static_cast<double>(m);
            samples[m * n + i] = center + Vec3{4 * std::sin(a + phase.x), 4 * std::sin(1.3 * a + phase.y),
                                               3 * std::sin(0.7 * a + phase.z)};
        }
    }
    return lattice_through(samples, n);
}

/// Properties (1) and (2): never above a dense sampling, within 2 % of it.
TEST(BoundSeparation, Property1And2_BracketsADenseSampling) {
    Random random(2026);
    for (int round = 0; round < 30; ++round) {
        const SeparationMetric metric{1.0 + 0.5 * static_cast<double>(round % 3)};
        const std::size_t n = 2 + random.below(9);
        const Act act{
            "x", ActRole::transit, Timing::free, 0, 10000, wandering(n, 33, 2.0 + 12.0 * random.unit(), random)};
        const double sampled = brute_force(act, metric, 10000);  // 1 kHz
        const auto bound = bound_separation(act.motion, 10.0, metric, 100.0, {});
        ASSERT_TRUE(bound);
        EXPECT_LE(bound->lower_bound_m, sampled) << round;
        EXPECT_GE(bound->lower_bound_m, 0.98 * sampled - 2e-3) << round;  // 2e-3: what 1 kHz itself may miss near zero
        ASSERT_TRUE(bound->closest);
        const auto& e = *bound->closest;
        const double there = metric.distance(kinematics(act, e.first, e.time_s).position_m,
                                             kinematics(act, e.second, e.time_s).position_m);
        EXPECT_NEAR(there, e.distance_m, 1e-9);
        EXPECT_LE(bound->lower_bound_m, e.distance_m);
        EXPECT_GE(bound->lower_bound_m, e.distance_m * (1 - 2e-4) - 3e-6);
    }
}

TEST(BoundSeparation, StraightClosedFormAgreesWithItsOwnLattice) {
    Random random(9);
    for (int round = 0; round < 40; ++round) {
        const std::size_t n = 2 + random.below(8);
        Straight straight{Points(n), Points(n), profile_rows(ProfileKind::minimum_jerk, 43)};
        for (Vec3& p : straight.from_m) p = {random.between(-9, 9), random.between(-9, 9), random.between(5, 9)};
        for (Vec3& p : straight.to_m) p = {random.between(-9, 9), random.between(-9, 9), random.between(5, 9)};
        Lattice lattice{n, {}};
        for (std::size_t k = 0; k < 43; ++k) {
            for (std::size_t i = 0; i < n; ++i) lattice.points_m.push_back(control_point(straight, k, i));
        }
        const SeparationMetric metric{1.5};
        const auto closed = bound_separation(straight, 8.0, metric, 50.0, {});
        const auto general = bound_separation(lattice, 8.0, metric, 50.0, {});
        ASSERT_TRUE(closed && general);
        EXPECT_NEAR(closed->lower_bound_m, general->closest->distance_m, 1e-3);
        const Act act{"x", ActRole::transit, Timing::free, 0, 8000, straight};
        const auto& e = *closed->closest;
        EXPECT_NEAR(metric.distance(kinematics(act, e.first, e.time_s).position_m,
                                    kinematics(act, e.second, e.time_s).position_m),
                    e.distance_m, 1e-6);
    }
}

TEST(BoundSeparation, HeadOnMeetingIsZero) {
    const Straight straight{
        {{0, 0, 5}, {10, 0, 5}}, {{10, 0, 5}, {0, 0, 5}}, profile_rows(ProfileKind::minimum_jerk, 23)};
    const auto bound = bound_separation(straight, 4.0, {}, 3.0, {});
    ASSERT_TRUE(bound);
    EXPECT_EQ(bound->lower_bound_m, 0.0);
    EXPECT_NEAR(bound->closest->time_s, 2.0, 1e-6);
}

TEST(BoundSeparation, Property3_PermutingDronesChangesOnlyNames) {
    Random random(31);
    const Lattice lattice = wandering(7, 25, 6.0, random);
    Lattice reversed = lattice;
    for (std::size_t k = 0; k < lattice.rows(); ++k) {
        for (std::size_t i = 0; i < 7; ++i) reversed.at(k, i) = lattice.at(k, 6 - i);
    }
    const auto a = bound_separation(lattice, 5.0, {}, 40.0, {}), b = bound_separation(reversed, 5.0, {}, 40.0, {});
    EXPECT_NEAR(a->closest->distance_m, b->closest->distance_m, 1e-3);
    EXPECT_EQ(a->closest->first.value, 6 - b->closest->second.value);
}

TEST(BoundSeparation, Property4_ScalingTimeScalesOnlyTheInstant) {
    Random random(12);
    const Lattice lattice = wandering(5, 25, 4.0, random);
    const auto fast = bound_separation(lattice, 5.0, {}, 40.0, {}),
               slow = bound_separation(lattice, 50.0, {}, 40.0, {});
    EXPECT_EQ(fast->lower_bound_m, slow->lower_bound_m);
    EXPECT_EQ(fast->closest->distance_m, slow->closest->distance_m);
    EXPECT_DOUBLE_EQ(10.0 * fast->closest->time_s, slow->closest->time_s);
}

/// The cap just above the minimum prunes nearly everything, and must not prune the minimum.
TEST(BoundSeparation, CapJustAboveTheMinimumKeepsIt) {
    Random random(13);
    for (int round = 0; round < 20; ++round) {
        const Lattice lattice = wandering(6, 25, 5.0, random);
        const double least_m = bound_separation(lattice, 5.0, {}, 100.0, {})->closest->distance_m;
        const auto capped = bound_separation(lattice, 5.0, {}, 1.001 * least_m + 1e-4, {});
        ASSERT_TRUE(capped->closest);
        EXPECT_NEAR(capped->closest->distance_m, least_m, 1e-4 * least_m + 1e-5);
        EXPECT_LE(capped->lower_bound_m, least_m);
        EXPECT_NEAR(bound_separation(lattice, 5.0, {}, 0.9 * least_m, {})->lower_bound_m, 0.9 * least_m, 1e-5);
    }
}

TEST(BoundSeparation, FarPairsNeedNotBeResolved) {
    const auto bound = bound_separation(Hold{{{0, 0, 5}, {50, 0, 5}}}, 4.0, {}, 3.0, {});
    EXPECT_NEAR(bound->lower_bound_m, 3.0, 1e-6);
}

TEST(BoundSeparation, StopsWhenAsked) {
    std::stop_source stop;
    stop.request_stop();
    Random random(1);
    const auto bound = bound_separation(wandering(3, 25, 6.0, random), 4.0, {}, 3.0, {stop.get_token(), nullptr, 1});
    ASSERT_FALSE(bound);
    EXPECT_EQ(bound.error().code, ErrorCode::stopped);
    const Straight straight{
        {{0, 0, 5}, {10, 0, 5}}, {{10, 0, 5}, {0, 0, 5}}, profile_rows(ProfileKind::minimum_jerk, 23)};
    EXPECT_FALSE(bound_separation(straight, 4.0, {}, 3.0, {stop.get_token(), nullptr, 1}));
}

Surroundings over_tokyo(std::size_t drones) {
    Surroundings around{geo::ShowFrame({{35.6586, 139.7454, 40.0}, 20.0, std::nullopt}), {}, Points(drones), Limits{}};
    for (std::size_t i = 0; i < drones; ++i) around.pads_m[i] = {3.0 * static_cast<double>(i), 0, 0};
    return around;
}

Act straight_act(Points from, Points to, Millis duration_ms) {
    return {"to A",       ActRole::transit,
            Timing::free, 10000,
            duration_ms,  Straight{std::move(from), std::move(to), profile_rows(ProfileKind::minimum_jerk, 43)}};
}

TEST(Certify, AcceptsAGentleFlight) {
    const auto c =
        certify(straight_act({{0, 0, 10}, {3, 0, 10}}, {{20, 5, 30}, {23, 5, 30}}, 20000), over_tokyo(2), {});
    ASSERT_TRUE(c);
    EXPECT_TRUE(c->certified());
    EXPECT_NEAR(c->separation.lower_bound_m, 3.0, 1e-6);
    EXPECT_NEAR(c->altitude_min_m, 10.0, 1e-4);
    EXPECT_NEAR(c->altitude_max_m, 30.0, 1e-3);
}

TEST(Certify, AcceptsWhatIsExactlyAtItsLimits) {
    Surroundings around = over_tokyo(2);
    around.pads_m[1].x = 1.55;  // the required separation to the last digit, through climb, flight and stand
    EXPECT_TRUE(
        certify(straight_act({{0, 0, 2.5}, {1.55, 0, 2.5}}, {{20, 5, 120}, {21.55, 5, 120}}, 150000), around, {})
            ->certified());
    EXPECT_TRUE(certify({"A", ActRole::hold, Timing::fixed, 0, 3000, Hold{{{0, 0, 120}, {1.55, 0, 120}}}}, around, {})
                    ->certified());
    const auto closer =
        certify({"A", ActRole::hold, Timing::fixed, 0, 3000, Hold{{{0, 0, 9}, {1.5499, 0, 9}}}}, around, {});
    EXPECT_FALSE(closer->certified());
    const auto higher =
        certify({"A", ActRole::hold, Timing::fixed, 0, 3000, Hold{{{0, 0, 9}, {5, 0, 120.002}}}}, around, {});
    EXPECT_THAT(higher->violations, ElementsAre(HasSubstr("ceiling_m")));
}

TEST(Certify, AudienceAndObstacleMarginsAreNeverMoreThanADenseSamplingFinds) {
    Random random(18);
    Surroundings around = over_tokyo(4);
    around.airspace.audience_m = {{{-40, -60}, {40, -60}, {35, -14}, {-30, -16}}};
    around.airspace.obstacles = {{"mast", geo::Cylinder{{13, 9}, 2.0}, 0.0, 9.0},
                                 {"hall", geo::Prism{{{-30, 15}, {-14, 14}, {-20, 30}}}, 2.0, 12.0}};
    for (int round = 0; round < 15; ++round) {
        const Act act{"x", ActRole::transit, Timing::free, 0, 60000, wandering(4, 33, 10.0, random)};
        const auto c = certify(act, around, {});
        double audience_m = 1e300, obstacle_m = 1e300;
        Points now(4);
        for (int s = 0; s <= 6000; ++s) {
            positions(act, s * 0.01, now);
            for (const Vec3& p : now) {
                audience_m = std::min(audience_m, -geo::signed_distance(around.airspace.audience_m[0], Vec2(p)));
                for (const auto& obstacle : around.airspace.obstacles)
                    obstacle_m = std::min(obstacle_m, geo::clearance(obstacle, p));
            }
        }
        EXPECT_LE(*c->audience_margin_m, audience_m + 1e-9);
        EXPECT_GE(*c->audience_margin_m, audience_m - std::max(5e-3, 2e-3 * audience_m));
        EXPECT_LE(*c->obstacle_margin_m, obstacle_m + 1e-9);
        EXPECT_GE(*c->obstacle_margin_m, obstacle_m - std::max(5e-3, 2e-3 * std::abs(obstacle_m)));
    }
}

TEST(Certify, NamesPairTimeAndDistance) {
    const auto c = certify(straight_act({{0, 0, 10}, {3, 0, 10}}, {{3, 0, 10}, {0, 0, 10}}, 20000), over_tokyo(2), {});
    ASSERT_TRUE(c);
    EXPECT_THAT(c->violations, ElementsAre(AllOf(HasSubstr("to A: separation"), HasSubstr("drones 1 and 2 at 20.00 s"),
                                                 HasSubstr("is below 1.55 m"))));
}

TEST(Certify, NamesEachBrokenLimit) {
    const auto fast = certify(straight_act({{0, 0, 10}}, {{50, 0, 10}}, 5000), over_tokyo(1), {});
    EXPECT_THAT(fast->violations, ::testing::Contains(HasSubstr("speed_horizontal_mps: reaches 18.7")));
    EXPECT_THAT(fast->violations, ::testing::Contains(HasSubstr("acceleration_mps2")));
    const auto high = certify(straight_act({{0, 0, 100}}, {{0, 0, 121}}, 60000), over_tokyo(1), {});
    EXPECT_THAT(high->violations,
                ElementsAre(HasSubstr("altitude 121 m of drone 1 at 68.50 s is above ceiling_m = 120")));
    const auto low = certify(straight_act({{0, 0, 2}}, {{5, 0, 2}}, 60000), over_tokyo(1), {});
    EXPECT_THAT(low->violations, ElementsAre(HasSubstr("drone 1 moves sideways at 2 m")));
    const auto vertical = certify(straight_act({{0, 0, 0}}, {{0, 0, 3}}, 60000), over_tokyo(1), {});
    EXPECT_TRUE(vertical->certified());
}

TEST(Certify, MeasuresFenceAudienceAndObstacleMargins) {
    Surroundings around = over_tokyo(1);
    around.airspace.geofence_m = {{-10, -10}, {30, -10}, {30, 10}, {-10, 10}};
    around.airspace.audience_m = {{{-10, -60}, {30, -60}, {30, -12}, {-10, -12}}};
    around.airspace.obstacles = {{"mast", geo::Cylinder{{10, 8}, 2.0}, 0.0, 25.0}};
    const auto c = certify(straight_act({{0, 0, 10}}, {{20, 0, 10}}, 20000), around, {});
    ASSERT_TRUE(c);
    EXPECT_TRUE(c->certified());
    EXPECT_NEAR(*c->geofence_margin_m, 10.0, 0.015);
    EXPECT_NEAR(*c->audience_margin_m, 12.0, 0.015);
    EXPECT_NEAR(*c->obstacle_margin_m, 6.0, 0.01);
    const auto out = certify(straight_act({{0, 0, 10}}, {{33, 0, 10}}, 30000), around, {});
    EXPECT_THAT(out->violations, ElementsAre(HasSubstr("drone 1 is outside the geofence by 3 m at")));
    const auto hit = certify(straight_act({{0, 8, 10}}, {{20, 8, 10}}, 30000), around, {});
    EXPECT_THAT(hit->violations, ElementsAre(HasSubstr("inside obstacle mast by 2 m")));
}

TEST(Certify, MarginsAreNeverMoreThanADenseSamplingFinds) {
    Random random(8);
    Surroundings around = over_tokyo(5);
    around.airspace.geofence_m = {{-20, -25}, {26, -18}, {22, 3}, {30, 24}, {-18, 20}};
    for (int round = 0; round < 20; ++round) {
        const Act act{"x", ActRole::transit, Timing::free, 0, 60000, wandering(5, 33, 12.0, random)};
        const auto c = certify(act, around, {});
        double sampled = 1e300;
        Points now(5);
        for (int s = 0; s <= 6000; ++s) {
            positions(act, s * 0.01, now);
            for (const Vec3& p : now)
                sampled = std::min(sampled, geo::signed_distance(around.airspace.geofence_m, Vec2(p)));
        }
        EXPECT_LE(*c->geofence_margin_m, sampled + 1e-9);
        EXPECT_GE(*c->geofence_margin_m, sampled - std::max(5e-3, 2e-3 * sampled));
    }
}

TEST(Certify, AltitudesAreTheGeodeticOnesOfEveryControlPoint) {
    Random random(19);
    Surroundings around = over_tokyo(6);
    around.limits.ceiling_m = 30.0;
    for (int round = 0; round < 10; ++round) {
        const Act act{"x", ActRole::transit, Timing::free, 0, 60000, wandering(6, 33, 12.0 + 400.0 * round, random)};
        const auto c = certify(act, around, {});
        double low_m = 1e300, high_m = -1e300;
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t m = 0; m < interval_count(act.motion); ++m) {
                for (const Vec3& p : bezier(act.motion, m, i)) {
                    const double altitude_m = around.frame.altitude_above(around.pads_m[i], p);
                    low_m = std::min(low_m, altitude_m);
                    high_m = std::max(high_m, altitude_m);
                }
            }
        }
        EXPECT_NEAR(c->altitude_min_m, low_m, 1e-4);
        EXPECT_NEAR(c->altitude_max_m, high_m, 1e-4);
        const bool said = std::any_of(c->violations.begin(), c->violations.end(), [](const std::string& v) {
            return v.find("ceiling_m = 30") != std::string::npos;
        });
        EXPECT_EQ(said, high_m > 30.001);
    }
}

TEST(Certify, NamesTheFirstDroneThatFliesLowInALattice) {
    Surroundings around = over_tokyo(3);
    Lattice lattice{3, {}};
    const auto rows = profile_rows(ProfileKind::minimum_jerk, 23);
    for (const double s : rows) {
        lattice.points_m.insert(lattice.points_m.end(), {{0, 0, 20.0 * s},            // straight up
                                                         {3.0 + s * s, 0, 20.0 * s},  // sideways from the ground on
                                                         {6.0 + s, 0, 20.0 * s}});
    }
    const auto c = certify({"x", ActRole::transit, Timing::free, 0, 60000, lattice}, around, {});
    EXPECT_THAT(c->violations, ElementsAre(HasSubstr("drone 2 moves sideways at 0 m at 0.00 s")));
}

/// Pads half as far apart as the separation: every second drone rises, the others stand.
TEST(Certify, StandingDronesAreExcusedDuringTakeOffAndLandingAlone) {
    Surroundings around = over_tokyo(4);
    for (std::size_t i = 0; i < 4; ++i) around.pads_m[i] = {0.8 * static_cast<double>(i), 0, 0};
    Points up = around.pads_m;
    up[0].z = up[2].z = 10.0;
    for (const auto& [role, first, last] :
         {std::tuple{ActRole::takeoff, around.pads_m, up}, std::tuple{ActRole::landing, up, around.pads_m}}) {
        Act act = straight_act(first, last, 20000);
        act.role = role;
        const auto c = certify(act, around, {});
        EXPECT_TRUE(c->certified());
        EXPECT_EQ(c->separation.closest->first, DroneId(0U));  // the two that fly
        EXPECT_EQ(c->separation.closest->second, DroneId(2U));
        EXPECT_NEAR(c->separation.lower_bound_m, 1.6, 1e-8);
        act.role = ActRole::transit;
        EXPECT_THAT(certify(act, around, {})->violations, ElementsAre(HasSubstr("separation 0.8 m of drones 1 and 2")));
    }
    // Neighbours that leave together are too close, whoever else stands.
    up[1].z = 10.0;
    Act together = straight_act(around.pads_m, up, 20000);
    together.role = ActRole::takeoff;
    EXPECT_THAT(certify(together, around, {})->violations,
                ElementsAre(HasSubstr("separation 0.8 m of drones 1 and 2")));
}

TEST(Certify, NobodyIsExcusedInATakeOffThatLeavesItsPadsSideways) {
    Surroundings around = over_tokyo(3);
    for (std::size_t i = 0; i < 3; ++i) around.pads_m[i] = {0.8 * static_cast<double>(i), 0, 0};
    // The first stands, the second rises, the third flies on above.
    Act act = straight_act({{0, 0, 0}, {0.8, 0, 0}, {1.6, 0, 20}}, {{0, 0, 0}, {0.8, 0, 10}, {9, 0, 20}}, 20000);
    act.role = ActRole::takeoff;
    EXPECT_THAT(certify(act, around, {})->violations, ElementsAre(HasSubstr("separation 0.8 m of drones 1 and 2")));
    // A hovering drone does not stand, and a pad is one's own.
    for (const double height_m : {1e-5, 3.0}) {
        act = straight_act({{0, 0, height_m}, {0.8, 0, 0}, {1.6, 0, 0}}, {{0, 0, height_m}, {0.8, 0, 10}, {1.6, 0, 0}},
                           20000);
        act.role = ActRole::takeoff;
        EXPECT_FALSE(certify(act, around, {})->certified()) << height_m;
    }
    act = straight_act({{0.8, 0, 0}, {0, 0, 0}, {1.6, 0, 0}}, {{0.8, 0, 10}, {0, 0, 0}, {1.6, 0, 0}}, 20000);
    act.role = ActRole::takeoff;
    EXPECT_FALSE(certify(act, around, {})->certified());
}

/// The rule, pair by pair, by sampling: excused only while one of the two stands on its pad for the whole act.
TEST(Certify, TakeOffsOfRandomWavesAreJudgedByTheRule) {
    Random random(21);
    int good = 0, bad = 0;
    for (int round = 0; round < 60; ++round) {
        const std::size_t n = 2 + random.below(7);
        Surroundings around = over_tokyo(n);
        around.limits.speed_up_mps = 50.0;
        around.limits.acceleration_mps2 = around.limits.jerk_mps3 = 1e3;
        for (Vec3& pad : around.pads_m) pad = {random.between(0, 4), random.between(0, 4), random.between(0, 0.2)};
        std::vector<double> top_m(n, 0.0);
        for (double& top : top_m) top = random.below(2) == 0 ? 0.0 : random.between(3.0, 20.0);
        Lattice lattice{n, {}};
        for (const double s : profile_rows(ProfileKind::minimum_jerk, 23)) {
            for (std::size_t i = 0; i < n; ++i) lattice.points_m.push_back(around.pads_m[i] + Vec3{0, 0, s * top_m[i]});
        }
        const Act act{"up", ActRole::takeoff, Timing::free, 0, 10000, lattice};
        double least_m = 1e300;
        Points now(n);
        for (int s = 0; s <= 1000; ++s) {
            positions(act, 0.01 * s, now);
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t j = i + 1; j < n; ++j) {
                    if (top_m[i] > 0.0 && top_m[j] > 0.0) least_m = std::min(least_m, glm::length(now[j] - now[i]));
                }
            }
        }
        if (std::abs(least_m - 1.55) < 1e-3) continue;
        const auto c = certify(act, around, {});
        EXPECT_EQ(c->certified(), least_m >= 1.55) << round;
        ++(least_m >= 1.55 ? good : bad);
    }
    EXPECT_GT(good, 10);
    EXPECT_GT(bad, 10);
}

}  // namespace
}  // namespace aerogram::planner
