#include "planner/formation/formation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "geo/units.hpp"
#include "tests/unit/planner/formation/missions.hpp"
#include "tests/unit/planner/sampling/random.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;

constexpr double kSpacing_m = 2.2;  ///< of the default limits

std::vector<Source> all_sources() {
    std::vector<Source> sources{text("THE END"), text("a8\nQ"), text("Hi.")};
    for (const ShapeKind kind :
         {ShapeKind::line, ShapeKind::grid, ShapeKind::circle, ShapeKind::sphere, ShapeKind::helix}) {
        sources.emplace_back(shape(kind));
    }
    return sources;
}

std::string failure(const Mission& mission) {
    const auto formation = build(mission);
    return formation.ok() ? "built" : formation.error().message;
}

/// A csv written for one test.
class Csv {
  public:
    explicit Csv(const std::string& words) {
        const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
        file_ = std::filesystem::path(::testing::TempDir()) / (test + ".csv");
        std::ofstream(file_) << words;
    }
    ~Csv() { std::filesystem::remove(file_); }
    Csv(const Csv&) = delete;
    Csv& operator=(const Csv&) = delete;
    [[nodiscard]] CsvSource source() const { return {file_}; }
    [[nodiscard]] std::string name() const { return file_.string(); }

  private:
    std::filesystem::path file_;
};

TEST(Formation, Property1And2EverySourceHasExactlyNSlotsAtTheSpacing) {
    for (const Source& source : all_sources()) {
        for (std::size_t n = 1; n <= 200; n = n < 40 ? n + 1 : n + 7) {
            const auto formation = build(mission_of({part_of(source, n)}));
            ASSERT_TRUE(formation.ok()) << formation.error().message;
            ASSERT_EQ(formation->points_m.size(), n);
            ASSERT_EQ(formation->colors.size(), n);
            ASSERT_EQ(formation->part.size(), n);
            if (n == 1) {
                EXPECT_EQ(formation->smallest_spacing_m, 0.0);
            } else {
                EXPECT_GE(formation->smallest_spacing_m, kSpacing_m - 1e-9) << "source " << source.index() << ", " << n;
                EXPECT_EQ(formation->smallest_spacing_m, closest_pair(formation->points_m, {}).distance_m);
            }
        }
    }
}

TEST(Formation, WithoutASizeTheSmallestTenthOfAMetreThatHoldsTheSpacingIsTaken) {
    for (const std::size_t n : {10U, 23U, 60U}) {
        const double height = box_of(built(part_of(text("E"), n)).points_m).size().z;
        EXPECT_NEAR(height * 10, std::round(height * 10), 1e-6) << n;
        const Mission lower = mission_of({part_of(text("E"), n, high(height - 0.1))});
        EXPECT_THAT(failure(lower), HasSubstr("is below formation_spacing_m = 2.2")) << n;
    }
}

TEST(Formation, FigureTwelveLettersStandTwelveBySixteenMetresAtTheSpacing) {
    for (const char c : std::string("THEND")) {
        const Formation letter = built(part_of(text(std::string(1, c)), 10, flat(12, 16)));
        EXPECT_GE(letter.smallest_spacing_m, kSpacing_m) << c;
        EXPECT_NEAR(glm::distance(box_of(letter.points_m).size(), Vec3(12, 0, 16)), 0.0, c == 'D' ? 0.5 : 1e-9) << c;
    }
}

TEST(Formation, TextStandsUprightAndReadsFromTheAudience) {
    // F has its bars at the right and at the top; the audience is at negative y and has +x on its right.
    const Points f = built(part_of(text("F"), 12, flat(12, 16))).points_m;
    for (const Vec3& p : f) EXPECT_EQ(p.y, 0.0);
    const auto corner = [&f](double x, double z) {
        return std::any_of(f.begin(), f.end(), [&](const Vec3& p) { return glm::distance(p, Vec3(x, 0, z)) < 1e-9; });
    };
    EXPECT_TRUE(corner(-6, 8) && corner(6, 8) && corner(-6, -8));
    EXPECT_FALSE(corner(6, -8));
}

