#include "planner/mesh/mesh_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "geo/random.hpp"
#include "planner/mesh/crossings.hpp"
#include "planner/mesh/mesh_measure.hpp"
#include "solids_by_hand.hpp"

namespace aerogram::planner {
namespace {

using testing::ball;
using testing::box;
using ::testing::HasSubstr;
using testing::inside_out;
using ::testing::Not;
using testing::ring;
using testing::together;

const TriangleMesh kCube = box({0, 0, 0}, {1, 1, 1});

TEST(MeshFaults, ClosedSolidsHaveNone) {
    EXPECT_EQ(faults_of(kCube), "");
    EXPECT_EQ(faults_of(ball({1, 2, 3}, 2.0, 4)), "");
    EXPECT_EQ(faults_of(ring(3.0, 1.0, 24, 12)), "");
    EXPECT_EQ(faults_of(inside_out(kCube)), "");
    EXPECT_EQ(faults_of(together(kCube, box({2, 0, 0}, {3, 1, 1}))), "");
    EXPECT_EQ(faults_of(together(ball({0, 0, 0}, 2.0, 3), inside_out(ball({0, 0, 0}, 1.0, 2)))), "");
}

TEST(MeshFaults, OpenEdgesAreCountedWithTheFirstPlace) {
    TriangleMesh mesh = kCube;
    mesh.triangles.erase(mesh.triangles.begin() + 2);  // of the top, its corners 4, 5, 6
    EXPECT_EQ(faults_of(mesh), "is open: 3 edges without a second triangle, the first from (0, 0, 1) to (1, 0, 1)");
    EXPECT_EQ(faults_of({}), "has no triangle");
}

TEST(MeshFaults, EdgesOfMoreThanTwoTrianglesAreCounted) {
    // Two cubes that share one edge.
    TriangleMesh mesh = kCube;
    const TriangleMesh other = box({1, 1, 0}, {2, 2, 1});
    std::vector<std::uint32_t> place;
    for (const Vec3& v : other.vertices) {
        const auto known = std::find(mesh.vertices.begin(), mesh.vertices.end(), v);
        place.push_back(static_cast<std::uint32_t>(known - mesh.vertices.begin()));
        if (known == mesh.vertices.end()) mesh.vertices.push_back(v);
    }
    for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({place[a], place[b], place[c]});
    EXPECT_EQ(faults_of(mesh), "has 1 edge of more than two triangles, the first from (1, 1, 0) to (1, 1, 1)");
}

TEST(MeshFaults, TrianglesThatDisagreeAreCounted) {
    TriangleMesh mesh = kCube;
    std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
    EXPECT_THAT(faults_of(mesh), HasSubstr("has 3 edges whose triangles disagree about the outside, the first from ("));
    EXPECT_EQ(faults_of(turned_outwards(mesh)), "");
}

TEST(MeshFaults, TrianglesWithoutAreaAreCounted) {
    TriangleMesh mesh = kCube;
    mesh.vertices[7] = mesh.vertices[5];
    EXPECT_THAT(faults_of(mesh), HasSubstr("has 2 triangles without area, the first at ("));
}

TEST(MeshFaults, ASurfaceFoldedFlatEnclosesNothing) {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
    EXPECT_THAT(faults_of(mesh), HasSubstr("passes through itself"));
}

TEST(MeshFaults, SolidsThatTouchOrCrossPassThroughThemselves) {
    EXPECT_THAT(faults_of(together(kCube, box({0.5, 0.5, 0.5}, {2, 2, 2}))), HasSubstr("passes through itself: "));
    EXPECT_THAT(faults_of(together(kCube, box({1, 0.2, 0.2}, {2, 0.8, 0.8}))), HasSubstr("passes through itself: "));
    // A corner pulled through the opposite side.
    TriangleMesh mesh = kCube;
    mesh.vertices[7] = {-0.2, 0.4, 0.3};
    EXPECT_THAT(faults_of(mesh), HasSubstr("passes through itself: "));
}

TEST(MeshFaults, TurnedOutwardsEnclosesEachPiecePositively) {
    const TriangleMesh two = together(inside_out(kCube), box({2, 0, 0}, {4, 1, 1}));
    EXPECT_NEAR(enclosed_volume(two), 1.0, 1e-12);
    EXPECT_NEAR(enclosed_volume(turned_outwards(two)), 3.0, 1e-12);
    Random random(5);
    TriangleMesh shuffled = ring(3.0, 1.0, 24, 12);
    const double volume = enclosed_volume(shuffled);
    for (auto& t : shuffled.triangles)
        if (random.unit() < 0.5) std::swap(t[0], t[2]);
    EXPECT_THAT(faults_of(shuffled), HasSubstr("disagree"));
    const TriangleMesh turned = turned_outwards(shuffled);
    EXPECT_EQ(faults_of(turned), "");
    EXPECT_NEAR(enclosed_volume(turned), volume, 1e-9);
    EXPECT_TRUE(turned_outwards({}).triangles.empty());
}

double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
    if (six_volumes(a, b, c, p) * six_volumes(a, b, c, q) >= 0.0) return false;
    const double ab = six_volumes(p, q, a, b), bc = six_volumes(p, q, b, c), ca = six_volumes(p, q, c, a);
    return (ab > 0) == (bc > 0) && (bc > 0) == (ca > 0);
}

// Loose triangles: two pass through each other exactly when an edge of one pierces the other.
TEST(Crossings, AgreeWithEveryEdgeAgainstEveryTriangle) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        TriangleMesh soup;
        for (std::uint32_t t = 0; t < 150; ++t) {
            const Vec3 at{random.unit(), random.unit(), random.unit()};
            for (int k = 0; k < 3; ++k)
                soup.vertices.push_back(at + 0.3 * Vec3{random.unit(), random.unit(), random.unit()});
            soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
        }
        std::set<std::pair<std::uint32_t, std::uint32_t>> expected;
        for (std::uint32_t s = 0; s < 150; ++s)
            for (std::uint32_t t = 0; t < 150; ++t)
                for (std::uint32_t k = 0; k < 3 && s != t; ++k)
                    if (pierces(soup.vertices[3 * s + k], soup.vertices[3 * s + (k + 1) % 3], soup.vertices[3 * t],
                                soup.vertices[3 * t + 1], soup.vertices[3 * t + 2]))
                        expected.insert(std::minmax(s, t));
        const Crossings found = crossings_of(soup, 1'000'000);
        ASSERT_FALSE(expected.empty());
        EXPECT_EQ(found.pairs, expected.size());
        EXPECT_EQ(found.first, *expected.begin());
    }
}

// A fan of triangles around one corner: all boxes meet, nothing crosses; the work is bounded and said.
TEST(Crossings, TooManyBoxesThatMeetAreGivenUp) {
    TriangleMesh fan;
    fan.vertices.emplace_back(0, 0, 0);
    const std::uint32_t n = 3000;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        fan.vertices.emplace_back(std::cos(angle), std::sin(angle), 1.0);
        fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
    }
    const Crossings all = crossings_of(fan, 10'000'000);
    EXPECT_FALSE(all.gave_up);
    EXPECT_EQ(all.pairs, 0U);
    EXPECT_TRUE(crossings_of(fan, 100'000).gave_up);
}

}  // namespace
}  // namespace aerogram::planner
