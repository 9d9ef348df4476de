#include "planner/sampling/area_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/sampling/area_shapes.hpp"
#include "planner/sampling/contour_track.hpp"
#include "planner/sampling/lloyd.hpp"
#include "planner/sampling/outline_points.hpp"
#include "planner/sampling/push_apart.hpp"
#include "planner/sampling/slide_apart.hpp"
#include "tests/unit/planner/sampling/random.hpp"

namespace aerogram::planner::testing {
namespace {

/// A bold H, one unit high, with corners, narrow and wide parts.
Region letter_h() {
    return {{{{0, 0},
              {.2, 0},
              {.2, .4},
              {.55, .4},
              {.55, 0},
              {.75, 0},
              {.75, 1},
              {.55, 1},
              {.55, .6},
              {.2, .6},
              {.2, 1},
              {0, 1}}}};
}

std::vector<Region> regions() {
    return {square_region(), disc_region(), ring_region(0.6), letter_h()};
}

/// Winding number by angles, an oracle without a raster.
bool inside(const Region& region, const Vec2& p) {
    double turns = 0.0;
    for (const Contour& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 a = contour[i] - p, b = contour[(i + 1) % contour.size()] - p;
            turns += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
        }
    }
    return std::abs(turns) > 3.0;
}

double distance_to_outline(const Region& region, const Vec2& p) {
    double nearest = 1e9;
    for (const Contour& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 a = contour[i], d = contour[(i + 1) % contour.size()] - a;
            const double share = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
            nearest = std::min(nearest, glm::distance(p, a + share * d));
        }
    }
    return nearest;
}

double brute_smallest(const std::vector<Vec2>& points) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size(); ++j)
            smallest = std::min(smallest, glm::distance(points[i], points[j]));
    }
    return smallest;
}

/// Twice the signed areas of the contours.
double area_of(const Region& region) {
    double sum = 0.0;
    for (const Contour& c : region.contours) {
        for (std::size_t i = 0; i < c.size(); ++i) {
            const Vec2 a = c[i], b = c[(i + 1) % c.size()];
            sum += 0.5 * (a.x * b.y - a.y * b.x);
        }
    }
    return std::abs(sum);
}

/// The side of the triangular lattice with as many points on the area.
double lattice(const Region& region, std::size_t count) {
    return std::sqrt(area_of(region) / static_cast<double>(count) * 2.0 / std::sqrt(3.0));
}

TEST(Rasterised, CellsHoldTheShareThatIsInside) {
    for (const Region& region : regions()) {
        const DensityRaster raster = rasterised(region, 20'000);
        EXPECT_NEAR(raster.total() * raster.cell * raster.cell, area_of(region), 1e-3 * area_of(region));
        Random random(7);
        for (int i = 0; i < 2000; ++i) {
            const std::size_t c = random.below(raster.mass.size());
            const Vec2 p = raster.centre(c % raster.across, c / raster.across);
            if (distance_to_outline(region, p) < raster.cell) continue;
            EXPECT_NEAR(static_cast<double>(raster.mass[c]), inside(region, p) ? 1.0 : 0.0, 1e-5);
        }
    }
}

TEST(Rasterised, OverlappingContoursOfOneDirectionAreOneArea) {
    const Region two{{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{1, 1}, {3, 1}, {3, 3}, {1, 3}}}};
    const DensityRaster raster = rasterised(two, 40'000);
    EXPECT_NEAR(raster.total() * raster.cell * raster.cell, 7.0, 0.01);
}

TEST(SampleRegion, Property1CountIsExact) {
    for (const Region& region : regions()) {
        for (const std::size_t n : {1U, 2U, 3U, 5U, 11U, 60U, 200U}) {
            for (const std::optional<double> share :
                 {std::optional<double>(), std::optional(0.0), std::optional(0.5), std::optional(1.0)}) {
                ASSERT_EQ(sample_region(region, n, share, {}).size(), n) << n << ' ' << share.value_or(-1);
            }
        }
    }
}

TEST(SampleRegion, Property2PointsAreInside) {
    for (const Region& region : regions()) {
        for (const std::size_t n : {5U, 50U, 700U}) {
            for (const Vec2& p : sample_region(region, n, {}, {})) {
                EXPECT_TRUE(inside(region, p) || distance_to_outline(region, p) <= 0.2 * lattice(region, n));
            }
        }
    }
}

TEST(SampleRegion, Property3CornersAreOccupied) {
    for (const Region& region : {square_region(), letter_h()}) {
        const auto points = sample_region(region, 300, {}, {});
        for (const Vec2& corner : region.contours[0]) {
            EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                                    [&](const Vec2& p) { return glm::distance(p, corner) < 1e-12; }))
                << corner.x << ' ' << corner.y;
        }
    }
}

