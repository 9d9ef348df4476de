#include "planner/steering/course.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

CourseSpace open_space() {
    CourseSpace space;
    space.floor_z_m = 2.5;
    space.ceiling_z_m = 120.0;
    space.keep_m = 1.5;
    return space;
}

/// Places every tenth of a metre along a course.
std::vector<Vec3> along(const std::vector<Vec3>& course) {
    std::vector<Vec3> out;
    for (std::size_t i = 1; i < course.size(); ++i) {
        const int steps = static_cast<int>(glm::distance(course[i - 1], course[i]) / 0.1) + 1;
        for (int s = 0; s <= steps; ++s)
            out.push_back(course[i - 1] + static_cast<double>(s) / steps * (course[i] - course[i - 1]));
    }
    return out;
}

double length_of(const std::vector<Vec3>& course) {
    double sum = 0.0;
    for (std::size_t i = 1; i < course.size(); ++i) sum += glm::distance(course[i - 1], course[i]);
    return sum;
}

TEST(Course, Property1And2_EndsAreExactAndOpenSpaceIsCrossedStraight) {
    const Vec3 from(-40, 3, 20), to(55, -20, 60);
    EXPECT_EQ(find_course(from, to, {10, 5}, open_space()), (std::vector<Vec3>{from, to}));
    EXPECT_EQ(find_course(from, from, {10, 5}, open_space()).size(), 2U);
}

/// Where a mast stands in the way, the body passes it with all its width, on a way that is little longer than the
/// shortest around the inflated circle (two tangents and an arc).
TEST(Course, TheWholeBodyPassesBesideAMast) {
    CourseSpace space = open_space();
    space.airspace.obstacles.push_back({"mast", geo::Cylinder{{0, 0}, 4.0}, 0.0, 100.0});
    space.ceiling_z_m = 60.0;
    const GroupBody body{8.0, 3.0};
    const Vec3 from(-60, 1, 30), to(60, -1, 30);
    const auto course = find_course(from, to, body, space);
    EXPECT_EQ(course.front(), from);
    EXPECT_EQ(course.back(), to);
    const double radius = 4.0 + 8.0 + 1.5;
    double nearest = 1e9;
    for (const Vec3& p : along(course)) nearest = std::min(nearest, std::hypot(p.x, p.y));
    EXPECT_GT(nearest, radius - 0.8) << "to the grid's step";
    const double reach = std::hypot(60.0, 1.0), tangent = std::sqrt(reach * reach - radius * radius);
    const double shortest = 2.0 * tangent + radius * 2.0 * std::asin(radius / reach);
    EXPECT_LT(length_of(course), 1.06 * shortest);
}

TEST(Course, ALowWallIsFlownOver) {
    CourseSpace space = open_space();
    space.airspace.obstacles.push_back({"wall", geo::Prism{{{-2, -200}, {2, -200}, {2, 200}, {-2, 200}}}, 0.0, 25.0});
    const GroupBody body{6.0, 3.0};
    const auto course = find_course({-50, 0, 15}, {50, 0, 15}, body, space);
    double top = 0.0;
    for (const Vec3& p : along(course)) {
        EXPECT_LT(std::abs(p.y), 60.0) << "over it, not round its far ends";
        if (std::abs(p.x) < 2.0) top = std::max(top, p.z);
    }
    EXPECT_GE(top, 25.0 + 1.5);
    EXPECT_LT(top, 45.0);
}

/// Property 3, on random masts: where there is a way, the middle keeps keep_m from every obstacle.
TEST(Course, Property3_TheMiddleKeepsClearOfRandomMasts) {
    Random random(7);
    for (int round = 0; round < 12; ++round) {
        CourseSpace space = open_space();
        for (int m = 0; m < 8; ++m) {
            space.airspace.obstacles.push_back(
                {"mast", geo::Cylinder{{random.between(-30, 30), random.between(-30, 30)}, random.between(1, 4)}, 0.0,
                 200.0});
        }
        const auto course = find_course({-60, 0, 20}, {60, 0, 20}, {5, 3}, space);
        for (const Vec3& p : along(course))
            for (const auto& mast : space.airspace.obstacles) EXPECT_GT(geo::clearance(mast, p), 1.5 - 0.2) << round;
    }
}

/// A gap too narrow for the body but wide enough for its middle is taken only when the way round is far dearer.
TEST(Course, AWideBodyGoesRoundANarrowGapWhenThatIsNear) {
    CourseSpace space = open_space();
    space.airspace.obstacles.push_back({"left", geo::Prism{{{-1, 3}, {1, 3}, {1, 30}, {-1, 30}}}, 0.0, 200.0});
    space.airspace.obstacles.push_back({"right", geo::Prism{{{-1, -30}, {1, -30}, {1, -3}, {-1, -3}}}, 0.0, 200.0});
    const auto crosses_gap = [&](double radius_m) {
        for (const Vec3& p : along(find_course({-50, 0, 20}, {50, 0, 20}, {radius_m, 3}, space)))
            if (std::abs(p.x) < 0.5 && std::abs(p.y) < 3.0) return true;
        return false;
    };
    EXPECT_TRUE(crosses_gap(1.0));
    EXPECT_FALSE(crosses_gap(20.0));
}

TEST(Course, NobodyIsLedOverTheAudienceOrOutOfTheFence) {
    CourseSpace space = open_space();
    space.airspace.audience_m.push_back({{-10, -20}, {10, -20}, {10, 40}, {-10, 40}});
    space.airspace.geofence_m = {{-80, -60}, {80, -60}, {80, 60}, {-80, 60}};
    for (const Vec3& p : along(find_course({-50, 0, 20}, {50, 0, 20}, {5, 3}, space))) {
        EXPECT_LT(geo::signed_distance(space.airspace.audience_m[0], {p.x, p.y}), 0.0);
        EXPECT_GT(geo::signed_distance(space.airspace.geofence_m, {p.x, p.y}), 0.0);
    }
}

}  // namespace
}  // namespace aerogram::planner
