#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string_view>

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

TEST(OutlineText, LinesOfEveryScriptAlign) {
    // A long line over a short one, in scripts of both directions: alignment is as seen, not as read.
    for (const auto& [font, words] : {std::pair("Amiri", "السلام عليكم\nسلام"),
                                      {"Lohit Devanagari", "नमस्ते दुनिया\nनमस्ते"},
                                      {"IPAGothic", "東京スカイツリー\n花火"},
                                      {"Symbola", "🎆🎆🎆🎆\n🎆"}}) {
        TextSource source = written(words, font);
        const FontData data = load_font(installed_font(font).value()).value();
        const std::string_view text = words;
        const std::array lines{text.substr(0, text.find('\n')), text.substr(text.find('\n') + 1)};
        const ShapedText shaped = shape_text(data, lines).value();
        ASSERT_GT(shaped.lines[0].width, 1.5 * shaped.lines[1].width);
        source.text = lines[1];
        source.align = TextAlign::left;
        const Bounds alone = bounds_of(outline_text(source).value());  // from its first origin
        source.text = words;
        for (const auto& [align, share] :
             {std::pair(TextAlign::left, 0.0), {TextAlign::center, 0.5}, {TextAlign::right, 1.0}}) {
            source.align = align;
            const Region both = outline_text(source).value();
            double left = 1e9;
            for (const Contour& c : both.contours) {
                const Bounds box = bounds_of({{c}});
                const double middle = 0.5 * (box.low.y + box.high.y);
                if (middle < 0.5 * (alone.low.y + alone.high.y - shaped.line_pitch)) left = std::min(left, box.low.x);
            }
            EXPECT_NEAR(left, alone.low.x - share * shaped.lines[1].width, 0.01 * shaped.units_per_em) << words;
        }
    }
}

DrawnLine half_circle() {
    constexpr double kHandle = 0.5522847498307936;  // of a quarter circle's cubic
    return {{{-1, 0}, {-1, kHandle}, {-kHandle, 1}, {0, 1}, {kHandle, 1}, {1, kHandle}, {1, 0}}, true, false};
}

TEST(TextAlong, OutlinesStandRigidlyOnTheLine) {
    TextSource source = written("IIIII");
    const Region straight = outline_text(source).value();
    const double width =
        shape_text(load_font(installed_font(kSans).value()).value(), std::array<std::string_view, 1>{"IIIII"})
            ->lines.front()
            .width;
    source.along = half_circle();
    const Region bent = outline_text(source).value();
    ASSERT_EQ(bent.contours.size(), 5U);
    const double radius = width / std::numbers::pi,
                 length = glm::distance(straight.contours[0][0], straight.contours[0][2]);
    for (std::size_t i = 0; i < 5; ++i) {
        const Contour& letter = bent.contours[i];
        ASSERT_EQ(letter.size(), 4U);
        EXPECT_NEAR(glm::distance(letter[0], letter[2]), length, 1e-9);
        Vec2 middle{};
        for (const Vec2& p : letter) middle += 0.25 * p;
        // Half its height above the circle, at its share of the half circle.
        EXPECT_NEAR(glm::length(middle), radius + 0.5 * 1493.0, 0.01 * radius);
        EXPECT_NEAR(std::atan2(middle.y, middle.x), std::numbers::pi * (1.0 - (static_cast<double>(i) + 0.5) / 5.0),
                    0.01);
    }
}

TEST(TextAlong, MarksStayWithTheirLetters) {
    TextSource source = written("सेसे", "Lohit Devanagari");
    source.along = half_circle();
    const Region bent = outline_text(source).value();
    source.along->points = {{0, 0}, {1, 0}};
    source.along->bezier = false;
    const Region straight = outline_text(source).value();
    ASSERT_EQ(bent.contours.size(), straight.contours.size());
    const std::size_t half = bent.contours.size() / 2;
    for (std::size_t c = 0; c < half; ++c) {  // the first syllable: letter and mark moved as one body
        EXPECT_NEAR(glm::distance(bent.contours[0][0], bent.contours[c][1]),
                    glm::distance(straight.contours[0][0], straight.contours[c][1]), 1e-9);
    }
}

