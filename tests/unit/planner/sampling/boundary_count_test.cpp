#include "planner/sampling/boundary_count.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/sampling/area_sampling.hpp"
#include "planner/sampling/area_shapes.hpp"
#include "planner/sampling/contour_track.hpp"
#include "tests/unit/planner/sampling/random.hpp"

namespace aerogram::planner::testing {
namespace {

TEST(BoundaryCount, IsTheRootOfTheEquation) {
    for (std::uint64_t seed = 1; seed <= cases(1000); ++seed) {
        Random random(seed);
        const double n = random.between(1, 20'000), boundary = random.between(1, 5000);
        const double inside = std::pow(10.0, random.between(-6, 7));
        const double b = boundary_count(n, boundary, inside), r = std::sqrt(inside) / boundary;
        EXPECT_NEAR(b + r * r * b * b, n, 1e-9 * n) << "seed " << seed;
        EXPECT_GT(b, 0.0);
        EXPECT_LE(b, n);
    }
}

TEST(BoundaryCount, WithoutAnInsideEverybodyStandsOnTheBoundary) {
    EXPECT_EQ(boundary_count(17, 40, 0), 17.0);
}

TEST(BoundaryCount, ASquareGridKnowsItsOwnRim) {  // m x m points: 4 (m - 1) on the rim, (m - 2)² inside
    for (const double m : {3.0, 10.0, 141.0})
        EXPECT_NEAR(boundary_count(m * m, 4 * (m - 1), (m - 2) * (m - 2)), 4 * (m - 1), 1e-9 * m);
}

double area_of(const Region& region) {
    double sum = 0.0;
    for (const Contour& c : region.contours) {
        for (std::size_t i = 0; i < c.size(); ++i) {
            const Vec2 a = c[i], b = c[(i + 1) % c.size()];
            sum += 0.5 * (a.x * b.y - a.y * b.x);
        }
    }
    return sum;
}

double distance_to_outline(const Region& region, const Vec2& p) {
    double nearest = 1e9;
    for (const Contour& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 a = contour[i], d = contour[(i + 1) % contour.size()] - a;
            nearest =
                std::min(nearest, glm::distance(p, a + std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0) * d));
        }
    }
    return nearest;
}

// The default share gives outline and inside one spacing, which is what the equation is for. It differs where corners
// and thin parts take whole drones, and as the equation's ratio, measured at a small sampling unit, leaves the strip
// along the outline to the inside.
TEST(BoundaryCount, TheDefaultOutlineOfAnAreaIsTheEquationsToATenth) {
    for (const Region& region : {square_region(), disc_region(), star_region(5, 0.5), heart_region()}) {
        double length = 0.0;
        for (const Contour& contour : region.contours) length += ContourTrack(contour).length();
        for (const std::size_t n : {60U, 250U, 1000U, 4000U}) {
            const auto points = sample_region(region, n, {}, {});
            const auto on = static_cast<double>(std::count_if(
                points.begin(), points.end(), [&](const Vec2& p) { return distance_to_outline(region, p) < 1e-9; }));
            const double unit = 1e-3;  // boundary and inside as counted at a small sampling unit
            const double b = boundary_count(static_cast<double>(n), length / unit, area_of(region) / (unit * unit));
            EXPECT_NEAR(on, b, 0.1 * b + 1.0) << n << " of a region with " << region.contours[0].size() << " vertices";
        }
    }
}

}  // namespace
}  // namespace aerogram::planner::testing