TEST(Formation, Property3EndsAndCornersOfStrokesAreOccupied) {
    const Points e = built(part_of(text("E"), 6, flat(13, 21))).points_m;  // the font's own units
    const Points wanted{{-6.5, 0, 10.5}, {6.5, 0, 10.5},   {-6.5, 0, 0.5},
                        {1.5, 0, 0.5},   {-6.5, 0, -10.5}, {6.5, 0, -10.5}};
    for (const Vec3& w : wanted) {
        EXPECT_TRUE(std::any_of(e.begin(), e.end(), [&](const Vec3& p) { return glm::distance(p, w) < 1e-9; }))
            << w.x << ' ' << w.z;
    }
}

TEST(Formation, OneSideOfTheSizeKeepsTheAspect) {
    const Vec3 by_height = box_of(built(part_of(text("E"), 10, high(42))).points_m).size();
    EXPECT_NEAR(by_height.x, 26.0, 1e-9);
    EXPECT_NEAR(by_height.z, 42.0, 1e-9);
    const Vec3 by_width = box_of(built(part_of(text("E"), 10, wide(26))).points_m).size();
    EXPECT_NEAR(by_width.z, 42.0, 1e-9);
}

TEST(Formation, ALetterWithoutWidthTakesItsHeightFromTheSize) {
    const Vec3 size = box_of(built(part_of(text("I"), 5, flat(12, 16))).points_m).size();
    EXPECT_NEAR(size.x, 0.0, 1e-12);
    EXPECT_NEAR(size.z, 16.0, 1e-12);
}

TEST(Formation, TurnsAboutXThenYThenZAroundItsCentre) {
    Part part = part_of(shape(ShapeKind::line), 3, wide(10));
    part.center_m = {1, 2, 3};
    part.rotate_rad = {0, radians(90), 0};  // +x goes to -z
    EXPECT_NEAR(glm::distance(built(part).points_m[2], Vec3(1, 2, -2)), 0.0, 1e-12);
    part.rotate_rad = {0, 0, radians(90)};  // +x goes to +y
    EXPECT_NEAR(glm::distance(built(part).points_m[2], Vec3(1, 7, 3)), 0.0, 1e-12);
    part.rotate_rad = {radians(90), 0, radians(90)};
    EXPECT_NEAR(glm::distance(built(part).points_m[2], Vec3(1, 7, 3)), 0.0, 1e-12);
    part.source = text("I");
    part.size = high(10);                             // from (0, 0, 5) down to (0, 0, -5)
    part.rotate_rad = {radians(90), 0, radians(90)};  // z to -y, then to +x
    EXPECT_NEAR(glm::distance(built(part).points_m[0], Vec3(6, 2, 3)), 0.0, 1e-12);
    part.rotate_rad = {radians(-90), radians(90), 0};  // z to +y, which y keeps
    EXPECT_NEAR(glm::distance(built(part).points_m[0], Vec3(1, 7, 3)), 0.0, 1e-12);
}

TEST(Formation, RandomTurnsKeepDistancesAndHandedness) {
    constexpr std::uint64_t kSeed = 21;
    SCOPED_TRACE(kSeed);
    Random random(kSeed);
    const Points straight = built(part_of(shape(ShapeKind::helix), 12, {20, 20, 20})).points_m;
    for (std::size_t round = 0; round < cases(50); ++round) {
        Part part = part_of(shape(ShapeKind::helix), 12, {20, 20, 20});
        part.rotate_rad = random.point(kPi);
        const Points turned = built(part).points_m;
        for (std::size_t i = 0; i < 12; ++i) {
            EXPECT_NEAR(glm::length(turned[i]), glm::length(straight[i]), 1e-9);
            EXPECT_NEAR(glm::distance(turned[i], turned[0]), glm::distance(straight[i], straight[0]), 1e-9);
        }
        const auto volume = [](const Points& p) { return glm::dot(p[1], glm::cross(p[5], p[8])); };
        EXPECT_NEAR(volume(turned), volume(straight), 1e-9 * 1000);
    }
}

TEST(Formation, PartsStandInOrderUnderTheKeyframesOwnPlaceAndTurn) {
    Part left = part_of(shape(ShapeKind::line), 3, wide(10)), right = part_of(text("T"), 5, flat(8, 10));
    left.center_m = {-20, 0, 0};
    right.center_m = {20, 0, 0};
    Mission mission = mission_of({left, right});
    mission.keyframes[0].center_m = {0, 100, 50};
    mission.keyframes[0].rotate_rad = {0, 0, radians(90)};
    const Formation formation = build(mission).value();
    EXPECT_EQ(formation.part, (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1, 1, 1}));
    EXPECT_NEAR(glm::distance(formation.points_m[0], Vec3(0, 75, 50)), 0.0, 1e-12);
    for (std::size_t i = 3; i < 8; ++i) EXPECT_GE(formation.points_m[i].y, 116.0 - 1e-9);
}

