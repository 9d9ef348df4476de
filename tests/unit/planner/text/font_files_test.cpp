#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "planner/text/outline_font.hpp"
#include "planner/text/outline_text.hpp"
#include "tests/fuzz/text_targets.hpp"

/// Font files of every kind, whole and damaged. tests/fuzz/make_fonts.py says what is in those of the corpus.
namespace aerogram::planner {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path kCorpus = fs::path(AEROGRAM_SOURCE_DIR) / "tests/fuzz/corpus";

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

FontData font_file(const std::string& name, unsigned face = 0) {
    return load_font({kCorpus / "font" / name, face}).value();
}

std::string why(const fs::path& file, const std::string& text = "A") {
    TextSource source;
    source.text = text;
    source.font_file = file;
    const auto region = outline_text(source);
    return region ? "drawn" : region.error().message;
}

double width_of(const FontData& font, std::string_view text) {
    return shape_text(font, std::array{text}).value().lines.front().width;
}

// Fails without FreeType: outlines as they were drawn, quadratic curves (TrueType) and cubic ones (CFF).
TEST(FreeType, DrawsOutlinesOfBothKindsOfFonts) {
    for (const char* file : {"own.ttf", "own.otf"}) {
        const FontData font = font_file(file);
        const auto glyphs = shape_text(font, std::array<std::string_view, 1>{"Ai"}).value().lines.front().glyphs;
        const auto outlines = glyph_outlines(font, std::array{glyphs[0].glyph, glyphs[1].glyph}).value();
        ASSERT_EQ(outlines[0].contours.size(), 2U) << file;
        const Bounds box = bounds_of(outlines[0]), ring = bounds_of(outlines[1]);
        EXPECT_EQ(box.low, Vec2(100, 0));
        EXPECT_EQ(box.high, Vec2(500, 700));
        EXPECT_NEAR(ring.low.x, 0.0, 0.5);
        EXPECT_NEAR(ring.high.y, 600.0, 0.5);
        for (const Vec2& p : outlines[1].contours.front()) {  // a circle to what its cubic curves and chords allow
            EXPECT_NEAR(glm::distance(p, Vec2(300, 300)), 300.0, 2.0) << file;
        }
        EXPECT_GT(outlines[1].contours.front().size(), 20U);
    }
}

// Fails without HarfBuzz: what the tables GSUB and GPOS of these fonts say.
TEST(HarfBuzz, FollowsTheFontsOwnTables) {
    for (const char* file : {"own.ttf", "own.otf"}) {
        const FontData font = font_file(file);
        EXPECT_EQ(width_of(font, "AV"), 600.0 + 600.0 - 120.0);
        EXPECT_EQ(width_of(font, "fi"), 650.0);
        EXPECT_EQ(width_of(font, "\u0628\u0628"), 400.0 + 500.0);
        const auto marked = shape_text(font, std::array<std::string_view, 1>{"A\u0301"}).value().lines.front();
        EXPECT_EQ(marked.glyphs.at(1).at, Vec2(250, -100));
        EXPECT_EQ(marked.letters.size(), 1U);
        const auto syllable = shape_text(font, std::array<std::string_view, 1>{"\u0915\u093F"}).value().lines.front();
        EXPECT_EQ(syllable.glyphs.at(1).at.x, 300.0);  // the vowel that is spoken last stands first
    }
}

TEST(FontFiles, CollectionsHoldSeveralFaces) {
    EXPECT_EQ(width_of(font_file("two.ttc", 0), "AV"), 1080.0);
    EXPECT_EQ(width_of(font_file("two.ttc", 1), "AV"), 1200.0);
    EXPECT_EQ(why(kCorpus / "font/two.ttc", "AV"), "drawn");
    const FontData none = font_file("two.ttc", 2);
    EXPECT_FALSE(shape_text(none, std::array<std::string_view, 1>{"A"}).ok());
    EXPECT_FALSE(glyph_outlines(none, std::array{1U}).ok());
}

TEST(FontFiles, VariableFontsHaveTheirNamedInstances) {
    const auto right_edge = [](const FontData& font) {
        const auto glyph =
            shape_text(font, std::array<std::string_view, 1>{"A"}).value().lines.front().glyphs.at(0).glyph;
        return bounds_of(glyph_outlines(font, std::array{glyph}).value().front()).high.x;
    };
    for (const unsigned instance : {0U, 1U}) {  // as it is by default, and Regular
        const FontData font = font_file("variable.ttf", instance << 16U);
        EXPECT_EQ(width_of(font, "A"), 600.0);
        EXPECT_EQ(right_edge(font), 500.0);
    }
    const FontData black = font_file("variable.ttf", 2U << 16U);
    EXPECT_EQ(width_of(black, "A"), 700.0);
    EXPECT_EQ(right_edge(black), 600.0);
    EXPECT_FALSE(glyph_outlines(font_file("variable.ttf", 9U << 16U), std::array{1U}).ok());
}

/// Fontconfig with the corpus's fonts alone.
class OnlyCorpusInstalled : public ::testing::Test {
  protected:
    void SetUp() override {
        const fs::path file = fs::path(::testing::TempDir()) / "only-corpus-fonts.conf";
        std::ofstream(file) << "<?xml version=\"1.0\"?><fontconfig><dir>" << (kCorpus / "font").string()
                            << "</dir><cachedir>" << ::testing::TempDir()
                            << "only-corpus-fonts</cachedir></fontconfig>";
        setenv("FONTCONFIG_FILE", file.c_str(), 1);
    }
    void TearDown() override { unsetenv("FONTCONFIG_FILE"); }
};

TEST_F(OnlyCorpusInstalled, InstancesOfVariableFontsAreFoundByName) {
    EXPECT_EQ(installed_font("Aerogram Variable").value().face >> 16U, 0U);
    const FontFile black = installed_font("aerogram variable black").value();
    EXPECT_EQ(black.file.filename(), "variable.ttf");
    EXPECT_EQ(black.face >> 16U, 2U);
    EXPECT_EQ(width_of(load_font(black).value(), "A"), 700.0);
}

TEST_F(OnlyCorpusInstalled, FontsOfBitmapsAloneAreNotOffered) {
    const auto refused = installed_font("Aerogram Bitmaps");
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().message, HasSubstr("no installed font has this name; the nearest are"));
}

