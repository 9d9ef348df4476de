#include "planner/separation/ladder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/random.hpp"
#include "planner/motion/profile.hpp"
#include "planner/separation/swaps.hpp"

namespace aerogram::planner {
namespace {

Points flat_grid(std::size_t side, double spacing_m, double z_m) {
    Points points;
    for (std::size_t i = 0; i < side * side; ++i) {
        points.push_back({spacing_m * static_cast<double>(i % side), spacing_m * static_cast<double>(i / side), z_m});
    }
    return points;
}

Lattice straight_lattice(const Points& from, const Points& to, std::size_t rows) {
    Lattice lattice{from.size(), {}};
    for (const double share : profile_rows(ProfileKind::minimum_jerk, rows)) {
        for (std::size_t i = 0; i < from.size(); ++i)
            lattice.points_m.push_back((1.0 - share) * from[i] + share * to[i]);
    }
    return lattice;
}

LadderTask task_between(const Points& from, const Points& to, double required_m) {
    LadderTask task;
    task.projection.required_m = required_m;
    task.projection.samples_per_interval = 2;
    task.raw = [=](std::size_t rows) -> Result<Lattice> { return straight_lattice(from, to, rows); };
    return task;
}

void allow_swaps(LadderTask& task, const Points& from, const Points& to) {
    task.swapped = [=](std::size_t rows, std::span<const std::uint32_t> target_of) -> Result<Lattice> {
        Points by_drone;
        for (const std::uint32_t t : target_of) by_drone.push_back(to[t]);
        return straight_lattice(from, by_drone, rows);
    };
}

Points shuffled(Points points, std::uint64_t seed) {
    Random random(seed);
    for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
    return points;
}

bool is_permutation_of_all(std::vector<std::uint32_t> values) {
    std::sort(values.begin(), values.end());
    for (std::uint32_t i = 0; i < values.size(); ++i) {
        if (values[i] != i) return false;
    }
    return true;
}

TEST(Ladder, SeparatedMotionComesBackAsItIs) {
    const Points from = flat_grid(4, 2.2, 20), to = flat_grid(4, 2.2, 40);
    const auto result = separate(task_between(from, to, 1.55), {});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->separated);
    EXPECT_TRUE(result->rungs.empty());
    EXPECT_EQ(std::get<Lattice>(result->motion).points_m, straight_lattice(from, to, 63).points_m);
}

TEST(Ladder, ProjectionIsTheFirstRung) {
    const Points from = flat_grid(4, 2.2, 20), to = shuffled(from, 2);
    const auto result = separate(task_between(from, to, 1.55), {});
    ASSERT_TRUE(result && result->separated);
    ASSERT_EQ(result->rungs.size(), 1u);
    EXPECT_EQ(result->rungs[0].substr(0, 11), "projection,");
    EXPECT_EQ(std::get<Lattice>(result->motion).rows(), 63u);
    EXPECT_TRUE(result->target_of.empty());
}

/// Separated, but not in the time that the limits allow: taken when the act may take longer, and said so by
/// limits_held.
TEST(Ladder, LimitsGiveWayOnlyWhereTheActMayTakeLonger) {
    const Points from = flat_grid(6, 2.2, 20), to = shuffled(from, 4);
    LadderTask task = task_between(from, to, 1.55);
    task.projection.motion = MotionLimits{Limits{}, 0.02};  // hopelessly fast
    const auto longer = separate(task, {});
    ASSERT_TRUE(longer);
    EXPECT_TRUE(longer->separated);
    EXPECT_FALSE(longer->limits_held);
    EXPECT_EQ(longer->rungs.size(), 1u);
    task.may_stretch = false;
    const auto fixed = separate(task, {});
    ASSERT_TRUE(fixed);
    EXPECT_TRUE(fixed->separated);
    EXPECT_FALSE(fixed->limits_held);
    EXPECT_GT(fixed->rungs.size(), 1u);
}

/// Two columns in a shaft of fences that is one drone wide cannot pass each other; swapped, nobody needs to.
LadderTask shaft(const Points& from, const Points& to) {
    LadderTask task = task_between(from, to, 1.55);
    task.projection.airspace.geofence_m = {{-0.4, -100}, {0.4, -100}, {0.4, 100}, {-0.4, 100}};
    task.projection.floor_z_m = 19.7;
    task.projection.ceiling_z_m = 20.3;
    task.projection.max_rounds = 100;
    return task;
}

TEST(Ladder, StuckDronesSwapTargetsWhereTheyMay) {
    const Points from{{0, -10, 20}, {0, 10, 20}, {0, 14, 20}}, to{{0, 10, 20}, {0, -10, 20}, {0, 30, 20}};
    LadderTask task = shaft(from, to);
    const auto refused = separate(task, {});
    ASSERT_TRUE(refused);
    EXPECT_FALSE(refused->separated && refused->airspace_held);
    EXPECT_TRUE(refused->target_of.empty());
    allow_swaps(task, from, to);
    const auto swapped = separate(task, {});
    ASSERT_TRUE(swapped);
    EXPECT_TRUE(swapped->separated && swapped->airspace_held);
    EXPECT_EQ(swapped->target_of, (std::vector<std::uint32_t>{1, 0, 2}));
    EXPECT_EQ(end_positions(swapped->motion)[0], to[1]);
}

TEST(Ladder, StraightLinesOnlyWhereGiven) {
    const Points from{{0, -10, 20}, {0, 10, 20}}, to{{0, 10, 20}, {0, -10, 20}};
    LadderTask task = shaft(from, to);
    task.straight = Straight{from, {to[1], to[0]}, profile_rows(ProfileKind::minimum_jerk, 63)};
    task.projection.airspace = {};
    task.projection.required_m = 25.0;  // nothing but standing still keeps that
    task.projection.max_rounds = 5;
    const auto far = separate(task, {});
    ASSERT_TRUE(far);
    EXPECT_FALSE(far->separated);
    EXPECT_NE(far->rungs.back().find("not separated: drones 1 and 2 come to"), std::string::npos) << far->rungs.back();
    task.projection.required_m = 19.0;
    const auto straight = separate(task, {});
    ASSERT_TRUE(straight);
    EXPECT_TRUE(straight->separated);
    EXPECT_TRUE(std::holds_alternative<Straight>(straight->motion));
    EXPECT_NE(straight->rungs.back().find("straight lines"), std::string::npos);
}

/// Ends that are too close can never be separated: every rung is tried, each gives up, and the pair is named.
TEST(Ladder, HopelessEndsWithPairTimeAndDistance) {
    Points from = flat_grid(8, 2.2, 20), to = flat_grid(8, 2.2, 30);
    to[5] = to[6] + Vec3{0.5, 0.0, 0.0};
    LadderTask task = task_between(from, to, 1.55);
    allow_swaps(task, from, to);
    const auto result = separate(task, {});
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->separated);
    ASSERT_TRUE(result->closest);
    EXPECT_EQ(result->closest->first, DroneId(5));
    EXPECT_EQ(result->closest->second, DroneId(6));
    EXPECT_NEAR(result->closest->distance_m, 0.5, 1e-3);
    EXPECT_NEAR(result->closest->time_s, 1.0, 0.05);
}

TEST(Ladder, StopIsHeard) {
    const Points from = flat_grid(4, 2.2, 20), to = shuffled(from, 2);
    std::stop_source source;
    source.request_stop();
    aerogram::Run run;
    run.stop = source.get_token();
    const auto result = separate(task_between(from, to, 1.55), run);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::stopped);
}

TEST(SwapStuck, UncrossesTheClusterAndNobodyElse) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Points from = flat_grid(5, 2.2, 20), to = shuffled(from, seed);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> stuck{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {10, 11}};
        std::vector<std::uint32_t> target_of(25);
        std::iota(target_of.begin(), target_of.end(), 0U);
        swap_stuck(from, to, stuck, {}, target_of);
        EXPECT_TRUE(is_permutation_of_all(target_of));
        for (std::uint32_t i = 0; i < 25; ++i) {
            if (i > 5 && i != 10 && i != 11) {
                EXPECT_EQ(target_of[i], i) << seed;
            }
            for (std::uint32_t j = 0; j < i && i <= 5; ++j) {
                EXPECT_GE(glm::dot(from[i] - from[j], to[target_of[i]] - to[target_of[j]]), -1e-6) << seed;
            }
        }
    }
}

}  // namespace
}  // namespace aerogram::planner
