#include "planner/formation/part_density.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/formation/area_figure.hpp"
#include "planner/sampling/area_shapes.hpp"
#include "tests/unit/planner/formation/missions.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kQuarters =
    std::filesystem::path(AEROGRAM_SOURCE_DIR) / "tests/unit/planner/formation/pictures/quarters.png";

Part square(std::size_t drones, DensityMap density, Size size = flat(40, 40)) {
    Part part = part_of(shape(ShapeKind::square), drones, size);
    part.density = std::move(density);
    return part;
}

DensityField field_of(const Part& part, const Vec3& extent) {
    const Mission mission = mission_of({part});
    return density_of({mission, mission.keyframes[0].parts[0], "keyframe[1]"}, extent).value();
}

std::string failure_of(const Part& part) {
    const auto formation = build(mission_of({part}));
    return formation ? "built" : formation.error().message;
}

std::size_t inside(const Points& points, const Vec2& middle, double radius) {
    return static_cast<std::size_t>(std::count_if(
        points.begin(), points.end(), [&](const Vec3& p) { return glm::distance(Vec2(p.x, p.z), middle) < radius; }));
}

TEST(DensityOf, AnEvenMapHasNoField) {
    EXPECT_FALSE(field_of(square(5, {}), {1, 0, 1}));
}

TEST(DensityOf, APictureIsLaidOverTheBoxAndBlackIsNobody) {  // red | green above blue | transparent
    const DensityField field = field_of(square(5, {kQuarters, {}}), {2, 0, 1});
    EXPECT_NEAR(field({-0.5, 0, 0.25}), 0.2126, 1e-6);
    EXPECT_NEAR(field({0.5, 7, 0.25}), 0.7152, 1e-6);  // seen from the front: depth does not matter
    EXPECT_NEAR(field({-0.5, 0, -0.25}), 0.0722, 1e-6);
    EXPECT_EQ(field({0.5, 0, -0.25}), 0.0);
    EXPECT_NEAR(field({0.0, 0, 0.25}), 0.5 * (0.2126 + 0.7152), 1e-6);  // linear between pixels
}

TEST(DensityOf, ABrushIsInMetresWhateverThePartsNaturalUnit) {
    const Part part = square(5, {{}, {{{5, -3}, 4, 3}}}, flat(40, 20));
    for (const double unit : {1.0, 100.0}) {
        const DensityField field = field_of(part, {unit, 0, unit});
        const auto at_m = [&](double x_m, double z_m) { return field({x_m / 40 * unit, 0, z_m / 20 * unit}); };
        EXPECT_NEAR(at_m(5, -3), 3.0, 1e-12);
        EXPECT_NEAR(at_m(9, -3), 1.0, 1e-12);
        EXPECT_NEAR(at_m(5, 1.1), 1.0, 1e-12);
        EXPECT_NEAR(at_m(7, -3), 1.0 + 2.0 * 0.75 * 0.75, 1e-12);
    }
}

TEST(DensityOf, PictureAndBrushMultiply) {
    const DensityField field = field_of(square(5, {kQuarters, {{{-10, 10}, 6, 0.5}}}), {1, 0, 1});
    EXPECT_NEAR(field({-0.25, 0, 0.25}), 0.5 * 0.2126, 1e-6);
}

TEST(DensityOf, ProblemsNameThePartsLine) {
    EXPECT_THAT(failure_of(square(5, {"no-such.png", {}})),
                HasSubstr("show.toml:7: keyframe[1].density = \"no-such.png\": cannot be read"));
    EXPECT_THAT(failure_of(square(5, {{}, {{{0, 0}, 3, 2}}}, {})), HasSubstr(".brush: is in metres"));
    EXPECT_THAT(failure_of(square(5, {{}, {{{0, 0}, 1000, 0}, {{0, 0}, 1, 0}}}, flat(40, 40))), HasSubstr("built"));
}

TEST(AreaFigure, Property1WithoutADensityAFillIsTheSameToTheBit) {
    const Part part = square(300, {});
    const Mission mission = mission_of({part});
    const PartRef ref{mission, mission.keyframes[0].parts[0], "keyframe[1]"};
    for (const std::optional<double> share : {std::optional<double>(), std::optional(0.4)}) {
        const Figure now = area_figure(ref, square_region(), AreaStyle::fill, share, {}).value();
        const Figure before = filled_figure(square_region(), 300, share, {});
        EXPECT_EQ(now.extent, before.extent);
        EXPECT_EQ(now.points({3, 1, 2}), before.points({3, 1, 2}));
    }
}

TEST(AreaFigure, ABrushGathersDrones) {
    const Points even = built(square(400, {}, flat(100, 100))).points_m;
    const Points brushed = built(square(400, {{}, {{{20, 20}, 25, 4}}}, flat(100, 100))).points_m;
    EXPECT_GT(inside(brushed, {20, 20}, 12), 2 * inside(even, {20, 20}, 12));
    ASSERT_EQ(brushed.size(), 400U);
}

