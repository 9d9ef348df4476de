#include "planner/separation/projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geo/random.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/profile.hpp"
#include "planner/separation/smoother.hpp"

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

TEST(SobolevSmoother, SolvesItsEquationAndKeepsFixedRows) {
    constexpr std::size_t rows = 20;
    constexpr double lambda = 37.0;
    std::vector<bool> fixed(rows, false);
    for (const std::size_t k : {0u, 1u, 2u, 9u, 17u, 18u, 19u}) fixed[k] = true;
    Random random(3);
    Points right(rows * 2);
    for (Vec3& c : right) c = {random.unit(), random.unit(), random.unit()};
    Points x = right;
    SobolevSmoother(fixed, lambda).apply(x);
    for (std::size_t k = 0; k < rows; ++k) {
        for (std::size_t i = 0; i < 2; ++i) {
            if (fixed[k]) {
                EXPECT_EQ(x[k * 2 + i], Vec3{});
                continue;
            }
            Vec3 left = x[k * 2 + i];  // (I + lambda D₂ᵀD₂) x, term by term
            for (std::size_t d = 0; d + 2 < rows; ++d) {
                if (k < d || k > d + 2) continue;
                const Vec3 second = x[d * 2 + i] - 2.0 * x[(d + 1) * 2 + i] + x[(d + 2) * 2 + i];
                left += lambda * (k == d + 1 ? -2.0 : 1.0) * second;
            }
            EXPECT_LT(glm::length(left - right[k * 2 + i]), 1e-10) << k;
        }
    }
}

/// With Lagrange multipliers the filtered rows are the minimiser of |X - C|² + lambda |D₂X|² among those that are zero
/// at the held knots: nudging them along any direction that keeps the knots does not lower it.
TEST(SobolevSmoother, HeldKnotsStayZeroAndTheRestIsOptimal) {
    constexpr std::size_t rows = 30;
    constexpr double lambda = 50.0;
    std::vector<bool> fixed(rows, false);
    for (const std::size_t k : {0u, 1u, 2u, 27u, 28u, 29u}) fixed[k] = true;
    const std::vector<std::size_t> held = {8, 15};
    Random random(6);
    Points right(rows);
    for (Vec3& c : right) c = {random.unit(), random.unit(), random.unit()};
    Points x = right;
    SobolevSmoother(fixed, lambda, held).apply(x);
    for (const std::size_t k : held) EXPECT_LT(glm::length(knot_value(x[k], x[k + 1], x[k + 2])), 1e-12);
    const auto energy = [&](const Points& at) {
        double sum = 0.0;
        for (std::size_t k = 3; k + 3 < rows; ++k) sum += glm::dot(at[k] - right[k], at[k] - right[k]);
        for (std::size_t k = 0; k + 2 < rows; ++k) {
            const Vec3 second = at[k] - 2.0 * at[k + 1] + at[k + 2];
            sum += lambda * glm::dot(second, second);
        }
        return sum;
    };
    for (int round = 0; round < 100; ++round) {
        Points nudge(rows);
        for (std::size_t k = 3; k + 3 < rows; ++k) nudge[k] = {random.between(-1, 1), 0, random.between(-1, 1)};
        for (const std::size_t k : held) nudge[k + 1] = (-nudge[k] - nudge[k + 2]) / 4.0;
        Points moved = x;
        for (std::size_t k = 0; k < rows; ++k) moved[k] += 1e-3 * nudge[k];
        EXPECT_GE(energy(moved), energy(x));
    }
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

TEST(Projection, SaysWhenItCannot) {  // the ends themselves are too close
    const auto result =
        project_separation(straight_lattice({{0, 0, 20}, {1, 0, 20}}, {{9, 0, 20}, {12, 0, 20}}), task_for(1.55), {});
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->separated);
    EXPECT_NEAR(result->lower_bound_m, 1.0, 1e-3);
}

}  // namespace
}  // namespace aerogram::planner
