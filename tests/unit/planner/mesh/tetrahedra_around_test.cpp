#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/random.hpp"
#include "planner/mesh/mesh_measure.hpp"
#include "planner/mesh/tetrahedra.hpp"
#include "solids_by_hand.hpp"

namespace aerogram::planner {
namespace {

using testing::ball;
using testing::box;
using ::testing::HasSubstr;
using testing::ring;

double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

/// The open segment passes through the open triangle.
bool crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double tiny = 1e-9;
    const double from = six_volumes(a, b, c, p), to = six_volumes(a, b, c, q);
    if (from * to >= 0.0 || std::abs(from) < tiny || std::abs(to) < tiny) return false;
    const double ab = six_volumes(p, q, a, b), bc = six_volumes(p, q, b, c), ca = six_volumes(p, q, c, a);
    return (ab > tiny && bc > tiny && ca > tiny) || (ab < -tiny && bc < -tiny && ca < -tiny);
}

std::size_t edges_through(const TetrahedralMesh& mesh, const std::vector<TriangleMesh>& walls) {
    std::size_t through = 0;
    for (const auto& [i, j] : mesh.edges)
        for (const TriangleMesh& wall : walls)
            for (const auto& [a, b, c] : wall.triangles)
                if (crosses(mesh.vertices[i], mesh.vertices[j], wall.vertices[a], wall.vertices[b], wall.vertices[c]))
                    ++through;
    return through;
}

double volume_of(const TetrahedralMesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c, d] : mesh.tetrahedra)
        sum += six_volumes(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], mesh.vertices[d]) / 6.0;
    return sum;
}

/// Corners of a box of 20 by 20 by 20, and random places in it that `free` likes.
template <class Free>
Points scattered(std::size_t count, std::uint64_t seed, const Free& free) {
    Points points = box({-10, -10, -10}, {10, 10, 10}).vertices;
    Random random(seed);
    while (points.size() < count) {
        const Vec3 p{random.between(-10, 10), random.between(-10, 10), random.between(-10, 10)};
        if (free(p)) points.push_back(p);
    }
    return points;
}

TEST(TetrahedraAround, NoEdgePassesThroughAWall) {
    const std::vector<TriangleMesh> walls{ball({4, 4, 0}, 3.0, 2), box({-8, -1, -8}, {-1, 0, 8}),
                                          box({3, -7, -4}, {5, -5, 4})};
    const auto free = [](const Vec3& p) {
        const bool in_ball = glm::length(p - Vec3{4, 4, 0}) < 3.1;
        const bool in_plate = p.x > -8.1 && p.x < -0.9 && p.y > -1.1 && p.y < 0.1 && std::abs(p.z) < 8.1;
        const bool in_post = p.x > 2.9 && p.x < 5.1 && p.y > -7.1 && p.y < -4.9 && std::abs(p.z) < 4.1;
        return !in_ball && !in_plate && !in_post;
    };
    std::size_t without = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        const Points points = scattered(20 + 40 * seed, seed, free);
        const auto mesh = tetrahedralise_around(points, walls, aerogram::Run{});
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        ASSERT_GE(mesh->vertices.size(), points.size());
        EXPECT_TRUE(std::equal(points.begin(), points.end(), mesh->vertices.begin()));
        EXPECT_EQ(edges_through(*mesh, walls), 0U);
        EXPECT_NEAR(volume_of(*mesh), 8000.0, 1e-6);
        const auto plain = tetrahedralise_around(points, {}, aerogram::Run{});
        ASSERT_TRUE(plain.ok());
        without += edges_through(*plain, walls);
    }
    EXPECT_GT(without, 1000U);  // there was something to keep off
}

TEST(TetrahedraAround, WithoutWallsItIsDelaunay) {
    const Points points = scattered(80, 7, [](const Vec3&) { return true; });
    const auto mesh = tetrahedralise_around(points, {}, aerogram::Run{});
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    EXPECT_EQ(mesh->vertices, points);
    for (const auto& t : mesh->tetrahedra) {
        const Vec3 a = points[t[1]] - points[t[0]], b = points[t[2]] - points[t[0]], c = points[t[3]] - points[t[0]];
        const Vec3 center = points[t[0]] + (glm::dot(a, a) * glm::cross(b, c) + glm::dot(b, b) * glm::cross(c, a) +
                                            glm::dot(c, c) * glm::cross(a, b)) /
                                               (2.0 * glm::dot(a, glm::cross(b, c)));
        const double radius = glm::length(points[t[0]] - center);
        for (const Vec3& p : points) EXPECT_GE(glm::length(p - center), radius * (1.0 - 1e-9));
    }
}

