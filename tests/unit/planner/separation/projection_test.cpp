#include "planner/separation/projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geo/random.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/profile.hpp"

namespace aerogram::planner {
namespace {

Lattice straight_lattice(const Points& from, const Points& to, std::size_t rows = 63) {
    const auto s = profile_rows(ProfileKind::minimum_jerk, rows);
    Lattice lattice{from.size(), {}};
    for (const double share : s) {
        for (std::size_t i = 0; i < from.size(); ++i)
            lattice.points_m.push_back((1.0 - share) * from[i] + share * to[i]);
    }
    return lattice;
}

ProjectionTask task_for(double required_m, double downwash = 1.0) {
    ProjectionTask task;
    task.required_m = required_m;
    task.metric = {downwash};
    task.samples_per_interval = 2;
    return task;
}

Points flat_grid(std::size_t side, double spacing_m, double z_m) {
    Points points;
    for (std::size_t i = 0; i < side * side; ++i) {
        points.push_back({spacing_m * static_cast<double>(i % side), spacing_m * static_cast<double>(i / side), z_m});
    }
    return points;
}

/// The same grid, its places dealt out at random: paths cross everywhere.
Points shuffled(Points points, std::uint64_t seed) {
    Random random(seed);
    for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
    return points;
}

TEST(Projection, Property1_EndsNeverMove) {
    const Points from = flat_grid(5, 2.2, 20), to = shuffled(from, 4);
    const Lattice input = straight_lattice(from, to);
    const auto result = project_separation(input, task_for(1.55), {});
    ASSERT_TRUE(result && result->separated);
    for (const std::size_t k :
         {std::size_t{0}, std::size_t{1}, std::size_t{2}, input.rows() - 3, input.rows() - 2, input.rows() - 1}) {
        for (std::size_t i = 0; i < 25; ++i) EXPECT_EQ(result->lattice.at(k, i), input.at(k, i));
    }
}

TEST(Projection, Property2_SeparatedInputComesBackUnchanged) {
    const Lattice input = straight_lattice(flat_grid(4, 2.2, 20), flat_grid(4, 2.2, 35));
    const auto result = project_separation(input, task_for(1.55), {});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->separated);
    EXPECT_EQ(result->rounds, 0);
    EXPECT_EQ(result->lattice.points_m, input.points_m);
}

TEST(Projection, Property3_SameSeedSameBytes) {
    const Points from = flat_grid(4, 2.2, 20), to = shuffled(from, 9);
    const auto a = project_separation(straight_lattice(from, to), task_for(1.55), {});
    const auto b = project_separation(straight_lattice(from, to), task_for(1.55), {});
    EXPECT_EQ(a->lattice.points_m, b->lattice.points_m);
}

/// Two drones changing places on one line: nothing but the noise tells them which way to give.
TEST(Projection, HeadOnPairGivesWay) {
    const Lattice input = straight_lattice({{0, 0, 20}, {10, 0, 20}}, {{10, 0, 20}, {0, 0, 20}});
    const auto result = project_separation(input, task_for(1.55), {});
    ASSERT_TRUE(result && result->separated);
    EXPECT_GE(result->lower_bound_m, 1.55);
}

TEST(Projection, SeparatesRandomlyMatchedGrids) {
    for (const std::size_t side : {3u, 5u, 8u}) {
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const Points from = flat_grid(side, 2.2, 20), to = shuffled(from, seed);
            const auto result = project_separation(straight_lattice(from, to), task_for(1.55), {});
            ASSERT_TRUE(result);
            EXPECT_TRUE(result->separated) << side << " seed " << seed << ": " << result->lower_bound_m;
            EXPECT_LT(result->rounds, 300) << side << " seed " << seed;
        }
    }
}

TEST(Projection, HonoursDownwash) {
    const Points from = flat_grid(4, 2.2, 20), to = shuffled(from, 2);
    const auto result = project_separation(straight_lattice(from, to), task_for(1.55, 2.0), {});
    ASSERT_TRUE(result && result->separated);
    const auto bound = bound_separation(result->lattice, 1.0, {2.0}, 4.0, {});
    EXPECT_GE(bound->lower_bound_m, 1.55);
}

TEST(Projection, StaysInItsBand) {
    const Points from = flat_grid(5, 2.2, 3), to = shuffled(from, 6);
    ProjectionTask task = task_for(1.55);
    task.floor_z_m = 2.9;
    task.ceiling_z_m = 8.0;
    const auto result = project_separation(straight_lattice(from, to), task, {});
    ASSERT_TRUE(result && result->separated);
    for (const Vec3& p : result->lattice.points_m) {
        EXPECT_GE(p.z, 2.9);
        EXPECT_LE(p.z, 8.0);
    }
}