TEST(FontFiles, BitmapsAndColouredPicturesAreRefused) {
    EXPECT_THAT(why(kCorpus / "font/bitmaps.ttf"), HasSubstr("bitmaps.ttf has bitmaps, not outlines"));
    EXPECT_EQ(why(kCorpus / "font/coloured.ttf", "A f"), "drawn");
    EXPECT_THAT(why(kCorpus / "font/coloured.ttf", "AV"), HasSubstr("a glyph is a coloured picture without outline"));
}

TEST(FontFiles, OtherFilesAreNoFonts) {
    EXPECT_THAT(why(fs::path(AEROGRAM_SOURCE_DIR) / "missions/straight.toml"), HasSubstr(".toml is not a font"));
    EXPECT_THAT(why(fs::path(AEROGRAM_SOURCE_DIR) / "missions/assets/balloon.png"), HasSubstr("is not a font"));
    EXPECT_THAT(why(kCorpus / "font"), HasSubstr("cannot be read"));
    EXPECT_THAT(why(kCorpus / "font/none.ttf"), HasSubstr("cannot be read"));
}

// Exact-size heap copies, so that a sanitizer sees any read past the end.
void replay(std::string_view bytes) {
    const std::vector<char> copy(bytes.begin(), bytes.end());
    fuzz::try_font({copy.data(), copy.size()});
}

TEST(FontFuzz, CorpusItsCutsAndFlippedBytesAreHandled) {
    std::size_t files = 0;
    std::uint64_t state = 1;
    for (const auto& entry : fs::directory_iterator(kCorpus / "font")) {
        SCOPED_TRACE(entry.path());
        const std::string bytes = bytes_of(entry.path());
        replay(bytes);
        for (std::size_t cut = 0; cut < bytes.size(); cut += 1 + bytes.size() / 20) replay(bytes.substr(0, cut));
        for (int flip = 0; flip < 25; ++flip) {
            std::string damaged = bytes;
            for (int k = 0; k < 1 + flip % 4; ++k) {
                state = state * 6364136223846793005U + 1442695040888963407U;
                damaged[(state >> 33U) % damaged.size()] = static_cast<char>(state >> 24U);
            }
            replay(damaged);
        }
        ++files;
    }
    EXPECT_EQ(files, 6U);
}

TEST(FontFuzz, InstalledFontsDamagedAreHandled) {
    std::uint64_t state = 2;
    for (const char* name : {"DejaVu Sans", "Amiri", "Lohit Devanagari"}) {
        std::string bytes = load_font(installed_font(name).value()).value().bytes;
        for (int round = 0; round < 6; ++round) {
            for (int k = 0; k < 200; ++k) {
                state = state * 6364136223846793005U + 1442695040888963407U;
                bytes[(state >> 33U) % bytes.size()] = static_cast<char>(state >> 24U);
            }
            replay(bytes);
        }
    }
}

TEST(TextFuzz, CorpusAndItsCutsAreHandled) {
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(kCorpus / "text")) {
        SCOPED_TRACE(entry.path());
        const std::string bytes = bytes_of(entry.path());
        for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
            fuzz::try_text(std::string_view(bytes).substr(0, cut), kCorpus / "font/own.ttf");
        }
        ++files;
    }
    EXPECT_GE(files, 5U);
}

}  // namespace
}  // namespace aerogram::planner
