#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

#include "export/verify/ground.hpp"
#include "export/verify/judge.hpp"
#include "tests/unit/export/verify/shows.hpp"

namespace aerogram::exporter {
namespace {

using testing::add_piece;
using testing::polyline;
using testing::Random;
using testing::show_of;

VerifiedSeparation separation(const RecordedShow& show, double downwash = 1.0, double beyond_m = 10.0) {
    return verify_separation(show, downwash, beyond_m, aerogram::Run{}).value();
}

/// Starts and ends at other heights than it flies, so that nobody counts as grounded on the way.
bool excused(const std::vector<Interval>& a, const std::vector<Interval>& b, double t) {
    const auto stands = [t](const std::vector<Interval>& all) {
        return std::ranges::any_of(all, [t](const Interval& i) { return i.begin_s <= t && t <= i.end_s; });
    };
    return stands(a) && stands(b);
}

/// The smallest distance at `samples` instants of every pair, by nothing but position_at.
double brute_force(const RecordedShow& show, double downwash, std::size_t samples) {
    double smallest = std::numeric_limits<double>::infinity();
    std::vector<std::vector<Interval>> grounded;
    for (const RecordedDrone& drone : show.drones) grounded.push_back(grounded_intervals(drone));
    for (std::size_t s = 0; s <= samples; ++s) {
        const double t = show.duration_s * static_cast<double>(s) / static_cast<double>(samples);
        std::vector<Vec3> at;
        for (const RecordedDrone& drone : show.drones) at.push_back(position_at(drone, t));
        for (std::size_t i = 0; i < at.size(); ++i) {
            for (std::size_t j = i + 1; j < at.size(); ++j) {
                if (excused(grounded[i], grounded[j], t)) continue;
                smallest = std::min(smallest,
                                    std::hypot(at[i].x - at[j].x, at[i].y - at[j].y, (at[i].z - at[j].z) / downwash));
            }
        }
    }
    return smallest;
}

TEST(VerifySeparation, CrossingLinesMeetTheClosedForm) {
    // Relative motion (-10, 0, 0) + t (4, -3, 0): distance from the origin |(-10)(-3) - 0| / 5 = 6.
    const RecordedShow show =
        show_of({polyline(5.0, {{-10, 0, 20}, {10, 0, 20}}), polyline(5.0, {{0, 0, 20}, {0, 15, 20}})});
    const VerifiedSeparation found = separation(show);
    EXPECT_NEAR(found.lower_bound_m, 6.0, 1e-8);
    EXPECT_LE(found.lower_bound_m, 6.0);
    EXPECT_NEAR(found.attained_m, 6.0, 1e-9);
    EXPECT_NEAR(found.time_s, 1.6, 1e-9);
    EXPECT_EQ(found.first, 0U);
    EXPECT_EQ(found.second, 1U);
}

TEST(VerifySeparation, ParabolaPassesAtItsVertex) {
    // z = 10 + 4 (2u - 1)² above a drone at 10: nearest 0 m off in z, 1.25 m in y, at half time.
    RecordedDrone parabola;
    add_piece(parabola, 4.0, {{-8, 1.25, 14}, {0, 1.25, 6}, {8, 1.25, 14}});
    const RecordedShow show = show_of({parabola, polyline(4.0, {{0, 0, 10}, {0, 0, 10.0}})});
    const VerifiedSeparation found = separation(show);
    EXPECT_LE(found.lower_bound_m, 1.25);
    EXPECT_NEAR(found.lower_bound_m, 1.25, 1.1e-5);
    EXPECT_NEAR(found.attained_m, 1.25, 1.1e-5);
    EXPECT_NEAR(found.time_s, 2.0, 0.01);
}

TEST(VerifySeparation, CollisionGivesZero) {
    const RecordedShow show = show_of({polyline(2.0, {{-3, 0, 9}, {3, 0, 9}}), polyline(2.0, {{0, -3, 9}, {0, 3, 9}})});
    const VerifiedSeparation found = separation(show);
    EXPECT_EQ(found.lower_bound_m, 0.0);
    EXPECT_NEAR(found.attained_m, 0.0, 1e-5);
    EXPECT_NEAR(found.time_s, 1.0, 1e-4);
}

TEST(VerifySeparation, DownwashShrinksHeightDifferences) {
    const RecordedShow show =
        show_of({polyline(2.0, {{-3, 0, 9}, {3, 0, 9}}), polyline(2.0, {{-3, 0, 12}, {3, 0, 12}})});
    EXPECT_NEAR(separation(show, 1.0).lower_bound_m, 3.0, 1e-8);
    EXPECT_NEAR(separation(show, 2.0).lower_bound_m, 1.5, 1e-8);
}

TEST(VerifySeparation, NothingCloserThanBeyondIsSaidAsThat) {
    const RecordedShow show = show_of({polyline(2.0, {{0, 0, 9}, {3, 0, 9}}), polyline(2.0, {{0, 20, 9}, {3, 20, 9}})});
    const VerifiedSeparation found = separation(show, 1.0, 4.0);
    EXPECT_EQ(found.lower_bound_m, 4.0);
    EXPECT_EQ(found.attained_m, std::numeric_limits<double>::infinity());
}

TEST(VerifySeparation, WindowLeavesOutWhatHappensOutsideIt) {
    const RecordedShow show = show_of({polyline(2.0, {{-3, 0, 9}, {3, 0, 9}}), polyline(2.0, {{0, -3, 9}, {0, 3, 9}})});
    const auto in = [&](double begin_s, double end_s) {
        return verify_separation(show, 1.0, 10.0, aerogram::Run{}, {begin_s, end_s}).value();
    };
    EXPECT_NEAR(in(0.0, 0.5).lower_bound_m, 1.5 * std::sqrt(2.0), 1.1e-5);  // 1.5 m each from the crossing at 0.5 s
    EXPECT_NEAR(in(0.0, 0.5).time_s, 0.5, 1e-9);
    EXPECT_EQ(in(0.5, 2.0).lower_bound_m, 0.0);
    EXPECT_EQ(in(2.0, 9.0).lower_bound_m, 10.0);
}

TEST(VerifySeparation, JumpBetweenPiecesIsSeenFromBothSides) {
    RecordedDrone jumper;
    add_piece(jumper, 1.0, {{0, 0, 10}, {2, 0, 10}});
    add_piece(jumper, 1.0, {{6, 0, 10}, {8, 0, 10}});
    const VerifiedSeparation before = separation(show_of({jumper, polyline(2.0, {{3, 0, 10}, {3, 0.0, 10}})}));
    EXPECT_NEAR(before.attained_m, 1.0, 1e-9);
    const VerifiedSeparation after = separation(show_of({jumper, polyline(2.0, {{5.5, 0, 10}, {5.5, 0, 10}})}));
    EXPECT_NEAR(after.attained_m, 0.5, 1e-9);
}

TEST(VerifySeparation, DronesHoldTheirLastPositionAfterTheirPieces) {
    const RecordedShow show =
        show_of({polyline(1.0, {{0, 0, 10}, {4, 0, 10}}), polyline(5.0, {{4, 20, 10}, {4, -20, 10}})});
    const VerifiedSeparation found = separation(show);
    EXPECT_NEAR(found.attained_m, 0.0, 1e-5);
    EXPECT_NEAR(found.time_s, 2.5, 1e-3);
}

TEST(VerifySeparation, BothOnTheGroundAreExcusedOneIsNot) {
    const std::vector<Vec3> stay = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    RecordedDrone near = polyline(5.0, {{0.8, 0, 0}, {0.8, 0, 0}, {0.8, 0, 0}});
    EXPECT_EQ(separation(show_of({polyline(5.0, stay), near})).lower_bound_m, 10.0);

    RecordedDrone rises = polyline(5.0, {{0.8, 0, 0}, {0.8, 0, 0}, {0.8, 0, 10}});
    const VerifiedSeparation found = separation(show_of({polyline(5.0, stay), rises}));
    EXPECT_GT(found.attained_m, 0.799);
    EXPECT_LT(found.attained_m, 0.81);  // it counts as flying once it has risen by 5 cm
    EXPECT_GT(found.time_s, 5.0);
}

TEST(VerifySeparation, StandingAtAHeightThatIsNotHomeIsFlying) {
    RecordedDrone a = polyline(5.0, {{0, 0, 5}, {0, 0, 5}}), b = polyline(5.0, {{1, 0, 5}, {1, 0, 5}});
    a.home_m = a.land_m = Vec3{0, 0, 0};
    b.home_m = b.land_m = Vec3{1, 0, 0};
    EXPECT_NEAR(separation(show_of({a, b})).lower_bound_m, 1.0, 1e-8);
    a.home_m = a.land_m = Vec3{0, 0, 5};
    EXPECT_NEAR(separation(show_of({a, b})).lower_bound_m, 1.0, 1e-8);
    b.home_m = b.land_m = Vec3{1, 0, 5.04};
    EXPECT_EQ(separation(show_of({a, b})).lower_bound_m, 10.0);
}

TEST(VerifySeparation, MovingAlongTheGroundIsNotStanding) {
    const RecordedShow show =
        show_of({polyline(5.0, {{0, 0, 0}, {0, 8, 0}, {0, 8, 0}}), polyline(5.0, {{1, 4, 0}, {1, 4, 0}, {1, 4, 0}})});
    EXPECT_NEAR(separation(show).attained_m, 1.0, 1e-5);
}

TEST(VerifySeparation, MalformedShowsAreRefusedByDroneAndPiece) {
    RecordedShow show =
        show_of({polyline(1.0, {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}), polyline(1.0, {{0, 9, 1}, {1, 9, 1}})});
    show.drones[0].pieces[1].start_s = 1.5;
    const auto gap = verify_separation(show, 1.0, 3.0, aerogram::Run{});
    ASSERT_FALSE(gap.ok());
    EXPECT_EQ(gap.error().code, ErrorCode::invalid_input);
    EXPECT_EQ(gap.error().message, "drone 1, piece 2: starts 0.500000 s after the piece before ends");
    show.drones[0].pieces[1].start_s = 1.0;
    show.drones[1].controls_m[1].y = std::nan("");
    EXPECT_EQ(verify_separation(show, 1.0, 3.0, aerogram::Run{}).error().message,
              "drone 2, piece 1: a control point is not finite or beyond 1e8 m");
}

TEST(VerifySeparation, StopIsHonoured) {
    std::stop_source stop;
    stop.request_stop();
    const RecordedShow show = show_of({polyline(1.0, {{0, 0, 1}, {1, 0, 1}}), polyline(1.0, {{0, 9, 1}, {1, 9, 1}})});
    const auto result =
        verify_separation(show, 1.0, 3.0, aerogram::Run{.stop = stop.get_token(), .progress = {}, .threads = 1});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::stopped);
}

/// Drones that wander in a box, each on its own knots. @param degree  0: a mix of all degrees.
RecordedShow wandering(Random& random, std::size_t drones, std::size_t degree, double box_m, double length_s) {
    std::vector<RecordedDrone> all;
    for (std::size_t d = 0; d < drones; ++d) {
        RecordedDrone drone;
        const auto place = [&] { return random.in_box({0, 0, 20}, {box_m, box_m, 20 + box_m}); };
        Vec3 at = place();
        while (drone.pieces.empty() || end_s(drone) < length_s) {
            const std::size_t piece_degree = degree > 0 ? degree : random.below(kMaxDegree + 1);
            std::vector<Vec3> controls{at};
            for (std::size_t c = 1; c <= piece_degree; ++c)
                controls.push_back(at + random.in_box(Vec3(-2.5), Vec3(2.5)));
            at = controls.back();
            add_piece(drone, random.in(0.3, 1.7), controls);
        }
        drone.home_m = drone.land_m = Vec3{0, 0, 0};
        all.push_back(drone);
    }
    return show_of(all);
}

class VerifySeparationOracle : public ::testing::TestWithParam<std::size_t> {};

TEST_P(VerifySeparationOracle, LowerBoundIsNeverAboveBruteForceAndClose) {
    const char* scale = std::getenv("AEROGRAM_TEST_N");
    const std::uint64_t cases = scale != nullptr ? std::strtoull(scale, nullptr, 10) : 12;
    for (std::uint64_t seed = 1; seed <= cases; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed * 1000 + GetParam());
        const RecordedShow show = wandering(random, 6, GetParam(), 14.0, 10.0);
        const double downwash = random.in(1.0, 3.0);
        const double sampled = brute_force(show, downwash, 20'000);
        const VerifiedSeparation found = separation(show, downwash, 6.0);
        EXPECT_LE(found.lower_bound_m, sampled);
        EXPECT_LE(found.lower_bound_m, found.attained_m);
        if (sampled < 6.0) {
            EXPECT_GE(found.lower_bound_m, found.attained_m - 1.01e-5);
            EXPECT_GE(found.lower_bound_m, sampled - std::max(0.02 * sampled, 0.005));
            const Vec3 d = position_at(show.drones[found.first], found.time_s) -
                           position_at(show.drones[found.second], found.time_s);
            EXPECT_NEAR(SeparationMetric{downwash}.length(d), found.attained_m, 1e-6);
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Degrees, VerifySeparationOracle, ::testing::Values(0U, 1U, 2U, 3U, 5U, 7U));

TEST(VerifySeparation, ManyDronesAgreeWithBruteForce) {
    Random random(77);
    const RecordedShow show = wandering(random, 60, 3, 40.0, 20.0);
    const double sampled = brute_force(show, 1.0, 4'000);
    const VerifiedSeparation found = separation(show, 1.0, 3.0);
    EXPECT_LE(found.lower_bound_m, sampled);
    EXPECT_GE(found.lower_bound_m, sampled - 0.05);
}

TEST(VerifySeparation, PermutingDronesChangesOnlyNames) {
    Random random(5);
    const RecordedShow show = wandering(random, 12, 3, 20.0, 20.0);
    const VerifiedSeparation found = separation(show, 1.5);
    std::vector<std::size_t> order(12);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    RecordedShow shuffled = show;
    for (std::size_t i = 0; i < order.size(); ++i) shuffled.drones[i] = show.drones[order[i]];
    const VerifiedSeparation again = separation(shuffled, 1.5);
    EXPECT_NEAR(again.lower_bound_m, found.lower_bound_m, 2.1e-5);
    EXPECT_NEAR(again.attained_m, found.attained_m, 2.1e-5);
    const auto in_order = [](std::size_t a, std::size_t b) { return std::pair(std::min(a, b), std::max(a, b)); };
    EXPECT_EQ(in_order(order[again.first], order[again.second]), in_order(found.first, found.second));
}

TEST(VerifySeparation, ThreadsChangeNothing) {
    Random random(6);
    const RecordedShow show = wandering(random, 20, 0, 30.0, 60.0);
    const VerifiedSeparation one = separation(show);
    const VerifiedSeparation two =
        verify_separation(show, 1.0, 10.0, aerogram::Run{.stop = {}, .progress = {}, .threads = 2}).value();
    EXPECT_EQ(one.lower_bound_m, two.lower_bound_m);
    EXPECT_EQ(one.attained_m, two.attained_m);
    EXPECT_EQ(one.time_s, two.time_s);
}

TEST(GroundedIntervals, AreFoundAtHomeAndAtTheLandingPlace) {
    RecordedDrone drone = polyline(10.0, {{0, 0, 0}, {0, 0, 0}, {0, 0, 10}, {5, 0, 10}, {5, 0, 0}, {5, 0, 0}});
    const auto found = grounded_intervals(drone);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].begin_s, -std::numeric_limits<double>::infinity());
    EXPECT_NEAR(found[0].end_s, 10.05, 0.005);
    EXPECT_LE(found[0].end_s, 10.05);
    EXPECT_NEAR(found[1].begin_s, 39.95, 0.005);
    EXPECT_GE(found[1].begin_s, 39.95);
    EXPECT_EQ(found[1].end_s, std::numeric_limits<double>::infinity());
}

TEST(GroundedIntervals, AreEmptyWhenHomeIsElsewhere) {
    RecordedDrone drone = polyline(10.0, {{0, 0, 0}, {0, 0, 10}, {0, 0, 0}});
    drone.home_m = drone.land_m = Vec3{0.06, 0, 0};
    EXPECT_TRUE(grounded_intervals(drone).empty());
}

}  // namespace
}  // namespace aerogram::exporter