TEST(Formation, ColoursAreThePartsElseTheSourcesElseWhite) {
    const Csv csv("x,y,z,Red,Green,Blue\n0,0,0,255,0,0\n5,0,0,0,0,255\n");
    Part plain = part_of(csv.source(), 2), painted = plain;
    painted.color = Rgb{0.0, 1.0, 0.0};
    painted.center_m = {0, 20, 0};
    Part white = part_of(shape(ShapeKind::line), 1);
    white.center_m = {0, 40, 0};
    const Formation formation = build(mission_of({plain, painted, white})).value();
    const Rgb red{1, 0, 0}, blue{0, 0, 1}, green{0, 1, 0};
    EXPECT_EQ(formation.colors, (std::vector<Rgb>{red, blue, green, green, {1, 1, 1}}));
}

TEST(Formation, ACsvIsUsedAsItIsRelativeToTheCentre) {
    const Csv csv("Name,x_m,y_m,z_m\na,10,1,2\nb,20,1,2\n");
    Part part = part_of(csv.source(), 2);
    part.center_m = {100, 0, 0};
    EXPECT_EQ(built(part).points_m, (Points{{110, 1, 2}, {120, 1, 2}}));
    part.size = wide(30);
    const Points scaled = built(part).points_m;  // about the csv's own origin; flat sides follow
    EXPECT_NEAR(glm::distance(scaled[0], Vec3(130, 3, 6)), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(scaled[1], Vec3(160, 3, 6)), 0.0, 1e-9);
}

TEST(Formation, Property4TheSameMissionGivesTheSameBytes) {
    for (const Source& source : all_sources()) {
        const Mission mission = mission_of({part_of(source, 57)});
        const Formation first = build(mission).value(), second = build(mission).value();
        EXPECT_EQ(first.points_m, second.points_m);
    }
}

TEST(Formation, AStoppedRunSaysSo) {
    std::stop_source stop;
    stop.request_stop();
    aerogram::Run run;
    run.stop = stop.get_token();
    const auto formation = build_formation(mission_of({part_of(shape(ShapeKind::sphere), 50)}), 0, run);
    ASSERT_FALSE(formation.ok());
    EXPECT_EQ(formation.error().code, ErrorCode::stopped);
}

TEST(FormationErrors, TooSmallASizeSaysWhatIsNeededAndThatSuffices) {
    Mission mission = mission_of({part_of(text("E"), 10, flat(6, 8))});
    const std::string message = failure(mission);
    EXPECT_EQ(
        message,
        "show.toml:7: keyframe[1].size_m: smallest spacing 2.00 m (slots 1 and 5) is below formation_spacing_m = 2.2; "
        "needs size_m >= [6.6, 8.8]");
    mission.keyframes[0].parts[0].size = flat(6.6, 8.8);
    EXPECT_EQ(failure(mission), "built");
}

TEST(FormationErrors, TheNeededSizeAlwaysSuffices) {
    for (const Source& source : all_sources()) {
        if (std::holds_alternative<TextSource>(source) && std::get<TextSource>(source).text == "Hi.") continue;
        for (const std::size_t n : {7U, 16U, 41U}) {
            const bool solid = source.index() == 2 && (std::get<ShapeSource>(source).kind == ShapeKind::sphere ||
                                                       std::get<ShapeSource>(source).kind == ShapeKind::helix);
            Mission mission = mission_of({part_of(source, n, solid ? Size{3, 2, 4} : flat(3, 2))});
            const std::string message = failure(mission);
            ASSERT_THAT(message, HasSubstr("needs size_m >= ["));
            double x = 0, y = 0, z = 0;
            const char* list = message.c_str() + message.find(">= ") + 3;
            const int read = std::sscanf(list, "[%lf, %lf, %lf]", &x, &y, &z);
            ASSERT_EQ(read, solid ? 3
                            : std::holds_alternative<ShapeSource>(source) &&
                                    std::get<ShapeSource>(source).kind == ShapeKind::line
                                ? 1
                                : 2)
                << message;
            mission.keyframes[0].parts[0].size = solid ? Size{x, y, z} : read == 1 ? wide(x) : flat(x, y);
            EXPECT_EQ(failure(mission), "built") << message;
        }
    }
}

