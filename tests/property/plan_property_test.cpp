// Whole plans of random missions, seen through sample() alone. AEROGRAM_TEST_N sets the number of missions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "brute_force.hpp"
#include "fleet_sampling.hpp"
#include "geo/show_frame.hpp"
#include "random_missions.hpp"
#include "random_shows.hpp"

namespace aerogram::property {
namespace {

using planner::Act;
using planner::ActCertificate;
using planner::FlightPlan;

constexpr double kRounding_m = 1e-9;
constexpr double kDifference_s = 1e-3;  ///< of finite differences

/// What refusals must look like: a mission line with a key, or the act with the limit that cannot be held.
const std::regex kBadInput(R"((random\.toml:\d+: (keyframe\[\d+\]|group\[\d+\]|fleet|limits|airspace)\S*.* \S+\n?)+)");
const std::regex kCannotFly(R"(random\.toml: this show cannot be flown within its limits(\n  )"
                            R"(.+: (separation \S+ m of drones \d+ and \d+ at \S+ s is below \S+ m \(.*\)|)"
                            R"([a-z_0-9]+: reaches \S+, limit \S+|altitude .*|drone \d+ moves sideways .*|)"
                            R"(drone \d+ is inside obstacle \S+ by \S+ m at \S+ s))+)");

TEST(PlanProperty, EveryMissionIsCertifiedOrRefusedByName) {
    int certified = 0, refused = 0;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(30)) * 5; ++seed) {
        const std::string text = random_mission(seed);
        const auto plan = plan_text(text);
        if (plan) {
            ++certified;
            EXPECT_TRUE(plan->certificate.certified()) << "seed " << seed << '\n' << text;
            EXPECT_EQ(plan->certificate.acts.size(), plan->acts.size());
            continue;
        }
        ++refused;
        const Error& error = plan.error();
        ASSERT_TRUE(error.code == ErrorCode::invalid_input || error.code == ErrorCode::infeasible);
        const std::regex& form = error.code == ErrorCode::invalid_input ? kBadInput : kCannotFly;
        EXPECT_TRUE(std::regex_match(error.message, form)) << "seed " << seed << '\n' << error.message;
    }
    EXPECT_GT(certified, refused);
    EXPECT_GT(refused, 0);
}

/// Shows that can be flown by construction, of up to a hundred drones (aerogram_study random-shows: up to 20,000).
TEST(PlanProperty, TameShowsAreCertifiedAndBruteForceFindsNoLess) {
    int tame = 0;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(30)) * 2; ++seed) {
        const RandomShow show = random_show(seed, 100);
        if (!show.tame) continue;
        ++tame;
        SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + show.text);
        const auto plan = plan_text(show.text);
        ASSERT_TRUE(plan) << plan.error().message;
        EXPECT_THAT(BruteForce(*plan, 3e4).check().lies, ::testing::IsEmpty());
    }
    EXPECT_GE(tame, cases(30));
}

/// 1 kHz over the whole show. Around the sampled minimum the closest pair is followed to its own minimum, so that what
/// 1 kHz itself misses at a sharp minimum does not count against the 2 %.
TEST(PlanProperty, SeparationBoundsAreNeverAboveAndAtMostTwoPercentBelowSampling) {
    int near = 0;
    for_each_flown_plan(1000, cases(30), [&](const FlightPlan& plan, const std::string&) {
        for (std::size_t a = 0; a < plan.acts.size(); ++a) {
            const Act& act = plan.acts[a];
            const double bound_m = plan.certificate.acts[a].separation.lower_bound_m;
            const double required_m = planned_separation_m(plan.limits);
            const auto found = sampled_separation(plan, act, 1);
            EXPECT_GE(bound_m, required_m - planner::kSeparationTolerance_m) << act.name;
            EXPECT_LE(bound_m, found.sampled.distance_m + kRounding_m) << act.name << " at " << found.sampled.time_s;
            EXPECT_LE(bound_m, found.refined.distance_m + kRounding_m) << act.name << " at " << found.refined.time_s;
            if (found.refined.distance_m > 2.0 * required_m) continue;
            ++near;
            EXPECT_GE(bound_m, 0.98 * found.refined.distance_m) << act.name << " at " << found.refined.time_s;
        }
    });
    EXPECT_GT(near, 0);
}

struct Motion {
    Vec3 velocity_mps, acceleration_mps2;
};
/// Central differences.
Motion differences(const FlightPlan& plan, DroneId drone, double t_s) {
    const auto at = [&](double t) { return planner::sample(plan, drone, t).motion.position_m; };
    const Vec3 before = at(t_s - kDifference_s), now = at(t_s), after = at(t_s + kDifference_s);
    return {(after - before) / (2.0 * kDifference_s), (after - 2.0 * now + before) / (kDifference_s * kDifference_s)};
}

