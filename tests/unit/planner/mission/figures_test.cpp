// The missions of 1,260 individuals and the formations that missions/assets/figures/make.py wrote.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "planner/mission/mission_reader.hpp"

namespace aerogram::planner {
namespace {

Points points_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    EXPECT_TRUE(in.good()) << file;
    Points out;
    std::string line, cell;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream cells(line);
        Vec3 p{};
        std::getline(cells, cell, ',');
        for (int c = 0; c < 3; ++c) {
            std::getline(cells, cell, ',');
            p[c] = std::stod(cell);
        }
        out.push_back(p);
    }
    return out;
}

TEST(FiguresMission, HasThirtyFiveFiguresOfSixSubgroupsOfSixThatMoveAtEveryLevel) {
    std::filesystem::current_path(AEROGRAM_SOURCE_DIR);
    const Result<Mission> mission = read_mission("missions/figures-1260.toml");
    ASSERT_TRUE(mission.ok()) << mission.error().message;
    std::map<std::size_t, int> groups_of_size;
    for (const Group& g : mission->groups) ++groups_of_size[g.drones.size()];
    EXPECT_EQ(groups_of_size, (std::map<std::size_t, int>{{1260, 1}, {36, 35}, {6, 210}}));
    for (std::size_t k = 1; k < mission->keyframes.size(); ++k) {
        EXPECT_EQ(mission->keyframes[k].arrive.groups.size(), 246U);
        EXPECT_EQ(mission->keyframes[k].arrive.assign, Assign::keep);
    }
    const Result<Mission> flat = read_mission("missions/figures-1260-flat.toml");
    ASSERT_TRUE(flat.ok()) << flat.error().message;
    EXPECT_TRUE(flat->groups.empty());
    EXPECT_EQ(flat->keyframes.size(), mission->keyframes.size());
}

TEST(FiguresMission, FormationsKeepTheSpacingAndFiguresAreCompact) {
    std::filesystem::current_path(AEROGRAM_SOURCE_DIR);
    const Result<Mission> mission = read_mission("missions/figures-1260.toml");
    ASSERT_TRUE(mission.ok());
    ASSERT_EQ(mission->keyframes.size(), 5U);
    for (const Keyframe& k : mission->keyframes) {
        SCOPED_TRACE(k.name);
        const Points points = points_of(std::get<CsvSource>(k.parts.at(0).source).file);
        ASSERT_EQ(points.size(), 1260U);
        double nearest = 1e9;
        for (std::size_t i = 0; i < points.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, glm::distance(points[i], points[j]));
        }
        EXPECT_GE(nearest, mission->limits.formation_spacing_m);
        for (std::size_t figure = 0; figure < 35; ++figure) {
            double widest = 0.0;
            for (std::size_t i = 0; i < 36; ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    widest = std::max(widest, glm::distance(points[36 * figure + i], points[36 * figure + j]));
                }
            }
            EXPECT_LT(widest, 50.0) << "figure " << figure + 1 << " is torn apart";
        }
    }
}

}  // namespace
}  // namespace aerogram::planner