TEST(Projection, SeparatedInputOutsideItsBandIsBroughtIn) {
    Lattice input = straight_lattice({{0, 0, 10}, {5, 0, 10}}, {{0, 9, 10}, {5, 9, 10}});
    for (std::size_t k = 20; k < 40; ++k) {
        for (std::size_t i = 0; i < 2; ++i) input.at(k, i).z = 15.0;
    }
    ProjectionTask task = task_for(1.55);
    task.ceiling_z_m = 12.0;
    const auto result = project_separation(input, task, {});
    ASSERT_TRUE(result && result->separated);
    EXPECT_GT(result->rounds, 0);
    for (const Vec3& p : result->lattice.points_m) EXPECT_LE(p.z, 12.0);
}

TEST(Projection, HeldKnotsKeepTheirPlace) {
    const Points from = flat_grid(3, 2.2, 20), to = shuffled(from, 8);
    const Lattice input = straight_lattice(from, to);
    ProjectionTask task = task_for(1.0);
    task.held_knots = {12, 40};
    const auto result = project_separation(input, task, {});
    ASSERT_TRUE(result);
    ASSERT_GT(result->rounds, 0);
    bool moved = false;
    for (std::size_t i = 0; i < 9; ++i) {
        for (const std::size_t k : task.held_knots) {
            const auto at = [&](const Lattice& l) { return knot_value(l.at(k, i), l.at(k + 1, i), l.at(k + 2, i)); };
            EXPECT_LT(glm::length(at(result->lattice) - at(input)), 1e-10);
            moved = moved || glm::length(result->lattice.at(k, i) - input.at(k, i)) > 1e-3;
        }
    }
    EXPECT_TRUE(moved);  // only the place is held, not the way through it
}

/// All pairs at many instants: what the certificate is not asked for.
double sampled_separation(const Lattice& lattice, int samples = 200) {
    const Act act{"", ActRole::transit, Timing::free, 0, 1000, lattice};
    Points now(lattice.drones);
    double least = 1e300;
    for (int s = 0; s <= samples; ++s) {
        positions(act, static_cast<double>(s) / samples, now);
        for (std::size_t i = 0; i < now.size(); ++i) {
            for (std::size_t j = i + 1; j < now.size(); ++j) least = std::min(least, glm::length(now[i] - now[j]));
        }
    }
    return least;
}

TEST(Projection, RandomMapOfAThousandDronesHoldsEverywhere) {
    const Points from = flat_grid(32, 2.2, 20);
    Points sphere;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / 1024.0, a = 2.399963 * static_cast<double>(i);
        const double r = std::sqrt(1.0 - z * z);
        sphere.push_back(Vec3{35.0, 35.0, 80.0} + 25.0 * Vec3{r * std::cos(a), r * std::sin(a), z});
    }
    const Points to = shuffled(sphere, 11);
    const auto result = project_separation(straight_lattice(from, to), task_for(1.55), {});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->separated) << result->lower_bound_m << " after " << result->rounds;
    EXPECT_GE(sampled_separation(result->lattice), 1.55 - 1e-4);
    EXPECT_LE(result->lower_bound_m, sampled_separation(result->lattice) + 1e-9);
}

TEST(Projection, Property3_ThreadsChangeNothing) {
    const Points from = flat_grid(15, 2.2, 20), to = shuffled(from, 3);
    aerogram::Run three;
    three.threads = 3;
    const auto one = project_separation(straight_lattice(from, to), task_for(1.55), {});
    const auto many = project_separation(straight_lattice(from, to), task_for(1.55), three);
    ASSERT_TRUE(one && many);
    EXPECT_EQ(one->rounds, many->rounds);
    EXPECT_EQ(one->lattice.points_m, many->lattice.points_m);
}

