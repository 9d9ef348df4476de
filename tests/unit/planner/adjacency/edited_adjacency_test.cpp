#include <gtest/gtest.h>

#include "geo/contract.hpp"
#include "planner/adjacency/adjacency.hpp"

namespace aerogram::planner {
namespace {

const Points kRow{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {6, 0, 0}, {8, 0, 0}};  // edges 0-1, 1-2, 2-3, 3-4 of weight 0.5

std::vector<DroneId> drones(std::initializer_list<std::size_t> numbers) {
    std::vector<DroneId> ids;
    for (const std::size_t n : numbers) ids.push_back(DroneId(n));
    return ids;
}
Group group(const char* name, std::initializer_list<std::size_t> members, double weight) {
    Group g;
    g.name = name;
    g.drones = drones(members);
    g.weight = weight;
    return g;
}
AdjacencyEdit edit(AdjacencyEnd first, AdjacencyEnd second, double weight) {
    return {first, second, weight, 0};
}
AdjacencyEnd drone(std::size_t d) {
    return {DroneId(d)};
}
AdjacencyEnd group_end(std::size_t g) {
    return {g};
}

std::vector<Edge> edited(const std::vector<Group>& groups, const std::vector<AdjacencyEdit>& edits) {
    return edited_adjacency(delaunay_adjacency(kRow), kRow, groups, edits).edges;
}

TEST(EditedAdjacency, WithoutWordsIsTheGraph) {
    EXPECT_EQ(edited({}, {}), delaunay_adjacency(kRow).edges);
}

TEST(EditedAdjacency, GroupsRaiseTheirInnerWeightsOnly) {
    EXPECT_EQ(edited({group("a", {0, 1}, 10), group("b", {2, 3, 4}, 4)}, {}),
              (std::vector<Edge>{{0, 1, 5.0}, {1, 2, 0.5}, {2, 3, 2.0}, {3, 4, 2.0}}));
}

TEST(EditedAdjacency, GroupsOfTwoLevelsMultiply) {
    EXPECT_EQ(edited({group("inner", {0, 1}, 10), group("outer", {0, 1, 2}, 2)}, {}),
              (std::vector<Edge>{{0, 1, 10.0}, {1, 2, 1.0}, {2, 3, 0.5}, {3, 4, 0.5}}));
}

TEST(EditedAdjacency, PairIsMultipliedCutAndConnectedInOrder) {
    EXPECT_EQ(edited({}, {edit(drone(1), drone(0), 3.0), edit(drone(1), drone(2), 0.0), edit(drone(0), drone(4), 2.0)}),
              (std::vector<Edge>{{0, 1, 1.5}, {0, 4, 0.25}, {2, 3, 0.5}, {3, 4, 0.5}}));
    EXPECT_EQ(edited({}, {edit(drone(0), drone(1), 0.0), edit(drone(0), drone(1), 4.0)}).front(), (Edge{0, 1, 2.0}));
}

TEST(EditedAdjacency, CuttingWhatIsNotThereChangesNothing) {
    EXPECT_EQ(edited({}, {edit(drone(0), drone(3), 0.0)}), delaunay_adjacency(kRow).edges);
}

TEST(EditedAdjacency, GroupEndStandsForItsMembers) {
    EXPECT_EQ(edited({group("a", {0, 1}, 1)}, {edit(group_end(0), drone(3), 4.0)}),
              (std::vector<Edge>{{0, 1, 0.5}, {0, 3, 4.0 / 6.0}, {1, 2, 0.5}, {1, 3, 1.0}, {2, 3, 0.5}, {3, 4, 0.5}}));
    EXPECT_EQ(edited({group("a", {0, 1}, 1), group("b", {2, 3}, 1)}, {edit(group_end(0), group_end(1), 0.0)}),
              (std::vector<Edge>{{0, 1, 0.5}, {2, 3, 0.5}, {3, 4, 0.5}}));
}

TEST(EditedAdjacency, PairNamedTwiceByAnEditCountsOnce) {
    EXPECT_EQ(edited({group("a", {0, 1, 2}, 1)}, {edit(group_end(0), group_end(0), 2.0)}),
              (std::vector<Edge>{{0, 1, 1.0}, {0, 2, 0.5}, {1, 2, 1.0}, {2, 3, 0.5}, {3, 4, 0.5}}));
}

TEST(EditedAdjacency, CoincidentDronesConnectAsStronglyAsTheClosest) {
    const Points points{{0, 0, 0}, {0, 0, 0}, {2, 0, 0}};
    const auto graph = edited_adjacency(delaunay_adjacency(points), points, {},
                                        {edit(drone(0), drone(1), 0.0), edit(drone(0), drone(1), 2.0)});
    EXPECT_EQ(graph.edges, (std::vector<Edge>{{0, 1, 1.0}, {0, 2, 0.5}}));
}

TEST(EditedAdjacency, WrongIndicesAreBugs) {
    EXPECT_THROW((void)edited({}, {edit(drone(0), drone(5), 1.0)}), ContractViolation);
    EXPECT_THROW((void)edited({}, {edit(drone(0), group_end(0), 1.0)}), ContractViolation);
    EXPECT_THROW((void)edited({}, {edit(drone(0), drone(1), -1.0)}), ContractViolation);
}

}  // namespace
}  // namespace aerogram::planner
