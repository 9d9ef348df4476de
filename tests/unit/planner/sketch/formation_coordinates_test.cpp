#include "planner/sketch/formation_coordinates.hpp"

#include <gtest/gtest.h>

#include "planner/sketch/principal_axes.hpp"
#include "tests/unit/planner/sketch/strokes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

Vec2 turned(const Vec2& p, double angle) {
    return {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle)};
}

std::vector<Vec3> cloud(std::size_t n, std::uint64_t seed, const Vec3& size) {
    Random random(seed);
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = random.between(-1, 1), y = random.between(-1, 1);
        out.push_back(size * Vec3(x, y, random.between(-1, 1)));
    }
    return out;
}

void expect_alike(const FormationCoordinate& a, const FormationCoordinate& b) {
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-9) << k;
}

TEST(PrincipalAxes, ClosedFormAgreesWithAnEllipseThatWasTurned) {
    for (double angle = -1.5; angle <= 1.5; angle += 0.1) {
        std::vector<Vec2> points;
        for (int k = 0; k < 40; ++k)
            points.push_back(turned(Vec2(3 * std::cos(k * kPi / 20), std::sin(k * kPi / 20)), angle));
        const Vec2 axis = main_axis(points, {0, 0});
        EXPECT_NEAR(std::abs(axis.x * std::cos(angle) + axis.y * std::sin(angle)), 1.0, 1e-9) << angle;
    }
}

TEST(PrincipalAxes, SquaresHaveTheFramesOwn) {
    const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    EXPECT_EQ(main_axis(square, {0.5, 0.5}), Vec2(1, 0));
}

// Oracle: the axes diagonalise the covariance.
TEST(PrincipalAxes, InSpaceTheyDiagonaliseTheCovariance) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        auto points = cloud(50, seed, {5, 2, 9});
        for (Vec3& p : points) p = Vec3(p.x + 0.7 * p.y, p.y - 0.3 * p.z, p.z + 0.2 * p.x);
        Vec3 center{};
        for (const Vec3& p : points) center += p / 50.0;
        const SpaceAxes axes = space_axes(points, center);
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t b = a; b < 3; ++b) {
                double sum = 0.0;
                for (const Vec3& p : points)
                    sum += glm::dot(p - center, axes.axis[a]) * glm::dot(p - center, axes.axis[b]) / 50.0;
                EXPECT_NEAR(sum, a == b ? axes.spread[a] * axes.spread[a] : 0.0, 1e-9) << seed;
                EXPECT_NEAR(glm::dot(axes.axis[a], axes.axis[b]), a == b ? 1.0 : 0.0, 1e-12);
            }
        }
        EXPECT_GE(axes.spread[0], axes.spread[1]);
        EXPECT_GE(axes.spread[1], axes.spread[2]);
    }
}

TEST(FormationCoordinates, Property1_DistancesAreWithinOneAndDirectionsAreUnit) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto points = scattered(60, seed);
        const auto of = coordinates_in(plane_frame(points), points);
        double farthest = 0.0;
        for (const FormationCoordinate& c : of) {
            EXPECT_GE(c[0], 0.0);
            EXPECT_LE(c[0], 1.0);
            EXPECT_NEAR(std::hypot(c[1], c[2]), 1.0, 1e-12);
            EXPECT_EQ(c[3], 0.0);
            farthest = std::max(farthest, c[0]);
        }
        EXPECT_EQ(farthest, 1.0);
        const auto in_space = cloud(80, seed, {3, 4, 5});
        for (const FormationCoordinate& c : coordinates_in(space_frame(in_space), in_space)) {
            EXPECT_LE(c[0], 1.0);
            EXPECT_NEAR(std::hypot(c[1], c[2], c[3]), 1.0, 1e-12);
        }
    }
}

TEST(FormationCoordinates, Property2_PlaceAndSizeDoNotMatter) {
    const auto points = scattered(60, 5);
    auto moved = points;
    for (Vec2& p : moved) p = 3.7 * p + Vec2(1000, -50);
    const PlaneFrame a = plane_frame(points), b = plane_frame(moved);
    for (std::size_t i = 0; i < points.size(); ++i)
        expect_alike(coordinate_in(a, points[i]), coordinate_in(b, moved[i]));
}

