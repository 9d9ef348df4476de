#include "planner/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "geo/units.hpp"
#include "small_shows.hpp"

namespace aerogram::planner {
namespace {

using namespace test;
using ::testing::HasSubstr;

const std::string kTwo = keyframe("a", "circle") + keyframe("b", "helix", "arrive = { method = \"spectral\" }");
const std::string kCrossing =
    keyframe("a", "line") + keyframe("b", "line", kHalfTurn + "arrive = { assign = \"keep\", separation = \"none\" }");

TEST(Plan, AFormationThatShrinksTooFarIsToldHowFarItMay) {
    const auto refused =
        plan(show_of(keyframe("a", "grid", "hold_s = 20\nmotion = { scale = 0.5 }")), {}, aerogram::Run{});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
    EXPECT_THAT(refused.error().message, ::testing::HasSubstr("motion.scale = 0.5: brings drones closer than 1.55 m"));
    EXPECT_THAT(refused.error().message, ::testing::HasSubstr("must be >= 0.70"));
}

TEST(Plan, ASoundMissionIsCertifiedActByAct) {
    const Mission mission = show_of(kTwo + "[[cue]]\nname = \"go\"\nat_s = 5\n");
    const auto plan = planner::plan(mission, {}, aerogram::Run{});
    ASSERT_TRUE(plan) << plan.error().message;
    EXPECT_TRUE(plan->certificate.certified());
    ASSERT_EQ(plan->certificate.acts.size(), plan->acts.size());
    for (std::size_t a = 0; a < plan->acts.size(); ++a) {
        EXPECT_EQ(plan->certificate.acts[a].name, plan->acts[a].name);
        EXPECT_EQ(plan->certificate.acts[a].start_ms, plan->acts[a].start_ms);
        EXPECT_EQ(plan->certificate.acts[a].duration_ms, plan->acts[a].duration_ms);
        EXPECT_EQ(plan->certificate.acts[a].required_separation_m, 1.55);
        EXPECT_EQ(plan->certificate.acts[a].method == "hold", plan->acts[a].role == ActRole::hold);
    }
    EXPECT_EQ(plan->certificate.acts[3].method, "spectral");
    EXPECT_EQ(plan->certificate.acts[3].assignment, "shortest, no paths cross");
    EXPECT_EQ(plan->name, mission.name);
    EXPECT_EQ(plan->pads_m, mission.fleet.pads_m);
    EXPECT_EQ(plan->origin.ground.height_m, 400.0);
    EXPECT_EQ(plan->tracks.size(), 8u);
    EXPECT_EQ(plan->cues, (std::vector<Cue>{{5000, "go"}}));
}

TEST(Plan, OneTwoAndThreeDronesAreFleetsToo) {
    for (const std::size_t drones : {1u, 2u, 3u}) {
        for (const char* method : {"straight", "spectral", "flow"}) {
            const std::string how = "arrive = { method = \"" + std::string(method) + "\" }";
            const auto plan = planner::plan(show_of(keyframe("a", "circle") + keyframe("b", "helix", how), drones), {},
                                            aerogram::Run{});
            ASSERT_TRUE(plan) << drones << ' ' << method << ": " << plan.error().message;
            EXPECT_TRUE(plan->certificate.certified());
            EXPECT_EQ(plan->drones(), drones);
        }
    }
}

TEST(Plan, BestEffortReturnsThePlanThatWasRefused) {
    const Mission mission = show_of(kCrossing);
    const auto refused = planner::plan(mission, {}, aerogram::Run{});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::infeasible);
    EXPECT_THAT(refused.error().message,
                HasSubstr("small.toml: this show cannot be flown within its limits\n  to b: "));
    const auto effort = planner::plan(mission, {.best_effort = true}, aerogram::Run{});
    ASSERT_TRUE(effort);
    EXPECT_FALSE(effort->certificate.certified());
    for (const ActCertificate& act : effort->certificate.acts) {
        EXPECT_EQ(act.certified(), act.name != "to b");
        for (const std::string& violation : act.violations) EXPECT_THAT(refused.error().message, HasSubstr(violation));
    }
}

TEST(Plan, BestEffortDoesNotExcuseABadMission) {
    const auto plan =
        planner::plan(show_of(keyframe("a", "circle", "at_s = 1")), {.best_effort = true}, aerogram::Run{});
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().code, ErrorCode::invalid_input);
}

TEST(Plan, AShowLongerThanTheEnduranceIsRefused) {
    Mission mission = show_of(kTwo);
    mission.fleet.endurance_s = 60.0;
    const auto plan = planner::plan(mission, {}, aerogram::Run{});
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().code, ErrorCode::infeasible);
    EXPECT_THAT(plan.error().message, HasSubstr(" s, longer than endurance_s = 60"));
}

