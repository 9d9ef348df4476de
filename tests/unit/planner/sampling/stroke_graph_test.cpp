#include "planner/sampling/stroke_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/text/stroke_font.hpp"

namespace aerogram::planner {
namespace {

std::size_t count(const StrokeGraph& graph, StationKind kind) {
    return static_cast<std::size_t>(std::count_if(graph.stations.begin(), graph.stations.end(),
                                                  [kind](const Station& s) { return s.kind == kind; }));
}

bool has(const StrokeGraph& graph, const Vec2& at, StationKind kind) {
    return std::any_of(graph.stations.begin(), graph.stations.end(),
                       [&](const Station& s) { return s.kind == kind && glm::distance(s.at, at) < 1e-6; });
}

StrokeGraph glyph(char c) {
    static const StrokeFont font = load_stroke_font().value();
    return stroke_graph(font.glyphs[static_cast<std::size_t>(c)]->strokes, StrokeFont::kCapHeight);
}

TEST(StrokeGraph, LetterEHasThreeEndsTwoCornersAndOneJunction) {
    const StrokeGraph e = glyph('E');
    EXPECT_EQ(count(e, StationKind::end), 5U);
    EXPECT_EQ(count(e, StationKind::junction), 1U);
    EXPECT_TRUE(has(e, {4, 11}, StationKind::junction));
    EXPECT_TRUE(has(e, {4, 21}, StationKind::end));
    EXPECT_TRUE(has(e, {17, 0}, StationKind::end));
    EXPECT_EQ(e.edges.size(), 5U);
}

TEST(StrokeGraph, CrossingStrokesShareOneJunction) {
    const StrokeGraph x = stroke_graph(std::vector<Stroke>{{{0, 0}, {10, 20}}, {{0, 20}, {10, 0}}}, 20.0);
    EXPECT_EQ(x.stations.size(), 5U);
    EXPECT_TRUE(has(x, {5, 10}, StationKind::junction));
    EXPECT_EQ(x.edges.size(), 4U);
}

TEST(StrokeGraph, EndsThatNearlyTouchAnotherStrokeBelongToIt) {
    const StrokeGraph a = glyph('A');  // its bar ends 0.31 font units inside the legs
    EXPECT_EQ(count(a, StationKind::junction), 2U);
    EXPECT_EQ(count(a, StationKind::end), 3U);
}

TEST(StrokeGraph, BendsOfCurvesAreNotCorners) {
    EXPECT_EQ(glyph('S').stations.size(), 2U);
    EXPECT_EQ(glyph('C').stations.size(), 2U);
    EXPECT_EQ(glyph('s').stations.size(), 2U);  // single bends of up to 53 degrees
    EXPECT_EQ(glyph('D').stations.size(), 2U);
}

TEST(StrokeGraph, AClosedCurveStartsAtTheMiddleOfItsTop) {
    const StrokeGraph o = glyph('O');
    ASSERT_EQ(o.stations.size(), 1U);
    EXPECT_TRUE(has(o, {11, 21}, StationKind::end));
    ASSERT_EQ(o.edges.size(), 1U);
    EXPECT_EQ(o.edges[0].path.front(), o.edges[0].path.back());
}

TEST(StrokeGraph, TheFigureEightHasOneJunctionAndTwoLoops) {
    const StrokeGraph eight = glyph('8');
    EXPECT_EQ(count(eight, StationKind::junction), 1U);
    EXPECT_EQ(eight.edges.size(), 2U);
}

TEST(StrokeGraph, SmallSeparateFiguresAreDots) {
    const StrokeGraph i = glyph('i');
    EXPECT_EQ(i.edges.size(), 2U);
    EXPECT_TRUE(has(i, {4, 21}, StationKind::end));
    const StrokeGraph colon = glyph(':');
    ASSERT_EQ(colon.edges.size(), 2U);
    EXPECT_EQ(colon.edges[0].path.size(), 1U);
}

TEST(StrokeGraph, OverlappingStrokesAreDrawnOnce) {
    const StrokeGraph line = stroke_graph(std::vector<Stroke>{{{0, 0}, {0, 20}}, {{0, 5}, {0, 30}}}, 20.0);
    EXPECT_EQ(line.stations.size(), 2U);
    ASSERT_EQ(line.edges.size(), 1U);
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < line.edges[0].path.size(); ++i) {
        length += glm::distance(line.edges[0].path[i], line.edges[0].path[i + 1]);
    }
    EXPECT_DOUBLE_EQ(length, 30.0);
}

TEST(StrokeGraph, AStrokeThatThickensAnotherIsLeftOut) {
    const StrokeGraph line = stroke_graph(std::vector<Stroke>{{{0, 0}, {0, 20}}, {{1, 0}, {1, 20}}}, 20.0);
    EXPECT_EQ(line.edges.size(), 1U);
}

TEST(StrokeGraph, EveryCharacterOfTheFontHasItsWholeLengthInItsEdges) {
    static const StrokeFont font = load_stroke_font().value();
    for (char c = 'A'; c <= 'Z'; ++c) {
        double drawn = 0.0, kept = 0.0;
        for (const Stroke& s : font.glyphs[static_cast<std::size_t>(c)]->strokes) {
            for (std::size_t i = 0; i + 1 < s.size(); ++i) drawn += glm::distance(s[i], s[i + 1]);
        }
        for (const StrokeEdge& e : glyph(c).edges) {
            for (std::size_t i = 0; i + 1 < e.path.size(); ++i) kept += glm::distance(e.path[i], e.path[i + 1]);
        }
        EXPECT_NEAR(kept, drawn, 0.7) << c;  // ends moved onto their neighbours
    }
}

}  // namespace
}  // namespace aerogram::planner
