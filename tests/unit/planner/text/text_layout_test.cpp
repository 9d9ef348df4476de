#include "planner/text/text_layout.hpp"

#include <gtest/gtest.h>

namespace aerogram::planner {
namespace {

const StrokeFont& font() {
    static const StrokeFont loaded = load_stroke_font().value();
    return loaded;
}

TEST(StrokeFont, CapitalsStandOnTheBaselineAndReachTheCapHeight) {
    const Glyph& t = *font().glyphs['T'];
    ASSERT_EQ(t.strokes.size(), 2U);
    EXPECT_EQ(t.strokes[0].front(), Vec2(8, 21));  // the stem from the top, where the bar is: y points up
    EXPECT_EQ(t.strokes[0].back(), Vec2(8, 0));
    EXPECT_EQ(t.strokes[1].front().y, 21.0);
    EXPECT_EQ(t.width, 16.0);
}

TEST(StrokeFont, HasThePrintableCharactersOfAsciiOnly) {
    for (std::size_t c = 0; c < 128; ++c) EXPECT_EQ(font().glyphs[c].has_value(), c >= 32 && c <= 126) << c;
}

TEST(StrokeFont, AMissingFontNamesItsPackage) {
    const auto missing = load_stroke_font("no-such-font");
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().code, ErrorCode::io);
    EXPECT_EQ(missing.error().message, "the stroke font no-such-font is not installed (package hershey-fonts-data)");
}

TEST(TextLayout, LettersStandOneGlyphWidthApart) {
    const auto letters = lay_out("TT", font()).value();
    ASSERT_EQ(letters.size(), 2U);
    EXPECT_EQ(letters[1][0].front() - letters[0][0].front(), Vec2(16, 0));
}

TEST(TextLayout, SpacesTakeRoomButDrawNothing) {
    const auto letters = lay_out("T T", font()).value();
    ASSERT_EQ(letters.size(), 2U);
    EXPECT_EQ(letters[1][0].front() - letters[0][0].front(), Vec2(16 + font().glyphs[' ']->width, 0));
}

TEST(TextLayout, LinesAreCentredUnderEachOther) {
    const auto letters = lay_out("TT\nT", font()).value();
    ASSERT_EQ(letters.size(), 3U);
    EXPECT_EQ(letters[2][0].front(), Vec2(0, 21 - StrokeFont::kLinePitch));
    EXPECT_EQ(letters[0][0].front().x, -letters[1][0].front().x);
}

TEST(TextLayout, UnknownCharactersAreNamed) {
    EXPECT_EQ(lay_out("caf\xC3\xA9", font()).error().message,
              "character \"\xC3\xA9\" (U+00E9) is not in the stroke font, which has the printable characters of ASCII");
    EXPECT_EQ(lay_out("\xF0\x9F\x98\x80", font()).error().message,
              "character \"\xF0\x9F\x98\x80\" (U+1F600) is not in the stroke font, which has the printable characters "
              "of ASCII");
    EXPECT_EQ(lay_out("a\tb", font()).error().message,
              "character U+0009 is not in the stroke font, which has the printable characters of ASCII");
}

TEST(TextLayout, MalformedUtf8IsAnErrorAndNotReadPastTheEnd) {
    EXPECT_EQ(lay_out("A\xE2\x82", font()).error().message,
              "character U+00E2 is not in the stroke font, which has the printable characters of ASCII");
    EXPECT_FALSE(lay_out("\x80", font()).ok());
}

TEST(TextLayout, TextWithoutStrokesIsAnError) {
    EXPECT_EQ(lay_out("", font()).error().message, "the text draws nothing");
    EXPECT_EQ(lay_out(" \n ", font()).error().message, "the text draws nothing");
}

}  // namespace
}  // namespace aerogram::planner
