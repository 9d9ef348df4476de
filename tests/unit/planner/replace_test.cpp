#include "planner/replace.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner/small_shows.hpp"

namespace aerogram::planner {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// 12 drones on 16 pads 3 m apart: pads 13 to 16 are spare.
FlightPlan plan_with_spares(const std::string& arrive = "") {
    const Mission mission = test::show_of(
        test::keyframe("A", "circle", "hold_s = 4") + test::keyframe("B", "star", "hold_s = 4\n" + arrive), 12);
    return plan(mission, {}, aerogram::Run{}).value();
}

Result<FlightPlan> with(const FlightPlan& plan, const std::vector<std::string>& words) {
    std::vector<Replacement> replacements;
    for (const std::string& word : words) replacements.push_back(parse_replacement(word).value());
    return replaced(plan, replacements, aerogram::Run{});
}

std::string refusal(const FlightPlan& plan, const std::vector<std::string>& words) {
    const auto result = with(plan, words);
    return result.ok() ? "none" : result.error().message;
}

Vec3 place(const FlightPlan& plan, std::size_t number, double t_s) {
    return sample(plan, DroneId::from_number(number), t_s).motion.position_m;
}

/// The first act of a role, and the last transit.
const Act& act_of(const FlightPlan& plan, ActRole role, bool last = false) {
    const Act* found = nullptr;
    for (const Act& act : plan.acts)
        if (act.role == role && (last || found == nullptr)) found = &act;
    return *found;
}

class Replace : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Ways, Replace, ::testing::Values("", "arrive = { method = \"spectral\", assign = \"keep\" }"));

TEST_P(Replace, Property1_EverybodyElseFliesTheSameBits) {
    const FlightPlan before = plan_with_spares(GetParam());
    const auto after = with(before, {"12=pad 16"});
    ASSERT_TRUE(after.ok()) << after.error().message;
    ASSERT_EQ(after->acts.size(), before.acts.size());
    for (std::size_t a = 0; a < before.acts.size(); ++a) {
        const Act &was = before.acts[a], &is = after->acts[a];
        EXPECT_EQ(is.start_ms, was.start_ms);
        EXPECT_EQ(is.duration_ms, was.duration_ms);
        ASSERT_EQ(interval_count(is.motion), interval_count(was.motion));
        for (std::size_t row = 0; row < interval_count(was.motion) + 3; ++row)
            for (std::size_t d = 0; d < 11; ++d)
                ASSERT_EQ(control_point(is.motion, row, d), control_point(was.motion, row, d));
    }
    EXPECT_EQ(after->tracks, before.tracks);
}

TEST_P(Replace, Property2_TheNewWayJoinsTheOldOneForTheFormations) {
    const FlightPlan before = plan_with_spares(GetParam());
    const auto after = with(before, {"12=16"});
    ASSERT_TRUE(after.ok()) << after.error().message;
    const Vec3 pad = before.spare_pads_m[3], off = pad - before.pads_m[11];
    EXPECT_EQ(after->pads_m[11], pad);
    EXPECT_EQ(after->spare_pads_m[3], before.pads_m[11]);
    EXPECT_EQ(place(*after, 12, 0.0), pad);
    const double end_s = static_cast<double>(before.duration_ms()) / 1000.0;
    EXPECT_LE(glm::length(place(*after, 12, end_s) - pad), 1e-12);
    const double joined_s = static_cast<double>(act_of(before, ActRole::transit).end_ms()) / 1000.0;
    const double parted_s = static_cast<double>(act_of(before, ActRole::transit, true).start_ms) / 1000.0;
    for (double t_s = joined_s; t_s <= parted_s; t_s += 0.1)
        ASSERT_EQ(place(*after, 12, t_s), place(before, 12, t_s)) << t_s;
    const double up_s = static_cast<double>(act_of(before, ActRole::takeoff).end_ms()) / 1000.0;
    for (double t_s = 0.0; t_s < up_s; t_s += 0.1)
        ASSERT_LE(glm::length(place(*after, 12, t_s) - place(before, 12, t_s) - off), 1e-12) << t_s;
    double last_m = glm::length(off);  // the shift only shrinks
    for (double t_s = up_s; t_s < joined_s; t_s += 0.1) {
        const double off_m = glm::length(place(*after, 12, t_s) - place(before, 12, t_s));
        ASSERT_LE(off_m, last_m + 1e-9);
        last_m = off_m;
    }
}

