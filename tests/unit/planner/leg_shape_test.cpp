#include "planner/leg_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/motion/profile.hpp"
#include "small_shows.hpp"

namespace aerogram::planner {
namespace {

using namespace test;

/// The shape of the leg to keyframe 2.
Lattice second_arrival(const Mission& mission, Method method, std::size_t rows = 33, double stagger_share = 0.0) {
    const Route route = build_route(mission, aerogram::Run{}).value();
    const Leg leg = legs_of(mission, route).at(2);
    return LegShape::of(mission, route, leg, method, aerogram::Run{})->lattice(rows, stagger_share);
}

TEST(LegShape, StraightRowsAreThoseOfTheProfile) {
    const Mission mission = show_of(keyframe("a", "circle") + keyframe("b", "helix"));
    const Lattice lattice = second_arrival(mission, Method::straight);
    const std::vector<double> profile = profile_rows(ProfileKind::minimum_jerk, 33);
    for (std::size_t k = 0; k < 33; ++k) {
        for (std::size_t i = 0; i < 8; ++i) {
            const Vec3 expected = (1.0 - profile[k]) * lattice.at(0, i) + profile[k] * lattice.at(32, i);
            EXPECT_LT(glm::distance(lattice.at(k, i), expected), 1e-12);
        }
    }
}

TEST(LegShape, StaggeredDronesLeaveOneAfterTheOtherTheForemostFirst) {
    const Mission mission = show_of(
        "[[keyframe]]\nname = \"a\"\nshape = \"line\"\nsize_m = [28]\ncenter_m = [0, 0, 40]\n"
        "arrive = { assign = \"keep\" }\n"
        "[[keyframe]]\nname = \"b\"\nshape = \"line\"\nsize_m = [28]\ncenter_m = [60, 0, 40]\n"
        "arrive = { assign = \"keep\" }\n");
    const Lattice lattice = second_arrival(mission, Method::straight, 63, 0.5);
    std::vector<std::pair<double, double>> gone_m;  // by place in the line, which flies to the right
    for (std::size_t i = 0; i < 8; ++i)
        gone_m.emplace_back(lattice.at(0, i).x, lattice.at(31, i).x - lattice.at(0, i).x);
    std::ranges::sort(gone_m);
    EXPECT_LT(gone_m.front().second, 2.0);
    for (std::size_t i = 1; i < 8; ++i) EXPECT_GT(gone_m[i].second, gone_m[i - 1].second);
}

/// An obstacle beside the way holds on to its neighbours: with a weight the paths are others than without.
TEST(LegShape, ObstaclesWithAWeightShapeSpectralWays) {
    const auto mission_with = [](const char* weight) {
        return show_of(std::string("[[airspace.obstacle]]\nkind = \"cylinder\"\ncenter_m = [0, 12]\nradius_m = "
                                   "1\nheight_m = 60\nweight = ") +
                       weight + "\n" + keyframe("a", "grid") +
                       keyframe("b", "grid",
                                "rotate_deg = [0, 90, 0]\narrive = { method = \"spectral\", assign = "
                                "\"keep\" }"));
    };
    const Lattice without = second_arrival(mission_with("0"), Method::spectral);
    const Lattice with = second_arrival(mission_with("50"), Method::spectral);
    double apart_m = 0.0;
    for (std::size_t p = 0; p < with.points_m.size(); ++p)
        apart_m = std::max(apart_m, glm::distance(with.points_m[p], without.points_m[p]));
    EXPECT_GT(apart_m, 0.05);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(with.at(32, i), without.at(32, i));
}

TEST(LegShape, GroupsThatOverlapOnOneWayAreRefused) {
    Mission mission =
        show_of("[[group]]\nname = \"a\"\ndrones = \"1-4\"\n[[group]]\nname = \"b\"\ndrones = \"5-8\"\n" +
                keyframe("a", "grid") + keyframe("b", "circle", "arrive = { groups = { a = {}, b = {} } }"));
    const Route route = build_route(mission, aerogram::Run{}).value();
    Route overlapping = route;
    overlapping.groups[1].drones = overlapping.groups[0].drones;  // as clusters may come out
    overlapping.groups[1].drones.back() = DroneId(7);
    const auto shape =
        LegShape::of(mission, overlapping, legs_of(mission, route).at(2), Method::straight, aerogram::Run{});
    ASSERT_FALSE(shape);
    EXPECT_EQ(shape.error().code, ErrorCode::invalid_input);
    EXPECT_NE(shape.error().message.find("shares some of its drones"), std::string::npos);
}

/// A row of eight, 4 m apart, with a mast in its middle: drones 4 and 5 (0-based 3 and 4) do not see each other.
TEST(GraphKeyframe, NobodyIsANeighbourThroughAnObstacleUnlessAnEditSaysSo) {
    const std::string row =
        "[[keyframe]]\nname = \"row\"\nshape = \"line\"\nsize_m = [28]\ncenter_m = [0, 0, 40]\n"
        "arrive = { assign = \"keep\" }\n";
    const auto neighbours_in_the_middle = [&](const std::string& more, bool carried = false) {
        Mission mission = show_of(more + row);
        if (carried) mission.carrier.emplace();
        Route route;
        Points row_m;
        for (int i = 0; i < 8; ++i) row_m.emplace_back(-14.0 + 4.0 * i, 0.0, 40.0);
        const auto keyframe = graph_keyframe(mission, route, row_m, aerogram::Run{});
        EXPECT_TRUE(keyframe.ok()) << keyframe.error().message;
        EXPECT_EQ(keyframe->positions_m, row_m);
        return std::ranges::count_if(keyframe->graph.edges, [](const Edge& e) { return e.a == 3 && e.b == 4; });
    };
    const std::string mast =
        "[[airspace.obstacle]]\nkind = \"cylinder\"\ncenter_m = [0, 0]\nradius_m = 1\nheight_m = 60\n";
    const std::string low =
        "[[airspace.obstacle]]\nkind = \"cylinder\"\ncenter_m = [0, 0]\nradius_m = 1\nheight_m = 39\n";
    EXPECT_EQ(neighbours_in_the_middle(""), 1);
    EXPECT_EQ(neighbours_in_the_middle(low), 1);
    EXPECT_EQ(neighbours_in_the_middle(mast), 0);
    EXPECT_EQ(neighbours_in_the_middle(mast + "[[adjacency]]\nbetween = [4, 5]\nweight = 1\n"), 1);
    EXPECT_EQ(neighbours_in_the_middle(mast, true), 1);  // it stands in the ground's frame, the row moves along
}

}  // namespace
}  // namespace aerogram::planner
