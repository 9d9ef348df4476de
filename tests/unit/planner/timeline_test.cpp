#include "planner/timeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "geo/units.hpp"
#include "small_shows.hpp"

namespace aerogram::planner {
namespace {

using namespace test;
using ::testing::HasSubstr;

std::string error_of(const std::string& keyframes) {
    const auto timeline = timeline_of(show_of(keyframes));
    if (timeline) return "accepted";
    EXPECT_EQ(timeline.error().code, ErrorCode::invalid_input);
    return timeline.error().message;
}

/// The last number of a message: what it says would do.
std::string offered(const std::string& message, const std::string& before) {
    const std::regex form(before + R"((\d+\.\d{3}))");
    std::smatch found;
    return std::regex_search(message, found, form) ? found[1].str() : "nothing offered in: " + message;
}

std::string at(double seconds) {
    return "at_s = " + std::to_string(seconds) + "\n";
}
Millis ms(const std::string& seconds) {
    return std::llround(std::stod(seconds) * 1000.0);
}

TEST(Timeline, ActsFollowOneAnotherWithoutGapsAndHoldsAreKept) {
    const auto timeline =
        timeline_of(show_of(keyframe("a", "circle", "hold_s = 4") + keyframe("b", "helix", "hold_s = 2.5")));
    ASSERT_TRUE(timeline);
    const std::vector<std::string> names{"take-off", "to a", "a", "to b", "b", "return", "landing"};
    ASSERT_EQ(timeline->acts.size(), names.size());
    ASSERT_EQ(timeline->leg_of.size(), names.size());
    Millis now_ms = 0;
    for (std::size_t a = 0; a < names.size(); ++a) {
        EXPECT_EQ(timeline->acts[a].name, names[a]);
        EXPECT_EQ(timeline->acts[a].start_ms, now_ms);
        EXPECT_EQ(timeline->leg_of[a].has_value(), timeline->acts[a].role != ActRole::hold);
        now_ms = timeline->acts[a].end_ms();
    }
    EXPECT_EQ(timeline->acts[2].duration_ms, 4000);
    EXPECT_EQ(timeline->acts[4].duration_ms, 2500);
    for (const std::size_t k : {0u, 1u}) {
        EXPECT_EQ(timeline->keyframes[k].stands_from_ms, timeline->acts[2 + 2 * k].start_ms);
        EXPECT_EQ(timeline->keyframes[k].stands_to_ms, timeline->acts[2 + 2 * k].end_ms());
    }
}

TEST(Timeline, GivenTimesMakeAnActFixed) {
    const auto timeline = timeline_of(show_of(keyframe("a", "circle") + keyframe("b", "helix", at(150)) +
                                              keyframe("c", "circle", "arrive = { duration_s = 40 }")));
    ASSERT_TRUE(timeline);
    EXPECT_EQ(find_act(timeline->acts, "to a")->timing, Timing::free);
    EXPECT_EQ(find_act(timeline->acts, "to b")->timing, Timing::fixed);
    EXPECT_EQ(find_act(timeline->acts, "to c")->timing, Timing::fixed);
    EXPECT_EQ(find_act(timeline->acts, "return")->timing, Timing::free);
}

TEST(Timeline, ALongerDurationIsFlownAsGiven) {
    const auto timeline =
        timeline_of(show_of(keyframe("a", "circle") + keyframe("b", "helix", "arrive = { duration_s = 61.25 }")));
    ASSERT_TRUE(timeline);
    EXPECT_EQ(find_act(timeline->acts, "to b")->duration_ms, 61250);
}

TEST(Timeline, ATooShortDurationIsToldTheShortestAndThatOneIsTaken) {
    const auto show = [](const std::string& duration) {
        return keyframe("a", "circle") + keyframe("b", "helix", "arrive = { duration_s = " + duration + " }");
    };
    const std::string message = error_of(show("1.5"));
    EXPECT_THAT(message, HasSubstr("small.toml:17: keyframe[2].arrive.duration_s = 1.5: must be >= "));
    EXPECT_THAT(message, HasSubstr("(set by "));
    const std::string shortest = offered(message, "must be >= ");
    const auto timeline = timeline_of(show_of(show(shortest)));
    ASSERT_TRUE(timeline) << timeline.error().message;
    EXPECT_EQ(find_act(timeline->acts, "to b")->duration_ms, ms(shortest));
    const auto free = timeline_of(show_of(keyframe("a", "circle") + keyframe("b", "helix")));
    EXPECT_EQ(find_act(free->acts, "to b")->duration_ms, ms(shortest));
}

TEST(Timeline, AtSIsReachedByFlyingSlower) {
    const auto free = timeline_of(show_of(keyframe("a", "circle") + keyframe("b", "helix")));
    const auto timed = timeline_of(show_of(keyframe("a", "circle") + keyframe("b", "helix", at(180.5))));
    ASSERT_TRUE(free && timed);
    EXPECT_EQ(timed->keyframes[1].stands_from_ms, 180500);
    EXPECT_EQ(timed->keyframes[0].stands_to_ms, free->keyframes[0].stands_to_ms);
    EXPECT_EQ(find_act(timed->acts, "to b")->end_ms(), 180500);
    EXPECT_GT(find_act(timed->acts, "to b")->duration_ms, find_act(free->acts, "to b")->duration_ms);
}

TEST(Timeline, AtSWithADurationHoldsTheFormationBeforeLonger) {
    const auto timed = timeline_of(show_of(keyframe("a", "circle", "hold_s = 2") +
                                           keyframe("b", "helix", at(180) + "arrive = { duration_s = 40 }")));
    ASSERT_TRUE(timed);
    EXPECT_EQ(find_act(timed->acts, "to b")->duration_ms, 40000);
    EXPECT_EQ(timed->keyframes[1].stands_from_ms, 180000);
    EXPECT_EQ(timed->keyframes[0].stands_to_ms, 140000);
    EXPECT_EQ(find_act(timed->acts, "a")->end_ms(), 140000);
    EXPECT_EQ(find_act(timed->acts, "a")->start_ms, timed->keyframes[0].stands_from_ms);
}

TEST(Timeline, ATooEarlyAtSIsToldTheEarliestAndThatOneIsTaken) {
    const auto show = [](const std::string& at_s) {
        return keyframe("a", "circle") + keyframe("b", "helix", "at_s = " + at_s);
    };
    const std::string message = error_of(show("12"));
    EXPECT_THAT(message, HasSubstr("small.toml:13: keyframe[2].at_s = 12: the earliest possible is "));
    const std::string earliest = offered(message, "the earliest possible is ");
    const auto timeline = timeline_of(show_of(show(earliest)));
    ASSERT_TRUE(timeline) << timeline.error().message;
    EXPECT_EQ(timeline->keyframes[1].stands_from_ms, ms(earliest));
    const auto free = timeline_of(show_of(keyframe("a", "circle") + keyframe("b", "helix")));
    EXPECT_EQ(free->keyframes[1].stands_from_ms, ms(earliest));
}

TEST(Timeline, NothingCanWaitBeforeTheFirstFormation) {
    const auto show = [](const std::string& at_s) {
        return keyframe("a", "circle", "at_s = " + at_s + "\narrive = { duration_s = 50 }");
    };
    const std::string message = error_of(show("200"));
    EXPECT_THAT(message, HasSubstr("keyframe[1].at_s = 200: with this duration_s nothing can wait"));
    const std::string offer = offered(message, "or at_s = ");
    const auto timeline = timeline_of(show_of(show(offer)));
    ASSERT_TRUE(timeline) << timeline.error().message;
    EXPECT_EQ(timeline->keyframes[0].stands_from_ms, ms(offer));
    EXPECT_EQ(find_act(timeline->acts, "to a")->duration_ms, 50000);
}

/// Where nobody has to move there is no act: the formation before stands until the time given.
TEST(Timeline, TheSameFormationAgainTakesNoTimeAndWaitsForItsAtS) {
    const auto free = timeline_of(show_of(keyframe("a", "circle") + keyframe("b", "circle")));
    ASSERT_TRUE(free);
    EXPECT_EQ(find_act(free->acts, "to b"), nullptr);
    EXPECT_EQ(free->keyframes[1].stands_from_ms, free->keyframes[0].stands_to_ms);
    const auto timed = timeline_of(show_of(keyframe("a", "circle") + keyframe("b", "circle", at(150))));
    ASSERT_TRUE(timed);
    EXPECT_EQ(timed->keyframes[0].stands_to_ms, 150000);
    EXPECT_EQ(timed->keyframes[1].stands_from_ms, 150000);
    EXPECT_EQ(find_act(timed->acts, "b")->start_ms, 150000);
}

TEST(Timeline, FlowsPassKeyframesAtTheirShareOfTheTime) {
    const Mission mission =
        show_of(keyframe("a", "circle") +
                keyframe("b", "helix", "hold_s = 0\narrive = { method = \"flow\", duration_s = 40 }") +
                keyframe("c", "sphere", "arrive = { method = \"flow\", duration_s = 80 }"));
    const Stages stages = stages_of(mission);
    const auto timeline = build_timeline(mission, stages.route, stages.legs, stages.motions);
    ASSERT_TRUE(timeline) << timeline.error().message;
    const Act& flow = *find_act(timeline->acts, "flow to c");
    EXPECT_EQ(flow.duration_ms, 120000);
    const PlannedKeyframe& passed = timeline->keyframes[1];
    EXPECT_EQ(passed.stands_from_ms, passed.stands_to_ms);
    const auto& knots = stages.motions[2].keyframe_knots;
    const double share = static_cast<double>(knots[0]) / static_cast<double>(knots[1]);
    EXPECT_NEAR(share, 1.0 / 3.0, 0.02);
    EXPECT_NEAR(static_cast<double>(passed.stands_from_ms - flow.start_ms), 120000.0 * share, 0.5);
    EXPECT_EQ(timeline->keyframes[2].stands_from_ms, flow.end_ms());
}

// --- tracks ---

struct Shown {
    Timeline timeline;
    std::vector<Tracks> tracks;
};
Shown shown(const Mission& mission) {
    Timeline timeline = timeline_of(mission).value();
    auto tracks = build_tracks(timeline.keyframes, timeline.acts, mission.fleet.drones);
    return {std::move(timeline), std::move(tracks)};
}
const std::string kRed = "color = \"#f00\"\n", kBlue = "color = \"#00f\"\n";

Rgb color_at(const Shown& show, std::size_t drone, Millis time_ms) {
    return light_at(show.tracks[drone].lights, seconds_from_ms(time_ms));
}

TEST(BuildTracks, KeysLieOnTheTickInOrderAndNosesPointAlongY) {
    const Shown show = shown(show_of(keyframe("a", "circle", kRed + "hold_s = 1.337") +
                                     keyframe("b", "helix", kBlue + kFlowOn) + keyframe("c", "circle", kRed + kFlow)));
    ASSERT_EQ(show.tracks.size(), 8u);
    for (const Tracks& tracks : show.tracks) {
        EXPECT_EQ(tracks.lights.front().time_ms, 0);
        for (const LightKey& key : tracks.lights) EXPECT_EQ(key.time_ms % 20, 0);
        for (std::size_t k = 1; k < tracks.lights.size(); ++k)
            EXPECT_GT(tracks.lights[k].time_ms, tracks.lights[k - 1].time_ms);
        EXPECT_TRUE(tracks.yaw.empty());
        EXPECT_TRUE(tracks.events.empty());
    }
}

TEST(BuildTracks, LampsAreDarkOnTheWayUpFromThePadAndDown) {
    const Shown show = shown(show_of(keyframe("a", "circle", kRed)));
    const Act& takeoff = *find_act(show.timeline.acts, "take-off");
    const Act& landing = *find_act(show.timeline.acts, "landing");
    for (std::size_t d = 0; d < 8; ++d) {
        for (const Millis t : {Millis{0}, takeoff.end_ms() / 2, takeoff.end_ms() - 20, landing.start_ms + 20,
                               landing.end_ms(), landing.end_ms() + 1000})
            EXPECT_EQ(color_at(show, d, t), Rgb{}) << t;
    }
}

TEST(BuildTracks, AFormationShowsItsColoursAndFadesToTheNext) {
    const Shown show = shown(show_of(keyframe("a", "circle", kRed) + keyframe("b", "helix", kBlue)));
    const PlannedKeyframe &a = show.timeline.keyframes[0], &b = show.timeline.keyframes[1];
    for (std::size_t d = 0; d < 8; ++d) {
        EXPECT_EQ(color_at(show, d, a.stands_from_ms + 20), (Rgb{1, 0, 0}));
        EXPECT_EQ(color_at(show, d, a.stands_to_ms - 20), (Rgb{1, 0, 0}));
        EXPECT_EQ(color_at(show, d, b.stands_from_ms + 20), (Rgb{0, 0, 1}));
        const Rgb halfway = color_at(show, d, (a.stands_to_ms + b.stands_from_ms) / 2);
        EXPECT_NEAR(halfway.r, 0.5, 0.01);
        EXPECT_NEAR(halfway.b, 0.5, 0.01);
        const Rgb rising =
            color_at(show, d, (find_act(show.timeline.acts, "take-off")->end_ms() + a.stands_from_ms) / 2);
        EXPECT_NEAR(rising.r, 0.5, 0.01);
    }
}

TEST(BuildTracks, AFlowShowsEachFormationsColourAsItPasses) {
    const Shown show = shown(show_of(keyframe("a", "circle", kRed) + keyframe("b", "helix", kBlue + kFlowOn) +
                                     keyframe("c", "circle", kRed + kFlow)));
    const PlannedKeyframe& passed = show.timeline.keyframes[1];
    const Millis tick = (passed.stands_from_ms + 10) / 20 * 20;
    EXPECT_EQ(color_at(show, 0, tick), (Rgb{0, 0, 1}));
    EXPECT_LT(color_at(show, 0, tick - 400).b, 1.0);
    const Millis next = (show.timeline.keyframes[2].stands_from_ms + 10) / 20 * 20;
    EXPECT_NEAR(color_at(show, 0, tick + 400).b, 1.0 - 400.0 / static_cast<double>(next - tick),
                1e-6);  // fades at once
}

/// Colours belong to slots: whoever stands there shows them.
TEST(BuildTracks, DronesShowTheColourOfTheirSlot) {
    const Mission mission = show_of(
        "[[keyframe]]\nname = \"two\"\narrive = { pins = { 1 = 8, 8 = 1 } }\n"
        "[[keyframe.part]]\nshape = \"line\"\ndrones = 4\ncenter_m = [-10, 0, 40]\n" +
        kRed + "[[keyframe.part]]\nshape = \"line\"\ndrones = 4\ncenter_m = [10, 0, 40]\n" + kBlue);
    const Shown show = shown(mission);
    const PlannedKeyframe& two = show.timeline.keyframes[0];
    for (std::size_t d = 0; d < 8; ++d) {
        const bool left = two.formation_m[two.slot_of[d].value].x < 0.0;
        EXPECT_EQ(color_at(show, d, two.stands_from_ms + 20), left ? (Rgb{1, 0, 0}) : (Rgb{0, 0, 1})) << d;
    }
    EXPECT_EQ(color_at(show, 0, two.stands_from_ms + 20), (Rgb{0, 0, 1}));
    EXPECT_EQ(color_at(show, 7, two.stands_from_ms + 20), (Rgb{1, 0, 0}));
}

}  // namespace
}  // namespace aerogram::planner
