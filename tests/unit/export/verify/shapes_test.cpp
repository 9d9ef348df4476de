#include "export/verify/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "export/verify/close_pairs.hpp"
#include "export/verify/judge.hpp"
#include "tests/unit/export/verify/shows.hpp"

namespace aerogram::exporter {
namespace {

using testing::Random;

const geo::Polygon kHook{{0, 0}, {10, 0}, {10, 8}, {6, 8}, {6, 4}, {0, 4}};

/// A star-shaped polygon about the origin, either way round.
geo::Polygon star(Random& random) {
    geo::Polygon outline;
    const std::size_t corners = 3 + random.below(7);
    const double turn = random.below(2) == 0 ? 1.0 : -1.0;
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = turn * 2.0 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(corners);
        outline.push_back(random.in(2.0, 9.0) * Vec2{std::cos(angle), std::sin(angle)});
    }
    return outline;
}

Bezier curve_in(Random& random, double size) {
    Bezier curve;
    curve.degree = random.below(kMaxDegree + 1);
    const Vec3 at = random.in_box({-12, -12, -3}, {12, 12, 12});
    for (std::size_t i = 0; i <= curve.degree; ++i) curve.control[i] = at + random.in_box(Vec3(-size), Vec3(size));
    return curve;
}

TEST(Shapes, MarginsOfAHookAreTheClosedForm) {
    EXPECT_NEAR(inner_margin(kHook, {3, 1}), 1.0, 1e-12);
    EXPECT_NEAR(inner_margin(kHook, {8, 5}), 2.0, 1e-12);
    EXPECT_NEAR(inner_margin(kHook, {3, 6}), -2.0, 1e-12);
    EXPECT_NEAR(inner_margin(kHook, {13, 12}), -5.0, 1e-12);
    EXPECT_NEAR(inner_margin(kHook, {5.5, 4.5}), -0.5, 1e-12);
    EXPECT_NEAR(edge_distance(kHook, {1, 2}, {9, 2}), 1.0, 1e-12);  // its right end is 1 m from x = 10
    EXPECT_EQ(edge_distance(kHook, {3, 2}, {3, 6}), 0.0);
}

TEST(Shapes, AgreeWithTheGeometryThePlannerUses) {
    Random random(3);
    for (int i = 0; i < 3000; ++i) {
        const geo::Polygon outline = star(random);
        const Vec3 p = random.in_box({-12, -12, -3}, {12, 12, 12});
        EXPECT_NEAR(inner_margin(outline, {p.x, p.y}), geo::signed_distance(outline, {p.x, p.y}), 1e-12);
        const geo::Obstacle prism{"", geo::Prism{outline}, 1.0, 6.0};
        const geo::Obstacle cylinder{"", geo::Cylinder{{1, -2}, 4.0}, -1.0, 5.0};
        EXPECT_NEAR(solid_margin(prism, p), geo::clearance(prism, p), 1e-12);
        EXPECT_NEAR(solid_margin(cylinder, p), geo::clearance(cylinder, p), 1e-12);
    }
}

TEST(Shapes, BoundsAreNeverAboveAnyPointOfTheCurve) {
    Random random(4);
    for (int i = 0; i < 2000; ++i) {
        const geo::Polygon outline = star(random);
        const geo::Obstacle prism{"", geo::Prism{outline}, 1.0, 6.0},
            cylinder{"", geo::Cylinder{{1, -2}, 4.0}, -1.0, 5.0};
        const Bezier curve = curve_in(random, random.in(0.0, 4.0));
        for (int k = 0; k <= 60; ++k) {
            const Vec3 p = value(curve, k / 60.0);
            const double inner = inner_margin(outline, {p.x, p.y});
            EXPECT_LE(inner_margin_bound(outline, curve), inner + 1e-9);
            EXPECT_LE(outer_margin_bound(outline, curve), -inner + 1e-9);
            EXPECT_LE(solid_margin_bound(prism, curve), solid_margin(prism, p) + 1e-9);
            EXPECT_LE(solid_margin_bound(cylinder, curve), solid_margin(cylinder, p) + 1e-9);
        }
    }
}

TEST(CloseBoxes, AreThoseOfAllPairs) {
    Random random(9);
    for (int round = 0; round < 20; ++round) {
        std::vector<Box> boxes;
        for (int i = 0; i < 150; ++i) {
            const Vec3 low = random.in_box(Vec3(-30.0), Vec3(30.0));
            const double size = i == 0 ? 40.0 : random.in(0.0, 3.0);
            boxes.push_back({low, low + random.in_box(Vec3(0.0), Vec3(size))});
        }
        const double reach = random.in(0.5, 5.0);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
                if (boxes[i].gap(boxes[j]) < reach) expected.emplace_back(i, j);
            }
        }
        CloseBoxes grid;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
        grid.find(boxes, reach, [&](std::uint32_t i, std::uint32_t j) {
            found.emplace_back(i, j);
            return true;
        });
        std::ranges::sort(found);
        EXPECT_EQ(found, expected);
    }
}