void expect_limits(const FlightPlan& plan, DroneId drone, double t_s) {
    constexpr double kSlack = 1e-3;
    const Limits& l = plan.limits;
    const Motion motion = differences(plan, drone, t_s);
    EXPECT_LE(glm::length(Vec2(motion.velocity_mps)), l.speed_horizontal_mps + kSlack) << drone.number() << ' ' << t_s;
    EXPECT_LE(motion.velocity_mps.z, l.speed_up_mps + kSlack) << drone.number() << ' ' << t_s;
    EXPECT_GE(motion.velocity_mps.z, -l.speed_down_mps - kSlack) << drone.number() << ' ' << t_s;
    EXPECT_LE(glm::length(motion.acceleration_mps2), l.acceleration_mps2 + kSlack) << drone.number() << ' ' << t_s;
    const planner::Kinematics exact = planner::sample(plan, drone, t_s).motion;
    EXPECT_LE(glm::distance(exact.velocity_mps, motion.velocity_mps), 1e-4 * l.jerk_mps3) << t_s;
}

TEST(PlanProperty, SpeedsAndAccelerationsStayWithinLimitsByFiniteDifferences) {
    for_each_flown_plan(2000, cases(30), [](const FlightPlan& plan, const std::string&) {
        for (std::size_t d = 0; d < plan.drones(); ++d) {
            // 7 ms and its multiples fall everywhere between the knots.
            for (Millis ms = 7; ms + 1 < plan.duration_ms(); ms += 77)
                expect_limits(plan, DroneId(d), seconds_from_ms(ms));
        }
    });
}

TEST(PlanProperty, AltitudesHoldAndLowFlightIsVertical) {
    constexpr double kTolerance_m = 1.001e-3;  // what certify() allows altitudes for the earth's curvature
    for_each_flown_plan(2000, cases(30), [](const FlightPlan& plan, const std::string&) {
        const geo::ShowFrame frame(plan.origin);
        for (Millis ms = 0; ms <= plan.duration_ms(); ms += 90) {
            const Points now = positions_at(plan, seconds_from_ms(ms));
            for (std::size_t d = 0; d < now.size(); ++d) {
                const double altitude_m = frame.altitude_above(plan.pads_m[d], now[d]);
                EXPECT_LE(altitude_m, plan.limits.ceiling_m + kTolerance_m) << d << ' ' << ms;
                EXPECT_GE(altitude_m, -1e-6) << d << ' ' << ms;
                if (altitude_m >= plan.limits.min_navigation_altitude_m - kTolerance_m) continue;
                EXPECT_LE(glm::distance(Vec2(now[d]), Vec2(plan.pads_m[d])), 1e-6) << d << ' ' << ms;
            }
        }
    });
}

TEST(PlanProperty, ShowsBeginAndEndAtRestOnTheOwnPads) {
    for_each_flown_plan(3000, cases(100), [](const FlightPlan& plan, const std::string&) {
        for (std::size_t d = 0; d < plan.drones(); ++d) {
            for (const double t_s : {0.0, seconds_from_ms(plan.duration_ms())}) {
                const planner::Kinematics there = planner::sample(plan, DroneId(d), t_s).motion;
                EXPECT_LE(glm::distance(there.position_m, plan.pads_m[d]), kRounding_m) << d << ' ' << t_s;
                EXPECT_LE(glm::length(there.velocity_mps), kRounding_m) << d << ' ' << t_s;
            }
        }
    });
}

TEST(PlanProperty, PositionAndVelocityAreContinuousOverActBoundaries) {
    for_each_flown_plan(3000, cases(100), [](const FlightPlan& plan, const std::string&) {
        EXPECT_EQ(plan.acts.front().start_ms, 0);
        for (std::size_t a = 1; a < plan.acts.size(); ++a) {
            EXPECT_EQ(plan.acts[a].start_ms, plan.acts[a - 1].end_ms());
            const double edge_s = seconds_from_ms(plan.acts[a].start_ms);
            constexpr double kInstant_s = 1e-9;
            for (std::size_t d = 0; d < plan.drones(); ++d) {
                const auto before = planner::sample(plan, DroneId(d), edge_s - kInstant_s).motion;
                const auto after = planner::sample(plan, DroneId(d), edge_s + kInstant_s).motion;
                EXPECT_LE(glm::distance(before.position_m, after.position_m), kRounding_m) << plan.acts[a].name;
                EXPECT_LE(glm::distance(before.velocity_mps, after.velocity_mps), 1e-6) << plan.acts[a].name;
            }
        }
    });
}

