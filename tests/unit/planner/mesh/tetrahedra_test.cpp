#include "planner/mesh/tetrahedra.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <stop_token>

#include "geo/random.hpp"
#include "planner/mesh/mesh_measure.hpp"
#include "solids_by_hand.hpp"

namespace aerogram::planner {
namespace {

using testing::ball;
using testing::box;
using ::testing::HasSubstr;
using testing::inside_out;
using testing::ring;
using testing::together;

using Tetrahedron = std::array<std::uint32_t, 4>;

double volume_of(const Points& v, const Tetrahedron& t) {
    return glm::dot(glm::cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]), v[t[3]] - v[t[0]]) / 6.0;
}

double volume_of(const TetrahedralMesh& mesh) {
    double sum = 0.0;
    for (const auto& t : mesh.tetrahedra) sum += volume_of(mesh.vertices, t);
    return sum;
}

/// Radius of the ball through the corners over the shortest edge.
double radius_edge_ratio(const Points& v, const Tetrahedron& t) {
    const Vec3 a = v[t[1]] - v[t[0]], b = v[t[2]] - v[t[0]], c = v[t[3]] - v[t[0]];
    const Vec3 to_center =
        (glm::dot(a, a) * glm::cross(b, c) + glm::dot(b, b) * glm::cross(c, a) + glm::dot(c, c) * glm::cross(a, b)) /
        (2.0 * glm::dot(a, glm::cross(b, c)));
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) shortest = std::min(shortest, glm::length(v[t[i]] - v[t[j]]));
    return glm::length(to_center) / shortest;
}

/// Vertices - edges + faces - tetrahedra: 1 for a ball, 0 for a ring.
long euler_characteristic(const TetrahedralMesh& mesh) {
    std::set<std::array<std::uint32_t, 3>> faces;
    std::set<std::uint32_t> used;
    for (auto t : mesh.tetrahedra) {
        std::sort(t.begin(), t.end());
        used.insert(t.begin(), t.end());
        for (std::size_t left_out = 0; left_out < 4; ++left_out) {
            std::array<std::uint32_t, 3> face{};
            std::copy_if(t.begin(), t.end(), face.begin(), [&](std::uint32_t v) { return v != t[left_out]; });
            faces.insert(face);
        }
    }
    return static_cast<long>(used.size()) - static_cast<long>(mesh.edges.size()) + static_cast<long>(faces.size()) -
           static_cast<long>(mesh.tetrahedra.size());
}

void expect_edges_of_tetrahedra(const TetrahedralMesh& mesh) {
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const auto& t : mesh.tetrahedra)
        for (const std::uint32_t a : t)
            for (const std::uint32_t b : t)
                if (a < b) edges.insert({a, b});
    EXPECT_EQ(mesh.edges, std::vector(edges.begin(), edges.end()));
}

std::string refusal(const TriangleMesh& surface, double most_volume = 1.0) {
    const auto mesh = tetrahedralise(surface, most_volume, aerogram::Run{});
    EXPECT_FALSE(mesh.ok());
    if (mesh) return {};
    EXPECT_EQ(mesh.error().code, ErrorCode::invalid_input);
    return mesh.error().message;
}

struct Solid {
    const char* name;
    TriangleMesh surface;
    double most_volume;
    long euler;
};

std::vector<Solid> solids() {
    TriangleMesh far_away = ball({1e5, -2e5, 300.0}, 20.0, 3);
    TriangleMesh tiny = box({0, 0, 0}, {1e-4, 2e-4, 1e-4});
    return {{"cube", box({0, 0, 0}, {1, 1, 1}), 0.01, 1},
            {"long box", box({-50, 0, 0}, {50, 1, 2}), 0.5, 1},
            {"ball", ball({0, 0, 0}, 2.0, 3), 0.05, 1},
            {"ball far away", std::move(far_away), 100.0, 1},
            {"tiny box", std::move(tiny), 1e-13, 1},
            {"ring", ring(3.0, 1.0, 24, 12), 0.2, 0},
            {"two balls", together(ball({0, 0, 0}, 1.0, 2), ball({5, 0, 0}, 1.0, 2)), 0.1, 2},
            {"hollow ball", together(ball({0, 0, 0}, 2.0, 3), inside_out(ball({0, 0, 0}, 1.0, 2))), 0.2, 2},
            {"ball in a ball", together(ball({0, 0, 0}, 2.0, 3), ball({0, 0, 0}, 1.0, 2)), 0.2, 1},
            {"inwards", inside_out(box({0, 0, 0}, {1, 2, 3})), 0.1, 1}};
}

TEST(Tetrahedralise, FillsExactlyWhatTheSurfaceEncloses) {
    for (const Solid& solid : solids()) {
        SCOPED_TRACE(solid.name);
        const auto mesh = tetrahedralise(solid.surface, solid.most_volume, aerogram::Run{});
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        // A ball in a ball: the space inside both counts once in the tetrahedra.
        const double expected = std::string_view(solid.name) == "ball in a ball"
                                    ? enclosed_volume(ball({0, 0, 0}, 2.0, 3))
                                    : std::abs(enclosed_volume(solid.surface));
        EXPECT_NEAR(volume_of(*mesh), expected, 1e-9 * expected);
        EXPECT_EQ(euler_characteristic(*mesh), solid.euler);
        expect_edges_of_tetrahedra(*mesh);
        for (const Vec3& v : solid.surface.vertices)
            EXPECT_NE(std::find(mesh->vertices.begin(), mesh->vertices.end(), v), mesh->vertices.end());
    }
}