TEST(CloseBoxes, NextToNothingIsSearchedInFewCells) {
    CloseBoxes grid;
    const std::vector<Box> boxes{{Vec3(0, 1e8, 30), Vec3(0, 1e8, 30)},
                                 {Vec3(1e-20, 1e8, 30), Vec3(40, 1e8, 30)},
                                 {Vec3(-1e8, 0, 0), Vec3(1e8, 0, 0)}};
    std::size_t visits = 0;
    grid.find(boxes, 1e-19, [&](std::uint32_t i, std::uint32_t j) {
        EXPECT_EQ(i, 0U);
        EXPECT_EQ(j, 1U);
        ++visits;
        return true;
    });
    EXPECT_EQ(visits, 1U);
}

TEST(CloseBoxes, VisitorEndsTheSearch) {
    CloseBoxes grid;
    std::size_t visits = 0;
    grid.find(std::vector<Box>(10, Box{Vec3(1.0), Vec3(2.0)}), 1.0,
              [&](std::uint32_t, std::uint32_t) { return ++visits < 3; });
    EXPECT_EQ(visits, 3U);
}

/// A fleet of one on random curves, sampled densely: what judge finds is never milder and never much worse.
TEST(JudgeOracle, FindsTheWorstOfDenseSamples) {
    constexpr int kSamples = 4000;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        RecordedDrone drone;
        Vec3 at{0, 0, 10};
        for (int k = 0; k < 5; ++k) {
            const std::size_t degree = random.below(kMaxDegree + 1);
            std::vector<Vec3> controls{at};
            for (std::size_t i = 0; i < degree; ++i) controls.push_back(at + random.in_box(Vec3(-4.0), Vec3(4.0)));
            at = controls.back();
            testing::add_piece(drone, random.in(0.5, 3.0), controls);
        }
        drone.home_m = Vec3{0, 0, 0};
        RecordedShow show = testing::show_of({drone});
        geo::Airspace air{star(random), {}, {{"", geo::Prism{star(random)}, 5.0, 6.0}}};
        const JudgeAgainst against{
            .limits = {}, .airspace = air, .origin = {}, .endurance_s = {}, .claimed_separation_m = {}};
        const Judgement found = judge(show, against, aerogram::Run{}).value();

        double across = 0, up = 0, acceleration = 0, high = -1e9, fence = 1e9, obstacle = 1e9;
        for (const Piece& piece : drone.pieces) {
            const Bezier curve = curve_of(drone, piece), speed = derivative(curve), change = derivative(speed);
            for (int k = 0; k <= kSamples; ++k) {
                const double u = static_cast<double>(k) / kSamples;
                const Vec3 p = value(curve, u), v = value(speed, u) / piece.duration_s;
                across = std::max(across, std::hypot(v.x, v.y));
                up = std::max(up, v.z);
                acceleration =
                    std::max(acceleration, glm::length(value(change, u)) / (piece.duration_s * piece.duration_s));
                high = std::max(high, p.z);
                fence = std::min(fence, geo::signed_distance(air.geofence_m, {p.x, p.y}));
                obstacle = std::min(obstacle, geo::clearance(air.obstacles[0], p));
            }
        }
        for (const Finding& finding : found.findings) {
            const auto largest = [&](double sampled, double slack) {
                EXPECT_GE(finding.worst, sampled - 1e-9) << finding.rule;
                EXPECT_LE(finding.worst, sampled + slack) << finding.rule;
            };
            const auto smallest = [&](double sampled, double slack) {
                EXPECT_LE(finding.worst, sampled + 1e-9) << finding.rule;
                EXPECT_GE(finding.worst, sampled - slack - 0.011 * std::abs(std::min(sampled, 0.0))) << finding.rule;
            };
            if (finding.rule == "speed_horizontal") largest(across, 0.001);
            if (finding.rule == "speed_up") largest(up, 0.001);
            if (finding.rule == "acceleration") largest(acceleration, 0.01);
            if (finding.rule == "altitude_max") largest(high, 0.001);
            if (finding.rule == "geofence") smallest(fence, 0.01);
            if (finding.rule == "obstacles") smallest(obstacle, 0.01);
        }
    }
}

}  // namespace
}  // namespace aerogram::exporter