TEST(TextAlong, EveryStyleHasItsDrones) {
    for (const TextStyle style : {TextStyle::stroke, TextStyle::outline, TextStyle::fill, TextStyle::solid}) {
        TextSource source = written("CURVE", style == TextStyle::stroke ? "stroke" : kSans, style);
        source.along = half_circle();
        Size size = wide(60);
        if (style == TextStyle::solid) size.depth_m = 6.0;
        Mission mission = mission_of({part_of(source, 120, size)});
        mission.limits.formation_spacing_m = 0.3;
        const Formation formation = build(mission).value();
        EXPECT_EQ(formation.points_m.size(), 120U);
        const Box box = box_of(formation.points_m);
        EXPECT_NEAR(box.size().x, 60.0, 1.5);
        EXPECT_NEAR(box.size().y, style == TextStyle::solid ? 6.0 : 0.0, 0.5);
        EXPECT_GT(box.size().z, 0.4 * box.size().x);  // a straight line of five letters is much flatter
    }
}

TEST(TextAlong, SeveralLinesOrALineWithoutLengthAreRefused) {
    for (const TextStyle style : {TextStyle::stroke, TextStyle::fill}) {
        TextSource source = written("A\nB", style == TextStyle::stroke ? "stroke" : kSans, style);
        source.along = half_circle();
        EXPECT_THAT(why(source), HasSubstr(".text = \"A\\nB\": has 2 lines; along a line it must have one"));
        source.text = "AB";
        source.along = DrawnLine{{{3, 3}, {3, 3}}, false, false};
        EXPECT_THAT(why(source), HasSubstr(".text = \"AB\": along: the line has no length"));
    }
}

TEST(TextAlong, SharpBendsMayOverlapButStillGiveEveryDroneAPlace) {
    TextSource source = written("OVERLAPPING");
    source.along = DrawnLine{{{0, 0}, {1, 0}, {0.9, -0.02}, {0, -0.1}}, false, false};
    for (const TextStyle style : {TextStyle::outline, TextStyle::fill}) {
        source.style = style;
        EXPECT_EQ(built(part_of(source, 300)).points_m.size(), 300U);
    }
}

TEST(OutlineStyle, JoinedLettersAreOneArea) {
    // Amiri's letters overlap where they join: no drone stands on an outline inside the word.
    const TextSource source = written("بببب", "Amiri", TextStyle::outline);
    const Points points = built(part_of(source, 150, wide(100))).points_m;
    const Region raw = outline_text(source).value();
    const Bounds box = bounds_of(raw);
    const double scale = box.size().x / 100.0;
    const auto windings = [&](const Vec2& p) {
        double turns = 0.0;
        for (const Contour& c : raw.contours) {
            for (std::size_t i = 0; i < c.size(); ++i) {
                const Vec2 a = c[i] - p, b = c[(i + 1) % c.size()] - p;
                turns += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
            }
        }
        return std::abs(turns) > 3.0;
    };
    int surrounded = 0;
    for (const Vec3& p : points) {
        const Vec2 at = 0.5 * (box.low + box.high) + scale * Vec2(p.x, p.z);
        bool inside = true;
        for (int k = 0; k < 8; ++k) {
            const double angle = std::numbers::pi * k / 4.0;
            inside = inside && windings(at + 12.0 * Vec2(std::cos(angle), std::sin(angle)));
        }
        surrounded += inside;
    }
    EXPECT_EQ(surrounded, 0);
}

TEST(SolidText, StandsOnBothFacesAndTheWallsBetween) {
    Size size = high(30);
    size.depth_m = 8.0;
    const Formation formation = built(part_of(written("AB", kBold, TextStyle::solid), 400, size));
    ASSERT_EQ(formation.points_m.size(), 400U);
    EXPECT_GE(formation.smallest_spacing_m, 2.2 - 1e-9);
    int front = 0, back = 0;
    for (const Vec3& p : formation.points_m) {
        EXPECT_LE(std::abs(p.y), 4.0 + 1e-6);
        front += p.y < -3.9;
        back += p.y > 3.9;
    }
    EXPECT_GT(front, 50);
    EXPECT_GT(back, 50);
    EXPECT_GT(400 - front - back, 50);
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
