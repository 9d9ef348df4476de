#include "planner/sketch/sketched_formation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "planner/sampling/push_apart.hpp"
#include "tests/unit/planner/sketch/strokes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

TEST(SketchedFormation, Property1To3_EverybodyHasAPlaceOfTheSketch) {
    for (const NamedSketch& named : sketches()) {
        const Sketch sketch = make_sketch(named.strokes).value();
        for (const std::size_t n : {1U, 2U, 3U, 4U, 6U, 10U, 17U, 60U, 100U, 333U}) {
            const SketchedFormation formed = form(sketch, scattered(n, n));
            ASSERT_EQ(formed.targets.size(), n);
            std::set<std::uint32_t> taken(formed.candidate_of.begin(), formed.candidate_of.end());
            EXPECT_EQ(taken.size(), n) << named.name;
            for (std::uint32_t p = 0; p < formed.candidates.boundary; ++p)
                EXPECT_TRUE(taken.contains(p)) << named.name << ' ' << n;
            EXPECT_EQ(std::set<std::size_t>(formed.place.begin(), formed.place.end()).size(), n);
            for (std::size_t a = 0; a < n; ++a) {
                EXPECT_LT(formed.place[a], n);
                EXPECT_EQ(formed.on_boundary[a], formed.place[a] < formed.candidates.boundary);
                if (formed.on_boundary[a]) {
                    EXPECT_LT(distance_to(sketch.paths, formed.targets[a]), 1e-9) << named.name;
                } else {
                    EXPECT_TRUE(sketch.region.contains(formed.targets[a])) << named.name;
                }
            }
        }
    }
}

TEST(SketchedFormation, NeighboursAreAboutAUnitApart) {
    for (const NamedSketch& named : sketches()) {
        const Sketch sketch = make_sketch(named.strokes).value();
        for (const std::size_t n : {40U, 100U, 400U}) {
            const SketchedFormation formed = form(sketch, scattered(n, 9));
            EXPECT_GT(smallest_distance(formed.targets), 0.5 * formed.candidates.unit) << named.name << ' ' << n;
        }
    }
}

TEST(SketchedFormation, Property4_WhereAndHowLargeTheGroupIsDoesNotMatter) {
    const Sketch sketch = make_sketch({circle({0, 0}, 10), circle({0, 0}, 5, true)}).value();
    const auto agents = scattered(100, 3);
    auto moved = agents;
    for (Vec2& p : moved) p = 8.0 * p + Vec2(1024, -64);
    EXPECT_EQ(form(sketch, agents).candidate_of, form(sketch, moved).candidate_of);
}

TEST(SketchedFormation, AgentsKeepTheirSideOfTheFormation) {
    const Sketch sketch = make_sketch({circle({100, 0}, 10)}).value();
    const auto agents = scattered(100, 4);
    const SketchedFormation formed = form(sketch, agents);
    Vec2 center{};
    for (const Vec2& p : agents) center += p / 100.0;
    std::size_t kept = 0;
    for (std::size_t a = 0; a < agents.size(); ++a)
        kept += (agents[a].x < center.x) == (formed.targets[a].x < 100.0) ? 1U : 0U;
    EXPECT_GE(kept, 85U);
}

TEST(SketchedFormation, AGroupThatFacesElsewhereTakesItsPlacesTurned) {
    const Sketch sketch = make_sketch({circle({0, 0}, 10)}).value();
    const auto agents = scattered(80, 5);
    auto turned = agents;
    for (Vec2& p : turned) p = {-p.y, p.x};
    SketchOptions facing;
    facing.agents_reference_rad = kPi / 2.0;
    const auto a = form(sketch, agents), b = form(sketch, turned, facing);
    std::size_t same = 0;
    for (std::size_t i = 0; i < 80; ++i) same += a.candidate_of[i] == b.candidate_of[i] ? 1U : 0U;
    EXPECT_GE(same, 78U);  // but for ties that rounding breaks
}