TEST(TetrahedraAround, IsDeterministic) {
    const std::vector<TriangleMesh> walls{ring(5.0, 1.0, 24, 12)};
    const Points points =
        scattered(300, 3, [](const Vec3& p) { return std::hypot(std::hypot(p.x, p.y) - 5.0, p.z) > 1.1; });
    const auto one = tetrahedralise_around(points, walls, aerogram::Run{});
    const auto two = tetrahedralise_around(points, walls, aerogram::Run{});
    ASSERT_TRUE(one.ok() && two.ok()) << one.error().message;
    EXPECT_EQ(one->vertices, two->vertices);
    EXPECT_EQ(one->edges, two->edges);
}

// Exactly even places, where every tetrahedron ties with its neighbours.
TEST(TetrahedraAround, GridsFlatFormationsAndRowsAroundAWall) {
    const std::vector<TriangleMesh> walls{box({-0.5, -0.5, -3.5}, {0.5, 0.5, 3.5})};
    Points grid, flat, row;
    for (int x = -3; x <= 3; ++x)
        for (int y = -3; y <= 3; ++y)
            for (int z = -3; z <= 3; ++z) {
                if (x == 0 && y == 0) continue;
                grid.emplace_back(x, y, z);
                if (y == 0) flat.emplace_back(x, y, z);
                if (y == 0 && z == 0) row.emplace_back(x, y, z);
            }
    for (const Points& points : {grid, flat, row, Points{{-2, 0, 0}, {2, 0, 0}}, Points{{2, 0, 0}}}) {
        const auto mesh = tetrahedralise_around(points, walls, aerogram::Run{});
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        EXPECT_EQ(edges_through(*mesh, walls), 0U);
        EXPECT_TRUE(std::equal(points.begin(), points.end(), mesh->vertices.begin()));
    }
}

std::string refusal(const Points& points, const std::vector<TriangleMesh>& walls) {
    const auto mesh = tetrahedralise_around(points, walls, aerogram::Run{});
    EXPECT_FALSE(mesh.ok());
    if (mesh) return {};
    EXPECT_EQ(mesh.error().code, ErrorCode::invalid_input);
    return mesh.error().message;
}

TEST(TetrahedraAround, WhatTetGenWouldCrashOnIsRefused) {
    const Points corners = box({0, 0, 0}, {1, 1, 1}).vertices;
    EXPECT_THAT(refusal({}, {}), HasSubstr("no points"));
    EXPECT_THAT(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}), HasSubstr("at least 4"));
    EXPECT_THAT(refusal({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {}), HasSubstr("in one plane"));
    EXPECT_THAT(refusal({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}), HasSubstr("in one plane"));
    EXPECT_THAT(refusal({{0, 0, 5}, {1, 0, 5}, {2, 3, 5}, {3, 0, 5}, {4, 4, 5}}, {}), HasSubstr("in one plane"));
    Points doubled = corners;
    doubled.push_back(corners[5] + Vec3{1e-8, 0, 0});
    EXPECT_THAT(refusal(doubled, {}), HasSubstr("at the same place"));
    Points endless = corners;
    endless[3].z = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal(endless, {}), HasSubstr("not finite"));
    TriangleMesh open = box({2, 2, 2}, {3, 3, 3});
    open.triangles.pop_back();
    EXPECT_THAT(refusal(corners, {open}), HasSubstr("a wall is open"));
    EXPECT_THAT(refusal(corners, {box({2, 2, 2}, {3, 3, 3}), box({2.5, 2.5, 2.5}, {4, 4, 4})}),
                HasSubstr("the walls together: passes through itself"));
}

// Places on a wall, against a wall, almost in a plane: a mesh or an error, whatever TetGen makes of them.
TEST(TetrahedraAround, NastyPlacesAreAMeshOrAnError) {
    const std::vector<TriangleMesh> walls{box({-1, -1, -1}, {1, 1, 1})};
    Random random(11);
    std::size_t meshes = 0;
    for (int round = 0; round < 60; ++round) {
        const double off = std::pow(10.0, -1.0 - round / 4);
        Points points;
        for (int i = 0; i < 40; ++i) {
            const double x = random.between(-2, 2), y = random.between(-2, 2);
            switch (round % 3) {
                case 0:
                    points.emplace_back(x, y, 1.0 + off * random.unit());  // above the top or its continuation
                    break;
                case 1:
                    points.emplace_back(std::round(4.0 * x) / 4.0, std::round(4.0 * y) / 4.0 + off * random.unit(),
                                        2.0);
                    break;
                default:
                    points.emplace_back(1.0 + off, y, x);  // against one side
            }
        }
        const auto mesh = tetrahedralise_around(points, walls, aerogram::Run{});
        if (!mesh) {
            EXPECT_EQ(mesh.error().code, ErrorCode::invalid_input);
            EXPECT_FALSE(mesh.error().message.empty());
            continue;
        }
        ++meshes;
        EXPECT_TRUE(std::equal(points.begin(), points.end(), mesh->vertices.begin()));
    }
    EXPECT_GT(meshes, 30U);
}

}  // namespace
}  // namespace aerogram::planner