TEST(Tetrahedralise, KeepsItsShapeAndSizeBounds) {
    for (const Solid& solid : solids()) {
        SCOPED_TRACE(solid.name);
        const auto mesh = tetrahedralise(solid.surface, solid.most_volume, aerogram::Run{});
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        double largest = 0.0, well_shaped = 0.0;
        for (const auto& t : mesh->tetrahedra) {
            const double volume = volume_of(mesh->vertices, t);
            EXPECT_GE(volume, 0.0);
            largest = std::max(largest, volume);
            if (radius_edge_ratio(mesh->vertices, t) <= 2.0 + 1e-6) well_shaped += volume;
        }
        // All of them where facets meet at right angles; the needles of the ring's surface cost some at the skin.
        const bool all = std::string_view(solid.name).find("ring") == std::string_view::npos;
        EXPECT_GE(well_shaped, (all ? 0.99 : 0.9) * volume_of(*mesh));
        EXPECT_LE(largest, solid.most_volume * (1.0 + 1e-9));
    }
}

TEST(Tetrahedralise, IsDeterministic) {
    const TriangleMesh surface = ring(3.0, 1.0, 24, 12);
    const auto one = tetrahedralise(surface, 0.1, aerogram::Run{}), two = tetrahedralise(surface, 0.1, aerogram::Run{});
    ASSERT_TRUE(one.ok() && two.ok());
    EXPECT_EQ(one->vertices, two->vertices);
    EXPECT_EQ(one->tetrahedra, two->tetrahedra);
}

TEST(Tetrahedralise, FlatSurfaceIsRefused) {
    TriangleMesh flat;
    flat.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    flat.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 2, 1}, {1, 2, 3}};
    EXPECT_THAT(refusal(flat), HasSubstr("the surface"));
    EXPECT_THAT(refusal(box({0, 0, 0}, {1, 1, 1e-13})), HasSubstr("the surface"));
}

TEST(Tetrahedralise, OpenSurfaceIsRefused) {
    TriangleMesh open = box({0, 0, 0}, {1, 1, 1});
    open.triangles.pop_back();
    EXPECT_THAT(refusal(open), HasSubstr("the surface is open: 3 edges without a second triangle, the first from ("));
}

TEST(Tetrahedralise, CoordinatesThatAreNotFiniteAreRefused) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
        TriangleMesh surface = box({0, 0, 0}, {1, 1, 1});
        surface.vertices[3].y = bad;
        EXPECT_THAT(refusal(surface), HasSubstr("not finite"));
    }
}

TEST(Tetrahedralise, VerticesAtTheSamePlaceAreRefused) {
    TriangleMesh surface = together(box({0, 0, 0}, {1, 1, 1}), box({1.00000001, 0, 0}, {2, 1, 1}));
    EXPECT_THAT(refusal(surface), HasSubstr("two vertices are at the same place"));
}

TEST(Tetrahedralise, SurfaceThroughItselfIsRefused) {
    EXPECT_THAT(refusal(together(box({0, 0, 0}, {1, 1, 1}), box({0.5, 0.5, 0.5}, {2, 2, 2}))),
                HasSubstr("passes through itself"));
}

TEST(Tetrahedralise, EmptySurfaceIsRefused) {
    EXPECT_THAT(refusal({}), HasSubstr("has no triangle"));
}

TEST(Tetrahedralise, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    aerogram::Run run;
    run.stop = source.get_token();
    EXPECT_EQ(tetrahedralise(box({0, 0, 0}, {1, 1, 1}), 1.0, run).error().code, ErrorCode::stopped);
}

// TetGen joins facets that it takes for one plane; its own idea of that (179.9 degrees) would lose what is bent here.
TEST(Tetrahedralise, FacetsAlmostInOnePlaneKeepTheirBend) {
    TriangleMesh surface = box({0, 0, 0}, {1, 1, 1});
    surface.triangles.erase(surface.triangles.begin() + 2, surface.triangles.begin() + 4);  // the top
    surface.vertices.emplace_back(0.5, 0.5, 1.0003);
    for (const auto& [a, b] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{{4, 5}, {5, 7}, {7, 6}, {6, 4}})
        surface.triangles.push_back({a, b, 8});
    const auto mesh = tetrahedralise(surface, 0.01, aerogram::Run{});
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    EXPECT_NEAR(enclosed_volume(surface), 1.0001, 1e-12);
    EXPECT_NEAR(volume_of(*mesh), 1.0001, 1e-9);
}

TEST(Tetrahedralise, LargeSurface) {
    const TriangleMesh surface = ball({0, 0, 0}, 1.0, 5);
    ASSERT_EQ(surface.triangles.size(), 8'192U);
    const auto mesh = tetrahedralise(surface, 1.0, aerogram::Run{});
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    EXPECT_NEAR(volume_of(*mesh), enclosed_volume(surface), 1e-9);
}

// A hundred thousand and more triangles of which one pair crosses, found before TetGen sees them.
TEST(Tetrahedralise, LargeSurfaceThroughItself) {
    TriangleMesh surface = ball({0, 0, 0}, 1.0, 7);
    ASSERT_EQ(surface.triangles.size(), 131'072U);
    surface.vertices[12'345] *= -1.5;
    EXPECT_THAT(refusal(surface), HasSubstr("passes through itself"));
}

}  // namespace
}  // namespace aerogram::planner