TEST(SketchedFormation, TheBrushMakesAPartDenser) {
    const Sketch sketch = make_sketch({box({0, 0}, {40, 20})}).value();
    SketchOptions options;
    options.sampling.density = [](const Vec2& p) { return p.x < 20.0 ? 1.0 : 3.0; };
    const SketchedFormation formed = form(sketch, scattered(600, 6), options);
    double left = 0.0, right = 0.0;
    for (std::size_t a = 0; a < 600; ++a)
        if (!formed.on_boundary[a]) ++(formed.targets[a].x < 20.0 ? left : right);
    EXPECT_NEAR(right / left, 3.0, 0.6);
}

TEST(SketchedFormation, Property5_SameInputSameResult) {
    const Sketch sketch = make_sketch(sketches()[5].strokes).value();
    const auto agents = scattered(150, 7);
    EXPECT_EQ(form(sketch, agents).targets, form(sketch, agents).targets);
}

TEST(SketchedFormation, DrawingsWithoutAPlaceForAnybodyAreRefused) {
    const auto message = [](const std::vector<SketchStroke>& strokes) { return make_sketch(strokes).error().message; };
    EXPECT_EQ(message({}), "has no line that drones could stand on: needs one that is not exclusive");
    EXPECT_EQ(message({circle({0, 0}, 3, true)}),
              "has no line that drones could stand on: needs one that is not exclusive");
    EXPECT_EQ(message({circle({0, 0}, 3), circle({0, 0}, 4, true)}),
              "encloses nothing: its exclusive lines take everything away");
    EXPECT_EQ(message({{{{1, 1}, {1, 1}}, false, false}}), "encloses nothing: its lines have no area and no length");
    EXPECT_EQ(message({open_line({{0, 0}, {std::numeric_limits<double>::quiet_NaN(), 1}})}),
              "has a point that is not a finite number");
    EXPECT_EQ(message(std::vector<SketchStroke>(1001, circle({0, 0}, 3))),
              "has 1001 lines with 180180 points; at most 1000 lines and 20000 points");
}

TEST(SketchedFormation, AgentsOnOneAnotherHavePlacesOfTheirOwn) {
    const Sketch sketch = make_sketch({circle({0, 0}, 10)}).value();
    const SketchedFormation formed = form(sketch, std::vector<Vec2>(50, Vec2(3, 4)));
    EXPECT_EQ(std::set<std::size_t>(formed.place.begin(), formed.place.end()).size(), 50U);
    EXPECT_GT(smallest_distance(formed.targets), 0.5 * formed.candidates.unit);
}

TEST(SketchedFormation, BrushesWithoutMeasureEnd) {
    const Sketch sketch = make_sketch({circle({0, 0}, 10)}).value();
    SketchOptions options;
    options.sampling.density = [](const Vec2& p) { return p.x > 3.0 ? 1e300 * 1e300 : p.x > 0.0 ? 0.0 : 1e-300; };
    const SketchedFormation formed = form(sketch, scattered(100, 8), options);
    for (const Vec2& p : formed.targets) EXPECT_LE(glm::length(p), 10.0 + 1e-9);
    options.sampling.density = [](const Vec2&) { return 0.0; };
    EXPECT_EQ(form(sketch, scattered(100, 8), options).targets.size(), 100U);
}

// A scribble crosses itself millions of times; it is bounded in time and memory, and everybody still has a place.
TEST(SketchedFormation, ScribblesEnd) {
    Random random(1);
    SketchStroke scribble;
    for (int k = 0; k < 2000; ++k) scribble.points.emplace_back(random.between(0, 10), random.between(0, 10));
    const Sketch sketch = make_sketch({scribble}).value();
    const SketchedFormation formed = form(sketch, scattered(50, 2));
    EXPECT_EQ(formed.targets.size(), 50U);
}

// Lines a thousandth apart: two million metres of them once took as many points as there was memory for.
TEST(SketchedFormation, EndlessLinesInALittleRoomEnd) {
    SketchStroke zigzag;
    for (int k = 0; k < 20'000; ++k) zigzag.points.emplace_back(k % 2 == 0 ? 0.0 : 100.0, 0.001 * k);
    const SketchedFormation formed = form(make_sketch({zigzag}).value(), scattered(500, 2));
    EXPECT_EQ(formed.targets.size(), 500U);
}

}  // namespace
}  // namespace aerogram::planner