TEST(FormationCoordinates, Property3_TheReferenceTurnsWithTheFormation) {
    const auto points = scattered(60, 6);
    for (const double angle : {0.3, 1.9, -2.5}) {
        auto moved = points;
        for (Vec2& p : moved) p = turned(p, angle);
        const PlaneFrame a = plane_frame(points), b = plane_frame(moved, {}, angle);
        for (std::size_t i = 0; i < points.size(); ++i)
            expect_alike(coordinate_in(a, points[i]), coordinate_in(b, moved[i]));
        std::vector<Vec3> in_space, turned_in_space;
        for (std::size_t i = 0; i < points.size(); ++i) {
            in_space.emplace_back(points[i].x, points[i].y, double(i % 7) * 3.0);
            turned_in_space.emplace_back(moved[i].x, moved[i].y, double(i % 7) * 3.0);
        }
        const SpaceFrame c = space_frame(in_space), d = space_frame(turned_in_space, {}, angle);
        ASSERT_EQ(c.direction.size(), 26U);
        for (std::size_t i = 0; i < points.size(); ++i)
            expect_alike(coordinate_in(c, in_space[i]), coordinate_in(d, turned_in_space[i]));
    }
}

TEST(FormationCoordinates, TheEightRadiiOfABoxReachItsSidesAndCorners) {
    std::vector<Vec2> points;
    for (int x = -10; x <= 10; ++x)
        for (int y = -4; y <= 4; ++y) points.emplace_back(x, y);
    const PlaneFrame frame = plane_frame(points);
    EXPECT_EQ(frame.direction[0], Vec2(1, 0));
    for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(glm::length(frame.direction[k]), 1.0, 1e-12);
    EXPECT_NEAR(frame.radius[0], std::hypot(10, 4), 1e-12);  // the corner is nearer to the axis than to the diagonal
    EXPECT_NEAR(frame.radius[2], std::hypot(1, 4), 1e-12);
    EXPECT_NEAR(coordinate_in(frame, {0, -2})[0], 2.0 / std::hypot(1, 4), 1e-12);
}

TEST(FormationCoordinates, WeightsMoveTheCentre) {
    const std::vector<Vec2> points{{0, 0}, {10, 0}};
    const std::vector<double> weights{3.0, 1.0};
    EXPECT_EQ(plane_frame(points, weights).center, Vec2(2.5, 0.0));
}

TEST(FormationCoordinates, TheCentreHasNoDirectionAndOnePointIsItsCentre) {
    const std::vector<Vec2> one{{4, 2}};
    EXPECT_EQ(coordinate_in(plane_frame(one), {4, 2}), FormationCoordinate{});
    const std::vector<Vec3> alone{{4, 2, 1}};
    EXPECT_EQ(coordinate_in(space_frame(alone), {4, 2, 1}), FormationCoordinate{});
}

TEST(FormationCoordinates, FlatFormationsInSpaceHaveTheirPlanesEight) {
    std::vector<Vec3> tilted;
    for (const Vec2& p : scattered(60, 8)) tilted.emplace_back(p.x, 0.6 * p.y, 0.8 * p.y);
    EXPECT_EQ(space_frame(tilted).direction.size(), 8U);
}

TEST(DrawingPlane, GroundAndUprightFormationsAreSeenAlike) {
    const auto points = scattered(60, 9);
    std::vector<Vec3> ground, upright;
    for (const Vec2& p : points) {
        ground.emplace_back(p.x, p.y, 0.0);
        upright.emplace_back(p.x, 5.0, p.y + 30.0);
    }
    DrawingPlane low, high;
    ASSERT_TRUE(is_flat(ground, low));
    ASSERT_TRUE(is_flat(upright, high));
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LT(glm::distance(low.seen(ground[i]), high.seen(upright[i])), 1e-9);
}

TEST(DrawingPlane, RowsAreFlatAndCloudsAreNot) {
    DrawingPlane plane;
    for (const Vec3& along : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1)}) {
        std::vector<Vec3> row;
        for (int k = 0; k < 10; ++k) row.push_back(double(k) * along);
        ASSERT_TRUE(is_flat(row, plane));
        for (const Vec3& p : row) EXPECT_NEAR(glm::length(plane.seen(p)), glm::distance(p, plane.center), 1e-9);
        EXPECT_GT(plane.seen(row.back()).x + plane.seen(row.back()).y, 0.0);
    }
    EXPECT_FALSE(is_flat(cloud(40, 1, {10, 10, 2}), plane));
}

}  // namespace
}  // namespace aerogram::planner
