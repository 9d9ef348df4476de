#include "planner/sketch/rim.hpp"

#include <gtest/gtest.h>

#include "tests/unit/planner/sketch/strokes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

TEST(Rim, OfALatticeIsItsOutermostRows) {
    std::vector<Vec3> points;
    for (int x = 0; x < 9; ++x)
        for (int z = 0; z < 6; ++z) points.emplace_back(2.0 * x, 7.0, 2.0 * z);
    const auto rim = rim_of(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool outermost = points[i].x == 0 || points[i].x == 16 || points[i].z == 0 || points[i].z == 10;
        EXPECT_EQ(rim[i], outermost) << i;
    }
}

TEST(Rim, GoesRoundHolesToo) {
    std::vector<Vec3> points;
    for (int x = -7; x <= 7; ++x)
        for (int z = -7; z <= 7; ++z)
            if (std::max(std::abs(x), std::abs(z)) > 3) points.emplace_back(x, 0, z);
    const auto rim = rim_of(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double ring = std::max(std::abs(points[i].x), std::abs(points[i].z));
        const double other = std::min(std::abs(points[i].x), std::abs(points[i].z));
        if (ring == 7 || (ring == 4 && other < 3)) {
            EXPECT_TRUE(rim[i]) << points[i].x << ' ' << points[i].z;
        } else if (ring == 5 || ring == 6) {
            EXPECT_FALSE(rim[i]) << points[i].x << ' ' << points[i].z;
        }
    }
}

TEST(Rim, OfACubeOfPointsIsItsSkin) {
    std::vector<Vec3> points;
    for (int x = 0; x < 6; ++x)
        for (int y = 0; y < 6; ++y)
            for (int z = 0; z < 6; ++z) points.emplace_back(x, y, z);
    const auto rim = rim_of(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 p = points[i];
        const bool skin = std::min({p.x, p.y, p.z}) == 0 || std::max({p.x, p.y, p.z}) == 5;
        EXPECT_EQ(rim[i], skin) << i;
    }
}

TEST(Rim, LinesAndFewPointsAreAllRim) {
    std::vector<Vec3> row;
    for (int k = 0; k < 20; ++k) row.emplace_back(k, 2 * k, 0);
    for (const bool on_rim : rim_of(row)) EXPECT_TRUE(on_rim);
    EXPECT_EQ(rim_of(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}), (std::vector<bool>{true, true}));
    EXPECT_TRUE(rim_of(std::vector<Vec3>{}).empty());
}

TEST(Rim, Property1_PointsOfConvexPositionAreOnIt) {
    std::vector<Vec3> sphere;
    for (int k = 0; k < 300; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / 300.0, r = std::sqrt(1.0 - z * z), angle = 2.4 * k;
        sphere.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
    for (const bool on_rim : rim_of(sphere)) EXPECT_TRUE(on_rim);
}

TEST(Rim, Property3_PlaceAndSizeDoNotMatter) {
    std::vector<Vec3> points, moved;
    for (const Vec2& p : scattered(300, 4)) {
        points.emplace_back(p.x, 0.0, p.y);
        moved.push_back(8.0 * points.back() + Vec3(64, 32, 16));
    }
    EXPECT_EQ(rim_of(points), rim_of(moved));
}

}  // namespace
}  // namespace aerogram::planner
