#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner/assignment/instances.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;
using ::testing::ElementsAre;

const Points kFrom{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {6, 0, 0}, {8, 0, 0}};

std::vector<std::uint32_t> kept(const std::map<DroneId, SlotId>& pins) {
    return numbers(assign_keep(kFrom, kFrom, pins, kEuclidean).value().slot_of);
}

TEST(AssignKeep, EveryDroneFliesToItsOwnSlot) {
    const Assignment found = assign_keep(kFrom, kFrom, {}, kEuclidean).value();
    EXPECT_THAT(numbers(found.slot_of), ElementsAre(0, 1, 2, 3, 4));
    EXPECT_EQ(found.cost_m2, 0.0);
    EXPECT_EQ(found.duality_gap, 0.0);
    EXPECT_TRUE(found.pairwise);
}

TEST(AssignKeep, DisplacedDronesTakeVacatedSlotsInOrder) {
    EXPECT_THAT(kept({{DroneId(4), SlotId(0)}}), ElementsAre(4, 1, 2, 3, 0));
    EXPECT_THAT(kept({{DroneId(4), SlotId(0)}, {DroneId(3), SlotId(1)}}), ElementsAre(3, 4, 2, 1, 0));
    EXPECT_THAT(kept({{DroneId(0), SlotId(1)}, {DroneId(1), SlotId(2)}}), ElementsAre(1, 2, 0, 3, 4));
    EXPECT_THAT(kept({{DroneId(2), SlotId(2)}}), ElementsAre(0, 1, 2, 3, 4));
}

TEST(AssignKeep, CrossingsAreReportedWithTheLowestPair) {
    const Points back{{0, 0, 0}, {8, 0, 0}, {4, 0, 0}, {6, 0, 0}, {2, 0, 0}};
    const Assignment found = assign_keep(kFrom, back, {}, kEuclidean).value();
    EXPECT_FALSE(found.pairwise);
    ASSERT_TRUE(found.crossing);
    EXPECT_EQ(found.crossing->first, DroneId(1));
    EXPECT_EQ(found.crossing->second, DroneId(2));
    EXPECT_DOUBLE_EQ(found.cost_m2, 36.0 + 36.0);
}

TEST(AssignKeep, CostIsInTheSeparationMetric) {
    Points up = kFrom;
    for (Vec3& p : up) p.z += 10.0;
    EXPECT_DOUBLE_EQ(assign_keep(kFrom, up, {}, SeparationMetric{2.0}).value().cost_m2, 5.0 * 25.0);
}

}  // namespace
}  // namespace aerogram::planner
