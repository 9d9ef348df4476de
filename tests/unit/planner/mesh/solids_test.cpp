#include "planner/mesh/solids.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "geo/random.hpp"
#include "measures.hpp"
#include "planner/mesh/mesh_faults.hpp"
#include "planner/mesh/mesh_measure.hpp"

namespace aerogram::planner {
namespace {

using std::numbers::pi;
using testing::is_closed;
using testing::whole_area;

constexpr double kRound = 4e-4;  ///< how far a facet may be from the true surface, shares of the width

struct Box {
    Vec3 low{1e300}, high{-1e300};
};
Box box_of(const TriangleMesh& mesh) {
    Box box;
    for (const Vec3& p : mesh.vertices) {
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
    }
    return box;
}

/// Closed, faultless, in the box, with the volume and area of the true body, and every facet near its surface.
void expect_body(const TriangleMesh& mesh, const Vec3& size, double volume, double area,
                 const std::function<double(const Vec3&)>& off_surface) {
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_EQ(faults_of(mesh), "");
    const Box box = box_of(mesh);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(box.high[axis] - box.low[axis], size[axis], 1e-12);
        EXPECT_NEAR(box.high[axis] + box.low[axis], 0.0, 1e-12);
    }
    EXPECT_NEAR(enclosed_volume(mesh) / volume, 1.0, 2e-3);
    EXPECT_NEAR(whole_area(mesh) / area, 1.0, 1e-3);
    for (const auto& [a, b, c] : mesh.triangles) {
        EXPECT_LT(std::abs(off_surface((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0)), kRound);
    }
}

double across(const Vec3& p) {
    return std::hypot(p.x, p.y);
}

TEST(Solids, CubeIsClosedAndOutward) {
    const auto off = [](const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - 0.5; };
    expect_body(cube_mesh(), Vec3(1.0), 1.0, 6.0, off);
}

TEST(Solids, SphereIsClosedOutwardAndRound) {
    expect_body(sphere_mesh(), Vec3(1.0), pi / 6.0, pi, [](const Vec3& p) { return glm::length(p) - 0.5; });
}

TEST(Solids, DomeWithItsFloorIsClosedOutwardAndRound) {
    const auto off = [](const Vec3& p) {
        return std::min(std::abs(glm::length(p + Vec3(0, 0, 0.25)) - 0.5), std::abs(p.z + 0.25));
    };
    expect_body(dome_mesh(true), {1, 1, 0.5}, pi / 12.0, 0.75 * pi, off);
}

TEST(Solids, DomeWithoutFloorIsOpenAtItsRimOnly) {
    const TriangleMesh dome = dome_mesh(false);
    EXPECT_FALSE(is_closed(dome));
    EXPECT_NEAR(whole_area(dome), 0.5 * pi, 1e-3);
}

TEST(Solids, CylinderIsClosedOutwardAndRound) {
    const auto off = [](const Vec3& p) { return std::min(std::abs(across(p) - 0.5), std::abs(std::abs(p.z) - 0.5)); };
    expect_body(cylinder_mesh(), Vec3(1.0), pi / 4.0, 1.5 * pi, off);
}

TEST(Solids, ConeIsClosedOutwardAndRound) {
    const auto off = [](const Vec3& p) {
        return std::min(std::abs(across(p) - 0.5 * (0.5 - p.z)), std::abs(p.z + 0.5));
    };
    expect_body(cone_mesh(), Vec3(1.0), pi / 12.0, 0.25 * pi * (1.0 + std::sqrt(5.0)), off);
}

TEST(Solids, TorusIsClosedOutwardAndRound) {
    for (const double tube : {0.1, 0.3, 0.45}) {
        const double r = 0.5 * tube, around = 0.5 - r;
        const auto off = [&](const Vec3& p) { return std::hypot(across(p) - around, p.z) - r; };
        expect_body(torus_mesh(tube), {1, 1, tube}, 2.0 * pi * pi * around * r * r, 4.0 * pi * pi * around * r, off);
    }
}

Contour rectangle(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}
Contour reversed(Contour contour) {
    std::reverse(contour.begin(), contour.end());
    return contour;
}

TEST(Extruded, ASquareIsABox) {
    const TriangleMesh mesh = extruded({{rectangle(2, 3, 4, 7)}}, 0.5);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_EQ(faults_of(mesh), "");
    EXPECT_EQ(mesh.vertices.size(), 8U);
    EXPECT_NEAR(enclosed_volume(mesh), 2 * 4 * 0.5, 1e-12);
    EXPECT_EQ(box_of(mesh).low, Vec3(2, -0.25, 3));
    EXPECT_EQ(box_of(mesh).high, Vec3(4, 0.25, 7));
}

TEST(Extruded, HolesRunThroughAndIslandsStandInThem) {
    const Region region{{rectangle(0, 0, 6, 6), reversed(rectangle(1, 1, 5, 5)), rectangle(2, 2, 4, 4)}};
    const TriangleMesh mesh = extruded(region, 2.0);
    EXPECT_EQ(faults_of(mesh), "");
    EXPECT_NEAR(enclosed_volume(mesh), (36 - 16 + 4) * 2.0, 1e-9);
}

TEST(Extruded, ContoursThatCrossBecomeOneBody) {
    const TriangleMesh cross = extruded({{rectangle(0, 1, 3, 2), rectangle(1, 0, 2, 3)}}, 1.0);
    EXPECT_EQ(faults_of(cross), "");
    EXPECT_NEAR(enclosed_volume(cross), 5.0, 1e-9);
    EXPECT_NEAR(whole_area(cross), 2 * 5.0 + 12.0, 1e-9);  // no walls inside
}

TEST(Extruded, ContoursThatShareAnEdgeOrLieOnEachOtherBecomeOneBody) {
    const TriangleMesh side = extruded({{rectangle(0, 0, 1, 1), rectangle(1, 0, 2, 1)}}, 1.0);
    EXPECT_EQ(faults_of(side), "");
    EXPECT_NEAR(whole_area(side), 2 * 2.0 + 6.0, 1e-9);
    const TriangleMesh twice = extruded({{rectangle(0, 0, 1, 1), rectangle(0, 0, 1, 1)}}, 1.0);
    EXPECT_EQ(faults_of(twice), "");
    EXPECT_NEAR(enclosed_volume(twice), 1.0, 1e-12);
}

TEST(Extruded, AContourThatCrossesItselfIsFilledWhereItWinds) {
    const Contour eight{{0, 0}, {2, 2}, {2, 0}, {0, 2}};  // winds once one way and once the other: both count
    const TriangleMesh mesh = extruded({{eight}}, 1.0);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(enclosed_volume(mesh), 2.0, 1e-9);
}

TEST(Extruded, DoubledPointsSpikesAndEmptyContoursAreBorne) {
    const Contour spiked{{0, 0}, {1, 0}, {1, 0}, {3, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}};
    const TriangleMesh mesh = extruded({{spiked, {}, {{5, 5}}, {{6, 6}, {7, 7}}}}, 1.0);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(enclosed_volume(mesh), 1.0, 1e-12);
}

/// Winding number of p by angles.
int winding(const Region& region, const Vec2& p) {
    double turn = 0.0;
    for (const Contour& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 a = contour[i] - p, b = contour[(i + 1) % contour.size()] - p;
            turn += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
        }
    }
    return static_cast<int>(std::lround(turn / (2.0 * pi)));
}

TEST(Extruded, RandomTanglesAreClosedAndHoldWhatWindsRound) {
    Random random(20);
    for (int tangle = 0; tangle < 40; ++tangle) {
        Region region;
        for (std::uint64_t c = 0; c < 1 + random.below(4); ++c) {
            Contour contour;
            for (std::uint64_t i = 0; i < 3 + random.below(7); ++i)
                contour.emplace_back(random.between(0.0, 1.0), random.between(0.0, 1.0));
            region.contours.push_back(contour);
        }
        const TriangleMesh mesh = extruded(region, 1.0);
        ASSERT_TRUE(is_closed(mesh)) << tangle;
        constexpr int kProbes = 300;
        double inside = 0;
        for (int i = 0; i < kProbes; ++i) {
            for (int j = 0; j < kProbes; ++j)
                inside += winding(region, {(i + 0.5) / kProbes, (j + 0.5) / kProbes}) != 0 ? 1.0 : 0.0;
        }
        EXPECT_NEAR(enclosed_volume(mesh), inside / kProbes / kProbes, 5e-3) << tangle;
    }
}

}  // namespace
}  // namespace aerogram::planner
