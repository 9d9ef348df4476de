#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/formation/sizing.hpp"
#include "planner/formation/solid_figure.hpp"
#include "planner/sampling/closest_pair.hpp"
#include "tests/unit/planner/formation/missions.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;

ShapeSource solid(ShapeKind kind, SolidStyle style) {
    ShapeSource source = shape(kind);
    source.solid_style = style;
    if (kind == ShapeKind::torus) source.inner = 0.3;
    return source;
}

Size sized_box(double width_m, double depth_m, double height_m) {
    return {width_m, depth_m, height_m};
}

/// A letter O of 1 by 1.4.
Region letter() {
    return {{{{0, 0}, {1, 0}, {1, 1.4}, {0, 1.4}}, {{0.3, 0.3}, {0.3, 1.1}, {0.7, 1.1}, {0.7, 0.3}}}};
}

/// Runs `check` on a part that shows the letter's extruded figure.
template <class Check>
void with_letter(const Size& size, std::size_t drones, const Check& check) {
    const Mission mission = mission_of({part_of(shape(ShapeKind::square), drones, size)});
    const PartRef ref{mission, mission.keyframes[0].parts[0], "keyframe[1]"};
    check(extruded_figure(ref, letter(), Run{}));
}

double spacing_of(const Points& points) {
    return closest_pair(points, {}).distance_m;
}

TEST(SolidShapes, EveryStyleHasExactlyItsDronesAndFillsItsBox) {
    for (const ShapeKind kind : {ShapeKind::cube, ShapeKind::dome, ShapeKind::torus, ShapeKind::cylinder,
                                 ShapeKind::cone, ShapeKind::sphere}) {
        for (const SolidStyle style : {SolidStyle::surface, SolidStyle::volume, SolidStyle::edges}) {
            const bool round = kind == ShapeKind::torus || kind == ShapeKind::sphere;
            if (round && style == SolidStyle::edges) continue;
            const bool slow = kind == ShapeKind::torus || kind == ShapeKind::cylinder || kind == ShapeKind::cone;
            if (slow && style == SolidStyle::volume) continue;  // a second each in TetGen
            const auto formation = built(part_of(solid(kind, style), 60, sized_box(60, 50, 40)));
            EXPECT_EQ(formation.points_m.size(), 60U);
            const Box box = box_of(formation.points_m);
            EXPECT_LE(box.high.x, 30 + 1e-6);
            EXPECT_LE(box.high.y, 25 + 1e-6);
            EXPECT_LE(box.high.z, 20 + 1e-6);
            EXPECT_GT(box.size().x, 0.9 * 60);
            EXPECT_GT(box.size().y, 0.9 * 50);
            const bool rim_only = style == SolidStyle::edges && kind == ShapeKind::dome;
            if (!rim_only) {
                EXPECT_GT(box.size().z, 0.8 * 40);
            }
        }
    }
}

TEST(SolidShapes, WithoutASizeTakeTheSmallestThatHoldsTheSpacing) {
    for (const ShapeKind kind : {ShapeKind::cube, ShapeKind::torus, ShapeKind::cone}) {
        const auto formation = built(part_of(solid(kind, SolidStyle::surface), 150));
        EXPECT_GE(formation.smallest_spacing_m, 2.2 - kSpacingTolerance_m);
        EXPECT_LT(formation.smallest_spacing_m, 2.2 * 1.02);
    }
}

TEST(SolidShapes, ASizeTooSmallIsAnErrorWhoseSizeFits) {
    const auto tight = build(mission_of({part_of(solid(ShapeKind::torus, SolidStyle::surface), 200, wide(10))}));
    ASSERT_FALSE(tight.ok());
    const std::string message = tight.error().message;
    const auto at = message.find("needs size_m >= [");
    ASSERT_NE(at, std::string::npos) << message;
    Size size{0.0, 0.0, 0.0};
    ASSERT_EQ(std::sscanf(message.c_str() + at, "needs size_m >= [%lf, %lf, %lf]", &*size.width_m, &*size.depth_m,
                          &*size.height_m),
              3);
    EXPECT_TRUE(build(mission_of({part_of(solid(ShapeKind::torus, SolidStyle::surface), 200, size)})).ok()) << message;
}

TEST(SolidShapes, ADomesSurfaceHasNoFloor) {
    const auto formation = built(part_of(solid(ShapeKind::dome, SolidStyle::surface), 300, wide(40)));
    for (const Vec3& p : formation.points_m) EXPECT_NEAR(glm::length(p + Vec3(0, 0, 10)), 20, 0.02);
}

TEST(SolidShapes, RoundSolidsHaveNoEdges) {
    const auto refused = build(mission_of({part_of(solid(ShapeKind::torus, SolidStyle::edges), 20)}));
    EXPECT_THAT(refused.error().message, HasSubstr("show.toml:7: keyframe[1].style = \"edges\": it has no edges"));
}

