#include "planner/drawing/region_clip.hpp"

#include "geo/random.hpp"
#include "tests/unit/planner/drawing/drawings.hpp"

namespace aerogram::planner::testing {
namespace {

Region box(double x, double y, double size) {
    return {{{{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}}}};
}

Region turned_round(Region region) {
    for (Contour& c : region.contours) std::reverse(c.begin(), c.end());
    return region;
}

double signed_area(const Region& region) {
    double sum = 0.0;
    for (const Contour& c : region.contours) sum += 0.5 * doubled_area(c);
    return sum;
}

TEST(RegionClip, UnionsDifferencesAndIntersectionsOfBoxes) {
    const Region parts[] = {box(0, 0, 10), turned_round(box(5, 5, 10)), box(50, 50, 1)};
    EXPECT_NEAR(signed_area(*united(parts)), 176.0, 1e-5);
    EXPECT_EQ(united(parts)->contours.size(), 2U);
    EXPECT_NEAR(signed_area(*subtracted(box(0, 0, 10), box(2, 2, 3))), 91.0, 1e-5);
    EXPECT_NEAR(signed_area(*intersected(box(0, 0, 10), box(5, 5, 10))), 25.0, 1e-5);
    EXPECT_TRUE(intersected(box(0, 0, 1), box(5, 5, 1))->contours.empty());
    EXPECT_TRUE(united({})->contours.empty());
}

/// By winding number as by parity: against the crossings counted at random places.
TEST(RegionClip, SimplifiedScribblesKeepTheirInsideByEitherRule) {
    Random random(20261122);
    for (int round = 0; round < 20; ++round) {
        Region scribble{{Contour{}, Contour{}}};
        for (Contour& c : scribble.contours) {
            for (int k = 0; k < 15; ++k) c.emplace_back(random.unit(), random.unit());
        }
        const Region even = *simplified(scribble, FillRule::evenodd), whole = *simplified(scribble, FillRule::nonzero);
        for (int k = 0; k < 500; ++k) {
            const Vec2 p(random.unit(), random.unit());
            const int turns = winding(scribble, p);
            ASSERT_EQ(winding(even, p) != 0, turns % 2 != 0) << round;
            ASSERT_EQ(winding(whole, p) != 0, turns != 0) << round;
            ASSERT_GE(winding(even, p), 0);
            ASSERT_LE(winding(whole, p), 1);
        }
    }
}

TEST(RegionClip, LinesAreCutInsideAndOutside) {
    const Chords lines{{{{-5, 5}, {15, 5}}}, {false}};
    const auto inside = clipped(lines, box(0, 0, 10)), outside = clipped(lines, box(0, 0, 10), Side::outside);
    ASSERT_EQ(inside->lines.size(), 1U);
    EXPECT_NEAR(length_of(inside->lines[0], false), 10.0, 1e-6);
    EXPECT_EQ(outside->lines.size(), 2U);
}

TEST(RegionClip, PensCoverLengthTimesWidthAndMitres) {
    EXPECT_NEAR(area_of(stroked({{{{0, 0}, {10, 0}}}, {false}}, 2.0)), 20.0, 1e-12);
    const auto frame = simplified(stroked({{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}}, {true}}, 2.0), FillRule::nonzero);
    EXPECT_NEAR(signed_area(*frame), 144.0 - 64.0, 1e-5);
}

TEST(RegionClip, WhatWouldCostTooMuchIsLeftUndone) {
    Random random(7);
    Region scribble{{Contour{}}};
    for (int k = 0; k < 20'000; ++k) scribble.contours[0].emplace_back(random.unit(), random.unit());
    EXPECT_FALSE(simplified(scribble, FillRule::evenodd).has_value());
}

}  // namespace
}  // namespace aerogram::planner::testing
