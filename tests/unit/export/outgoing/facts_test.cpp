#include "export/outgoing/facts_json.hpp"

#include <gtest/gtest.h>

#include "export/outgoing/planned_show.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

struct Read {
    RecordedShow show;
    std::string problem;
};
Read read(const std::string& text) {
    Read result;
    const auto document = JsonDocument::parse("a.json", text);
    EXPECT_TRUE(document.ok()) << text;
    JsonProblem problem;
    if (document) read_facts(document->root(problem), result.show);
    result.problem = problem.text;
    return result;
}

std::string written(const planner::FlightPlan& plan) {
    return facts_json(PlannedShow(plan).facts(), test_seal());
}

TEST(Facts, ComeBackExactly) {
    planner::FlightPlan plan = fixed::show();
    plan.limits.min_separation_m = 1.1 + 1e-16;
    plan.limits.plane = PlaneLimits{13.0, 29.0, 31.0, 4.5, 3.5};
    const auto [show, problem] = read(written(plan));
    EXPECT_EQ(problem, "");
    EXPECT_EQ(show.title, plan.name);
    EXPECT_EQ(show.show_hash, test_seal().show_hash);
    EXPECT_EQ(show.certified, true);
    ASSERT_TRUE(show.origin && show.limits && show.airspace);
    EXPECT_EQ(show.origin->ground.longitude_deg, plan.origin.ground.longitude_deg);
    EXPECT_EQ(show.origin->ground.height_m, plan.origin.ground.height_m);
    EXPECT_EQ(show.limits->min_separation_m, plan.limits.min_separation_m);
    EXPECT_EQ(show.limits->ceiling_m, plan.limits.ceiling_m);
    EXPECT_EQ(show.limits->plane, plan.limits.plane);
    EXPECT_EQ(show.airspace->audience_m, plan.airspace.audience_m);
    ASSERT_EQ(show.airspace->obstacles.size(), 2U);
    const auto& mast = std::get<geo::Cylinder>(show.airspace->obstacles[0].shape);
    EXPECT_EQ(mast.center_m, (Vec2{30.0, 10.0}));
    EXPECT_EQ(mast.radius_m, 4.0);
    EXPECT_EQ(std::get<geo::Prism>(show.airspace->obstacles[1].shape).outline_m.size(), 3U);
    EXPECT_EQ(show.airspace->obstacles[1].base_m, 0.5);
    EXPECT_EQ(show.cues, plan.cues);
}

TEST(Facts, MayBeAbsent) {
    const auto [show, problem] = read("{}");
    EXPECT_EQ(problem, "");
    EXPECT_FALSE(show.show_hash || show.certified || show.origin || show.limits || show.airspace || show.endurance_s);
    EXPECT_EQ(read(R"({"origin":{"latitude_deg":1,"longitude_deg":2,"height_m":3,"heading_deg":4}})").problem, "");
}

TEST(Facts, ErrorsNameFileAndKey) {
    EXPECT_EQ(read(R"({"show_hash":"12"})").problem, "a.json: show_hash: must be 64 lower-case hex digits");
    EXPECT_EQ(read(R"({"certified":1})").problem.substr(0, 18), "a.json: certified:");
    EXPECT_EQ(read(R"({"origin":{"latitude_deg":91}})").problem,
              "a.json: origin.latitude_deg: must be a number from -90 to 90");
    EXPECT_EQ(read(R"({"limits":{"downwash":0.5}})").problem, "a.json: limits.min_separation_m: is missing");
    const std::string rest = R"(,"audience_m":[],"obstacles":[]}})";
    EXPECT_EQ(read(R"({"airspace":{"geofence_m":[[0,0],[1,1]])" + rest).problem,
              "a.json: airspace.geofence_m: needs at least three corners");
    EXPECT_EQ(read(R"({"airspace":{"geofence_m":[[0,0],[1,1],[1,0],[0,1]])" + rest).problem,
              "a.json: airspace.geofence_m: crosses or touches itself");
}

TEST(Facts, TextsAreEscaped) {
    EXPECT_EQ(json_text("a \"b\"\n"), R"("a \"b\"\n")");
    EXPECT_EQ(json_text("\xFF"), "\"\xEF\xBF\xBD\"");
}

}  // namespace
}  // namespace aerogram::exporter
