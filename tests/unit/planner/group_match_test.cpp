#include "planner/group_match.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "small_shows.hpp"

namespace aerogram::planner {
namespace {

using namespace test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Formation slots_of(const Mission& mission) {
    Formation formation;
    for (std::size_t p = 0; p < mission.keyframes[0].parts.size(); ++p) {
        for (std::size_t i = 0; i < mission.keyframes[0].parts[p].drones; ++i) {
            formation.points_m.emplace_back(static_cast<double>(formation.points_m.size()), 0.0, 40.0);
            formation.part.push_back(static_cast<std::uint32_t>(p));
        }
    }
    formation.spare.assign(formation.points_m.size(), false);
    return formation;
}

Result<GroupMatch> match_of(const Mission& mission) {
    return match_groups(mission.groups, mission.keyframes[0], slots_of(mission), mission.fleet.drones);
}

template <class Id>
std::vector<std::vector<std::size_t>> numbers(const std::vector<std::vector<Id>>& sets) {
    std::vector<std::vector<std::size_t>> out;
    for (const auto& set : sets) {
        out.emplace_back();
        for (const Id id : set) out.back().push_back(id.number());
    }
    return out;
}

const std::string kSplit = "[[group]]\nname = \"all\"\nsplit = [2, 2]\n";

TEST(MatchGroups, OnePartIsDealtOutInRunsOfTheGroupsSizes) {
    const auto match =
        match_of(show_of("[[group]]\nname = \"a\"\ndrones = \"6-8\"\n[[group]]\nname = \"b\"\ndrones = "
                         "\"1-2\"\n" +
                         keyframe("k", "line", "arrive = { assign = \"groups\" }")));
    EXPECT_THAT(numbers(match->drones), ElementsAre(ElementsAre(6, 7, 8), ElementsAre(1, 2), ElementsAre(3, 4, 5)));
    EXPECT_THAT(numbers(match->slots), ElementsAre(ElementsAre(1, 2, 3), ElementsAre(4, 5), ElementsAre(6, 7, 8)));
}

TEST(MatchGroups, GroupsInsideTakeRunsInsideTheirWholesRun) {
    const auto match = match_of(show_of(
        kSplit +
        keyframe("k", "line", "arrive = { assign = \"groups\", groups = { all-1 = { levels = [{}] }, all-2 = {} } }")));
    EXPECT_THAT(numbers(match->drones), ElementsAre(ElementsAre(1, 2, 3, 4), ElementsAre(5, 6, 7, 8)));
    EXPECT_THAT(numbers(match->drones_inside[0].sets), ElementsAre(ElementsAre(1, 2), ElementsAre(3, 4)));
    EXPECT_THAT(numbers(match->slots_inside[0].sets), ElementsAre(ElementsAre(1, 2), ElementsAre(3, 4)));
    EXPECT_TRUE(match->drones_inside[1].sets.empty());
}

TEST(MatchGroups, InnerGroupsThatPartsCallByNameAreWholes) {
    const auto match = match_of(
        show_of(kSplit +
                "[[keyframe]]\nname = \"k\"\ncenter_m = [0, 0, 40]\narrive = { assign = \"groups\" }\n"
                "[[keyframe.part]]\nshape = \"line\"\ngroup = \"all-2\"\n[[keyframe.part]]\nshape = \"line\"\ngroup = "
                "\"all-1\"\n"));
    ASSERT_TRUE(match);
    EXPECT_THAT(numbers(match->drones), ElementsAre(ElementsAre(1, 2, 3, 4), ElementsAre(5, 6, 7, 8)));
    EXPECT_EQ(match->wanted[0], 1u);
    EXPECT_EQ(match->wanted[1], 0u);
}

TEST(MatchGroups, WholesThatShareADroneAreRefusedByName) {
    const auto match =
        match_of(show_of("[[group]]\nname = \"a\"\ndrones = \"1-4\"\n[[group]]\nname = \"b\"\ndrones = "
                         "\"4-8\"\n" +
                         keyframe("k", "line", "arrive = { assign = \"groups\" }")));
    ASSERT_FALSE(match);
    EXPECT_EQ(match.error().code, ErrorCode::infeasible);
    EXPECT_THAT(match.error().message, HasSubstr("group \"b\" shares drone 4"));
}

}  // namespace
}  // namespace aerogram::planner
