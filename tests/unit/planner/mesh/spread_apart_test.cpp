#include "planner/mesh/spread_apart.hpp"

#include <gtest/gtest.h>

#include "geo/random.hpp"
#include "measures.hpp"
#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

Points thrown(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    Points points;
    for (std::size_t i = 0; i < count; ++i)
        points.emplace_back(random.between(0, 1), random.between(0, 2), random.between(0, 0.5));
    return points;
}

TEST(SpaceGrid, NearestAgreesWithAllSites) {
    for (const double side : {0.01, 0.1, 3.0}) {
        const Points sites = thrown(300, 1);
        const SpaceGrid grid(sites, side);
        for (const Vec3& p : thrown(200, 2)) {
            const Vec3 asked = 1.5 * p - Vec3(0.2);
            double smallest = 1e300;
            for (const Vec3& site : sites) smallest = std::min(smallest, glm::distance(site, asked));
            EXPECT_EQ(glm::distance(sites[grid.nearest(asked)], asked), smallest);
        }
    }
}

TEST(SmallestShare, AgreesWithAllPairs) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Points points = thrown(2 + seed * 17, seed);
        const std::vector<double> reach(points.size(), 2.0);
        EXPECT_NEAR(smallest_share(points, reach), testing::smallest_gap(points) / 2.0, 1e-15);
    }
}

TEST(SpreadApart, TheSmallestShareNeverFalls) {  // property 1
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        Points points = thrown(2 + seed * 7, seed);
        const Points before = points;
        const std::vector<double> reach(points.size(), 1.0);
        const Ground ground{[](std::size_t i) {
                                if (i % 3 == 0) return Freedom{Freedom::Kind::none, {}};
                                if (i % 3 == 1) return Freedom{Freedom::Kind::line, {0, 1, 0}};
                                return Freedom{Freedom::Kind::plane, {0, 0, 1}};
                            },
                            [&](std::size_t, const Vec3& wanted) { return wanted; }};
        spread_apart(points, reach, ground, targets_for(points, reach), 50, {});
        EXPECT_GE(smallest_share(points, reach), smallest_share(before, reach));
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3 moved = points[i] - before[i];
            if (i % 3 == 0) {
                EXPECT_EQ(moved, Vec3{});
            }
            if (i % 3 == 1) {
                EXPECT_EQ(moved.x, 0.0);
            }
            EXPECT_NEAR(moved.z, 0.0, 1e-15);
        }
    }
}

}  // namespace
}  // namespace aerogram::planner
