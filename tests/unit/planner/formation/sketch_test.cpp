#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/sampling/closest_pair.hpp"
#include "tests/unit/planner/formation/missions.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;

SketchLine closed(std::vector<Vec2> points, bool exclude = false) {
    return {{std::move(points), false, true}, exclude};
}
SketchLine open(std::vector<Vec2> points) {
    return {{std::move(points), false, false}, false};
}
/// A circle of four cubic curves.
SketchLine round(const Vec2& c, double r, bool exclude = false) {
    const double k = 0.5522847498 * r;
    return {{{c + Vec2(r, 0), c + Vec2(r, k), c + Vec2(k, r), c + Vec2(0, r), c + Vec2(-k, r), c + Vec2(-r, k),
              c + Vec2(-r, 0), c + Vec2(-r, -k), c + Vec2(-k, -r), c + Vec2(0, -r), c + Vec2(k, -r), c + Vec2(r, -k)},
             true,
             true},
            exclude};
}

SketchSource sketch(std::vector<SketchLine> lines) {
    SketchSource source;
    source.lines = std::move(lines);
    return source;
}
Part part(std::vector<SketchLine> lines, std::size_t drones, Size size = {}) {
    return part_of(sketch(std::move(lines)), drones, size);
}
/// Without asking for a spacing.
Formation loose(Part part) {
    Mission mission = mission_of({std::move(part)});
    mission.limits.formation_spacing_m = 1e-3;
    mission.limits.min_separation_m = 1e-3;
    Formation formation = build(mission).value();
    for (Vec3& p : formation.points_m) p.z -= 1000.0;
    return formation;
}
std::string failure_of(const Part& part) {
    const auto formation = build(mission_of({part}));
    return formation ? "built" : formation.error().message;
}

TEST(SketchFigure, StandsInMetresWithExactlyN) {
    for (const std::size_t n : {1U, 2U, 3U, 7U, 40U, 100U, 500U}) {
        const Formation ring = loose(part({round({30, 10}, 20), round({30, 10}, 10, true)}, n));
        ASSERT_EQ(ring.points_m.size(), n);
        for (const Vec3& p : ring.points_m) {
            EXPECT_NEAR(p.y, 0.0, 1e-12);
            const double r = std::hypot(p.x, p.z);  // the middle of the sketch's box is the formation's
            EXPECT_LT(r, 20.02) << n;
            EXPECT_GT(r, 9.9) << n;
        }
    }
}

