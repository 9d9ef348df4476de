#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "geo/units.hpp"
#include "tests/unit/planner/formation/missions.hpp"
#include "tests/unit/planner/sampling/random.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;

ShapeSource area(ShapeKind kind, AreaStyle style, std::uint32_t sides = 5) {
    ShapeSource source = shape(kind);
    source.area_style = style;
    source.sides = sides;
    return source;
}

bool has_point(const Points& points, const Vec3& place, double tolerance) {
    return std::ranges::any_of(points, [&](const Vec3& p) { return glm::distance(p, place) < tolerance; });
}

TEST(Polygon, StandsOnASideWithAllCornersOccupied) {
    const Points p = built(part_of(area(ShapeKind::polygon, AreaStyle::fill, 6), 200, wide(40))).points_m;
    for (const Vec3& corner :
         {Vec3(20, 0, 0), Vec3(-20, 0, 0), Vec3(10, 0, 17.3205), Vec3(-10, 0, 17.3205), Vec3(10, 0, -17.3205)})
        EXPECT_TRUE(has_point(p, corner, 1e-3)) << corner.x << ' ' << corner.z;
    EXPECT_NEAR(box_of(p).size().z, 40 * std::sqrt(0.75), 1e-3);
    const Points triangle = built(part_of(area(ShapeKind::polygon, AreaStyle::outline, 3), 30, wide(30))).points_m;
    EXPECT_TRUE(has_point(triangle, {0, 0, 15 * std::sqrt(0.75)}, 1e-6));
    EXPECT_TRUE(has_point(triangle, {15, 0, -15 * std::sqrt(0.75)}, 1e-6));
}

TEST(Star, HasItsTipsAndNotchesOccupiedWithOneTipUp) {
    for (const AreaStyle style : {AreaStyle::fill, AreaStyle::outline}) {
        ShapeSource star = area(ShapeKind::star, style, 5);
        star.inner = 0.4;
        const Points p = built(part_of(star, style == AreaStyle::fill ? 250 : 80, wide(60))).points_m;
        const double tip = 30 / std::sin(0.4 * kPi);                  // the tips' distance from the middle
        const double middle = 0.5 * tip * (1 - std::cos(0.2 * kPi));  // of the star, below the middle of its box
        for (int i = 0; i < 10; ++i) {
            const double r = i % 2 == 0 ? tip : 0.4 * tip;
            const Vec3 corner(r * std::sin(0.2 * kPi * i), 0, r * std::cos(0.2 * kPi * i) - middle);
            EXPECT_TRUE(has_point(p, corner, 1e-6)) << i;
        }
    }
}

TEST(Heart, HasItsTipAndItsNotchOccupied) {
    for (const AreaStyle style : {AreaStyle::fill, AreaStyle::outline}) {
        const Points p =
            built(part_of(area(ShapeKind::heart, style), style == AreaStyle::fill ? 120 : 40, wide(32))).points_m;
        const double middle = 0.5 * (box_of(p).low.z + box_of(p).high.z);
        // Of x = 16 sin³ t, y = ...: the notch is at y = 5, the tip at y = -17, the highest at 11.95.
        EXPECT_TRUE(has_point(p, {0, 0, middle - 14.5}, 0.1));
        EXPECT_TRUE(has_point(p, {0, 0, middle + 7.5}, 0.1));
    }
}

TEST(Spiral, ComesFromTheMiddleInEqualStepsAndEndsAtTheTop) {
    ShapeSource spiral = shape(ShapeKind::spiral);
    spiral.turns = 3;
    const Points p = built(part_of(spiral, 200, wide(200))).points_m;
    const Vec3 middle = p.front();
    for (std::size_t i = 1; i < p.size(); ++i) {
        EXPECT_LE(glm::distance(p[i], middle) - glm::distance(p[i - 1], middle), 8.0);
        EXPECT_GT(glm::distance(p[i], middle), glm::distance(p[i - 1], middle));
    }
    EXPECT_NEAR(p.back().x, middle.x, 1e-6);
    EXPECT_NEAR(p.back().z, box_of(p).high.z, 1e-9);
    double low = 1e9, high = 0;
    for (std::size_t i = 20; i + 1 < p.size(); ++i) {  // chords of equal arcs, where the arcs are wide
        low = std::min(low, glm::distance(p[i], p[i + 1]));
        high = std::max(high, glm::distance(p[i], p[i + 1]));
    }
    EXPECT_LT(high / low, 1.02);
}