/// Rows of a sheet leave one after the other over three seconds: straight lines lose s / sqrt 2, the projection keeps
/// 0.95 of the spacing.
TEST(Projection, StaggeredRowsOfAThousandDronesKeepTheirSpacing) {
    constexpr std::size_t side = 32, rows = 63;
    constexpr double flight_s = 20.0, stagger_s = 3.0;
    const Points from = flat_grid(side, 2.2, 20);
    Points to;  // upright, and turned a little
    for (const Vec3& p : from)
        to.push_back({0.9 * p.x + 0.436 * p.y + 30.0, 15.0 - 0.1 * p.x, 60.0 + 0.9 * p.y - 0.436 * p.x});
    Lattice input{from.size(), Points(rows * from.size())};
    for (std::size_t k = 0; k < rows; ++k) {
        const double t_s = (static_cast<double>(k) - 1.0) / static_cast<double>(rows - 3) * (flight_s + stagger_s);
        for (std::size_t i = 0; i < from.size(); ++i) {
            const double late_s = stagger_s * static_cast<double>(i / side) / static_cast<double>(side - 1);
            double share = profile_value(ProfileKind::minimum_jerk, std::clamp((t_s - late_s) / flight_s, 0.0, 1.0));
            if (k < 3) share = 0.0;
            if (k + 3 >= rows) share = 1.0;
            input.at(k, i) = (1.0 - share) * from[i] + share * to[i];
        }
    }
    const double required_m = 0.95 * 2.2;
    ASSERT_LT(sampled_separation(input), required_m);
    const auto result = project_separation(input, task_for(required_m), {});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->separated) << result->lower_bound_m << " after " << result->rounds;
    EXPECT_GE(sampled_separation(result->lattice), required_m - 1e-4);
}

/// Limits at the input's own peaks: giving way costs no time worth mentioning.
TEST(Projection, HoldsSpeedAndAccelerationLimits) {
    const Points from = flat_grid(12, 2.2, 20);
    Points to = shuffled(from, 5);
    for (Vec3& p : to) p.z += 40.0;
    const Lattice input = straight_lattice(from, to);
    ProjectionTask task = task_for(1.55);
    const Limits limits;
    const double step_s = 1e-3 * static_cast<double>(shortest_duration(input, limits).duration_ms) /
                          static_cast<double>(input.rows() - 3);
    const auto loose = project_separation(input, task, {});
    task.motion = MotionLimits{limits, step_s};
    const auto tight = project_separation(input, task, {});
    ASSERT_TRUE(loose && tight && loose->separated && tight->separated);
    EXPECT_TRUE(tight->limits_held);
    const double duration_s = step_s * static_cast<double>(input.rows() - 3);
    const Extremes peaks = extremes(tight->lattice, duration_s);
    EXPECT_LE(peaks.acceleration_mps2, 1.011 * limits.acceleration_mps2);
    EXPECT_LE(peaks.speed_horizontal_mps, 1.006 * limits.speed_horizontal_mps);
    EXPECT_LE(peaks.speed_up_mps, 1.006 * limits.speed_up_mps);
    EXPECT_LE(peaks.speed_down_mps, 1.006 * limits.speed_down_mps);
    const Extremes before = extremes(loose->lattice, duration_s);  // the test would show nothing otherwise
    EXPECT_GT(std::max({before.acceleration_mps2 / limits.acceleration_mps2, before.speed_up_mps / limits.speed_up_mps,
                        before.speed_horizontal_mps / limits.speed_horizontal_mps}),
              1.02);
}

geo::Polygon square(double cx, double cy, double half) {
    return {{cx - half, cy - half}, {cx + half, cy - half}, {cx + half, cy + half}, {cx - half, cy + half}};
}

/// The smallest of a distance over all drones at many instants.
template <class Distance>
double least_over_time(const Lattice& lattice, Distance distance) {
    const Act act{"", ActRole::transit, Timing::free, 0, 1000, lattice};
    Points now(lattice.drones);
    double least = 1e300;
    for (int s = 0; s <= 1000; ++s) {
        positions(act, s / 1000.0, now);
        for (const Vec3& p : now) least = std::min(least, distance(p));
    }
    return least;
}

TEST(Projection, FlockGoesRoundATower) {
    Points from = flat_grid(6, 2.2, 20), to = from;
    for (Vec3& p : from) p.x -= 45.0;
    for (Vec3& p : to) p.x += 45.0;
    ProjectionTask task = task_for(1.55);
    task.ceiling_z_m = 60.0;
    task.airspace.obstacles.push_back({"tower", geo::Cylinder{{5.0, 5.5}, 4.0}, 0.0, 50.0});
    task.airspace_margin_m = 1.0;
    task.smoothing_knots = 6.0;
    const auto result = project_separation(straight_lattice(from, to), task, {});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->separated && result->airspace_held) << result->lower_bound_m << " " << result->rounds;
    const auto clear = [&](const Vec3& p) { return geo::clearance(task.airspace.obstacles[0], p); };
    EXPECT_LT(least_over_time(straight_lattice(from, to), clear), -2.5);
    EXPECT_GE(least_over_time(result->lattice, clear), 0.95);
    EXPECT_GE(sampled_separation(result->lattice), 1.55 - 1e-4);
}

