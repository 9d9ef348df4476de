#include "export/picture/formation_facts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pictures.hpp"

namespace aerogram::exporter {
namespace {

std::string text_of(const FormationFacts& facts, const std::string& name) {
    for (const FactLine& line : fact_lines(facts)) {
        if (line.name == name) return line.text;
    }
    return "";
}

TEST(FormationFacts, AThreeByFourTriangle) {
    const auto facts =
        facts_of(mission_of_one("show", "triangle"), 0, formation_of({{0, 0, 30}, {3, 0, 30}, {3, 0, 34}}));
    EXPECT_EQ(facts.drones, 3U);
    EXPECT_EQ(facts.closest->first, 0U);
    EXPECT_EQ(facts.closest->second, 1U);
    EXPECT_THAT(facts.nearest_m, testing::ElementsAre(3.0, 3.0, 4.0));
    EXPECT_EQ(text_of(facts, "smallest spacing"), "3.00 m, slots 1 and 2 (asked 2.00 m)");
    EXPECT_EQ(text_of(facts, "size"), "3.0 x 0.0 x 4.0 m (width, depth, height)");
    EXPECT_EQ(text_of(facts, "heights"), "z = 30.0 to 34.0 m");
    EXPECT_EQ(text_of(facts, "coverage"), "");
}

TEST(FormationFacts, SpacingsAreInTheSeparationMetric) {
    auto mission = mission_of_one("show", "pillar");
    mission.limits.downwash = 2.0;
    const auto facts = facts_of(mission, 0, formation_of({{0, 0, 30}, {0, 0, 36}}));
    EXPECT_DOUBLE_EQ(facts.closest->distance_m, 3.0);
    EXPECT_THAT(facts.nearest_m, testing::ElementsAre(3.0, 3.0));
    EXPECT_EQ(text_of(facts, "smallest spacing"), "3.00 m, slots 1 and 2 (asked 2.00 m, downwash 2.00)");
}

TEST(FormationFacts, SpareDronesCountForSpacingsButNotForTheSize) {
    auto formation = formation_of({{0, 0, 30}, {10, 0, 30}, {0, 0, 27}});
    formation.spare[2] = true;
    const auto facts = facts_of(mission_of_one("show", "pair"), 0, formation);
    EXPECT_EQ(facts.spares, 1U);
    EXPECT_DOUBLE_EQ(facts.closest->distance_m, 3.0);
    EXPECT_THAT(facts.nearest_m, testing::ElementsAre(3.0, 10.0));
    EXPECT_EQ(facts.low_m, Vec3(0, 0, 30));
    EXPECT_EQ(text_of(facts, "drones"), "3, of which 1 is spare");
}

TEST(FormationFacts, OneDroneHasNoSpacing) {
    const auto facts = facts_of(mission_of_one("show", "dot"), 0, formation_of({{1, 2, 30}}));
    EXPECT_FALSE(facts.closest);
    EXPECT_EQ(text_of(facts, "smallest spacing"), "none, one drone alone");
    EXPECT_EQ(text_of(facts, "size"), "0.0 x 0.0 x 0.0 m (width, depth, height)");
}

TEST(FormationFacts, CoverageIsToldPartByPart) {
    auto formation = formation_of({{0, 0, 30}, {3, 0, 30}});
    formation.coverage_m = {0.756};
    const auto mission = mission_of_one("show", "area");
    EXPECT_EQ(text_of(facts_of(mission, 0, formation), "coverage"), "0.76 m to the nearest drone");
    formation.coverage_m = {std::nullopt, 1.5};
    EXPECT_EQ(text_of(facts_of(mission, 0, formation), "coverage"), "-, 1.50 m to the nearest drone, part by part");
    formation.coverage_m = {std::nullopt};
    EXPECT_EQ(text_of(facts_of(mission, 0, formation), "coverage"), "");
}

TEST(Fixed, NeverWritesMinusZero) {
    EXPECT_EQ(fixed(-0.001, 2), "0.00");
    EXPECT_EQ(fixed(-0.01, 2), "-0.01");
    EXPECT_EQ(fixed(1234.5, 0), "1234");
    EXPECT_EQ(fixed(1e300, 2).size(), 304U);
}

}  // namespace
}  // namespace aerogram::exporter