TEST(Spiral, ManyTurnsKeepEqualSteps) {
    ShapeSource spiral = shape(ShapeKind::spiral);
    spiral.turns = 200;
    const Points p = built(part_of(spiral, 5000, wide(900))).points_m;
    const double length = kPi * 200 * 450;  // nearly
    for (std::size_t i = 4000; i + 1 < p.size(); ++i)
        EXPECT_NEAR(glm::distance(p[i], p[i + 1]), length / 4999, 0.04 * length / 4999);  // a chord of 0.15 of a turn
}

TEST(Wave, Property1And2AndCornersOfTheSheetAreOccupied) {
    for (const double waves : {0.2, 1.0, 2.5}) {
        ShapeSource wave = shape(ShapeKind::wave);
        wave.waves = waves;
        const Points p = built(part_of(wave, 300, {60, 40, 8})).points_m;
        ASSERT_EQ(p.size(), 300U);
        const Box box = box_of(p);
        EXPECT_NEAR(box.size().x, 60, 1e-6);
        EXPECT_NEAR(box.size().y, 40, 1e-6);
        EXPECT_LE(box.size().z, 8 + 1e-9);
        EXPECT_GE(box.size().z, 7.5);
        double high = 1e-300, low = 0;
        for (int i = 0; i <= 10'000; ++i) {
            high = std::max(high, std::sin(2 * kPi * waves * i / 10'000));
            low = std::min(low, std::sin(2 * kPi * waves * i / 10'000));
        }
        for (const Vec3& q : p) {
            const double sine = std::sin(2 * kPi * waves * (q.x / 60 + 0.5));
            EXPECT_NEAR(q.z, 8 * ((sine - low) / (high - low) - 0.5), 1e-4);
        }
        std::size_t corners = 0;
        for (const Vec3& q : p) corners += std::abs(std::abs(q.x) - 30) < 1e-6 && std::abs(std::abs(q.y) - 20) < 1e-6;
        EXPECT_EQ(corners, 4U);
    }
}

TEST(Wave, IsSpreadEvenlyOverTheSheetAndKnowsItsCoverage) {
    const Formation formation = built(part_of(shape(ShapeKind::wave), 400, {50, 50, 10}));
    // Two waves of amplitude 5 on 50 m: the sheet is 1.31 times its shadow; the lattice's spacing is as wide as that.
    EXPECT_GT(formation.smallest_spacing_m, 0.75 * std::sqrt(1.31 * 2500 / 400 * 2 / std::sqrt(3.0)));
    ASSERT_TRUE(formation.coverage_m[0]);
    double sum = 0.0, weight = 0.0;
    for (int i = 0; i < 250; ++i) {
        for (int j = 0; j < 100; ++j) {
            const double x = -25 + 0.2 * (i + 0.5), angle = 4 * kPi * (x / 50 + 0.5);
            const Vec3 place(x, -25 + 0.5 * (j + 0.5), 5 * std::sin(angle));
            double nearest = 1e300;
            for (const Vec3& p : formation.points_m) nearest = std::min(nearest, glm::distance(p, place));
            const double slope = 5 * std::cos(angle) * 4 * kPi / 50, area = std::sqrt(1 + slope * slope);
            sum += nearest * area;
            weight += area;
        }
    }
    EXPECT_NEAR(*formation.coverage_m[0], sum / weight, 0.02 * sum / weight);
}

std::vector<ShapeSource> lines() {
    std::vector<ShapeSource> out{shape(ShapeKind::line), shape(ShapeKind::circle), shape(ShapeKind::spiral),
                                 shape(ShapeKind::grid)};
    for (const ShapeKind kind :
         {ShapeKind::disc, ShapeKind::ring, ShapeKind::square, ShapeKind::polygon, ShapeKind::star, ShapeKind::heart})
        out.push_back(area(kind, AreaStyle::outline));
    return out;
}

std::vector<ShapeSource> areas() {
    std::vector<ShapeSource> out{shape(ShapeKind::wave)};
    for (const ShapeKind kind :
         {ShapeKind::disc, ShapeKind::ring, ShapeKind::square, ShapeKind::polygon, ShapeKind::star, ShapeKind::heart})
        out.push_back(area(kind, AreaStyle::fill));
    return out;
}

void expect_exact(const ShapeSource& source, std::size_t n) {
    const auto formation = build(mission_of({part_of(source, n)}));  // without a size: the smallest that fits
    ASSERT_TRUE(formation.ok()) << static_cast<int>(source.kind) << ' ' << n << ' ' << formation.error().message;
    EXPECT_EQ(formation->points_m.size(), n) << static_cast<int>(source.kind);
    if (n > 1) {
        EXPECT_GE(formation->smallest_spacing_m, 2.2 - 1e-9) << static_cast<int>(source.kind) << ' ' << n;
    }
}

Mission sky_high(Mission mission) {
    mission.limits.ceiling_m = 1e6;
    mission.limits.min_navigation_altitude_m = -1e6;
    return mission;
}

TEST(FlatShapes, HaveExactlyNDronesAtTheSpacingForEveryN) {
    for (const ShapeSource& source : lines()) {
        for (const std::size_t n : {1U, 2U, 3U, 4U, 5U, 7U, 10U, 100U, 400U}) expect_exact(source, n);
    }
    for (const ShapeSource& source : areas()) {
        for (const std::size_t n : {1U, 2U, 3U, 4U, 5U, 7U, 10U, 100U, 400U}) expect_exact(source, n);
    }
}

TEST(FlatShapes, HaveExactlyNDronesWhereThereAreMany) {
    const auto count = [](const ShapeSource& source, std::size_t n) {
        const auto formation = build(sky_high(mission_of({part_of(source, n)})));
        ASSERT_TRUE(formation.ok()) << formation.error().message;
        EXPECT_EQ(formation->points_m.size(), n);
        EXPECT_GE(formation->smallest_spacing_m, 2.2 - 1e-9);
    };
    for (const ShapeSource& source : lines()) count(source, 1000);
    for (const ShapeSource& source : {lines()[0], lines()[3], area(ShapeKind::heart, AreaStyle::outline)})
        count(source, 20'000);
    count(area(ShapeKind::star, AreaStyle::fill), 10'000);
    count(area(ShapeKind::disc, AreaStyle::fill), 20'000);
}

/// The size that an error names, and the formation at it.
Result<Formation> at_the_size_named(Part part, const std::string& message) {
    static const std::regex kFlat(R"(needs size_m >= \[([0-9.e+]+), ([0-9.e+]+)\])");
    std::smatch found;
    if (!std::regex_search(message, found, kFlat)) return Error{ErrorCode::invalid_input, "names no size: " + message};
    part.size = flat(std::stod(found[1]), std::stod(found[2]));
    return build(sky_high(mission_of({std::move(part)})));
}

TEST(FlatShapes, TheSizeThatAnErrorNamesFits) {
    std::vector<Part> parts;
    for (const ShapeSource& source : areas()) {
        if (source.kind == ShapeKind::wave) continue;
        parts.push_back(part_of(source, 80, flat(6, 6)));
        parts.push_back(part_of(source, 60, flat(50, 1)));    // 50:1
        parts.push_back(part_of(source, 60, flat(0.5, 25)));  // 1:50
        ShapeSource outline = source;
        outline.area_style = AreaStyle::outline;
        parts.push_back(part_of(outline, 50, flat(3, 4)));
        parts.push_back(part_of(outline, 40, flat(40, 0.8)));
    }
    parts.push_back(part_of(shape(ShapeKind::spiral), 90, flat(5, 9)));
    Part brushed = part_of(shape(ShapeKind::square), 200, flat(12, 12));
    brushed.density.brush = {{{2, 2}, 4, 5}};
    parts.push_back(brushed);
    for (const Part& part : parts) {
        const auto tight = build(sky_high(mission_of({part})));
        ASSERT_FALSE(tight.ok());
        ASSERT_THAT(tight.error().message, HasSubstr("is below formation_spacing_m"));
        const auto fits = at_the_size_named(part, tight.error().message);
        EXPECT_TRUE(fits.ok()) << tight.error().message << "\n" << (fits.ok() ? "" : fits.error().message);
    }
}

TEST(FlatShapes, SolidOnesStandOnBothFacesAndTheWallsBetween) {
    const Points p = built(part_of(area(ShapeKind::star, AreaStyle::solid), 400, {40, 10, 40})).points_m;
    ASSERT_EQ(p.size(), 400U);
    EXPECT_NEAR(box_of(p).size().y, 10, 1e-6);
    const auto front = std::ranges::count_if(p, [](const Vec3& q) { return q.y < -5 + 1e-6; });
    const auto back = std::ranges::count_if(p, [](const Vec3& q) { return q.y > 5 - 1e-6; });
    EXPECT_GT(front, 80);
    EXPECT_GT(back, 80);
    EXPECT_LT(front + back, 390);
}

}  // namespace
}  // namespace aerogram::planner::testing
