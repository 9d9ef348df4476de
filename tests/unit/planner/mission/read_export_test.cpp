#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mission_text.hpp"

namespace aerogram::planner::test {
namespace {

using ::testing::HasSubstr;

TEST(ReadExport, DefaultsWithoutTheTables) {
    const Mission m = parse_with("").value();
    EXPECT_EQ(m.exporting.timing, WaypointTiming::none);
    EXPECT_FALSE(m.exporting.start_utc_s.has_value());
    EXPECT_EQ(m.exporting.autopilot, Autopilot::ardupilot);
    EXPECT_EQ(m.exporting.mission_items, 650u);
    EXPECT_FALSE(m.exporting.leg_speed_mps.has_value());
    EXPECT_EQ(m.exporting.vviz, VvizFlavour::verge);
    EXPECT_EQ(m.reporting.wind_mps, 8.0);
    EXPECT_EQ(m.reporting.reserve_percent, 15.0);
    EXPECT_FALSE(m.reporting.return_altitude_m.has_value());
}

TEST(ReadExport, EveryKeyOfExport) {
    const ExportWishes w = parse_with(R"([export]
timing = "absolute"
start_utc = "2026-12-31T22:00:00Z"
autopilot = "px4"
mission_items = 161
leg_speed_mps = 4
leg_speed_up_mps = 2.5
leg_speed_down_mps = 1.5
leg_acceleration_mps2 = 0.8
leg_jerk_mps3 = 2
slack_s = 0
vviz = "finale"
)")
                               .value()
                               .exporting;
    EXPECT_EQ(w.timing, WaypointTiming::absolute);
    EXPECT_EQ(w.start_utc_s, 1798754400);  // date -u -d 2026-12-31T22:00:00Z +%s
    EXPECT_EQ(w.autopilot, Autopilot::px4);
    EXPECT_EQ(w.mission_items, 161u);
    EXPECT_EQ(w.leg_speed_mps, 4.0);
    EXPECT_EQ(w.leg_speed_up_mps, 2.5);
    EXPECT_EQ(w.leg_speed_down_mps, 1.5);
    EXPECT_EQ(w.leg_acceleration_mps2, 0.8);
    EXPECT_EQ(w.leg_jerk_mps3, 2.0);
    EXPECT_EQ(w.slack_s, 0.0);
    EXPECT_EQ(w.vviz, VvizFlavour::finale);
    EXPECT_EQ(parse_with("[export]\ntiming = \"speed\"\n").value().exporting.timing, WaypointTiming::speed);
}

TEST(ReadExport, EveryKeyOfReport) {
    const ReportWishes w = parse_with(R"([report]
wind_mps = 6
reserve_percent = 20
return_altitude_m = 60
return_layer_m = 2
return_speed_mps = 3
land_speed_mps = 1
volume_gps_m = 1
volume_path_m = 2
volume_map_m = 0
volume_reaction_s = 1.5
volume_bank_deg = 30
)")
                               .value()
                               .reporting;
    EXPECT_EQ(w.wind_mps, 6.0);
    EXPECT_EQ(w.reserve_percent, 20.0);
    EXPECT_EQ(w.return_altitude_m, 60.0);
    EXPECT_EQ(w.return_layer_m, 2.0);
    EXPECT_EQ(w.return_speed_mps, 3.0);
    EXPECT_EQ(w.land_speed_mps, 1.0);
    EXPECT_EQ(w.volume_gps_m, 1.0);
    EXPECT_EQ(w.volume_path_m, 2.0);
    EXPECT_EQ(w.volume_map_m, 0.0);
    EXPECT_EQ(w.volume_reaction_s, 1.5);
    EXPECT_EQ(w.volume_bank_deg, 30.0);
}

TEST(ReadExport, WrongValuesAreToldWithWhatWouldDo) {
    const auto told = [](const std::string& line) { return message(parse_with("[export]\n" + line + "\n")); };
    EXPECT_THAT(told("timing = \"exact\""), HasSubstr("export.timing = \"exact\": must be"));
    EXPECT_THAT(told("start_utc = \"2026-02-30T22:00:00Z\""),
                HasSubstr("must be a moment such as \"2026-12-31T22:00:00Z\""));
    EXPECT_THAT(told("autopilot = \"inav\""), HasSubstr("\"ardupilot\""));
    EXPECT_THAT(told("mission_items = 1"), HasSubstr("export.mission_items = 1: must be"));
    for (const char* const key :
         {"leg_speed_mps", "leg_speed_up_mps", "leg_speed_down_mps", "leg_acceleration_mps2", "leg_jerk_mps3"})
        EXPECT_THAT(told(std::string(key) + " = 0"), HasSubstr("export." + std::string(key) + " = 0: must be > 0"));
    EXPECT_THAT(told("slack_s = -1"), HasSubstr("export.slack_s = -1: must be >= 0"));
    EXPECT_THAT(told("vviz = \"depence\""), HasSubstr("\"finale\""));
    EXPECT_THAT(told("start = 1"), HasSubstr("export.start = 1: unknown key"));
    EXPECT_THAT(message(parse_with("[report]\nwind = 8\n")), HasSubstr("report.wind = 8: unknown key"));
    EXPECT_THAT(message(parse_with("[report]\nvolume_bank_deg = 90\n")),
                HasSubstr("report.volume_bank_deg = 90: must be"));
}

}  // namespace
}  // namespace aerogram::planner::test
