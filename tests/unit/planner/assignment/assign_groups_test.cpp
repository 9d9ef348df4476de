#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner/assignment/instances.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;
using ::testing::ElementsAre;

template <class Id>
std::vector<Id> range(std::size_t begin, std::size_t end) {
    std::vector<Id> ids;
    for (std::size_t i = begin; i < end; ++i) ids.emplace_back(i);
    return ids;
}

/// Groups of three, three and two in a row; slot sets likewise, with the two threes on swapped sides.
const Points kFrom{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {10, 0, 0}, {11, 0, 0}, {12, 0, 0}, {20, 0, 0}, {21, 0, 0}};
const Points kTo{{12, 0, 5}, {11, 0, 5}, {10, 0, 5}, {0, 0, 5}, {1, 0, 5}, {2, 0, 5}, {21, 0, 5}, {20, 0, 5}};
GroupMatch three_groups() {
    return {{range<DroneId>(0, 3), range<DroneId>(3, 6), range<DroneId>(6, 8)},
            {range<SlotId>(0, 3), range<SlotId>(3, 6), range<SlotId>(6, 8)},
            {}};
}
Result<Assignment> grouped(const GroupMatch& groups, const std::map<DroneId, SlotId>& pins = {}) {
    return assign_groups(kFrom, kTo, groups, pins, kEuclidean, aerogram::Run{});
}
std::string refusal(const GroupMatch& groups, const std::map<DroneId, SlotId>& pins = {}) {
    const auto result = grouped(groups, pins);
    EXPECT_EQ(result.error().code, ErrorCode::infeasible);
    return result.error().message;
}

TEST(AssignGroups, GroupsGoToTheNearestSetOfTheirSize) {
    const Assignment found = grouped(three_groups()).value();
    EXPECT_THAT(numbers(found.slot_of), ElementsAre(3, 4, 5, 2, 1, 0, 7, 6));
    EXPECT_DOUBLE_EQ(found.cost_m2, 8.0 * 25.0);
    EXPECT_LE(found.duality_gap, 1e-12);
    EXPECT_TRUE(found.pairwise);
}

TEST(AssignGroups, WantedSetsAreTakenAndCrossingsReported) {
    GroupMatch groups = three_groups();
    groups.wanted = {0, std::nullopt, std::nullopt};
    const Assignment found = grouped(groups).value();
    EXPECT_THAT(numbers(found.slot_of), ElementsAre(2, 1, 0, 3, 4, 5, 7, 6));
    EXPECT_FALSE(found.pairwise);
    EXPECT_EQ(found.crossing->second, DroneId(3));
}

TEST(AssignGroups, PinTakesItsGroupAlong) {
    const Assignment found = grouped(three_groups(), {{DroneId(1), SlotId(0)}}).value();
    EXPECT_THAT(numbers(found.slot_of), ElementsAre(2, 0, 1, 3, 4, 5, 7, 6));
}

TEST(AssignGroups, DronesOutsideGroupsAreAGroupOfTheirOwnAndOrderInsideSetsIsFree) {
    GroupMatch groups{
        {{DroneId(7), DroneId(0), DroneId(3)}, {DroneId(1), DroneId(2), DroneId(4), DroneId(5), DroneId(6)}},
        {{SlotId(6), SlotId(0), SlotId(3)}, {SlotId(7), SlotId(5), SlotId(4), SlotId(1), SlotId(2)}},
        {}};
    const Assignment found = grouped(groups).value();
    EXPECT_TRUE(is_bijection(found.slot_of));
    EXPECT_THAT(numbers(found.slot_of), ElementsAre(3, 4, 5, 0, 2, 1, 7, 6));
}

TEST(AssignGroups, WholeGroupsAreMatchedAtTheLeastTotal) {
    // Two groups, two sets between them: the nearest set of the first is the only good one for the second.
    const Points from{{0, 0, 0}, {3, 0, 0}}, to{{2, 0, 0}, {-9, 0, 0}};
    const GroupMatch groups{{{DroneId(0)}, {DroneId(1)}}, {{SlotId(0)}, {SlotId(1)}}, {std::nullopt, std::nullopt}};
    EXPECT_THAT(numbers(assign_groups(from, to, groups, {}, kEuclidean, aerogram::Run{}).value().slot_of),
                ElementsAre(1, 0));
}

TEST(AssignGroups, SizesWithoutPartnerAreRefused) {
    GroupMatch groups = three_groups();
    groups.slots = {range<SlotId>(0, 4), range<SlotId>(4, 6), range<SlotId>(6, 8)};
    EXPECT_EQ(refusal(groups),
              "1 group of 2 drones but 2 slot sets of that size: make the sizes equal or name who goes where");
}

TEST(AssignGroups, WantedSetOfAnotherSizeIsRefused) {
    GroupMatch groups = three_groups();
    groups.wanted = {2, std::nullopt, std::nullopt};
    EXPECT_EQ(refusal(groups), "group 1 has 3 drones, but slot set 3 that it must take has 2 slots");
}

TEST(AssignGroups, SetWantedTwiceIsRefused) {
    GroupMatch groups = three_groups();
    groups.wanted = {1, 1, std::nullopt};
    EXPECT_EQ(refusal(groups), "group 1 and group 2 must both take slot set 2");
}

TEST(AssignGroups, PinThatLeavesItsGroupIsRefused) {
    GroupMatch groups = three_groups();
    groups.wanted = {1, std::nullopt, std::nullopt};
    EXPECT_EQ(refusal(groups, {{DroneId(1), SlotId(2)}}),
              "pin 2 = 3 leaves its group: group 1 flies to slot set 2, the slot is in slot set 1");
    EXPECT_EQ(refusal(three_groups(), {{DroneId(0), SlotId(0)}, {DroneId(1), SlotId(4)}}),
              "pin 2 = 5 leaves its group: group 1 flies to slot set 1, the slot is in slot set 2");
}