/// The time was once that within the act.
TEST(Plan, ABreachOfTheFenceIsNamedAtItsShowTime) {
    Mission mission =
        show_of(keyframe("a", "circle") + "[[keyframe]]\nname = \"b\"\nshape = \"circle\"\ncenter_m = [60, 0, 40]\n");
    mission.airspace.geofence_m = {{-40, -40}, {40, -40}, {40, 40}, {-40, 40}};
    const auto plan = planner::plan(mission, {}, aerogram::Run{});
    ASSERT_FALSE(plan);
    const std::regex form(R"(to b: drone (\d+) is outside the geofence by (\S+) m at (\S+) s)");
    std::smatch told;
    ASSERT_TRUE(std::regex_search(plan.error().message, told, form)) << plan.error().message;
    const auto effort = planner::plan(mission, {.best_effort = true}, aerogram::Run{});
    const Vec3 there = sample(*effort, DroneId::from_number(std::stoul(told[1])), std::stod(told[3])).motion.position_m;
    EXPECT_NEAR(there.x - 40.0, std::stod(told[2]), 0.02);
}

TEST(Plan, ProgressGoesFromStageToStageUpToOne) {
    std::map<std::string, double> reached;
    std::vector<std::string> order;
    const aerogram::Run run{{},
                            [&](std::string_view stage, double fraction) {
                                EXPECT_GE(fraction, 0.0);
                                EXPECT_LE(fraction, 1.0);
                                const std::string name(stage);
                                if (!reached.contains(name)) order.push_back(name);
                                EXPECT_GE(fraction, reached[name]);
                                reached[name] = fraction;
                            },
                            1};
    ASSERT_TRUE(planner::plan(show_of(kTwo), {}, run));
    for (const char* stage : {"formations", "transitions", "certificate"}) EXPECT_EQ(reached[stage], 1.0) << stage;
    const auto place = [&](const char* stage) { return std::ranges::find(order, stage); };
    EXPECT_LT(place("formations"), place("transitions"));
    EXPECT_LT(place("transitions"), place("certificate"));
}

/// Asked to stop at any report, planning stops; asked at the very last one it may have finished.
TEST(Plan, AStopIsHonouredAtEveryReport) {
    const Mission mission = show_of(kTwo);
    int reports = 0;
    ASSERT_TRUE(planner::plan(mission, {}, aerogram::Run{{}, [&](std::string_view, double) { ++reports; }, 1}));
    ASSERT_GT(reports, 5);
    for (int stop_at = 0; stop_at + 1 < reports; ++stop_at) {
        std::stop_source source;
        int seen = 0;
        const aerogram::Run run{source.get_token(),
                                [&](std::string_view, double) {
                                    if (seen++ == stop_at) source.request_stop();
                                },
                                1};
        const auto plan = planner::plan(mission, {}, run);
        ASSERT_FALSE(plan) << "report " << stop_at << " of " << reports;
        EXPECT_EQ(plan.error().code, ErrorCode::stopped);
    }
}

TEST(Plan, ARefusalComesAfterAllActsWereJudged) {
    const auto plan = planner::plan(
        show_of(kCrossing + keyframe("c", "line", "arrive = { assign = \"keep\", separation = \"none\" }")), {},
        aerogram::Run{});
    ASSERT_FALSE(plan);
    EXPECT_THAT(plan.error().message, HasSubstr("\n  to b: separation "));
    EXPECT_THAT(plan.error().message, HasSubstr("\n  to c: separation "));
}

/// A hold that drifts into the ground was certified once, and the way home began below it.
TEST(Plan, NobodyFliesBelowThePads) {
    const auto planned =
        plan(show_of(keyframe("a", "grid", "hold_s = 60\nmotion = { drift_m = [0, 0, -60] }")), {}, aerogram::Run{});
    ASSERT_FALSE(planned);
    EXPECT_EQ(planned.error().code, ErrorCode::infeasible);
    EXPECT_NE(planned.error().message.find("is below its pad"), std::string::npos) << planned.error().message;
}

/// A separation asked for beyond what certificates usually resolve was taken for kept once.
TEST(Plan, ASeparationThatFormationsCannotKeepIsRefusedBySizeAndPair) {
    const auto planned = plan(
        show_of(keyframe("a", "line", "size_m = [35]") +
                keyframe("b", "line", "size_m = [35]\nrotate_deg = [0, 30, 0]\narrive = { min_separation_m = 10 }")),
        {}, aerogram::Run{});
    ASSERT_FALSE(planned);
    EXPECT_NE(planned.error().message.find("is below 10.05 m (arrive.min_separation_m + export_margin_m)"),
              std::string::npos)
        << planned.error().message;
}

/// The shortest duration that a refusal names is one that is then accepted, whatever separates the leg.
TEST(Plan, TheShortestDurationNamedIsAccepted) {
    const auto with = [](const std::string& duration_s) {
        return plan(show_of(keyframe("a", "grid") + keyframe("b", "grid",
                                                             kHalfTurn +
                                                                 "arrive = { method = \"spectral\", assign = \"keep\", "
                                                                 "duration_s = " +
                                                                 duration_s + " }")),
                    {}, aerogram::Run{});
    };
    const auto refused = with("0.5");
    ASSERT_FALSE(refused);
    const std::string& told = refused.error().message;
    const std::size_t at = told.find("must be >= ");
    ASSERT_NE(at, std::string::npos) << told;
    EXPECT_TRUE(with(told.substr(at + 11, told.find(' ', at + 11) - at - 11)));
}

}  // namespace
}  // namespace aerogram::planner