/// A moving hold keeps the formation's shape: distances between drones stay what they were when it stood. Spares that
/// wait above their pads do not move with it.
void expect_same_shape(const FlightPlan& plan, const planner::PlannedKeyframe& keyframe) {
    const SeparationMetric level{1.0};
    const Points before = positions_at(plan, seconds_from_ms(keyframe.stands_from_ms));
    const Points after = positions_at(plan, seconds_from_ms(keyframe.stands_to_ms));
    const auto stays = [&](std::size_t d) { return glm::distance(before[d], after[d]) < kRounding_m; };
    for (int k = 1; k <= 8; ++k) {
        const Millis span_ms = keyframe.stands_to_ms - keyframe.stands_from_ms;
        const Points now = positions_at(plan, seconds_from_ms(keyframe.stands_from_ms + k * span_ms / 8));
        for (std::size_t a = 0; a < now.size(); ++a) {
            for (std::size_t b = a + 1; b < now.size(); ++b) {
                if (stays(a) || stays(b)) continue;
                const double was_m = level.distance(before[a], before[b]);
                EXPECT_NEAR(level.distance(now[a], now[b]), was_m, 3e-5 * was_m + kRounding_m) << keyframe.name;
            }
        }
    }
}

/// Formations stand, or begin to move as a whole, on whole milliseconds, exactly. A flow passes between them: its
/// instants are rounded to the nearest millisecond, so a drone is off by at most half of that at its speed.
TEST(PlanProperty, EveryFormationStandsAtItsSlots) {
    int passed = 0, moved = 0;
    for_each_flown_plan(4000, cases(100), [&](const FlightPlan& plan, const std::string&) {
        const Limits& l = plan.limits;
        const double fastest_mps = std::hypot(l.speed_horizontal_mps, std::max(l.speed_up_mps, l.speed_down_mps));
        Millis after_ms = 0;
        for (const planner::PlannedKeyframe& keyframe : plan.keyframes) {
            EXPECT_GT(keyframe.stands_from_ms, after_ms);
            EXPECT_GE(keyframe.stands_to_ms, keyframe.stands_from_ms);
            after_ms = keyframe.stands_to_ms;
            const bool passes = keyframe.stands_from_ms == keyframe.stands_to_ms;
            passed += passes;
            const double off_m = kRounding_m + (passes ? 0.5e-3 * fastest_mps : 0.0);
            const bool moves = !passes && std::holds_alternative<planner::Lattice>(
                                              plan.acts[act_at(plan, seconds_from_ms(keyframe.stands_from_ms))].motion);
            moved += moves;
            if (moves) expect_same_shape(plan, keyframe);
            std::vector<bool> taken(plan.drones(), false);
            for (std::size_t d = 0; d < plan.drones(); ++d) {
                const SlotId slot = keyframe.slot_of[d];
                EXPECT_FALSE(taken[slot.value]);
                taken[slot.value] = true;
                for (const Millis ms : {keyframe.stands_from_ms, (keyframe.stands_from_ms + keyframe.stands_to_ms) / 2,
                                        keyframe.stands_to_ms}) {
                    if (moves && ms > keyframe.stands_from_ms) continue;
                    const Vec3 place = planner::sample(plan, DroneId(d), seconds_from_ms(ms)).motion.position_m;
                    EXPECT_LE(glm::distance(place, keyframe.formation_m[slot.value]), off_m)
                        << keyframe.name << " drone " << d + 1 << " at " << ms;
                }
            }
        }
    });
    EXPECT_GT(passed, 0);
    EXPECT_GT(moved, 0);
}

/// The exact instant at which a flow passes is within half a millisecond of the stated one: searched along the path.
TEST(PlanProperty, FlowsPassTheirFormationsWithinHalfAMillisecond) {
    for_each_flown_plan(4000, cases(100), [](const FlightPlan& plan, const std::string&) {
        for (const planner::PlannedKeyframe& keyframe : plan.keyframes) {
            if (keyframe.stands_from_ms != keyframe.stands_to_ms) continue;
            const double stated_s = seconds_from_ms(keyframe.stands_from_ms);
            const auto off_m = [&](double t_s) {
                double worst_m = 0.0;
                for (std::size_t d = 0; d < plan.drones(); ++d) {
                    const Vec3 place = planner::sample(plan, DroneId(d), t_s).motion.position_m;
                    worst_m = std::max(worst_m, glm::distance(place, keyframe.formation_m[keyframe.slot_of[d].value]));
                }
                return worst_m;
            };
            double low_s = stated_s - 0.501e-3, high_s = stated_s + 0.501e-3;
            for (int step = 0; step < 80; ++step) {
                const double third_s = (high_s - low_s) / 3.0;
                if (off_m(low_s + third_s) < off_m(high_s - third_s)) {
                    high_s -= third_s;
                } else {
                    low_s += third_s;
                }
            }
            EXPECT_LE(off_m(0.5 * (low_s + high_s)), 1e-8) << keyframe.name;  // 1e-9 and the search's own 1e-10 s
        }
    });
}

}  // namespace
}  // namespace aerogram::property
