#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "planner/text/outline_font.hpp"
#include "planner/text/outline_text.hpp"
#include "tests/unit/planner/formation/missions.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kSans = "DejaVu Sans", kBold = "DejaVu Sans Bold";  ///< of fonts-dejavu-core

TextSource written(std::string words, std::string font = kSans, TextStyle style = TextStyle::fill) {
    TextSource source = text(std::move(words));
    source.font = std::move(font);
    source.style = style;
    return source;
}

Bounds bounds(const std::string& words, const std::string& font = kSans) {
    return bounds_of(outline_text(written(words, font)).value());
}

double area(const Region& region) {
    const DensityRaster raster = rasterised(region, 20'000);
    return raster.total() * raster.cell * raster.cell;
}

std::string why(const TextSource& source) {
    const auto formation = build(mission_of({part_of(source, 20)}));
    return formation ? "built" : formation.error().message;
}

TEST(InstalledFont, IsFoundByFamilyAndByFullNameAndNeverReplaced) {
    EXPECT_EQ(installed_font(kSans).value().file.filename(), "DejaVuSans.ttf");
    EXPECT_EQ(installed_font("dejavu sans BOLD").value().file.filename(), "DejaVuSans-Bold.ttf");
    const auto other = installed_font("Dejavu Sansa");
    ASSERT_FALSE(other.ok());
    EXPECT_THAT(other.error().message, StartsWith("no installed font has this name; the nearest are \"DejaVu Sans\""));
}

TEST(OutlineText, LettersHaveTheFontsProportions) {
    const Bounds h = bounds("H");  // DejaVu Sans: 2048 units an em, capitals 1493 high
    EXPECT_NEAR(h.size().y, 1493.0, 1.0);
    EXPECT_GT(area(outline_text(written("O", kBold)).value()), 1.3 * area(outline_text(written("O")).value()));
}

TEST(OutlineText, HolesAreHoles) {
    const Region o = outline_text(written("O")).value();
    ASSERT_EQ(o.contours.size(), 2U);
    const DensityRaster raster = rasterised(o, 20'000);
    const Bounds box = bounds_of(o);
    EXPECT_EQ(raster.at(0.5 * (box.low + box.high)), 0.0F);
}

TEST(OutlineText, KerningMovesLettersTogether) {
    EXPECT_LT(bounds("AV").size().x, bounds("A").size().x + bounds("V").size().x);
}

TEST(OutlineText, ArabicJoinsAndRunsFromRightToLeft) {
    // Beh alone has its own shape; two of them join: narrower than two alone.
    EXPECT_LT(bounds("\u0628\u0628").size().x, 0.95 * 2.0 * bounds("\u0628").size().x);
    // Alef, the first letter, is a tall stem: it stands at the right of alef-reh and is taller than reh.
    const Region word = outline_text(written("\u0627\u0631")).value();
    const auto taller = [](const Contour& a, const Contour& b) {
        return bounds_of({{a}}).high.y < bounds_of({{b}}).high.y;
    };
    const Contour alef = *std::max_element(word.contours.begin(), word.contours.end(), taller);
    EXPECT_NEAR(bounds_of({{alef}}).high.x, bounds_of(word).high.x, 1.0);
    // Digits inside run left to right: 12 after the word is 1 left of 2, all left of the word.
    const Region dated = outline_text(written("\u0627 14")).value();
    const Bounds one = bounds_of(outline_text(written("1")).value());
    const Contour first = *std::min_element(
        dated.contours.begin(), dated.contours.end(),
        [](const Contour& a, const Contour& b) { return bounds_of({{a}}).low.x < bounds_of({{b}}).low.x; });
    EXPECT_NEAR(bounds_of({{first}}).size().x, one.size().x, 1.0);
}

TEST(OutlineText, LinesStandUnderEachOtherAndAlign) {
    TextSource source = written("MMMM\nI");
    const auto line_of = [](const Region& region, bool upper) {
        Region out;
        for (const Contour& c : region.contours) {
            if ((bounds_of({{c}}).low.y > -100.0) == upper) out.contours.push_back(c);
        }
        return bounds_of(out);
    };
    for (const auto& [align, share] :
         {std::pair(TextAlign::left, 0.0), {TextAlign::center, 0.5}, {TextAlign::right, 1.0}}) {
        source.align = align;
        const Region region = outline_text(source).value();
        const Bounds upper = line_of(region, true), lower = line_of(region, false);
        EXPECT_LT(lower.high.y, upper.low.y);
        const double at_upper = upper.low.x + share * upper.size().x, at_lower = lower.low.x + share * lower.size().x;
        EXPECT_NEAR(at_upper, at_lower, 30.0);  // side bearings differ by a little
    }
}

TEST(OutlineText, AMissingCharacterIsNamed) {
    EXPECT_THAT(why(written("A\u6F22")), HasSubstr("character \"\u6F22\" (U+6F22) is not in the font"));
}

TEST(OutlineText, AFontThatIsNotInstalledIsNamedWithTheNearest) {
    EXPECT_THAT(why(written("A", "DejaVu Sanz")),
                HasSubstr(".text = \"A\": font = \"DejaVu Sanz\": no installed font has this name; the nearest are"));
}

TEST(OutlineText, TextThatDrawsNothingIsRefused) {
    EXPECT_THAT(why(written("\u00A0")), HasSubstr("the text draws nothing"));
}

TEST(OutlineText, ABrokenFontFileIsRefused) {
    const auto good = installed_font(kSans).value();
    const std::string bytes = load_font(good).value().bytes;
    const auto file = std::filesystem::path(::testing::TempDir()) / "broken.ttf";
    TextSource source = written("A", "broken.ttf");
    source.font_file = file;
    for (const std::size_t kept : {std::size_t{1}, std::size_t{12}, std::size_t{700}, bytes.size() / 8}) {
        std::ofstream(file, std::ios::binary) << bytes.substr(0, kept);
        EXPECT_THAT(why(source), HasSubstr(".text = \"A\": ")) << kept;
    }
    std::filesystem::remove(file);
    EXPECT_THAT(why(source), HasSubstr("cannot be read"));
}

TEST(OutlineText, AFontFileDrawsLikeTheInstalledFont) {
    TextSource source = written("Ag");
    const Region installed = outline_text(source).value();
    source.font = "any.ttf";
    source.font_file = installed_font(kSans).value().file;
    EXPECT_EQ(outline_text(source).value().contours, installed.contours);
}

TEST(OutlineStyle, PointsStandOnTheOutlineCornersFirst) {
    const Points e = built(part_of(written("E", kSans, TextStyle::outline), 12, high(20))).points_m;
    // An E has twelve corners: as many drones stand on them, at the corners of its box among others.
    const Box box = box_of(e);
    EXPECT_NEAR(box.size().z, 20.0, 1e-9);
    for (const Vec3& corner : {Vec3(box.low.x, 0, box.low.z), Vec3(box.low.x, 0, box.high.z)}) {
        EXPECT_TRUE(std::any_of(e.begin(), e.end(), [&](const Vec3& p) { return glm::distance(p, corner) < 1e-9; }));
    }
}

TEST(FilledText, HasExactlyNSlotsAtTheSpacingInEverySize) {
    for (const std::size_t n : {1U, 9U, 40U, 300U, 2000U}) {
        for (const TextStyle style : {TextStyle::fill, TextStyle::outline}) {
            const auto formation = build(mission_of({part_of(written("A8\ng", kBold, style), n)}));
            ASSERT_TRUE(formation.ok()) << formation.error().message;
            EXPECT_EQ(formation->points_m.size(), n);
            if (n > 1) {
                EXPECT_GE(formation->smallest_spacing_m, 2.2 - 1e-9) << n;
            }
        }
    }
}

TEST(FilledText, TheNeededSizeSuffices) {
    Mission mission = mission_of({part_of(written("AB", kBold), 150, flat(20, 10))});
    const std::string message = build(mission).error().message;
    double x = 0, z = 0;
    ASSERT_EQ(std::sscanf(message.c_str() + message.find(">= ") + 3, "[%lf, %lf]", &x, &z), 2) << message;
    mission.keyframes[0].parts[0].size = flat(x, z);
    EXPECT_TRUE(build(mission).ok());
}

}  // namespace
}  // namespace aerogram::planner::testing
