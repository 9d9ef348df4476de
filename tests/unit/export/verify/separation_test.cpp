#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>

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

/// By hand: within 5 cm of a place where the drone is said to start or land.
bool on_ground(const RecordedDrone& drone, const Vec3& at) {
    const auto near = [&](const std::optional<Vec3>& place) {
        return place && std::abs(at.z - place->z) <= 0.05 && std::hypot(at.x - place->x, at.y - place->y) <= 0.05;
    };
    return near(drone.home_m) || near(drone.land_m);
}

/// The smallest distance at `samples` instants of every pair, by nothing but position_at.
double brute_force(const RecordedShow& show, double downwash, std::size_t samples) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s <= samples; ++s) {
        const double t = show.duration_s * static_cast<double>(s) / static_cast<double>(samples);
        std::vector<Vec3> at;
        for (const RecordedDrone& drone : show.drones) at.push_back(position_at(drone, t));
        for (std::size_t i = 0; i < at.size(); ++i) {
            for (std::size_t j = i + 1; j < at.size(); ++j) {
                if (on_ground(show.drones[i], at[i]) && on_ground(show.drones[j], at[j])) continue;
                smallest = std::min(smallest,
                                    std::hypot(at[i].x - at[j].x, at[i].y - at[j].y, (at[i].z - at[j].z) / downwash));
            }
        }
    }
    return smallest;
}

