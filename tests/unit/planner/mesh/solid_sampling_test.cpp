#include "planner/mesh/solid_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geo/random.hpp"
#include "measures.hpp"
#include "planner/mesh/mesh_measure.hpp"
#include "planner/mesh/nearest_on_mesh.hpp"
#include "planner/mesh/solids.hpp"
#include "planner/sampling/closest_pair.hpp"

namespace aerogram::planner {
namespace {

using testing::distance_to;
using testing::whole_area;

/// The spacing of the hexagonal lattice with as many points on as much area.
double ideal_on(const TriangleMesh& mesh, std::size_t count) {
    return std::sqrt(whole_area(mesh) * 2.0 / std::numbers::sqrt3 / static_cast<double>(count));
}
/// The spacing of the densest packing of as many points in as much space.
double ideal_in(double volume, std::size_t count) {
    return std::cbrt(std::numbers::sqrt2 * volume / static_cast<double>(count));
}
double spacing(const Points& points) {
    return closest_pair(points, {}).distance_m;
}
/// A unit cube as five tetrahedra.
TetrahedralMesh five_tetrahedra() {
    TetrahedralMesh mesh;
    mesh.vertices = cube_mesh().vertices;
    mesh.tetrahedra = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
    return mesh;
}
Region letter() {
    return {{{{0, 0}, {1, 0}, {1, 1.4}, {0, 1.4}}, {{0.3, 0.3}, {0.3, 1.1}, {0.7, 1.1}, {0.7, 0.3}}}};
}

TEST(SampleSurface, CountIsExactAndPointsAreOnTheSurface) {  // properties 1 and 2
    const TriangleMesh bodies[] = {cube_mesh(), cone_mesh(), torus_mesh(0.3), dome_mesh(false),
                                   extruded(letter(), 0.02)};
    for (const TriangleMesh& body : bodies) {
        for (const std::size_t count : {1U, 2U, 3U, 4U, 7U, 8U, 9U, 31U, 100U, 333U}) {
            const Points points = sample_surface(body, count, {}, {});
            ASSERT_EQ(points.size(), count);
            for (std::size_t i = 0; i < count; i += 1 + count / 20) EXPECT_LT(distance_to(points[i], body), 1e-9);
            if (count > 1) {
                EXPECT_GT(spacing(points), 0.3 * ideal_on(body, count)) << count;
            }
        }
    }
}

TEST(SampleSurface, IsDeterministicAndTheSameForAnyNumberOfThreads) {  // property 3
    aerogram::Run many;
    many.threads = 7;
    EXPECT_EQ(sample_surface(torus_mesh(0.3), 500, {}, {}), sample_surface(torus_mesh(0.3), 500, {}, many));
}

TEST(SampleSurface, SpacingIsNearTheLattices) {
    for (const TriangleMesh& body : {cube_mesh(), sphere_mesh(), torus_mesh(0.3), cylinder_mesh(), cone_mesh()}) {
        for (const std::size_t count : {100U, 400U, 1500U})
            EXPECT_GT(spacing(sample_surface(body, count, {}, {})), 0.80 * ideal_on(body, count)) << count;
    }
}

TEST(SampleSurface, TwentyThousandPointsKeepTheSpacing) {
    const TriangleMesh body = torus_mesh(0.4);
    const Points points = sample_surface(body, 20'000, {}, {});
    EXPECT_EQ(points.size(), 20'000U);
    EXPECT_GT(spacing(points), 0.80 * ideal_on(body, 20'000));
}

TEST(SampleSurface, ThePointsOfThinWallsKeepClearOfThoseOnTheOtherSide) {
    const TriangleMesh sheet = extruded(letter(), 1e-3);
    for (const std::size_t count : {60U, 200U, 800U}) {
        // Both sides are one to drones: the lattice of half the area.
        EXPECT_GT(spacing(sample_surface(sheet, count, {}, {})), 0.8 * std::sqrt(0.5) * ideal_on(sheet, count))
            << count;
    }
}

TEST(SampleSurface, CornersAndEdgesOfACubeAreOccupied) {
    const TriangleMesh cube = cube_mesh();
    for (const std::size_t count : {8U, 20U, 100U, 1000U}) {
        const Points points = sample_surface(cube, count, {}, {});
        for (const Vec3& corner : cube.vertices)
            EXPECT_EQ(std::count(points.begin(), points.end(), corner), 1) << count;
    }
    const Points points = sample_surface(cube, 600, {}, {});
    const auto on_front_edge = [](const Vec3& p) { return std::abs(p.y + 0.5) < 1e-12 && std::abs(p.z - 0.5) < 1e-12; };
    const double steps = 1.0 / ideal_on(cube, 600);
    EXPECT_NEAR(static_cast<double>(std::count_if(points.begin(), points.end(), on_front_edge)), steps + 1, 2.0);
}

TEST(SampleSurface, TheTipOfAConeIsOccupied) {
    for (const std::size_t count : {20U, 100U, 1000U}) {
        const Points points = sample_surface(cone_mesh(), count, {}, {});
        EXPECT_EQ(std::count(points.begin(), points.end(), Vec3(0, 0, 0.5)), 1) << count;
    }
}

TEST(SampleSurface, FacetsOfARoundThingAreNotDrawn) {
    TriangleMesh lumpy = sphere_mesh();  // every facet turns by more than 30 degrees against its neighbours
    Random random(3);
    for (Vec3& p : lumpy.vertices) p *= random.between(0.97, 1.03);
    const Points points = sample_surface(lumpy, 400, {}, {});
    EXPECT_GT(spacing(points), 0.6 * std::sqrt(std::numbers::pi * 2.0 / std::numbers::sqrt3 / 400.0));
}

TEST(SampleSurface, TwiceAsDenseGivesTwiceAsMany) {  // property 4
    for (const double times : {2.0, 5.0}) {
        const auto density = [&](const Vec3& p) { return p.x > 0.0 ? times : 1.0; };
        for (const TriangleMesh& body : {cube_mesh(), torus_mesh(0.3)}) {
            const Points points = sample_surface(body, 2000, density, {});
            const auto right = std::count_if(points.begin(), points.end(), [](const Vec3& p) { return p.x > 0.0; });
            EXPECT_NEAR(static_cast<double>(right) / 2000.0, times / (times + 1.0), 0.02);
        }
    }
}

TEST(SampleSurface, NobodyGoesWhereTheDensityIsZero) {
    const auto density = [](const Vec3& p) { return p.z > 0.1 ? 1.0 : 0.0; };
    for (const Vec3& p : sample_surface(sphere_mesh(), 500, density, {})) EXPECT_GT(p.z, 0.1 - 0.01);
    EXPECT_EQ(sample_surface(sphere_mesh(), 50, [](const Vec3&) { return 0.0; }, {}).size(), 50U);
}

TEST(SampleSurface, NeedlesAndStretchedBodiesAreBorne) {
    TriangleMesh needle;
    needle.vertices = {{0, 0, 0}, {100, 0, 0}, {100, 1e-6, 0}, {0, 1e-6, 0}};
    needle.triangles = {{0, 1, 2}, {0, 2, 3}};
    const Points points = sample_surface(needle, 50, {}, {});
    EXPECT_EQ(points.size(), 50U);
    EXPECT_GT(spacing(points), 1.0);  // equal steps would be 2
}

TEST(SampleVolume, CountIsExactAndPointsAreInside) {
    const TetrahedralMesh cube = five_tetrahedra();
    for (const std::size_t count : {1U, 2U, 5U, 8U, 9U, 27U, 100U, 1000U, 3000U}) {
        const Points points = sample_volume(cube, count, {}, {});
        ASSERT_EQ(points.size(), count);
        for (const Vec3& p : points) EXPECT_LE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 0.5 + 1e-9);
        if (count > 1) {
            EXPECT_GT(spacing(points), 0.75 * ideal_in(1.0, count)) << count;
        }
    }
    EXPECT_LT(glm::length(sample_volume(cube, 1, {}, {}).front()), 1e-3);
}

TEST(SampleVolume, IsDeterministic) {
    EXPECT_EQ(sample_volume(five_tetrahedra(), 300, {}, {}), sample_volume(five_tetrahedra(), 300, {}, {}));
}

TEST(SampleVolume, TheSkinIsOccupied) {
    const Points points = sample_volume(five_tetrahedra(), 1000, {}, {});
    const auto on_skin = std::count_if(points.begin(), points.end(), [](const Vec3& p) {
        return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 0.5 - 1e-9;
    });
    // Six faces of a lattice of about ten points a side.
    EXPECT_GT(on_skin, 400);
    EXPECT_LT(on_skin, 650);
}

TEST(SampleVolume, TwiceAsDenseGivesTwiceAsMany) {
    const auto density = [](const Vec3& p) { return p.x > 0.0 ? 3.0 : 1.0; };
    const Points points = sample_volume(five_tetrahedra(), 4000, density, {});
    const auto inner = [](const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 0.44; };
    double right = 0, all = 0;
    for (const Vec3& p : points) {
        if (!inner(p)) continue;
        all += 1;
        right += p.x > 0.0 ? 1 : 0;
    }
    EXPECT_NEAR(right / all, 0.75, 0.03);
}

TEST(SampleEdges, ACubesCornersComeFirstThenEqualSteps) {
    const TriangleMesh cube = cube_mesh();
    const Points points = sample_edges(cube, 8 + 12 * 3);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_NE(std::find(points.begin(), points.begin() + 8, cube.vertices[i]), points.begin() + 8);
    EXPECT_NEAR(spacing(points), 0.25, 1e-12);
    for (const Vec3& p : points) {
        const auto on_side = [](double v) { return std::abs(std::abs(v) - 0.5) < 1e-12 ? 1 : 0; };
        EXPECT_GE(on_side(p.x) + on_side(p.y) + on_side(p.z), 2);
    }
}

TEST(SampleEdges, CountIsExactForAnyNumber) {
    for (const TriangleMesh& body : {cube_mesh(), cylinder_mesh(), cone_mesh(), extruded(letter(), 0.1)}) {
        for (const std::size_t count : {1U, 2U, 3U, 7U, 8U, 9U, 50U, 1000U})
            EXPECT_EQ(sample_edges(body, count).size(), count);
    }
}

TEST(SampleEdges, FewerPointsThanCornersTakeThoseFarApart) {
    const Points points = sample_edges(cube_mesh(), 2);
    EXPECT_NEAR(glm::distance(points[0], points[1]), std::sqrt(3.0), 1e-12);
}

TEST(SampleEdges, BothRimsOfACylinderAreDividedEqually) {
    const Points points = sample_edges(cylinder_mesh(), 40);
    EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const Vec3& p) { return p.z > 0.4999; }), 20);
    EXPECT_NEAR(spacing(points), std::sin(std::numbers::pi / 20), 1e-3);
}

TEST(SampleEdges, EdgesNearToEachOtherAreDrawnAlternately) {
    const Points points = sample_edges(extruded({{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}, 0.02), 80);
    EXPECT_GT(spacing(points), 0.02);  // face to face they would be exactly that
}

TEST(HasSharpEdges, RoundBodiesHaveNone) {
    EXPECT_FALSE(has_sharp_edges(sphere_mesh()));
    EXPECT_FALSE(has_sharp_edges(torus_mesh(0.3)));
    EXPECT_TRUE(has_sharp_edges(dome_mesh(false)));  // its rim
    EXPECT_TRUE(has_sharp_edges(cube_mesh()));
}

TEST(MeanDistance, IsTheIntegralsOfOnePoint) {
    TriangleMesh square;
    square.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    const double in_square = (std::numbers::sqrt2 + std::asinh(1.0)) / 6.0;  // mean distance from the middle
    EXPECT_NEAR(mean_distance(square, {{0.5, 0.5, 0.0}}), in_square, 1e-4);
    EXPECT_NEAR(mean_distance(five_tetrahedra(), {{0.0, 0.0, 0.0}}), 0.4802959782,
                1e-3);  // MathWorld, cube point picking
    EXPECT_NEAR(mean_distance(sphere_mesh(), {{0.0, 0.0, 0.0}}), 0.5, 3e-4);
    const auto right = [](const Vec3& p) { return p.x > 0.5 ? 1.0 : 0.0; };
    EXPECT_NEAR(mean_distance(square, {{0.5, 0.5, 0.0}}, right), in_square, 1e-3);
}

TEST(MeanDistance, SampledPointsCoverBetterThanRandomOnes) {
    const TriangleMesh body = torus_mesh(0.3);
    Random random(5);
    Points thrown;
    for (int i = 0; i < 300; ++i) {
        const double u = random.between(0, 2 * std::numbers::pi), v = random.between(0, 2 * std::numbers::pi);
        const double r = 0.35 + 0.15 * std::cos(v);
        thrown.emplace_back(r * std::cos(u), r * std::sin(u), 0.15 * std::sin(v));
    }
    EXPECT_LT(mean_distance(body, sample_surface(body, 300, {}, {})), 0.8 * mean_distance(body, thrown));
}

TEST(NearestOnMesh, AgreesWithAllTriangles) {
    const TriangleMesh body = extruded(letter(), 0.2);
    const NearestOnMesh search(body);
    Random random(9);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p(random.between(-1, 2), random.between(-1, 1), random.between(-1, 2));
        EXPECT_NEAR(glm::distance(p, position_of(search.nearest(p), body)), distance_to(p, body), 1e-12);
    }
}

TEST(NearestOnMesh, ColoursAreThoseBetweenTheCorners) {
    TriangleMesh triangle;
    triangle.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    triangle.colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Rgb middle = color_of(NearestOnMesh(triangle).nearest({0.25, 0.25, 3.0}), triangle);
    EXPECT_NEAR(middle.r, 0.5, 1e-12);
    EXPECT_NEAR(middle.g, 0.25, 1e-12);
    EXPECT_NEAR(middle.b, 0.25, 1e-12);
}

/// missions/mesh.toml: white corners by shares that add up to 1 + 2e-16 made a lamp brighter than lamps are.
TEST(NearestOnMesh, ColoursOfWhiteCornersAreNeverBrighterThanWhite) {
    TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0.3, 0.9, 0.1}}, {{0, 1, 2}}, std::vector<Rgb>(3, Rgb{1, 1, 1})};
    const NearestOnMesh nearest(triangle);
    Random random(4);
    for (int i = 0; i < 2000; ++i) {
        const Rgb c =
            color_of(nearest.nearest({random.between(-1, 2), random.between(-1, 2), random.between(-1, 1)}), triangle);
        EXPECT_TRUE(c.r <= 1.0 && c.g <= 1.0 && c.b <= 1.0);
        EXPECT_GT(c.r, 1.0 - 1e-12);
    }
}

}  // namespace
}  // namespace aerogram::planner
