#include "planner/sketch/relaxation.hpp"

#include <gtest/gtest.h>

#include "planner/sampling/push_apart.hpp"
#include "tests/unit/planner/sketch/strokes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

/// A frame of fixed points around a square of 10, then n inside.
std::vector<Vec2> framed(std::size_t n, std::uint64_t seed, std::size_t& fixed) {
    std::vector<Vec2> points;
    for (int k = 0; k < 10; ++k) {
        points.emplace_back(k, 0);
        points.emplace_back(10, k);
        points.emplace_back(10 - k, 10);
        points.emplace_back(0, 10 - k);
    }
    fixed = points.size();
    Random random(seed);
    for (std::size_t i = 0; i < n; ++i) {
        const double x = random.between(0.5, 9.5);
        points.emplace_back(x, random.between(0.5, 9.5));
    }
    return points;
}
bool in_square(const Vec2& p) {
    return p.x > 0.0 && p.x < 10.0 && p.y > 0.0 && p.y < 10.0;
}

// Oracle: one round by all pairs, as algorithm 1 is printed.
TEST(Relaxation, OneRoundIsAlgorithmOne) {
    std::size_t fixed = 0;
    const auto points = framed(60, 1, fixed);
    const GaussianRelaxation how{.rounds = 1, .beta = 1.7, .speed = 0.3};
    const auto after = relaxed(points, fixed, how);
    for (std::size_t i = fixed; i < points.size(); ++i) {
        Vec2 v{};
        double neighbours = 0.0;
        for (std::size_t j = 0; j < points.size(); ++j) {
            const double d = glm::distance(points[i], points[j]);
            if (j == i || d > 2.5) continue;
            v += (points[i] - points[j]) * std::exp(-1.7 * d * d);
            neighbours += 1.0;
        }
        const Vec2 step = v / neighbours * 0.3;
        ASSERT_LT(glm::length(step), 0.25);
        EXPECT_LT(glm::distance(after[i], points[i] + step), 1e-12);
    }
}

TEST(Relaxation, Property1And2_FixedPointsStayAndNobodyLeaves) {
    std::size_t fixed = 0;
    const auto points = framed(81, 2, fixed);
    const auto after = relaxed(points, fixed, {.rounds = 80, .speed = 20.0, .inside = in_square});
    for (std::size_t i = 0; i < fixed; ++i) EXPECT_EQ(after[i], points[i]);
    for (std::size_t i = fixed; i < points.size(); ++i) EXPECT_TRUE(in_square(after[i]));
}

TEST(Relaxation, SpreadsScatteredPoints) {
    std::size_t fixed = 0;
    const auto points = framed(81, 3, fixed);
    EXPECT_LT(smallest_distance(points), 0.3);
    EXPECT_GT(smallest_distance(relaxed(points, fixed, {.rounds = 200, .inside = in_square})), 0.6);
}

/// Mean distance to the nearest other of the points of one kind, inside.
double room_of(const std::vector<Vec2>& points, std::size_t from, std::size_t every, std::size_t which) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = from; i < points.size(); ++i) {
        if ((i - from) % every != which) continue;
        double nearest = 1e300;
        for (std::size_t j = 0; j < points.size(); ++j)
            if (j != i) nearest = std::min(nearest, glm::distance(points[i], points[j]));
        sum += nearest;
        count += 1.0;
    }
    return sum / count;
}

TEST(Relaxation, HeavyPointsMakeRoomAroundThem) {
    std::size_t fixed = 0;
    const auto points = framed(81, 4, fixed);
    std::vector<double> weights(points.size(), 1.0);
    for (std::size_t i = fixed; i < points.size(); i += 9) weights[i] = 4.0;
    const auto even = relaxed(points, fixed, {.rounds = 200, .inside = in_square});
    const auto after = relaxed(points, fixed, {.rounds = 200, .weights = weights, .inside = in_square});
    EXPECT_GT(room_of(after, fixed, 9, 0), 1.15 * room_of(even, fixed, 9, 0));
}

TEST(Relaxation, AnOpenDensityPullsPointsTogetherWhereItIsHigh) {
    std::size_t fixed = 0;
    const auto points = framed(81, 5, fixed);
    const auto spacing = [](const Vec2& p) { return p.x < 5.0 ? 0.7 : 1.4; };
    const auto after = relaxed(points, fixed, {.rounds = 400, .spacing_at = spacing, .inside = in_square});
    const auto left = [&](const std::vector<Vec2>& all) {
        return std::count_if(all.begin() + std::ptrdiff_t(fixed), all.end(), [](const Vec2& p) { return p.x < 5.0; });
    };
    EXPECT_GT(left(after), left(points) + 10);
}

TEST(Relaxation, NoRoundsNoNeighboursNoMove) {
    const std::vector<Vec2> far{{0, 0}, {10, 0}};
    EXPECT_EQ(relaxed(far, 0, {.rounds = 5}), far);
    const std::vector<Vec2> near{{0, 0}, {0.5, 0}};
    EXPECT_EQ(relaxed(near, 0, {.rounds = 0}), near);
    EXPECT_EQ(relaxed(near, 2, {.rounds = 5}), near);
}

}  // namespace
}  // namespace aerogram::planner
