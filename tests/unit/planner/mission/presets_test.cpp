#include "planner/mission/presets.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mission_text.hpp"

namespace aerogram::planner::test {
namespace {

struct Row {
    const char* name;
    double separation, spacing, horizontal, up, down, acceleration, ceiling, lowest, downwash;
};

TEST(Presets, AreTheTableOfTheContract) {
    const Row rows[] = {{"dense", 1.0, 1.5, 5, 2.5, 2, 2, 120, 2.5, 1},
                        {"standard", 1.5, 2.2, 5, 2.5, 2, 2, 120, 2.5, 1},
                        {"conservative", 2.0, 3.0, 4, 2, 1.5, 1.5, 120, 2.5, 1},
                        {"indoor", 0.35, 0.5, 1.5, 1, 0.8, 1.5, 6, 0.5, 2}};
    for (const Row& row : rows) {
        const auto m = parse_with(std::string("[limits]\npreset = \"") + row.name + "\"\n");
        ASSERT_TRUE(m.ok()) << message(m);
        const Limits& l = m->limits;
        EXPECT_EQ(l.min_separation_m, row.separation) << row.name;
        EXPECT_EQ(l.formation_spacing_m, row.spacing) << row.name;
        EXPECT_EQ(l.speed_horizontal_mps, row.horizontal) << row.name;
        EXPECT_EQ(l.speed_up_mps, row.up) << row.name;
        EXPECT_EQ(l.speed_down_mps, row.down) << row.name;
        EXPECT_EQ(l.acceleration_mps2, row.acceleration) << row.name;
        EXPECT_EQ(l.jerk_mps3, 4.0 * row.acceleration) << row.name;
        EXPECT_EQ(l.ceiling_m, row.ceiling) << row.name;
        EXPECT_EQ(l.min_navigation_altitude_m, row.lowest) << row.name;
        EXPECT_EQ(l.downwash, row.downwash) << row.name;
        EXPECT_EQ(l.export_margin_m, 0.05) << row.name;
    }
}

TEST(Presets, StandardIsTheDefault) {
    const auto m = parse_with("");
    ASSERT_TRUE(m.ok()) << message(m);
    EXPECT_EQ(m->limits.min_separation_m, 1.5);
    EXPECT_EQ(m->limits.formation_spacing_m, 2.2);
}

TEST(Presets, SingleLimitsStandBesideThePreset) {
    const auto m = parse_with("[limits]\npreset = \"dense\"\nspeed_up_mps = 1\nacceleration_mps2 = 3\n");
    ASSERT_TRUE(m.ok()) << message(m);
    EXPECT_EQ(m->limits.min_separation_m, 1.0);
    EXPECT_EQ(m->limits.speed_up_mps, 1.0);
    EXPECT_EQ(m->limits.jerk_mps3, 12.0);
}

TEST(Presets, SpacingGrowsWithTheSeparation) {
    const auto wide = parse_with("[limits]\nmin_separation_m = 2\n");
    ASSERT_TRUE(wide.ok()) << message(wide);
    EXPECT_EQ(wide->limits.formation_spacing_m, 2.9);  // sqrt(2) * 2.05 = 2.899
    const auto narrow = parse_with("[limits]\nmin_separation_m = 1\n");
    ASSERT_TRUE(narrow.ok()) << message(narrow);
    EXPECT_EQ(narrow->limits.formation_spacing_m, 2.2);  // never below the preset's
    const auto explicit_spacing = parse_with("[limits]\nmin_separation_m = 2\nformation_spacing_m = 2.1\n");
    ASSERT_TRUE(explicit_spacing.ok()) << message(explicit_spacing);
    EXPECT_EQ(explicit_spacing->limits.formation_spacing_m, 2.1);
}

TEST(Presets, DefaultSpacingIsAMultipleOfFiveCentimetresAtOrAboveTheSafeOne) {
    for (int mm = 100; mm < 20000; mm += 37) {
        const double planned_m = mm / 1000.0;
        const double spacing_m = default_spacing_m(planned_m, 0.0);
        EXPECT_GE(spacing_m, std::sqrt(2.0) * planned_m - 1e-9);
        EXPECT_LT(spacing_m, std::sqrt(2.0) * planned_m + 0.05 + 1e-9);
        EXPECT_NEAR(spacing_m * 20.0, std::round(spacing_m * 20.0), 1e-9);
    }
}

}  // namespace
}  // namespace aerogram::planner::test