TEST(FormationErrors, DownwashWidensUprightSpacings) {
    Mission mission = mission_of({part_of(text("I"), 4, high(6.6))});
    EXPECT_EQ(failure(mission), "built");
    mission.limits.downwash = 2.0;
    EXPECT_EQ(
        failure(mission),
        "show.toml:7: keyframe[1].size_m: smallest spacing 1.10 m (slots 1 and 2) is below formation_spacing_m = 2.2; "
        "needs size_m >= { height = 13.2 }");
    mission.keyframes[0].parts[0].rotate_rad = {radians(90), 0, 0};  // lying flat
    EXPECT_EQ(failure(mission), "built");
}

TEST(FormationErrors, PartsTooCloseToEachOtherAreNamed) {
    Part upper = part_of(shape(ShapeKind::line), 3, wide(10)), lower = upper;
    upper.center_m = {0, 0, 1.5};
    upper.line = 12;
    EXPECT_EQ(failure(mission_of({lower, upper})),
              "show.toml:12: keyframe[1].part[2].center_m: smallest spacing 1.50 m (slots 1 and 4) is below "
              "formation_spacing_m = 2.2; move it away from keyframe[1].part[1]");
}

TEST(FormationErrors, PointsInTheSamePlaceCannotBeHelpedBySize) {
    const Csv csv("x,y,z\n0,0,0\n5,0,0\n0,0,0\n");
    EXPECT_EQ(failure(mission_of({part_of(csv.source(), 3)})),
              "show.toml:7: keyframe[1]: smallest spacing 0.00 m (slots 1 and 3) is below formation_spacing_m = 2.2; "
              "no size_m can part points in the same place");
}

TEST(FormationErrors, TooLowAndTooHighSlotsAreNamed) {
    Mission mission = mission_of({part_of(text("I"), 5, high(110))});
    mission.limits.ceiling_m = 120.0;
    mission.keyframes[0].center_m = {0, 0, 50};
    EXPECT_EQ(failure(mission),
              "show.toml:7: keyframe[1].center_m: slot 5 stands at z = -5.00 m, below min_navigation_altitude_m = 2.5; "
              "raise it by 7.5 m");
    mission.keyframes[0].center_m = {0, 0, 70};
    EXPECT_EQ(
        failure(mission),
        "show.toml:7: keyframe[1].center_m: slot 1 stands at z = 125.00 m, above ceiling_m = 120; lower it by 5 m");
}

/// It was told to be raised and lowered at once.
TEST(FormationErrors, WhatIsTooTallForTheAirIsTold) {
    Mission mission = mission_of({part_of(text("I"), 5, high(130))});
    mission.limits.ceiling_m = 120.0;
    mission.keyframes[0].center_m = {0, 0, 60};
    EXPECT_EQ(failure(mission),
              "show.toml:7: keyframe[1].size_m: stands 130 m high; at most 117.5 m fit between "
              "min_navigation_altitude_m = 2.5 and ceiling_m = 120");
}

TEST(FormationErrors, AWrongCsvIsNamedByItsOwnLine) {
    const Csv csv("x,y,z\n0,0,0\n5,0\n");
    EXPECT_EQ(failure(mission_of({part_of(csv.source(), 2)})), csv.name() + ":3: 2 fields, expected 3");
}

TEST(FormationErrors, AMissingCsvIsAnIoError) {
    const auto formation = build(mission_of({part_of(CsvSource{"no/such.csv"}, 2)}));
    ASSERT_FALSE(formation.ok());
    EXPECT_EQ(formation.error().code, ErrorCode::io);
    EXPECT_EQ(formation.error().message, "show.toml:7: keyframe[1].csv = \"no/such.csv\": cannot be read");
}

TEST(FormationErrors, TextThatCannotBeDrawnIsNamed) {
    EXPECT_EQ(failure(mission_of({part_of(text("\xC3\x84"), 5)})),
              "show.toml:7: keyframe[1].text = \"\xC3\x84\": character \"\xC3\x84\" (U+00C4) is not in the stroke "
              "font, which has "
              "the printable characters of ASCII");
    EXPECT_EQ(failure(mission_of({part_of(text("..."), 5)})),
              "show.toml:7: keyframe[1].text = \"...\": has only dots: 3 places for 5 drones");
}

}  // namespace
}  // namespace aerogram::planner::testing
