#include "export/waypoint/qgc_plan.hpp"
#include "export/outgoing/planned_show.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/bytes/json_document.hpp"
#include "export/verify/judge.hpp"
#include "tests/unit/export/waypoint/missions_read_back.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Result<RecordedShow> read(const std::string& text) {
    return read_qgc_plan(std::vector<FileBytes>{{"qgc/ann.plan", text}});
}
std::string error_of(const std::string& text) {
    const auto show = read(text);
    return show ? "none" : show.error().message;
}

std::string plan_with(const std::string& items) {
    return R"({"fileType":"Plan","groundStation":"QGroundControl","version":1,"mission":{"version":2,"firmwareType":12,
        "plannedHomePosition":[35.1,139.7,3.3],"items":[)" +
           items + R"(]},"geoFence":{"version":2,"circles":[],
        "polygons":[]},"rallyPoints":{"version":2,"points":[]}})";
}
std::string item(const std::string& changes) {
    return R"({"type":"SimpleItem","autoContinue":true,"doJumpId":1,)" + changes + "}";
}

TEST(QgcPlan, WritesTheseBytes) {
    expect_golden("qgc.txt", unpacked_text(written_files(qgc_plan_format(), fixed::show())));
}

void expect_pair(const JsonNode& corner) {
    EXPECT_EQ(corner.size(), 2u);
    static_cast<void>(corner.at(0).number(-90.0, 90.0));
    static_cast<void>(corner.at(1).number(-180.0, 180.0));
}

/// What the loader insists on (FORMATS.md 5); wrong JSON types fail its load.
void expect_loader_rules(const JsonNode& root) {
    EXPECT_EQ(root["fileType"].text(), "Plan");
    EXPECT_FALSE(root["groundStation"].text().empty());
    EXPECT_EQ(root["version"].whole(1, 1), 1);
    const JsonNode mission = root["mission"];
    EXPECT_EQ(mission["firmwareType"].whole(3, 3), 3);
    EXPECT_EQ(mission["version"].whole(2, 2), 2);
    EXPECT_EQ(mission["vehicleType"].whole(2, 2), 2);
    EXPECT_GT(mission["cruiseSpeed"].number(0.1, 100.0), 0.0);
    EXPECT_GT(mission["hoverSpeed"].number(0.1, 100.0), 0.0);
    EXPECT_EQ(mission["plannedHomePosition"].size(), 3u);
    const JsonNode items = mission["items"];
    EXPECT_EQ(items.size(), 5u);
    for (std::size_t k = 0; k < items.size(); ++k) {
        const JsonNode simple = items.at(k);
        EXPECT_EQ(simple["type"].text(), "SimpleItem");
        EXPECT_EQ(simple["frame"].whole(3, 3), 3);
        static_cast<void>(simple["command"].whole(16, 22));
        EXPECT_TRUE(simple["autoContinue"].flag());
        EXPECT_EQ(simple["doJumpId"].whole(1, 5), static_cast<std::int64_t>(k + 1));
        const JsonNode params = simple["params"];
        ASSERT_EQ(params.size(), 7u);
        for (std::size_t p = 0; p < 7; ++p) static_cast<void>(params.at(p).number(-180.0, 1000.0));
        for (const char* key : {"AltitudeMode", "Altitude", "AMSLAltAboveTerrain"}) EXPECT_FALSE(simple.find(key));
    }
    const JsonNode fence = root["geoFence"], rally = root["rallyPoints"];
    EXPECT_EQ(fence["version"].whole(2, 2), 2);
    EXPECT_EQ(fence["circles"].size(), 0u);
    const JsonNode polygons = fence["polygons"];
    ASSERT_EQ(polygons.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(polygons.at(k)["version"].whole(1, 1), 1);
        EXPECT_EQ(polygons.at(k)["inclusion"].flag(), k == 0);  // the fence, then the audience
        const JsonNode corners = polygons.at(k)["polygon"];
        EXPECT_EQ(corners.size(), k == 0 ? 5u : 4u);
        for (std::size_t c = 0; c < corners.size(); ++c) expect_pair(corners.at(c));
    }
    EXPECT_EQ(rally["version"].whole(2, 2), 2);
    ASSERT_EQ(rally["points"].size(), 1u);
    EXPECT_EQ(rally["points"].at(0).size(), 3u);
}