TEST(AreaFigure, QuartersHoldWhatTheirShareOfTheDensityAsksFor) {
    const Part part = square(1000, {kQuarters, {}}, flat(200, 200));
    const DensityField field = field_of(part, {1, 0, 1});
    const auto quarter = [](const Vec3& p) { return (p.x < 0 ? 0U : 1U) + (p.z > 0 ? 0U : 2U); };
    std::array<double, 4> mass{}, drones{};
    for (int i = 0; i < 256 * 256; ++i) {
        const Vec3 p((i % 256 + 0.5) / 256 - 0.5, 0, (i / 256 + 0.5) / 256 - 0.5);
        mass.at(quarter(p)) += field(p);
    }
    for (const Vec3& p : built(part).points_m) drones.at(quarter(p)) += 1.0;
    const double total = mass[0] + mass[1] + mass[2] + mass[3];
    for (std::size_t q = 0; q < 4; ++q) EXPECT_NEAR(drones.at(q), 1000 * mass.at(q) / total, 15.0) << q;
    EXPECT_LT(drones[3], 30.0);  // black but for half a pixel at its rim
}

TEST(AreaFigure, AskedOutlineStandsWhereTheDensityIsNotZero) {
    Part part = square(400, {kQuarters, {}}, flat(150, 150));
    std::get<ShapeSource>(part.source).outline_share = 0.3;
    const Points points = built(part).points_m;
    std::size_t on = 0;
    for (const Vec3& p : points) {
        const bool edge = std::abs(std::max(std::abs(p.x), std::abs(p.z)) - 75) < 1e-6;
        on += edge;
        EXPECT_FALSE(edge && p.x > 10 && p.z < -10);
    }
    EXPECT_NEAR(static_cast<double>(on), 0.75 * 0.3 * 400, 8.0);
}

TEST(AreaFigure, ADensityThatIsZeroAllOverTheShapeIsRefused) {
    Part part = square(10, {{}, {{{0, 0}, 1e6, 0}}});
    EXPECT_THAT(failure_of(part), HasSubstr("built"));  // 0 in the very middle only
    part.density = {kQuarters, {}};                     // the transparent quarter
    part.source = shape(ShapeKind::disc);
    const Mission mission = mission_of({part});
    const Region corner{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{9, -9}, {10, -9}, {10, -8}, {9, -8}}}};
    const PartRef ref{mission, mission.keyframes[0].parts[0], "keyframe[1]"};
    EXPECT_TRUE(area_figure(ref, corner, AreaStyle::fill, {}, {}).ok());
}

TEST(Coverage, IsTheMeanDistanceOfTheAreasPlacesToTheNearestDrone) {
    const Formation formation = built(part_of(shape(ShapeKind::square), 60, flat(40, 20)));
    ASSERT_EQ(formation.coverage_m.size(), 1U);
    ASSERT_TRUE(formation.coverage_m[0]);
    double sum = 0.0;  // brute force: 400 x 200 places
    for (int i = 0; i < 400; ++i) {
        for (int j = 0; j < 200; ++j) {
            double nearest = 1e300;
            const Vec3 place(-20 + 0.1 * (i + 0.5), 0, -10 + 0.1 * (j + 0.5));
            for (const Vec3& p : formation.points_m) nearest = std::min(nearest, glm::distance(p, place));
            sum += nearest;
        }
    }
    EXPECT_NEAR(*formation.coverage_m[0], sum / 80'000, 1e-3 * sum / 80'000);
    // A place of a hexagon is 0.351 times its lattice's spacing from the middle on average (closed form).
    EXPECT_GT(*formation.coverage_m[0], 0.3512 * std::sqrt(800.0 / 60 * 2 / std::sqrt(3.0)) * 0.85);
}

TEST(Coverage, ASpheresSkinIsItsPlaces) {
    const Formation formation = built(part_of(shape(ShapeKind::sphere), 300, {30, 30, 30}));
    ASSERT_TRUE(formation.coverage_m[0]);
    double sum = 0.0;  // brute force over a golden spiral of places
    for (int i = 0; i < 20'000; ++i) {
        const double z = 1 - (2 * i + 1) / 20'000.0, angle = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
        const Vec3 place = 15.0 * Vec3(r * std::cos(angle), r * std::sin(angle), z);
        double nearest = 1e300;
        for (const Vec3& p : formation.points_m) nearest = std::min(nearest, glm::distance(p, place));
        sum += nearest;
    }
    EXPECT_NEAR(*formation.coverage_m[0], sum / 20'000, 0.02 * sum / 20'000);
}

TEST(Coverage, LinesAndPointsHaveNone) {
    EXPECT_FALSE(built(part_of(shape(ShapeKind::circle), 20)).coverage_m[0]);
    EXPECT_FALSE(built(part_of(text("A"), 20)).coverage_m[0]);
}

}  // namespace
}  // namespace aerogram::planner::testing