TEST(AssignGroups, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    aerogram::Run run;
    run.stop = source.get_token();
    EXPECT_EQ(assign_groups(kFrom, kTo, three_groups(), {}, kEuclidean, run).error().code, ErrorCode::stopped);
}

/// Two rows of four, each of two pairs; the other formation has the rows on swapped sides and the pairs swapped inside.
TEST(AssignGroups, GroupsInGroupsGoToSetsInSets) {
    const Points from{{0, 0, 0}, {1, 0, 0}, {4, 0, 0}, {5, 0, 0}, {0, 9, 0}, {1, 9, 0}, {4, 9, 0}, {5, 9, 0}};
    const Points to{{4, 9, 5}, {5, 9, 5}, {0, 9, 5}, {1, 9, 5}, {4, 0, 5}, {5, 0, 5}, {0, 0, 5}, {1, 0, 5}};
    const Subsets<DroneId> low{{range<DroneId>(0, 2), range<DroneId>(2, 4)}, {}},
        high{{range<DroneId>(4, 6), range<DroneId>(6, 8)}, {}};
    const Subsets<SlotId> first{{range<SlotId>(0, 2), range<SlotId>(2, 4)}, {}},
        second{{range<SlotId>(4, 6), range<SlotId>(6, 8)}, {}};
    GroupMatch groups{{range<DroneId>(0, 4), range<DroneId>(4, 8)},
                      {range<SlotId>(0, 4), range<SlotId>(4, 8)},
                      {},
                      {low, high},
                      {first, second}};
    const Assignment found = assign_groups(from, to, groups, {}, kEuclidean, aerogram::Run{}).value();
    EXPECT_THAT(numbers(found.slot_of), ElementsAre(6, 7, 4, 5, 2, 3, 0, 1));
    EXPECT_TRUE(found.pairwise);
    // A pin takes the pair along, and with it the pair's row.
    const Assignment pinned =
        assign_groups(from, to, groups, {{{DroneId(0), SlotId(1)}}}, kEuclidean, aerogram::Run{}).value();
    EXPECT_THAT(numbers(pinned.slot_of), ElementsAre(1, 0, 2, 3, 6, 7, 4, 5));
}

TEST(AssignGroups, WhatNoInnerSetHoldsStaysTogether) {
    GroupMatch groups = three_groups();
    groups.drones = {range<DroneId>(0, 8)};
    groups.slots = {range<SlotId>(0, 8)};
    groups.drones_inside = {{{range<DroneId>(0, 3)}, {}}};
    groups.slots_inside = {{{range<SlotId>(0, 3)}, {}}};
    const std::vector<std::uint32_t> found = numbers(grouped(groups).value().slot_of);
    EXPECT_THAT(std::vector(found.begin(), found.begin() + 3), ElementsAre(2, 1, 0));
    groups.slots_inside = {{{range<SlotId>(0, 2)}, {}}};
    EXPECT_EQ(refusal(groups),
              "the rest of group 1 has 5 drones, but the rest of its slot set that it must take has 6 slots");
    groups.slots_inside = {{{range<SlotId>(0, 2), range<SlotId>(2, 8)}, {}}};
    EXPECT_EQ(refusal(groups),
              "inside group 1: 0 groups of 2 drones but 1 slot set of that size: make the sizes equal or name who goes "
              "where");
    // Sets on one side only say nothing: drones are matched as in one group.
    groups.slots_inside.clear();
    EXPECT_THAT(numbers(grouped(groups).value().slot_of), ElementsAre(3, 4, 5, 2, 1, 0, 7, 6));
}

TEST(AssignGroups, RandomTreesKeepEveryLevelTogether) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(seed);
        const Points from = random_points(60, seed), to = random_points(60, seed + 100);
        GroupMatch groups;
        for (std::size_t g = 0; g < 3; ++g) {
            groups.drones.push_back(range<DroneId>(20 * g, 20 * g + 20));
            groups.slots.push_back(range<SlotId>(20 * g, 20 * g + 20));
            Subsets<DroneId> drones;
            Subsets<SlotId> slots;
            for (std::size_t k = 0; k < 4; ++k) {
                drones.sets.push_back(range<DroneId>(20 * g + 5 * k, 20 * g + 5 * k + 5));
                slots.sets.push_back(range<SlotId>(20 * g + 5 * k, 20 * g + 5 * k + 5));
            }
            groups.drones_inside.push_back(drones);
            groups.slots_inside.push_back(slots);
        }
        const Assignment found = assign_groups(from, to, groups, {}, kEuclidean, aerogram::Run{}).value();
        EXPECT_TRUE(is_bijection(found.slot_of));
        for (std::size_t d = 0; d < 60; ++d) EXPECT_EQ(found.slot_of[d].value / 5, found.slot_of[d / 5 * 5].value / 5);
        for (std::size_t d = 0; d < 60; ++d)
            EXPECT_EQ(found.slot_of[d].value / 20, found.slot_of[d / 20 * 20].value / 20);
        EXPECT_LE(found.duality_gap, 1e-12);
    }
}

TEST(AssignGroups, SetsThatAreNoPartitionAreBugs) {
    GroupMatch groups = three_groups();
    groups.drones[0].push_back(DroneId(3));
    EXPECT_THROW((void)grouped(groups), ContractViolation);
    groups = three_groups();
    groups.slots.pop_back();
    EXPECT_THROW((void)grouped(groups), ContractViolation);
}

}  // namespace
}  // namespace aerogram::planner