TEST(QgcPlan, KeepsTheLoadersRules) {
    const auto files = written_files(qgc_plan_format(), fixed::show());
    ASSERT_EQ(files.size(), 3u);
    EXPECT_EQ(files[0].path, "qgc/drone-001.plan");
    for (const FileBytes& file : files) {
        EXPECT_TRUE(qgc_plan_format().recognises(file.path, file.bytes));
        EXPECT_TRUE(qgc_plan_format().recognises("renamed", file.bytes));
        EXPECT_THAT(file.bytes, Not(HasSubstr("null")));
        const auto document = JsonDocument::parse(file.path, file.bytes);
        ASSERT_TRUE(document.ok());
        JsonProblem problem;
        expect_loader_rules(document->root(problem));
        EXPECT_EQ(problem.text, "");
    }
}

TEST(QgcPlan, ReadsBackWithinTheStatedRounding) {
    const RecordedShow show =
        read_back(qgc_plan_format(), written_files(qgc_plan_format(), fixed::show(), test_seal(false)));
    expect_goes_where_the_plan_goes(show);
    EXPECT_EQ(show.title, fixed::show().name);
    EXPECT_EQ(show.show_hash, test_seal().show_hash);
    EXPECT_EQ(show.certified, false);
}

TEST(QgcPlan, ItsJudgeClaimsNoSeparationAndFindsNothingWrong) {
    JudgeAgainst against;
    against.origin = fixed::show().origin;
    against.airspace = fixed::show().airspace;
    const auto judgement =
        judge(read_back(qgc_plan_format(), written_files(qgc_plan_format(), fixed::show())), against, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    EXPECT_FALSE(judgement->separation_claimed);
    for (const Finding& finding : judgement->findings)
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
}

using planner::Autopilot, planner::WaypointTiming;

TEST(QgcPlan, AbsoluteMissionsAreTheseBytes) {
    expect_golden("qgc-absolute.txt",
                  unpacked_text(written_files(qgc_plan_format(), timed_show(WaypointTiming::absolute))));
}

TEST(QgcPlan, AbsoluteMissionsLeaveWhenThePlanLeaves) {
    const auto files = written_files(qgc_plan_format(), timed_show(WaypointTiming::absolute));
    EXPECT_THAT(files[0].bytes, HasSubstr(R"("timing": "absolute: separation is not claimed")"));
    EXPECT_THAT(files[0].bytes, HasSubstr(R"("startUtc": "2026-12-31T23:59:50Z")"));
    const RecordedShow show = read_back(qgc_plan_format(), files);
    expect_goes_where_the_plan_goes(show, 1.0);
    expect_leaves_when_the_plan_leaves(show, 0.0);
    expect_standing_is_judged(show);
}

TEST(QgcPlan, SpeedMissionsSayHowInaccurateTheyAre) {
    const auto files = written_files(qgc_plan_format(), timed_show(WaypointTiming::speed));
    EXPECT_THAT(files[0].bytes,
                HasSubstr("\"speed: legs 0.5 to 5 s late, vehicles up to 4 s apart: separation is not"));
    const RecordedShow show = read_back(qgc_plan_format(), files);
    expect_goes_where_the_plan_goes(show);
    EXPECT_EQ(show.timing, "speed: legs 0.5 to 5 s late, vehicles up to 4 s apart");
    for (const RecordedDrone& drone : show.drones)
        for (std::size_t k = 1; k < 4; ++k) EXPECT_TRUE(drone.waypoints[k].speed_mps.has_value());
}

TEST(QgcPlan, ForPx4TurnAsTheyLike) {
    const auto files = written_files(qgc_plan_format(), timed_show(WaypointTiming::none, Autopilot::px4));
    EXPECT_THAT(files[0].bytes, HasSubstr("\"firmwareType\": 12"));
    EXPECT_THAT(files[0].bytes, HasSubstr("null"));
    expect_goes_where_the_plan_goes(read_back(qgc_plan_format(), files));
}

TEST(QgcPlan, ThatSaysAnotherTimingThanItsItemsIsRefused) {
    auto files = written_files(qgc_plan_format(), timed_show(WaypointTiming::absolute));
    for (FileBytes& file : files) {
        const std::string from = "\"absolute: sep";
        file.bytes.replace(file.bytes.find(from), from.size(), "\"none: sep");
    }
    EXPECT_EQ(read_qgc_plan(files).error().message,
              "qgc/drone-001.plan: aerogram.timing: is not what the items do: absolute");
}

TEST(QgcPlan, OfOursKeepsEveryRuleOfTheLoader) {
    std::string text = written_files(qgc_plan_format(), fixed::show())[0].bytes;
    text.replace(text.find("\"doJumpId\": 2"), 13, "\"doJumpId\": 3");
    EXPECT_THAT(error_of(text), HasSubstr("mission.items[1].doJumpId: rule 7: must be 2"));
}

TEST(QgcPlan, RefusesAShowWithoutAGeoid) {
    planner::FlightPlan plan = fixed::show();
    plan.origin.geoid_undulation_m.reset();
    EXPECT_THAT(qgc_plan_format().unsuited(PlannedShow(plan)), HasSubstr("needs geoid_undulation_m"));
    const ScratchFolder folder;
    EXPECT_FALSE(qgc_plan_format().write(PlannedShow(plan), test_seal(), folder.path(), aerogram::Run{}).ok());
}

TEST(QgcPlan, ReadsWhatOthersWrite) {
    const auto show =
        read(plan_with(item(R"("frame":3,"command":22,"params":[0,0,0,null,0,0,12],"Altitude":12,"AltitudeMode":1)") +
                       "," + item(R"("frame":0,"command":16,"params":[1.5,0,0,null,35.2,139.8,23.3])") + "," +
                       item(R"("frame":2,"command":178,"params":[1,5,-1,0,0,0,0])") + "," +
                       item(R"("frame":2,"command":20,"params":[0,0,0,0,0,0,0])")));
    ASSERT_TRUE(show.ok()) << show.error().message;
    ASSERT_EQ(show->drones[0].waypoints.size(), 3u);
    EXPECT_EQ(show->drones[0].waypoints[1].altitude_above_home_m, 20.0);
    EXPECT_FALSE(show->show_hash || show->certified);
}

TEST(QgcPlan, ErrorsNameFileAndKey) {
    const std::string at = "qgc/ann.plan: ", good = R"("frame":3,"command":16,"params":[0,0,0,0,35,139,9])";
    EXPECT_EQ(error_of("{"), at + "byte 2: is not JSON");
    EXPECT_EQ(error_of("[]"), at + "must be an object");
    EXPECT_EQ(error_of("{}"), at + "fileType: is missing");
    EXPECT_EQ(error_of(R"({"fileType":"Fence"})"), at + "fileType: must be \"Plan\"");
    EXPECT_EQ(error_of(plan_with("")), at + "mission.items: needs at least one place to fly to");
    EXPECT_EQ(error_of(plan_with(R"({"type":"ComplexItem"})")),
              at + "mission.items[0].type: must be \"SimpleItem\"; others are not read");
    EXPECT_EQ(error_of(plan_with(item(R"("frame":3,"command":16,"params":[1])"))),
              at + "mission.items[0].params: must be exactly 7 numbers or nulls");
    EXPECT_EQ(error_of(plan_with(item(R"("frame":3,"command":16,"params":[0,0,0,0,"35",139,9])"))),
              at + "mission.items[0].params[4]: must be a number from -1e+09 to 1e+09");
    EXPECT_EQ(error_of(plan_with(item(R"("frame":3.5,"command":16,"params":[])"))),
              at + "mission.items[0].frame: must be a whole number from 0 to 255");
    EXPECT_THAT(error_of(plan_with(item(good) + "," + item(R"("frame":3,"command":17,"params":[0,0,0,0,0,0,0])"))),
                HasSubstr(at + "mission.items[1]: command 17: only"));
}

TEST(QgcPlan, RefusesPlansOfDifferentShows) {
    auto files = written_files(qgc_plan_format(), fixed::show());
    files[1] = written_files(qgc_plan_format(), fixed::show(), test_seal(false))[1];
    const auto show = read_qgc_plan(files);
    ASSERT_FALSE(show.ok());
    EXPECT_EQ(show.error().message, "qgc/drone-002.plan: aerogram: says another show than the file before");
}

TEST(QgcPlan, DamagedInputIsRefusedNotCrashedOn) {
    const std::string text = written_files(qgc_plan_format(), fixed::show())[0].bytes;
    std::size_t refused = 0;
    for_damaged(text, 2'000, [&](const std::string& damaged) { refused += read(damaged).ok() ? 0u : 1u; });
    EXPECT_GT(refused, 500u);
    const std::string timed = written_files(qgc_plan_format(), timed_show(planner::WaypointTiming::absolute))[0].bytes;
    refused = 0;
    for_damaged(timed, 2'000, [&](const std::string& damaged) { refused += read(damaged).ok() ? 0u : 1u; });
    EXPECT_GT(refused, 500u);
}

}  // namespace
}  // namespace aerogram::exporter