TEST(SolidShapes, CoverageOfTheVolumeIsFartherThanOfTheSurface) {
    for (const SolidStyle style : {SolidStyle::surface, SolidStyle::volume}) {
        const Mission mission = mission_of({part_of(solid(ShapeKind::cube, style), 8, wide(20))});
        const PartRef ref{mission, mission.keyframes[0].parts[0], "keyframe[1]"};
        const Figure figure = solid_shape_figure(ref, std::get<ShapeSource>(ref.part.source), aerogram::Run{}).value();
        const Points corners = figure.points(Vec3(20.0));
        // Eight drones at the corners of a cube 20 m wide: the mean distance from the nearest one is that of a place in
        // a 10 m square or cube from its corner: 10 times 0.765196 and 0.960592 (MathWorld, cube line picking).
        const double mean_m = figure.coverage(Vec3(20.0), corners);
        EXPECT_NEAR(mean_m, style == SolidStyle::surface ? 7.65196 : 9.60592, 0.02);
    }
}

TEST(SolidShapes, ABrushGathersDronesOnTheSkin) {
    Part part = part_of(solid(ShapeKind::cube, SolidStyle::surface), 600, wide(80));
    const auto upper = [](const Formation& formation) {
        return std::ranges::count_if(formation.points_m,
                                     [](const Vec3& p) { return glm::length(Vec3(p.x, 0, p.z)) < 20; });
    };
    const auto even = upper(built(part));
    part.density.brush.push_back({{0, 0}, 40, 4.0});
    EXPECT_GT(upper(built(part)), 1.5 * static_cast<double>(even));
}

TEST(Extruded, HasExactlyTheDepthWidthAndHeightAskedFor) {
    with_letter({std::nullopt, 6.0, 28.0}, 200, [](const Result<Figure>& figure) {
        const SizedFigure drawn = sized(*figure, {std::nullopt, 6.0, 28.0}, 0.5, spacing_of);
        const Vec3 size = figure->extent * drawn.scale;
        EXPECT_NEAR(size.x, 20.0, 1e-9);
        EXPECT_NEAR(size.y, 6.0, 1e-9);
        EXPECT_NEAR(size.z, 28.0, 1e-9);
        EXPECT_NEAR(box_of(drawn.points_m).size().y, 6.0, 1e-9);
        EXPECT_NEAR(box_of(drawn.points_m).high.y, 3.0, 1e-9);
        EXPECT_NEAR(box_of(drawn.points_m).size().z, 28.0, 1e-9);
    });
    with_letter({20.0, 4.0, 14.0}, 200, [](const Result<Figure>& figure) {
        const SizedFigure drawn = sized(*figure, {20.0, 4.0, 14.0}, 0.5, spacing_of);
        EXPECT_NEAR(glm::distance(figure->extent * drawn.scale, Vec3(20, 4, 14)), 0.0, 1e-9);
    });
}

TEST(Extruded, NeededSizeNamesAllThreeSidesAndFits) {
    const Size tight{10.0, 3.0, std::nullopt};
    with_letter(tight, 200, [&](const Result<Figure>& figure) {
        const SizedFigure drawn = sized(*figure, tight, 2.2, spacing_of);
        const std::string needed = needed_size(*figure, drawn, 2.2, spacing_of);
        Size size{0.0, 0.0, 0.0};
        ASSERT_EQ(std::sscanf(needed.c_str(), "[%lf, %lf, %lf]", &*size.width_m, &*size.depth_m, &*size.height_m), 3)
            << needed;
        with_letter(size, 200, [&](const Result<Figure>& fitting) {
            EXPECT_GE(spacing_of(sized(*fitting, size, 2.2, spacing_of).points_m), 2.2 - kSpacingTolerance_m);
        });
    });
}

TEST(Extruded, BothFacesAndTheWallsAreShown) {
    with_letter({20.0, 8.0, std::nullopt}, 600, [](const Result<Figure>& figure) {
        const Points points = sized(*figure, {20.0, 8.0, std::nullopt}, 0.1, spacing_of).points_m;
        std::size_t front = 0, back = 0, between = 0;
        for (const Vec3& p : points) ++(p.y < -3.999 ? front : p.y > 3.999 ? back : between);
        EXPECT_GT(front, 150U);
        EXPECT_GT(back, 150U);
        EXPECT_GT(between, 100U);
    });
}

TEST(Extruded, WithoutADepthOrAnotherSideIsAnError) {
    with_letter({20.0, std::nullopt, 20.0}, 10, [](const Result<Figure>& figure) {
        EXPECT_THAT(figure.error().message,
                    HasSubstr("show.toml:7: keyframe[1].size_m: style = \"solid\" needs a depth"));
    });
    with_letter({std::nullopt, 3.0, std::nullopt}, 10, [](const Result<Figure>& figure) { EXPECT_FALSE(figure.ok()); });
}

TEST(Figures, StretchingByAFactorTimesTheScaleGivesTimesThePoints) {
    with_letter({20.0, 3.0, std::nullopt}, 50, [](const Result<Figure>& figure) {
        const Points one = figure->points({2, 3, 4}), twice = figure->points({4, 6, 8});
        for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(glm::distance(2.0 * one[i], twice[i]), 0.0, 1e-12);
    });
}

}  // namespace
}  // namespace aerogram::planner::testing