TEST(VerifySeparation, WhereItIsToldToLookFirstDoesNotChangeTheBound) {
    Random random{11};
    for (int round = 0; round < 20; ++round) {
        std::vector<RecordedDrone> drones(12);
        for (RecordedDrone& drone : drones) {
            Vec3 at = random.in_box({-8, -8, 10}, {8, 8, 20});
            for (int k = 0; k < 4; ++k) {
                const Vec3 next = random.in_box({-8, -8, 10}, {8, 8, 20});
                testing::add_smooth(drone, 5.0, at, next);
                at = next;
            }
        }
        const RecordedShow show = show_of(drones);
        const VerifiedSeparation plain = separation(show);
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const std::vector<LikelyClosest> tips{{plain.first, plain.second, plain.time_s},
                                              {0, 1, 3.0},
                                              {4, 4, 3.0},
                                              {0, 99, 3.0},
                                              {2, 3, -5.0},
                                              {2, 3, nan}};
        for (const LikelyClosest& tip : tips) {
            SeparationSearch search;
            search.likely_closest = tip;
            const auto told = verify_separation(show, 1.0, 10.0, aerogram::Run{}, search).value();
            EXPECT_NEAR(told.lower_bound_m, plain.lower_bound_m, 2e-5) << "round " << round;
            EXPECT_NEAR(told.attained_m, plain.attained_m, 2e-5);
            EXPECT_LE(told.lower_bound_m, told.attained_m);
        }
    }
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

TEST(VerifySeparation, BothOnTheGroundAreExcused) {
    const std::vector<Vec3> stay = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    RecordedDrone near = polyline(5.0, {{0.8, 0, 0}, {0.8, 0, 0}, {0.8, 0, 0}});
    EXPECT_EQ(separation(show_of({polyline(5.0, stay), near})).lower_bound_m, 10.0);

    RecordedDrone hovers = polyline(5.0, {{0.8, 0, 0.06}, {0.8, 0, 0.06}, {0.8, 0, 0.06}});
    EXPECT_NEAR(separation(show_of({polyline(5.0, stay), hovers})).attained_m, std::hypot(0.8, 0.06), 1e-9);
}

TEST(VerifySeparation, StraightAboveItsPadOneIsExcusedBesideOneThatStands) {
    const RecordedDrone stands = polyline(5.0, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    const RecordedDrone rises = polyline(5.0, {{0.8, 0, 0}, {0.8, 0, 0}, {0.8, 0, 10}});
    EXPECT_EQ(separation(show_of({stands, rises})).lower_bound_m, 10.0);
    // 9 mm beside the pad is straight above it, 2 cm is not, unless the file's rounding may have moved it so far.
    RecordedShow show = show_of({stands, polyline(5.0, {{0.8, 0, 0}, {0.809, 0, 5}, {0.8, 0, 10}})});
    EXPECT_EQ(separation(show).lower_bound_m, 10.0);
    show = show_of({stands, polyline(5.0, {{0.8, 0, 0}, {0.82, 0, 5}, {0.8, 0, 10}})});
    EXPECT_LT(separation(show).attained_m, 5.1);
    show.rounding.position_m = 0.01;
    EXPECT_EQ(separation(show).lower_bound_m, 10.0);
}

// A drone that rose out of another one was once excused, because both were at home.
TEST(VerifySeparation, TwoOnOnePadAreNotExcused) {
    const RecordedDrone stands = polyline(5.0, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    const auto beside = [&](double apart_m) {
        const Vec3 home{apart_m, 0, 0};
        return show_of({stands, polyline(5.0, {home, home, home + Vec3{0, 0, 10}})});
    };
    EXPECT_NEAR(separation(beside(0.0)).attained_m, 0.0, 1e-5);
    EXPECT_NEAR(separation(beside(0.19)).attained_m, 0.19, 1e-6);
    EXPECT_EQ(separation(beside(0.2)).lower_bound_m, 10.0);
    RecordedShow show = beside(0.199);  // pads 0.2 m apart in a file of millimetres
    EXPECT_NEAR(separation(show).attained_m, 0.199, 1e-6);
    show.rounding.position_m = 5e-4;
    EXPECT_EQ(separation(show).lower_bound_m, 10.0);

    show = show_of({stands, polyline(5.0, {{8, 0, 9}, {0.05, 0, 9}, {0.05, 0, 0}})});  // lands on the other
    EXPECT_LT(separation(show).attained_m, 0.051);
}

TEST(VerifySeparation, TwoThatRiseBesideEachOtherAreNotExcused) {
    const RecordedDrone a = polyline(5.0, {{0, 0, 0}, {0, 0, 5}, {0, 0, 10}});
    const RecordedDrone b = polyline(5.0, {{0.8, 0, 0}, {0.8, 0, 5}, {0.8, 0, 10}});
    EXPECT_NEAR(separation(show_of({a, b})).attained_m, 0.8, 1e-6);
}

TEST(VerifySeparation, SidewaysIntruderAboveAGroundedDroneIsFound) {
    const RecordedDrone stands = polyline(5.0, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    RecordedDrone passes = polyline(5.0, {{-8, 0, 0.5}, {8, 0, 0.5}, {8, 0, 0.5}});
    passes.home_m = passes.land_m = Vec3{8, 0, 0};
    EXPECT_NEAR(separation(show_of({stands, passes})).attained_m, 0.5, 1e-6);
    passes.home_m = passes.land_m = Vec3{0.8, 0, 0};  // passes its own pad on the way
    EXPECT_NEAR(separation(show_of({stands, passes})).attained_m, 0.5, 1e-6);
}

TEST(VerifySeparation, StandingAtAHeightThatIsNotHomeIsFlying) {
    RecordedDrone a = polyline(5.0, {{0, 0, 5}, {0, 0, 5}}), b = polyline(5.0, {{1, 0, 5}, {1, 0, 5}});
    a.home_m = a.land_m = Vec3{0, 0, 0};
    b.home_m = b.land_m = Vec3{1, 0, 0};
    EXPECT_NEAR(separation(show_of({a, b})).lower_bound_m, 1.0, 1e-8);
    a.home_m = a.land_m = Vec3{0, 0, 5};
    b.home_m = b.land_m = Vec3{1, 0, 5.06};  // b is below its home
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

// Two drones that hovered 0.3 m apart were once taken to stand on the ground, because they did so where they were first
// (or last) seen.
TEST(VerifySeparation, HoveringWhereTheRecordBeginsOrEndsIsFlying) {
    const auto pair_of = [](const std::vector<Vec3>& way) {
        std::vector<Vec3> beside = way;
        for (Vec3& p : beside) p.x += 0.3;
        return show_of({polyline(30.0, way), polyline(30.0, beside)});
    };
    const RecordedShow always = pair_of({{0, 0, 30}, {0, 0, 30}});
    const RecordedShow first = pair_of({{0, 0, 30}, {0, 0, 30}, {0, 0, 20}});
    const RecordedShow last = pair_of({{0, 0, 20}, {0, 0, 30}, {0, 0, 30}});
    for (const RecordedShow& show : {always, first, last}) {
        EXPECT_NEAR(separation(show).attained_m, 0.3, 1e-9);
        EXPECT_NEAR(separation(show).lower_bound_m, 0.3, 1.1e-5);
        EXPECT_NEAR(brute_force(show, 1.0, 100), 0.3, 1e-9);
        RecordedShow stated = show;  // pads below them excuse nobody either
        for (RecordedDrone& drone : stated.drones) {
            drone.home_m = drone.land_m = Vec3{first_position(drone).x, first_position(drone).y, 0.0};
        }
        EXPECT_NEAR(separation(stated).attained_m, 0.3, 1e-9);
    }
    RecordedShow landed = always;  // on a roof that the file says is their place
    for (RecordedDrone& drone : landed.drones) drone.home_m = first_position(drone);
    EXPECT_EQ(separation(landed).lower_bound_m, 10.0);
}

// The grid's cells shrank with the distance found, until a box of ordinary size had more than can be counted.
TEST(VerifySeparation, NextToNothingIsFoundInBoundedTimeAndMemory) {
    for (const double apart_m : {1e-20, 1e-12, 1e-7, 0.0}) {
        RecordedShow show = show_of({polyline(40.0, {{0, 1000, 30}, {0, 1000, 30}}),
                                     polyline(40.0, {{apart_m, 1000, 30}, {apart_m, 1000, 30}})});
        RecordedDrone busy;  // so many pieces that slabs are cut short, and searched one after another
        for (int k = 0; k < 400; ++k) add_piece(busy, 0.1, {{500, 500, 30}});
        show.drones.push_back(busy);
        const VerifiedSeparation found = separation(show);
        EXPECT_EQ(found.lower_bound_m, 0.0);
        EXPECT_NEAR(found.attained_m, apart_m, 1e-12);
        EXPECT_EQ(std::pair(found.first, found.second), std::pair(std::size_t{0}, std::size_t{1}));
    }
}

TEST(VerifySeparation, FarthestCoordinatesAreSearchedToo) {
    const RecordedShow show = show_of(
        {polyline(40.0, {{1e8, -1e8, 30}, {1e8, -1e8, 30}}), polyline(40.0, {{1e8, -1e8, 30.5}, {1e8, -1e8, 30.5}})});
    EXPECT_NEAR(separation(show).attained_m, 0.5, 1e-6);
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

TEST(GroundedIntervals, WithoutStatedPlacesZeroIsTheGround) {
    EXPECT_EQ(grounded_intervals(polyline(10.0, {{4, 0, 0.04}, {4, 0, 10}, {4, 0, 10}})).size(), 1U);
    EXPECT_EQ(grounded_intervals(polyline(10.0, {{4, 0, 10}, {4, 0, 10}, {4, 0, -0.04}})).size(), 1U);
    EXPECT_TRUE(grounded_intervals(polyline(10.0, {{4, 0, 0.06}, {4, 0, 0.06}, {4, 0, 10}})).empty());
    EXPECT_TRUE(grounded_intervals(polyline(10.0, {{4, 0, 10}, {4, 0, -0.06}, {4, 0, -0.06}})).empty());
    EXPECT_TRUE(grounded_intervals(polyline(10.0, {{4, 0, 3}, {4, 0, 0}, {4, 0, 3}})).empty());
}

TEST(GroundedIntervals, AreEmptyWhenHomeIsElsewhere) {
    RecordedDrone drone = polyline(10.0, {{0, 0, 0}, {0, 0, 10}, {0, 0, 0}});
    drone.home_m = drone.land_m = Vec3{0.06, 0, 0};
    EXPECT_TRUE(grounded_intervals(drone).empty());
}

}  // namespace
}  // namespace aerogram::exporter
