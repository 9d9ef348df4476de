#include "export/waypoint/waypoints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "export/verify/judge.hpp"
#include "tests/unit/export/waypoint/missions_read_back.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

Result<RecordedShow> read(const std::string& text) {
    return read_waypoints(std::vector<FileBytes>{{"waypoints/ann.waypoints", text}});
}
std::string error_of(const std::string& text) {
    const auto show = read(text);
    return show ? "none" : show.error().message;
}
const std::string kHome = "0\t1\t0\t16\t0\t0\t0\t0\t35.1\t139.7\t3.3\t1\n";
const std::string kUp = "1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t10\t1\n";

TEST(Waypoints, WritesTheseBytes) {
    expect_golden("waypoints.txt", unpacked_text(written_files(waypoints_format(), fixed::show())));
}

/// FORMATS.md 5: the exact first line, 12 fields split by single tabs, eight decimals, no blank lines, nothing
/// trailing.
TEST(Waypoints, KeepTheLoadersRules) {
    const auto files = written_files(waypoints_format(), fixed::show());
    ASSERT_EQ(files.size(), 3u);
    EXPECT_EQ(files[2].path, "waypoints/drone-003.waypoints");
    const std::regex item(
        "\\d+\t[01]\t[03]\t\\d+\t\\d+\t0\t0\t0\t-?\\d+\\.\\d{8}\t-?\\d+\\.\\d{8}\t-?\\d+\\.\\d{3}\t1");
    for (const FileBytes& file : files) {
        EXPECT_TRUE(waypoints_format().recognises(file.path, file.bytes));
        std::istringstream lines(file.bytes);
        std::string line;
        std::getline(lines, line);
        EXPECT_EQ(line, "QGC WPL 110");
        std::size_t count = 0;
        for (; std::getline(lines, line); ++count) {
            EXPECT_TRUE(std::regex_match(line, item)) << line;
            EXPECT_THAT(line,
                        ::testing::StartsWith(std::to_string(count) + (count == 0 ? "\t1\t0\t16\t" : "\t0\t3\t")));
        }
        EXPECT_EQ(count, 6u);
        EXPECT_EQ(file.bytes.back(), '\n');
    }
}

TEST(Waypoints, ReadBackWithinTheStatedRounding) {
    expect_goes_where_the_plan_goes(read_back(waypoints_format(), written_files(waypoints_format(), fixed::show())));
}

