#include "export/waypoint/plan_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

/// Uses everything that a plan may hold.
const std::string kGood = R"({"fileType":"Plan","groundStation":"QGroundControl","version":1,
"mission":{"version":2,"firmwareType":12,"vehicleType":2,"cruiseSpeed":15,"hoverSpeed":5.5,
"plannedHomePosition":[35.1,139.7,3.3],"items":[
{"type":"SimpleItem","frame":3,"command":22,"params":[0,0,0,null,35.1,139.7,12],"autoContinue":true,"doJumpId":1,
"AltitudeMode":1,"Altitude":12,"AMSLAltAboveTerrain":null},
{"type":"SimpleItem","frame":3,"command":82,"params":[0,0,0,0,35.2,139.8,12],"autoContinue":false,"doJumpId":2}]},
"geoFence":{"version":2,"polygons":[{"version":1,"inclusion":true,"polygon":[[35,139],[36,139],[35,140]]}],
"circles":[{"version":1,"inclusion":false,"circle":{"center":[35,139.5],"radius":12.5}}]},
"rallyPoints":{"version":2,"points":[[35.1,139.7,20]]}})";

std::string broken_rule(const std::string& text) {
    const auto document = JsonDocument::parse("a.plan", text);
    if (!document) return document.error().message;
    JsonProblem problem;
    check_plan_rules(document->root(problem));
    return problem.text;
}
/// The good plan with one place changed.
std::string with(const std::string& what, const std::string& by) {
    const std::size_t at = kGood.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return std::string(kGood).replace(at, what.size(), by);
}

TEST(PlanRules, HoldForAPlanWithEverythingInIt) {
    EXPECT_EQ(broken_rule(kGood), "");
}

TEST(PlanRules, EveryOneIsChecked) {
    struct Case {
        std::string what, by, problem;
    };
    const std::vector<Case> cases{
        {R"("fileType":"Plan",)", "", "rule 1: fileType is missing"},
        {R"("geoFence":{)", R"("fence":{)", "rule 1: geoFence is missing"},
        {R"("rallyPoints":{)", R"("rally":{)", "rule 1: rallyPoints is missing"},
        {R"("fileType":"Plan")", R"("fileType":"Mission")", "fileType: rule 2"},
        {R"("QGroundControl")", "7", "groundStation: must be a text"},
        {R"("version":1,)", R"("version":2,)", "version: must be a whole number from 1 to 1"},
        {"[35.1,139.7,3.3]", "[35.1,139.7]", "plannedHomePosition: rule 3: must be 3 numbers"},
        {"[35.1,139.7,3.3]", R"(["35.1",139.7,3.3])", "plannedHomePosition[0]: must be a number"},
        {R"("firmwareType":12)", R"("firmwareType":"12")", "firmwareType: must be a whole number"},
        {R"({"version":2,"firmwareType")", R"({"version":1,"firmwareType")", "mission.version: must be"},
        {R"("vehicleType":2,)", "", "vehicleType: is missing"},
        {R"("cruiseSpeed":15)", R"("cruiseSpeed":null)", "cruiseSpeed: must be a number"},
        {"SimpleItem", "ComplexItem", "items[0].type: rule 5"},
        {R"("autoContinue":true)", R"("autoContinue":1)", "items[0].autoContinue: must be true or false"},
        {R"("frame":3)", R"("frame":3.5)", "items[0].frame: must be a whole number"},
        {"[0,0,0,null,35.1,139.7,12]", "[0,0,0,35.1,139.7,12]", "items[0].params: rule 6"},
        {"[0,0,0,null,35.1", "[true,0,0,null,35.1", "items[0].params[0]: must be a number"},
        {R"("doJumpId":2)", R"("doJumpId":1)", "items[1].doJumpId: rule 7: must be 2"},
        {R"(,"AMSLAltAboveTerrain":null)", "", "items[0]: rule 8"},
        {R"("geoFence":{"version":2)", R"("geoFence":{"version":1)", "geoFence.version: must be"},
        {R"("inclusion":true)", R"("inclusion":1)", "polygons[0].inclusion: must be true or false"},
        {",[35,140]]", "]", "polygons[0].polygon: rule 10: must be at least three corners"},
        {"[36,139]", "[36,139,0]", "polygon[1]: rule 10: must be 2 numbers"},
        {R"("radius":12.5)", R"("radius":"12.5")", "circle.radius: must be a number"},
        {R"("center":[35,139.5])", R"("center":[35])", "circle.center: rule 11"},
        {R"("rallyPoints":{"version":2)", R"("rallyPoints":{"version":1)", "rallyPoints.version: must be"},
        {"[[35.1,139.7,20]]", "[[35.1,139.7]]", "points[0]: rule 12: must be 3 numbers"},
        {"[0,0,0,0,35.2", "[0,0,0,null,35.2", "items[1].params[3]: rule 13"},
    };
    for (const Case& c : cases)
        EXPECT_THAT(broken_rule(with(c.what, c.by)), HasSubstr(c.problem)) << c.what << " -> " << c.by;
}

TEST(PlanRules, AnyShapeOfJsonIsAnswered) {
    for (const char* text :
         {"[]", "7", "null", R"({"mission":7})",
          R"({"fileType":{},"groundStation":[],"version":{},"mission":[],"geoFence":"","rallyPoints":null})"})
        EXPECT_NE(broken_rule(text), "") << text;
}

}  // namespace
}  // namespace aerogram::exporter
