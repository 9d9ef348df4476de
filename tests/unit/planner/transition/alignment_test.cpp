#include "planner/transition/alignment.hpp"

#include <gtest/gtest.h>

#include "geo/units.hpp"
#include "planner/transition/columns.hpp"
#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

Points about_barycentre(const Points& points) {
    return centred(points, barycentre(points));
}
Points turned_by(const Turn& turn, const Points& points) {
    Points out;
    for (const Vec3& p : points) out.push_back(turned(turn, 1.0, p));
    return out;
}
double misfit(const Points& a, const Points& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
    return sum;
}

TEST(Alignment, UndoesAKnownTurnForSolidFlatAndLineFormations) {
    const int count = tries(40);
    for (int seed = 1; seed <= count; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        Points line;
        for (int i = 0; i < 6; ++i) line.push_back({1.0 * i, 0.3 * i, 2.0 * i});
        for (const Points& shape :
             {random_points(random, 20), letter_t(15), letter_e(23), line, random_points(random, 2)}) {
            SCOPED_TRACE(seed);
            const Points source = about_barycentre(shape);
            const Turn turn{random.direction(), random.between(0.0, 3.1)};
            const Points target = turned_by(turn, source);
            const Points aligned = turned_by(alignment_turn(source, target, Align::kabsch), target);
            EXPECT_LT(largest_distance(aligned, source), 1e-9);
        }
    }
}

TEST(Alignment, KabschBeatsEveryOtherRotation) {
    const int count = tries(30);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 3 + random.below(10);
        const Points source = about_barycentre(random_points(random, n)),
                     target = about_barycentre(random_points(random, n));
        const double best = misfit(source, turned_by(alignment_turn(source, target, Align::kabsch), target));
        for (int i = 0; i < 200; ++i) {
            const Turn other{random.direction(), random.between(0.0, kPi)};
            EXPECT_LE(best, misfit(source, turned_by(other, target)) + 1e-9);
        }
    }
}

TEST(Alignment, PcaPutsAxesOnAxesByTheSmallestAngle) {
    const int count = tries(40);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const Points source = about_barycentre(random_points(random, 12)),
                     target = about_barycentre(random_points(random, 12));
        const Turn turn = alignment_turn(source, target, Align::pca);
        EXPECT_LE(turn.angle_rad, 2.0 * kPi / 3.0 + 1e-12);  // the best of the four choices never needs more
        const PrincipalAxes a = principal_axes(source), b = principal_axes(turned_by(turn, target));
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(std::abs(glm::dot(a.axes.columns[i], b.axes.columns[i])), 1.0, 1e-9);
        }
    }
}

TEST(Alignment, PcaOfRoundFormationsFallsBackToKabsch) {
    const Points source = ring(12, 5.0);
    const Points target = turned_by({{0, 1, 0}, 0.4}, source);
    const Turn turn = alignment_turn(source, target, Align::pca);
    EXPECT_NEAR(turn.angle_rad, 0.4, 1e-12);
    EXPECT_EQ(alignment_turn(source, target, Align::none).angle_rad, 0.0);
}

TEST(Alignment, Property1RigidMotionTurnsTheAxis) {
    const int count = tries(40);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const Points flat = about_barycentre(letter_e(14));
        // In its own plane, out of it, and half turns of both kinds.
        const std::vector<Turn> turns{{random.direction(), 1.0}, {{0, 1, 0}, kPi}, {{0, 0, 1}, kPi}, {{1, 0, 0}, kPi}};
        const Turn motion{random.direction(), random.between(0.1, 3.0)};
        for (const Turn& turn : turns) {
            const Points target = turned_by(turn, flat);
            for (const Align align : {Align::kabsch, Align::pca}) {
                const Turn here = alignment_turn(flat, target, align);
                const Turn there = alignment_turn(turned_by(motion, flat), turned_by(motion, target), align);
                EXPECT_NEAR(here.angle_rad, there.angle_rad, 1e-7);
                for (const Vec3& p : flat) {
                    const Vec3 expected = turned(motion, 1.0, turned(here, 0.5, p));
                    EXPECT_LT(glm::distance(turned(there, 0.5, turned(motion, 1.0, p)), expected), 1e-6);
                }
            }
        }
    }
}

TEST(Alignment, WhatHasNoUniqueRotationIsLeftAlone) {
    const Points point(3, Vec3{0, 0, 0});
    EXPECT_EQ(alignment_turn(point, point, Align::kabsch).angle_rad, 0.0);
    EXPECT_EQ(alignment_turn(point, point, Align::pca).angle_rad, 0.0);
    Points octahedron{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    Points mirrored = octahedron;
    for (Vec3& p : mirrored) p = -p;
    EXPECT_EQ(alignment_turn(octahedron, mirrored, Align::kabsch).angle_rad, 0.0);
}

TEST(Alignment, ThinnestAxisOfAFlatFormationIsItsNormalAndOfALineShowY) {
    const Vec3 normal = thinnest_axis(about_barycentre(letter_t(12)));
    EXPECT_NEAR(std::abs(normal.y), 1.0, 1e-12);
    EXPECT_EQ(thinnest_axis(about_barycentre({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}})), Vec3(0, 1, 0));
    EXPECT_EQ(thinnest_axis(Points{Vec3{0, 0, 0}}), Vec3(0, 1, 0));
}

}  // namespace
}  // namespace aerogram::planner
