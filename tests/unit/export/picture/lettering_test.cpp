#include "export/picture/lettering.hpp"

#include <gtest/gtest.h>

namespace aerogram::exporter {
namespace {

class LetteringTest : public testing::Test {
  protected:
    Result<Lettering> lettering_ = Lettering::load();
    const Lettering& lettering() { return *lettering_; }
};

TEST_F(LetteringTest, CapitalsAreAsHighAsTheFontSays) {
    const Label label = lettering().label("H", 100.0);
    const auto box = planner::bounds_of(label.outlines);
    EXPECT_NEAR(box.size().y, 72.9, 0.2);  // DejaVu Sans: cap height 1493 of 2048 units
    EXPECT_NEAR(box.high.y, 0.0, 0.01);    // stands on the baseline, y down
    EXPECT_NEAR(label.width, 75.2, 0.2);   // advance 1540 of 2048
}

TEST_F(LetteringTest, LongNamesAreCutToTheRoomAndSaySo) {
    const std::string name(250, 'w');
    const Label whole = lettering().label(name, 12.0), cut = lettering().label(name, 12.0, 200.0);
    EXPECT_GT(whole.width, 200.0);
    EXPECT_LE(cut.width, 200.0);
    EXPECT_GT(cut.width, 200.0 - 2.0 * 12.0);
    const Label dots = lettering().label("…", 12.0);
    ASSERT_GT(cut.outlines.contours.size(), dots.outlines.contours.size());
    const auto end = planner::bounds_of({{cut.outlines.contours.back()}}),
               dot = planner::bounds_of({{dots.outlines.contours.back()}});
    EXPECT_NEAR(end.size().y, dot.size().y, 1e-9);
}

TEST_F(LetteringTest, NoRoomDrawsAtMostTheDots) {
    EXPECT_LE(lettering().label("keyframe", 12.0, 1.0).outlines.contours.size(), 3U);
    EXPECT_TRUE(lettering().label("", 12.0).outlines.contours.empty());
}

TEST_F(LetteringTest, ScriptsThatTheFontLacksComeFromAnother) {
    const Label both = lettering().label("T 夢", 12.0), question = lettering().label("T ?", 12.0);
    EXPECT_GT(both.outlines.contours.size(), question.outlines.contours.size());
}

TEST_F(LetteringTest, BrokenTextIsQuestionMarksAndControlCharactersAreSpaces) {
    EXPECT_EQ(lettering().label("a\xFFz", 12.0).width, lettering().label("a?z", 12.0).width);
    EXPECT_EQ(lettering().label("a\nz", 12.0).width, lettering().label("a z", 12.0).width);
    EXPECT_EQ(lettering().label("\xF4\x8F\xBF\xBD", 12.0).width, lettering().label("?", 12.0).width);  // U+10FFFD
}

}  // namespace
}  // namespace aerogram::exporter