TEST_P(Replace, Property3_WhatChangedIsCertifiedAnew) {
    const auto after = with(plan_with_spares(GetParam()), {"12=16"});
    ASSERT_TRUE(after.ok()) << after.error().message;
    EXPECT_TRUE(after->certificate.certified());
    const Surroundings around{geo::ShowFrame(after->origin), after->airspace, after->pads_m, after->limits};
    for (std::size_t a = 0; a < after->acts.size(); ++a) {
        const ActCertificate again = certify(after->acts[a], around, aerogram::Run{}).value();
        EXPECT_TRUE(again.certified());
        EXPECT_EQ(again.separation.lower_bound_m, after->certificate.acts[a].separation.lower_bound_m) << a;
        EXPECT_FALSE(after->certificate.acts[a].method.empty());
    }
}

TEST(ReplaceSeveral, InOneGo) {
    const auto after = with(plan_with_spares(), {"12=16", "9=pad13"});
    ASSERT_TRUE(after.ok()) << after.error().message;
    EXPECT_EQ(place(*after, 9, 0.0), after->pads_m[8]);
}

TEST(ReplaceRefused, WithTheLimitTheDronesTheTimeAndOtherPads) {
    FlightPlan plan = plan_with_spares();
    plan.spare_pads_m[0] = plan.pads_m[2] + Vec3{0.7, 0.0, 0.0};    // too near pad 3, which stays in use
    plan.spare_pads_m[1] = plan.pads_m[2] + Vec3{400.0, 0.0, 0.0};  // too far to come in time
    const std::string near = refusal(plan, {"12=13"});
    EXPECT_THAT(near, StartsWith("drone 12 cannot be replaced from pad 13\n"));
    EXPECT_THAT(near, HasSubstr("separation 0.7 m of drones 3 and 12"));
    EXPECT_THAT(near, HasSubstr(" s is below 1.55 m"));
    EXPECT_THAT(near, HasSubstr("these spare pads would do: "));
    EXPECT_THAT(near, HasSubstr("pad 16"));
    EXPECT_THAT(near, ::testing::Not(HasSubstr("pad 14")));
    EXPECT_THAT(refusal(plan, {"12=14"}), HasSubstr("speed_horizontal_mps: reaches"));
    plan.spare_pads_m.resize(2);
    EXPECT_THAT(refusal(plan, {"12=13"}), HasSubstr("no other spare pad would do either: plan the mission anew"));
}

TEST(ReplaceRefused, WhatIsNotThere) {
    const FlightPlan plan = plan_with_spares();
    EXPECT_EQ(refusal(plan, {"13=16"}), "13=pad 16: there is no drone 13, only 1 to 12");
    EXPECT_EQ(refusal(plan, {"1=17"}), "1=pad 17: there is no pad 17; the spare ones are 13 to 16");
    EXPECT_EQ(refusal(plan, {"1=4"}), "1=pad 4: drone 4 stands on that pad; the spare ones are 13 to 16");
    EXPECT_EQ(refusal(plan, {"12=16", "12=15"}), "12=pad 15: drone 12 is replaced twice");
    EXPECT_EQ(refusal(plan, {"12=16", "11=16"}), "11=pad 16: pad 16 is taken by another replacement");
    FlightPlan none = plan;
    none.spare_pads_m.clear();
    EXPECT_THAT(refusal(none, {"1=13"}), HasSubstr("this show has no spare pads"));
}

TEST(ReplaceRefused, ShowsOnAMovingCarrierAndPlanes) {
    FlightPlan plan = plan_with_spares();
    FlightPlan planes = plan;
    planes.limits.plane = PlaneLimits{};
    EXPECT_THAT(refusal(planes, {"1=13"}), HasSubstr("rides along a route"));
    Lattice moving{12, {}};
    for (std::size_t row = 0; row < 9; ++row)
        for (std::size_t d = 0; d < 12; ++d)
            moving.points_m.emplace_back(static_cast<double>(row), 5.0 * static_cast<double>(d), 30.0);
    for (Act& act : plan.acts)
        if (act.role == ActRole::hold) act.motion = moving;
    EXPECT_THAT(refusal(plan, {"1=13"}), HasSubstr("rides along a route"));
}

TEST(ReplaceWords, AreADroneAndAPad) {
    const Replacement want{DroneId::from_number(17), PadId::from_number(41)};
    for (const char* const text : {"17=pad 41", "17=pad41", "17=41", " 17 = pad 41 "})
        EXPECT_EQ(parse_replacement(text).value(), want) << text;
    for (const char* const text : {"", "17", "=41", "17=", "17=pad", "0=41", "17=pad 0", "17=-1", "17=41x", "a=b"})
        EXPECT_THAT(parse_replacement(text).error().message, HasSubstr("such as \"17=pad 41\"")) << text;
}

}  // namespace
}  // namespace aerogram::planner