TEST(Projection, FliesOverALowWall) {
    const Lattice input = straight_lattice({{-20, 0, 5}, {-20, 3, 5}}, {{20, 0, 5}, {20, 3, 5}});
    ProjectionTask task = task_for(1.55);
    task.airspace.obstacles.push_back({"wall", geo::Prism{{{-1, -100}, {1, -100}, {1, 100}, {-1, 100}}}, 0.0, 7.0});
    task.airspace_margin_m = 1.0;
    const auto result = project_separation(input, task, {});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->holds_all()) << result->rounds;
    EXPECT_GE(
        least_over_time(result->lattice, [&](const Vec3& p) { return geo::clearance(task.airspace.obstacles[0], p); }),
        0.95);
    EXPECT_LT(-least_over_time(result->lattice, [](const Vec3& p) { return -p.z; }), 15.0);
}

TEST(Projection, StaysInsideTheFenceAndOffTheAudience) {
    // A fence with a notch that the straight ways cut across, and an audience area on the way.
    ProjectionTask task = task_for(1.55);
    task.airspace.geofence_m = {{-40, -40}, {40, -40}, {40, 40}, {6, 40}, {6, 12}, {-6, 12}, {-6, 40}, {-40, 40}};
    task.airspace.audience_m.push_back(square(0.0, -3.0, 4.0));
    task.airspace_margin_m = 1.0;
    const Lattice input =
        straight_lattice({{-20, 16, 20}, {-20, -3, 20}, {-20, 0, 24}}, {{20, 16, 20}, {20, -2, 20}, {20, 5, 24}});
    const auto result = project_separation(input, task, {});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->holds_all()) << result->rounds << " " << result->lower_bound_m;
    const auto fence = [&](const Vec3& p) { return geo::signed_distance(task.airspace.geofence_m, {p.x, p.y}); };
    const auto audience = [&](const Vec3& p) { return -geo::signed_distance(task.airspace.audience_m[0], {p.x, p.y}); };
    EXPECT_LT(least_over_time(input, fence), 0.0);
    EXPECT_LT(least_over_time(input, audience), 0.0);
    EXPECT_GE(least_over_time(result->lattice, fence), 0.95);
    EXPECT_GE(least_over_time(result->lattice, audience), 0.95);
}

/// Ends that stand closer to an obstacle than the margin are the designer's: the interior does as well as they do.
TEST(Projection, EndsNearAnObstacleAreTheDesigners) {
    ProjectionTask task = task_for(1.55);
    task.airspace.obstacles.push_back({"mast", geo::Cylinder{{0.0, 0.0}, 1.0}, 0.0, 50.0});
    task.airspace_margin_m = 2.0;
    const auto result = project_separation(straight_lattice({{-1.5, 0, 20}}, {{1.5, 0.1, 20}}), task, {});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->airspace_held);
    EXPECT_GE(
        least_over_time(result->lattice, [&](const Vec3& p) { return geo::clearance(task.airspace.obstacles[0], p); }),
        0.45);
}

/// First and last rows that do not repeat belong to a ride: they stay, whatever they are.
TEST(Projection, RidingEndsStayAsTheyAre) {
    Lattice input = straight_lattice({{0, 0, 20}, {10, 0, 20}}, {{10, 0, 20}, {0, 0, 20}});
    for (std::size_t k = 0; k < input.rows(); ++k) {
        for (std::size_t i = 0; i < 2; ++i) input.at(k, i).y += 0.8 * static_cast<double>(k);
    }
    const auto result = project_separation(input, task_for(1.55), {});
    ASSERT_TRUE(result && result->separated);
    for (const std::size_t k : {0u, 1u, 2u, 60u, 61u, 62u}) {
        for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(result->lattice.at(k, i), input.at(k, i));
    }
}

/// Everyone through one point: there is no room for that, so the fleet is blown up there first.
TEST(Projection, EveryoneThroughOnePoint) {
    Points from = flat_grid(12, 2.2, 30), to;
    for (const Vec3& p : from) to.push_back({24.2 - p.x, 24.2 - p.y, 90.0 - p.z});
    const auto result = project_separation(straight_lattice(from, to), task_for(1.55), {});
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->separated) << result->lower_bound_m << " after " << result->rounds;
    EXPECT_GE(sampled_separation(result->lattice), 1.55 - 1e-4);
}

TEST(Projection, SaysWhenItCannot) {  // the ends themselves are too close
    const auto result =
        project_separation(straight_lattice({{0, 0, 20}, {1, 0, 20}}, {{9, 0, 20}, {12, 0, 20}}), task_for(1.55), {});
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->separated);
    EXPECT_NEAR(result->lower_bound_m, 1.0, 1e-3);
    ASSERT_TRUE(result->closest);
    EXPECT_NEAR(result->closest->distance_m, 1.0, 1e-3);
    EXPECT_EQ(result->stuck.size(), 1u);
}

}  // namespace
}  // namespace aerogram::planner