TEST(SampleRegion, Property4IsDeterministic) {
    EXPECT_EQ(sample_region(letter_h(), 400, {}, {}), sample_region(letter_h(), 400, {}, {}));
}

TEST(SampleRegion, SpacingIsNearTheLattices) {
    for (const Region& region : regions()) {
        for (const std::size_t n : {100U, 2000U}) {
            const double spacing = brute_smallest(sample_region(region, n, {}, {}));
            EXPECT_GE(spacing, 0.85 * lattice(region, n)) << n;
            EXPECT_LE(spacing, 1.6 * lattice(region, n)) << n;
        }
    }
}

TEST(SampleRegion, NoPlaceInsideIsFarFromAllPoints) {
    for (const Region& region : regions()) {
        const auto points = sample_region(region, 500, {}, {});
        const DensityRaster raster = rasterised(region, 5000);
        for (std::size_t c = 0; c < raster.mass.size(); ++c) {
            if (raster.mass[c] < 0.5F) continue;
            const Vec2 p = raster.centre(c % raster.across, c / raster.across);
            double nearest = 1e9;
            for (const Vec2& q : points) nearest = std::min(nearest, glm::distance(p, q));
            EXPECT_LE(nearest, 1.2 * lattice(region, 500));
        }
    }
}

TEST(SampleRegion, TheOutlinesShareIsWhatIsAsked) {
    for (const double share : {0.1, 0.3, 0.6}) {
        const auto points = sample_region(disc_region(), 400, share, {});
        std::size_t on = 0;
        while (on < points.size() && std::abs(glm::length(points[on]) - 0.5) < 1e-4) ++on;
        EXPECT_NEAR(static_cast<double>(on), 400 * share, 3.0) << share;
    }
}

TEST(OutlinePoints, Property1And2AreOnTheOutlineAndApart) {
    for (const Region& region : regions()) {
        for (const double spacing : {0.3, 0.1, 0.03, 0.011}) {
            const auto points = outline_points(region, spacing);
            for (const Vec2& p : points) EXPECT_LT(distance_to_outline(region, p), 1e-9);
            EXPECT_GE(brute_smallest(points), 0.98 * spacing) << spacing;
        }
    }
}

TEST(OutlinePoints, WhereTheAreaIsNarrowItHasNone) {
    const Region stem{{{{0, 0}, {0.05, 0}, {0.05, 1}, {0, 1}}}};
    for (const Vec2& p : outline_points(stem, 0.1)) EXPECT_TRUE(p.y < 1e-9 || p.y > 1 - 1e-9) << p.x << ' ' << p.y;
}

TEST(Corners, AreSharpTurnsOnly) {
    EXPECT_EQ(corners_of(square_region().contours[0]).size(), 4U);
    EXPECT_TRUE(corners_of(disc_region().contours[0]).empty());
}