TEST(SketchFigure, TwentyThousandInSeconds) {
    const Formation disc = loose(part({round({0, 0}, 150)}, 20'000));
    EXPECT_EQ(disc.points_m.size(), 20'000U);
    const double even = std::sqrt(std::acos(-1.0) * 150.0 * 150.0 / 20'000.0);
    EXPECT_GT(disc.smallest_spacing_m, 0.8 * even);
}

TEST(SketchFigure, SizeScalesIt) {
    const Formation natural = loose(part({round({0, 0}, 20)}, 60)),
                    half = loose(part({round({0, 0}, 20)}, 60, wide(20)));
    for (std::size_t i = 0; i < 60; ++i) EXPECT_LT(glm::distance(0.5 * natural.points_m[i], half.points_m[i]), 1e-9);
    const Vec3 stretched = box_of(loose(part({round({0, 0}, 20)}, 60, flat(60, 20))).points_m).size();
    EXPECT_NEAR(stretched.x, 60.0, 0.5);
    EXPECT_NEAR(stretched.z, 20.0, 0.5);
}

TEST(SketchFigure, SlotsAreBoundaryFirstThenInside) {
    const Formation disc = loose(part({round({0, 0}, 20)}, 100));
    std::size_t boundary = 0;
    while (std::hypot(disc.points_m[boundary].x, disc.points_m[boundary].z) > 19.9) ++boundary;
    EXPECT_GT(boundary, 30U);
    EXPECT_LT(boundary, 50U);
    for (std::size_t i = boundary; i < 100; ++i) EXPECT_LT(std::hypot(disc.points_m[i].x, disc.points_m[i].z), 19.5);
}

TEST(SketchFigure, OpenLinesAreStoodUpon) {
    const Formation corner = loose(part({open({{0, 0}, {10, 0}, {10, 10}})}, 21));
    for (const Vec3& p : corner.points_m)
        EXPECT_TRUE(std::abs(p.z + 5.0) < 1e-9 || std::abs(p.x - 5.0) < 1e-9) << p.x << ' ' << p.z;
    EXPECT_NEAR(corner.smallest_spacing_m, 1.0, 1e-9);
}

TEST(SketchFigure, CrossingLinesAreLegal) {
    const Formation cross = loose(part({closed({{0, 8}, {20, 8}, {20, 12}, {0, 12}}),
                                        closed({{8, 0}, {12, 0}, {12, 20}, {8, 20}}), open({{0, 0}, {20, 20}})},
                                       200));
    EXPECT_EQ(cross.points_m.size(), 200U);
    EXPECT_GT(cross.smallest_spacing_m, 0.3);
}

TEST(SketchFigure, AHeavySlotMakesRoom) {
    SketchSource source = sketch({round({0, 0}, 20)});
    const Formation even = loose(part_of(source, 100));
    const SlotId heavy(80);
    source.relaxation_weight[heavy] = 5.0;
    source.relaxation_rounds = 200;
    const Formation weighted = loose(part_of(source, 100));
    const auto room = [&](const Formation& f) {
        double nearest = 1e300;
        for (std::size_t i = 0; i < 100; ++i)
            if (i != heavy.value) nearest = std::min(nearest, glm::distance(f.points_m[i], f.points_m[heavy.value]));
        return nearest;
    };
    EXPECT_GT(room(weighted), 1.2 * room(even));
}

TEST(SketchFigure, TheBrushIsInMetresFromTheMiddleWithOrWithoutSize) {
    for (const double scale : {1.0, 2.0}) {
        Part brushed =
            part({closed({{100, 0}, {140, 0}, {140, 40}, {100, 40}})}, 400, scale == 1.0 ? Size{} : wide(80));
        brushed.density.brush = {{{10.0 * scale, 10.0 * scale}, 8.0 * scale, 6.0}};
        const Formation f = loose(brushed);
        const auto near = [&](double x, double z) {
            return std::count_if(f.points_m.begin(), f.points_m.end(), [&](const Vec3& p) {
                return std::hypot(p.x - scale * x, p.z - scale * z) < 5.0 * scale;
            });
        };
        EXPECT_GT(near(10, 10), 2 * near(-10, -10)) << scale;
    }
}

TEST(SketchFigure, TheSamplingUnitIsKeptWhereItSuitsAndElseTold) {
    SketchSource source = sketch({closed({{0, 0}, {20, 0}, {20, 20}, {0, 20}})});
    source.sampling_unit_m = 2.0;
    const Formation kept = loose(part_of(source, 100));
    EXPECT_EQ(kept.note, "");
    std::size_t on_edge = 0;
    for (const Vec3& p : kept.points_m) on_edge += std::max(std::abs(p.x), std::abs(p.z)) > 10.0 - 1e-9 ? 1U : 0U;
    EXPECT_EQ(on_edge, 40U);
    source.sampling_unit_m = 0.1;
    EXPECT_EQ(loose(part_of(source, 100)).note, "sampling unit 0.1 m does not suit 100 drones, another was taken");
}

TEST(SketchFigure, DepthMakesItSolid) {
    Part deep = part({round({5, 5}, 10), round({5, 5}, 4, true)}, 300);
    deep.size.depth_m = 6.0;
    const Vec3 size = box_of(loose(deep).points_m).size();
    EXPECT_NEAR(size.x, 20.0, 0.5);
    EXPECT_NEAR(size.y, 6.0, 1e-6);
    EXPECT_NEAR(size.z, 20.0, 0.5);
    Part lines = part({open({{0, 0}, {10, 0}})}, 30);
    lines.size.depth_m = 6.0;
    EXPECT_EQ(failure_of(lines), "show.toml:7: keyframe[1].sketch: depth needs a closed line that encloses an area");
}

TEST(SketchFigure, TooLittleRoomIsToldAsForOtherSources) {
    EXPECT_THAT(failure_of(part({round({0, 0}, 5)}, 100)),
                HasSubstr("is below formation_spacing_m = 2.2; needs size_m >= "));
}

TEST(SketchFigure, UnusableSketchesAreRefused) {
    EXPECT_EQ(
        failure_of(part({}, 5)),
        "show.toml:7: keyframe[1].sketch has no line that drones could stand on: needs one that is not exclusive");
    EXPECT_EQ(failure_of(part({round({0, 0}, 5), round({0, 0}, 6, true)}, 5)),
              "show.toml:7: keyframe[1].sketch encloses nothing: its exclusive lines take everything away");
    SketchLine wrong = open({{0, 0}, {1, 1}});
    wrong.exclude = true;
    EXPECT_EQ(failure_of(part({round({0, 0}, 5), wrong}, 5)),
              "show.toml:7: keyframe[1].sketch: an open line encloses nothing that it could exclude");
}

}  // namespace
}  // namespace aerogram::planner::testing
