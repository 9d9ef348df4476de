#include "planner/adjacency/delaunay.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "geo/contract.hpp"
#include "tests/unit/planner/adjacency/formations.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

TEST(Delaunay, TetrahedronHasSixEdgesWithRingsOfTwo) {
    const Delaunay delaunay = delaunay_in_space(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    ASSERT_EQ(delaunay.edges.size(), 6U);
    for (const DelaunayEdge& e : delaunay.edges) {
        EXPECT_LT(e.a, e.b);
        ASSERT_EQ(delaunay.ring(e).size(), 2U);
        EXPECT_EQ(e.a + e.b + delaunay.ring(e)[0] + delaunay.ring(e)[1], 6U);
    }
}

TEST(Delaunay, TriangleWithItsCentreHasInnerEdgesWithTwoNeighbours) {
    const Delaunay delaunay = delaunay_in_plane(std::vector<Vec2>{{-3, -2}, {3, -2}, {0, 4}, {0, 0}});
    ASSERT_EQ(delaunay.edges.size(), 6U);
    for (const DelaunayEdge& e : delaunay.edges) EXPECT_EQ(delaunay.ring(e).size(), e.b == 3 ? 2U : 1U);
}

TEST(Delaunay, PointsAtOneVertexAreReported) {
    const Delaunay plane = delaunay_in_plane(std::vector<Vec2>{{0, 0}, {1, 0}, {0, 0}, {0, 1}});
    EXPECT_EQ(plane.doubles, (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0, 2}}));
    const Delaunay space = delaunay_in_space(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 0}});
    EXPECT_EQ(space.doubles, (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{2, 4}}));
}

TEST(Delaunay, EulerHoldsForRandomPlanes) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        std::vector<Vec2> points;
        for (const Vec3& p : random_points(50, seed)) points.emplace_back(p.x, p.y);
        const Delaunay delaunay = delaunay_in_plane(points);
        std::size_t hull = 0, corners = 0;
        for (const DelaunayEdge& e : delaunay.edges) {
            hull += delaunay.ring(e).size() == 1 ? 1U : 0U;
            corners += delaunay.ring(e).size();
        }
        EXPECT_EQ(corners % 3, 0U);
        EXPECT_EQ(points.size() + corners / 3 + 1, delaunay.edges.size() + 2) << seed;  // V + F = E + 2
        EXPECT_EQ(delaunay.edges.size(), 3 * points.size() - 3 - hull);
    }
}

TEST(Delaunay, LowerDimensionsAndNonsenseAreBugs) {
    EXPECT_THROW((void)delaunay_in_space(grid(3, 3, 1.0)), ContractViolation);
    EXPECT_THROW((void)delaunay_in_plane(std::vector<Vec2>{{0, 0}, {1, 1}, {2, 2}}), ContractViolation);
    EXPECT_THROW(
        (void)delaunay_in_plane(std::vector<Vec2>{{0, 0}, {1, 0}, {std::numeric_limits<double>::infinity(), 2}}),
        ContractViolation);
}

}  // namespace
}  // namespace aerogram::planner