TEST(Relax, Property2TheCoverageCostFalls) {
    const DensityRaster raster = rasterised(letter_h(), 40'000);
    auto sites = spread_by_mass(raster, 150);
    relax(sites, 0, raster, 7, {});  // past the jumps
    double before = coverage_cost(sites, raster);
    for (int round = 0; round < 10; ++round) {
        relax(sites, 0, raster, 1, {});  // a single round does not jump
        const double now = coverage_cost(sites, raster);
        EXPECT_LE(now, before * (1.0 + 1e-9));
        before = now;
    }
    // At the optimum of the plane: 5 / (18 sqrt 3) area^2 / n for hexagons, a little more at the rim.
    EXPECT_LT(before, 1.3 * 5.0 / (18.0 * std::sqrt(3.0)) * std::pow(area_of(letter_h()), 2) / 150.0);
}

TEST(Relax, Property1FixedSitesStay) {
    const DensityRaster raster = rasterised(square_region(), 10'000);
    std::vector<Vec2> sites = spread_by_mass(raster, 30);
    sites.insert(sites.begin(), {{-0.5, -0.5}, {0.5, 0.5}});
    relax(sites, 2, raster, 10, {});
    EXPECT_EQ(sites.size(), 32U);
    EXPECT_EQ(sites[0], Vec2(-0.5, -0.5));
    EXPECT_EQ(sites[1], Vec2(0.5, 0.5));
}

TEST(CoverageCost, IsTheSumOverCellsOfTheNearestSite) {
    const DensityRaster raster = rasterised(disc_region(), 2000);
    Random random(3);
    std::vector<Vec2> sites;
    for (int i = 0; i < 40; ++i) sites.emplace_back(random.between(-2.0, 2.0), random.between(-0.3, 0.3));
    double cost = 0.0;
    for (std::size_t c = 0; c < raster.mass.size(); ++c) {
        double nearest = 1e300;
        const Vec2 p = raster.centre(c % raster.across, c / raster.across);
        for (const Vec2& s : sites) nearest = std::min(nearest, glm::dot(p - s, p - s));
        cost += static_cast<double>(raster.mass[c]) * nearest * raster.cell * raster.cell;
    }
    EXPECT_NEAR(coverage_cost(sites, raster), cost, 1e-9 * cost);
}

TEST(SampleDensity, TwiceAsDenseHasTwiceAsMany) {
    DensityRaster raster{200, 100, {0, 0}, 1.0, std::vector<float>(20'000, 1.0F)};
    for (std::size_t c = 0; c < raster.mass.size(); ++c) raster.mass[c] = c % 200 < 100 ? 1.0F : 2.0F;
    const auto points = sample_density(raster, 900, {});
    EXPECT_NEAR(
        static_cast<double>(std::count_if(points.begin(), points.end(), [](const Vec2& p) { return p.x >= 100; })),
        600.0, 15.0);
}

TEST(PushApart, Property1TheSmallestDistanceNeverFalls) {
    const DensityRaster raster = rasterised(square_region(), 10'000);
    for (std::uint64_t seed = 1; seed <= cases(20); ++seed) {
        Random random(seed);
        std::vector<Vec2> points;
        for (int i = 0; i < 60; ++i) points.emplace_back(random.between(-0.5, 0.5), random.between(-0.5, 0.5));
        const double before = brute_smallest(points);
        push_apart(points, 5, raster, 0.13, 200, {});
        EXPECT_GE(brute_smallest(points), before) << "seed " << seed;
        EXPECT_NEAR(smallest_distance(points), brute_smallest(points), 1e-15) << "seed " << seed;
    }
}

TEST(SlideApart, Property1And2PointsStayOnTheirContoursAndTheSmallestDistanceNeverFalls) {
    for (std::uint64_t seed = 1; seed <= cases(20); ++seed) {
        Random random(seed);
        const Region region = letter_h();
        const ContourTrack track(region.contours[0]);
        std::vector<Vec2> points;
        for (int i = 0; i < 40; ++i) points.push_back(track.at(random.between(0.0, track.length())));
        const auto out = slide_apart(region, points, track.length() / 40.0, 100);
        ASSERT_EQ(out.size(), points.size());
        EXPECT_GT(brute_smallest(out), brute_smallest(points)) << "seed " << seed;
        for (const Vec2& p : out) EXPECT_LT(distance_to_outline(region, p), 1e-9) << "seed " << seed;
    }
}

TEST(SlideApart, PointsOfNeighbouringLinesComeToStandAlternately) {
    const Region two{{{{0, 0}, {10, 0}, {10, 5}, {0, 5}}, {{0, 5.1}, {10, 5.1}, {10, 10}, {0, 10}}}};
    std::vector<Vec2> points;  // face to face across the gap
    for (int i = 1; i < 10; ++i) points.insert(points.end(), {Vec2(i, 5), Vec2(i, 5.1)});
    EXPECT_LT(brute_smallest(points), 0.11);
    EXPECT_GT(brute_smallest(slide_apart(two, points, 1.0, 300)), 0.45);
}

/// A drawing of 20 drones had one of them 7.5 m outside of its box: points that began outside went where they liked.
TEST(PushApart, PointsThatBeginOutsideOnlyMoveIn) {
    DensityRaster raster{10, 10, {0, 0}, 1.0, std::vector<float>(100, 0.0F)};
    for (std::size_t row = 0; row < 10; ++row)
        for (std::size_t column = 0; column < 4; ++column) raster.mass[row * 10 + column] = 1.0F;
    std::vector<Vec2> points{{4.3, 5.0}, {3.6, 5.1}, {3.4, 4.6}, {3.7, 5.6}};
    push_apart(points, 0, raster, 4.0, 60, {});
    EXPECT_LE(points[0].x, 4.3);
    for (const Vec2& p : points)
        EXPECT_TRUE(p.x >= 0.0 && p.x <= 4.3 && p.y >= 0.0 && p.y <= 10.0) << p.x << ' ' << p.y;
}

}  // namespace
}  // namespace aerogram::planner::testing
