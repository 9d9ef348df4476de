#include "planner/sampling/stroke_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "planner/sampling/edge_placing.hpp"
#include "planner/text/stroke_font.hpp"

namespace aerogram::planner {
namespace {

StrokeGraph glyph(char c) {
    static const StrokeFont font = load_stroke_font().value();
    return stroke_graph(font.glyphs[static_cast<std::size_t>(c)]->strokes, StrokeFont::kCapHeight);
}

bool occupied(const std::vector<Vec2>& points, const Vec2& at) {
    return std::any_of(points.begin(), points.end(), [&](const Vec2& p) { return glm::distance(p, at) < 1e-9; });
}

double smallest_distance(const std::vector<Vec2>& points) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) smallest = std::min(smallest, glm::distance(points[i], points[j]));
    }
    return smallest;
}

TEST(StrokeSampling, Property1EveryCharacterGivesExactlyCountPoints) {
    for (char c = '!'; c <= '~'; ++c) {
        const StrokeGraph drawing = glyph(c);
        const bool dots_only = c == '.' || c == ':';
        for (std::size_t n = dots_only ? 60 : 1; n <= 60; ++n) {
            const auto points = sample_strokes(drawing, {0.7, 1.1}, n);
            ASSERT_EQ(points.has_value(), !dots_only) << c << n;
            if (!points) continue;
            ASSERT_EQ(points->size(), n) << c;
            ASSERT_GT(smallest_distance(*points), 0.0) << c << n;
        }
    }
}

TEST(StrokeSampling, Property2EndsCornersAndJunctionsAreOccupiedWhenCountAllows) {
    for (char c = 'A'; c <= 'Z'; ++c) {
        const StrokeGraph drawing = glyph(c);
        for (std::size_t n = drawing.stations.size(); n <= 30; ++n) {
            const auto points = sample_strokes(drawing, {1.0, 1.0}, n);
            for (const Station& s : drawing.stations) EXPECT_TRUE(occupied(*points, s.at)) << c << n;
        }
    }
}

TEST(StrokeSampling, TooFewPointsKeepEndsAndCornersBeforeJunctions) {
    const StrokeGraph e = glyph('E');
    const auto five = sample_strokes(e, {1.0, 1.0}, 5);
    for (const Station& s : e.stations) EXPECT_EQ(occupied(*five, s.at), s.kind == StationKind::end);
    const auto two = sample_strokes(e, {1.0, 1.0}, 2);  // farthest from each other
    EXPECT_TRUE(occupied(*two, {17, 21}));
    EXPECT_TRUE(occupied(*two, {4, 0}));
}

TEST(StrokeSampling, Property3ACircleIsEquallySpacedFromItsTop) {
    const StrokeGraph o = glyph('O');
    const std::vector<Vec2>& path = o.edges[0].path;
    const auto points = sample_strokes(o, {1.0, 1.0}, 12);
    EXPECT_TRUE(occupied(*points, {11, 21}));
    // Walks along the curve from point to point: each stretch must be a twelfth.
    std::size_t piece = 0;
    double walked = 0.0;
    std::vector<double> stops;
    for (const Vec2& p : *points) {
        while (piece + 2 < path.size()) {
            const double detour = glm::distance(path[piece], p) + glm::distance(p, path[piece + 1]);
            if (detour - glm::distance(path[piece], path[piece + 1]) < 1e-9) break;
            walked += glm::distance(path[piece], path[piece + 1]);
            ++piece;
        }
        stops.push_back(walked + glm::distance(path[piece], p));
    }
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) EXPECT_NEAR(stops[i + 1] - stops[i], length_of(path) / 12, 1e-9);
}

TEST(StrokeSampling, Property4NoOtherNumbersOnTheEdgesHaveAWiderSmallestGap) {
    // H has no acute angles: its gaps can be read off the distances of neighbours on the straight edges.
    const StrokeGraph h = glyph('H');
    std::vector<double> lengths;
    for (const StrokeEdge& e : h.edges) lengths.push_back(length_of(e.path));
    for (std::size_t n = h.stations.size(); n <= 14; ++n) {
        double best = 0.0;
        const std::function<void(std::size_t, std::size_t, double)> try_all = [&](std::size_t edge, std::size_t left,
                                                                                  double gap) {
            if (edge == lengths.size()) {
                if (left == 0) best = std::max(best, gap);
                return;
            }
            for (std::size_t m = 0; m <= left; ++m) {
                try_all(edge + 1, left - m, std::min(gap, lengths[edge] / static_cast<double>(m + 1)));
            }
        };
        try_all(0, n - h.stations.size(), std::numeric_limits<double>::infinity());
        EXPECT_NEAR(smallest_distance(*sample_strokes(h, {1.0, 1.0}, n)), best, 1e-9) << n;
    }
}

TEST(StrokeSampling, AcuteAnglesDoNotCrowdTheCorner) {
    // The legs of M meet at 21 degrees: equal division would bring points to 0.36 gaps of each other.
    const StrokeGraph m = glyph('M');
    double length = 0.0;
    for (const StrokeEdge& e : m.edges) length += length_of(e.path);
    const auto points = sample_strokes(m, {1.0, 1.0}, 16);
    EXPECT_GT(smallest_distance(*points), 0.65 * length / 15);
}

TEST(StrokeSampling, PointsComeInDrawingOrder) {
    const std::vector<Stroke> strokes{{{0, 0}, {10, 0}}, {{20, 0}, {30, 0}}};
    const auto points = sample_strokes(stroke_graph(strokes, 20.0), {1.0, 1.0}, 8);
    EXPECT_TRUE(std::is_sorted(points->begin(), points->end(), [](const Vec2& a, const Vec2& b) { return a.x < b.x; }));
}

TEST(StrokeSampling, ScaleIsAppliedBeforePointsAreShared) {
    // An L twice as wide as high once stretched: the bar takes two thirds of the points between.
    const std::vector<Stroke> strokes{{{0, 20}, {0, 0}, {20, 0}}};
    const auto points = sample_strokes(stroke_graph(strokes, 20.0), {2.0, 1.0}, 6);
    const auto on_bar =
        std::count_if(points->begin(), points->end(), [](const Vec2& p) { return p.x > 1.0 && p.x < 39.0; });
    EXPECT_EQ(on_bar, 2);
}

}  // namespace
}  // namespace aerogram::planner
