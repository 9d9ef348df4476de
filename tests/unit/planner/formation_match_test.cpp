#include "planner/formation_match.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "planner/sketch/formation_coordinates.hpp"
#include "planner/sketch/rim.hpp"
#include "small_shows.hpp"
#include "tests/unit/planner/assignment/instances.hpp"

namespace aerogram::planner {
namespace {

using testing::ball;
using ::testing::HasSubstr;
using testing::letters;
using testing::pads;
using testing::sheet;

const SeparationMetric kMetric{1.0};

Assignment matched(const Points& from, const Points& to, const MatchRules& rules = {},
                   const std::vector<bool>& spare = {}) {
    return assign_formation_coordinates(from, to, spare, rules, kMetric, {}).value();
}
void expect_bijection(const Assignment& assignment, std::size_t n) {
    EXPECT_EQ(std::set<SlotId>(assignment.slot_of.begin(), assignment.slot_of.end()).size(), n);
    EXPECT_EQ(assignment.slot_of.size(), n);
    for (const SlotId s : assignment.slot_of) EXPECT_LT(s.value, n);
}
Points moved(Points points, double scale, const Vec3& by) {
    for (Vec3& p : points) p = scale * p + by;
    return points;
}

TEST(FormationMatch, Property1_IsABijectionBetweenAnyFormations) {
    for (const std::size_t n : {1U, 2U, 3U, 10U, 100U, 257U}) {
        const std::vector<Points> all{pads(n), letters(n), sheet(n), ball(n)};
        for (const Points& from : all)
            for (const Points& to : all) expect_bijection(matched(from, to), n);
    }
}

TEST(FormationMatch, AFormationThatOnlyMovesAndGrowsKeepsItsSlots) {
    for (const Points& points : {sheet(100), letters(100), ball(100)}) {
        const Assignment assignment = matched(points, moved(points, 1.5, {40, 7, 90}));
        for (std::size_t d = 0; d < 100; ++d) EXPECT_EQ(assignment.slot_of[d], SlotId(d));
        EXPECT_TRUE(assignment.pairwise);
    }
}

TEST(FormationMatch, FromTheGroundWhatIsFarAwayGoesUp) {
    const Points from = pads(100), to = sheet(100);
    const Assignment assignment = matched(from, to);
    for (std::size_t d = 0; d < 100; ++d) EXPECT_EQ(assignment.slot_of[d], SlotId(d));
}

TEST(FormationMatch, Property2_WhereAndHowLargeTheyAreDoesNotMatter) {
    const Points from = letters(120), to = ball(120);
    EXPECT_EQ(matched(from, to).slot_of, matched(moved(from, 4, {64, 0, 8}), moved(to, 0.5, {0, 128, 0})).slot_of);
}

// Oracle: the first rim slot's nearest drone in coordinate space, by brute force; a slot inside has no such right.
TEST(FormationMatch, TheRimIsServedFirst) {
    const Points from = pads(144), to = ball(144);
    const auto of_drones = coordinates_in(space_frame(from), from), of_slots = coordinates_in(space_frame(to), to);
    const auto rim = rim_of(to);
    const auto first = static_cast<std::size_t>(std::find(rim.begin(), rim.end(), true) - rim.begin());
    ASSERT_LT(first, 144U);
    std::size_t nearest = 0;
    double least = 1e300;
    for (std::size_t d = 0; d < 144; ++d) {
        double squared = 0.0;
        for (std::size_t k = 0; k < 4; ++k) squared += std::pow(of_drones[d][k] - of_slots[first][k], 2);
        if (squared >= least) continue;
        least = squared;
        nearest = d;
    }
    EXPECT_EQ(matched(from, to).slot_of[nearest], SlotId(first));
}

TEST(FormationMatch, PinsAndForbiddenPairsAreKept) {
    const Points from = sheet(60), to = letters(60);
    MatchRules rules;
    for (std::size_t d = 0; d < 10; ++d) rules.pins[DroneId(d)] = SlotId(59 - d);
    for (std::size_t d = 10; d < 60; ++d)
        for (std::size_t s = 0; s < 48; s += 2) rules.forbid.insert({DroneId(d), SlotId(s)});
    for (std::size_t d = 10; d < 35; ++d)
        for (std::size_t s = 0; s < 48; s += 2) rules.forbid.erase({DroneId(d), SlotId(s)});
    const Assignment assignment = matched(from, to, rules);
    expect_bijection(assignment, 60);
    for (const auto& [drone, slot] : rules.pins) EXPECT_EQ(assignment.slot_of[drone.value], slot);
    for (const auto& [drone, slot] : rules.forbid) EXPECT_NE(assignment.slot_of[drone.value], slot);
}

TEST(FormationMatch, WhoeverIsLeftWithForbiddenSlotsIsGivenRoom) {
    // Everybody but the last may take any slot; the last one only the slot that the first takes by place.
    const Points from = sheet(20), to = sheet(20);
    MatchRules rules;
    for (std::size_t s = 1; s < 20; ++s) rules.forbid.insert({DroneId(19), SlotId(s)});
    const Assignment assignment = matched(from, to, rules);
    expect_bijection(assignment, 20);
    EXPECT_EQ(assignment.slot_of[19], SlotId(0));
}

TEST(FormationMatch, RulesThatAdmitNothingAreToldAsByShortest) {
    const Points from = sheet(10), to = sheet(10);
    MatchRules rules;
    for (std::size_t s = 0; s < 10; ++s) rules.forbid.insert({DroneId(4), SlotId(s)});
    const auto none = assign_formation_coordinates(from, to, {}, rules, kMetric, {});
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().code, ErrorCode::infeasible);
    EXPECT_EQ(none.error().message, assign_shortest(from, to, rules, kMetric, {}).error().message);
    const auto pinned =
        assign_formation_coordinates(from, to, {}, {{{DroneId(4), SlotId(2)}}, {{DroneId(4), SlotId(2)}}}, kMetric, {});
    EXPECT_THAT(pinned.error().message, HasSubstr("drone 5 is pinned to slot 3"));
}

TEST(FormationMatch, SparesAreTakenByWhoIsLeft) {
    Points to = moved(sheet(60), 1.0, {0, 0, 40});
    std::vector<bool> spare(64, false);
    for (std::size_t s = 60; s < 64; ++s) {
        to.emplace_back(200.0 + 3.0 * double(s), 0.0, 5.0);
        spare[s] = true;
    }
    const Points from = pads(64);
    const Assignment assignment = matched(from, to, {}, spare);
    expect_bijection(assignment, 64);
    // The picture is as if the spare places were not there: moving them changes nobody in it.
    Points elsewhere = to;
    for (std::size_t s = 60; s < 64; ++s) elsewhere[s] += Vec3(-500, 30, 10);
    const Assignment other = matched(from, elsewhere, {}, spare);
    for (std::size_t d = 0; d < 64; ++d)
        if (assignment.slot_of[d].value < 60) {
            EXPECT_EQ(assignment.slot_of[d], other.slot_of[d]);
        }
    const Assignment pinned = matched(from, to, {{{DroneId(30), SlotId(62)}}}, spare);
    expect_bijection(pinned, 64);
    EXPECT_EQ(pinned.slot_of[30], SlotId(62));
}

TEST(FormationMatch, Property3_SameInputSameResultAtTenThousand) {
    const Points from = pads(10'000), to = ball(10'000);
    const Assignment a = matched(from, to);
    expect_bijection(a, 10'000);
    EXPECT_EQ(a.slot_of, matched(from, to).slot_of);
    EXPECT_FALSE(a.pairwise);
    EXPECT_TRUE(a.crossing);
}

TEST(FormationMatch, MissionsChooseIt) {
    const Mission mission =
        test::show_of(test::keyframe("a", "circle") +
                      test::keyframe("b", "circle", "size_m = [30]\narrive = { assign = \"formation_coordinates\" }"));
    const Route route = build_route(mission, aerogram::Run{}).value();
    EXPECT_EQ(route.stops[1].keyframe.slot_of, route.stops[0].keyframe.slot_of);
    EXPECT_EQ(route.stops[1].assignment, "formation coordinates, no paths cross");
}

}  // namespace
}  // namespace aerogram::planner