TEST(Waypoints, TheirJudgeClaimsNoSeparationAndFindsNothingWrong) {
    JudgeAgainst against;
    against.origin = fixed::show().origin;
    against.airspace = fixed::show().airspace;
    const auto judgement = judge(read_back(waypoints_format(), written_files(waypoints_format(), fixed::show())),
                                 against, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    EXPECT_FALSE(judgement->separation_claimed);
    EXPECT_FALSE(judgement->findings.empty());
    for (const Finding& finding : judgement->findings)
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
}

using planner::Autopilot, planner::WaypointTiming;

TEST(Waypoints, OfAbsoluteTimingAreTheseBytes) {
    expect_golden("waypoints-absolute.txt",
                  unpacked_text(written_files(waypoints_format(), timed_show(WaypointTiming::absolute))));
}

/// The file tells times of day; its show times count from the first wait.
TEST(Waypoints, OfAbsoluteTimingLeaveWhenThePlanLeaves) {
    const RecordedShow show =
        read_back(waypoints_format(), written_files(waypoints_format(), timed_show(WaypointTiming::absolute)));
    expect_goes_where_the_plan_goes(show, 1.0);
    expect_leaves_when_the_plan_leaves(show, 8.0);
    expect_standing_is_judged(show);
}

TEST(Waypoints, OfSpeedTimingSetASpeedForEachLeg) {
    const RecordedShow show =
        read_back(waypoints_format(), written_files(waypoints_format(), timed_show(WaypointTiming::speed)));
    expect_goes_where_the_plan_goes(show);
    EXPECT_EQ(show.timing, "speed: legs 0.5 to 5 s late, vehicles up to 4 s apart");
}

TEST(Waypoints, ForPx4HaveNoHomeItem) {
    const auto files = written_files(waypoints_format(), timed_show(WaypointTiming::none, Autopilot::px4));
    EXPECT_THAT(files[0].bytes, ::testing::StartsWith("QGC WPL 120\n0\t1\t3\t22\t0\t0\t0\t0\t"));
    const RecordedShow show = read_back(waypoints_format(), files);
    EXPECT_FALSE(show.drones[0].home_amsl_m.has_value());
    expect_goes_where_the_plan_goes(show);
    JudgeAgainst against;
    against.origin = fixed::show().origin;
    against.airspace = fixed::show().airspace;
    EXPECT_TRUE(judge(show, against, aerogram::Run{})->held());
}

TEST(Waypoints, ReadWhatOthersWrite) {
    const auto show = read(
        "QGC WPL 110\r\n0\t1\t0\t16\t0.000000\t0\t0\t0\t35.1\t139.7\t3.3\t1\r\n"
        "1\t0\t3\t22\t0\t0\t0\t0\t0.0\t0.0\t10\t1\r\n2\t0\t0\t16\t5\t0\t0\t0\t35.2\t139.8\t23.3\t1\r\n"
        "3\t0\t3\t178\t1\t5\t0\t0\t0\t0\t0\t1\r\n4\t0\t3\t20\t0\t0\t0\t0\t0\t0\t0\t1\r\n\r\n");
    ASSERT_TRUE(show.ok()) << show.error().message;
    const RecordedDrone& drone = show->drones[0];
    EXPECT_EQ(drone.name, "ann");
    ASSERT_EQ(drone.waypoints.size(), 3u);
    EXPECT_EQ(drone.waypoints[1].altitude_above_home_m, 20.0);
    EXPECT_EQ(drone.waypoints[1].hold_s, 5.0);
    EXPECT_EQ(drone.waypoints[2].kind, Waypoint::Kind::land);
}

TEST(Waypoints, ErrorsNameFileAndLine) {
    const std::string head = "QGC WPL 110\n", at = "waypoints/ann.waypoints:";
    EXPECT_EQ(error_of(""), at + "1: must be \"QGC WPL 110\" or \"QGC WPL 120\"");
    EXPECT_EQ(error_of("QGC WPL 130\n"), at + "1: must be \"QGC WPL 110\" or \"QGC WPL 120\"");
    EXPECT_EQ(error_of("QGC WPL 120\n" + kUp), at + "2: seq: must be 0");
    EXPECT_EQ(error_of(head + kHome), at + "3: needs a home and at least one place to fly to");
    EXPECT_EQ(error_of(head + kUp), at + "2: seq: must be 0");
    EXPECT_EQ(error_of(head + kHome + kHome), at + "3: seq: must be 1");
    EXPECT_EQ(error_of(head + "0\t1\t3\t16\t0\t0\t0\t0\t35\t139\t3\t1\n" + kUp),
              at + "2: item 0 must be the home: frame 0, command 16");
    EXPECT_EQ(error_of(head + kHome + "\n" + kUp), at + "3: seq = \"\": must be a whole number from 0 to 65536");
    EXPECT_EQ(error_of(head + kHome + "1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t10\t1\t\n"),
              at + "3: must be 12 fields split by single tabs");
    EXPECT_EQ(error_of(head + kHome + "1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t10\n"),
              at + "3: autocontinue = \"\": must be a whole number from 0 to 1");
    EXPECT_EQ(error_of(head + kHome + "1\t0\t3\t22\t0\t0\t0\t0\t35,1\t0\t10\t1\n"),
              at + "3: \"35,1\": must be a number");
    EXPECT_THAT(error_of(head + kHome + "1\t0\t3\t84\t0\t0\t0\t0\t0\t0\t10\t1\n"), HasSubstr(at + "3: command 84"));
    EXPECT_THAT(error_of(head + "0\t1\t0\t16\t0\t0\t0\t0\t95\t139\t3\t1\n"), HasSubstr(at + "2: latitude"));
}

TEST(Waypoints, DamagedInputIsRefusedNotCrashedOn) {
    const std::string text = written_files(waypoints_format(), fixed::show())[1].bytes;
    std::size_t refused = 0;
    for_damaged(text, 2'000, [&](const std::string& damaged) { refused += read(damaged).ok() ? 0u : 1u; });
    EXPECT_GT(refused, 500u);
    const std::string timed = written_files(waypoints_format(), timed_show(planner::WaypointTiming::absolute))[0].bytes;
    refused = 0;
    for_damaged(timed, 2'000, [&](const std::string& damaged) { refused += read(damaged).ok() ? 0u : 1u; });
    EXPECT_GT(refused, 500u);
}

}  // namespace
}  // namespace aerogram::exporter
