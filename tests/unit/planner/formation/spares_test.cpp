#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "planner/formation/spare_places.hpp"
#include "planner/sampling/thinning.hpp"
#include "tests/unit/planner/formation/missions.hpp"
#include "tests/unit/planner/sampling/random.hpp"

namespace aerogram::planner::testing {
namespace {

using ::testing::HasSubstr;

/// Parts that leave `spare` drones over, above pads 2.5 m apart.
Mission with_spares(std::vector<Part> parts, std::size_t spare, Spares where) {
    Mission mission = mission_of(std::move(parts));
    mission.keyframes[0].center_m = {0, 0, 60};
    mission.keyframes[0].line = 9;
    mission.fleet.drones += spare;
    mission.fleet.spares = where;
    for (std::size_t d = 0; d < mission.fleet.drones; ++d) {
        mission.fleet.pads_m.emplace_back(2.5 * static_cast<double>(d % 20), 2.5 * static_cast<double>(d / 20), 0.0);
    }
    return mission;
}

TEST(Spares, Property1And2EveryDroneHasASlotAtTheSpacing) {
    for (const Spares where : {Spares::pads, Spares::wings, Spares::overflow}) {
        for (const std::size_t spare : {1U, 2U, 150U}) {
            for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::line, ShapeKind::disc}) {
                for (const double downwash : {1.0, 2.0}) {
                    Mission mission = with_spares({part_of(shape(kind), 40)}, spare, where);
                    mission.limits.downwash = downwash;
                    const Formation formation = build(mission).value();
                    ASSERT_EQ(formation.points_m.size(), 40 + spare);
                    EXPECT_GE(formation.smallest_spacing_m, 2.2 - 1e-9) << spare;
                    for (std::size_t s = 0; s < formation.points_m.size(); ++s) {
                        EXPECT_EQ(formation.spare[s], s >= 40);
                        EXPECT_EQ(formation.part[s], s >= 40 ? 1U : 0U);
                        if (s >= 40) {
                            EXPECT_EQ(formation.colors[s], Rgb{});
                        }
                    }
                }
            }
        }
    }
}

TEST(Spares, WaitAboveTheLastPads) {
    const Mission mission = with_spares({part_of(shape(ShapeKind::sphere), 10)}, 3, Spares::pads);
    const Formation formation = build(mission).value();
    std::set<double> wanted, found;
    for (std::size_t i = 10; i < 13; ++i) {
        wanted.insert(mission.fleet.pads_m[i].x);
        found.insert(formation.points_m[i].x);
        EXPECT_NEAR(formation.points_m[i].z, 2.6, 1e-12);
    }
    EXPECT_EQ(found, wanted);
    EXPECT_EQ(formation.note, "3 spare drones wait above their pads");
}

TEST(Spares, ALowFormationLeavesNoRoomAboveThePads) {
    Mission mission = with_spares({part_of(shape(ShapeKind::grid), 100, flat(40, 40))}, 20, Spares::pads);
    for (Vec3& pad : mission.fleet.pads_m) pad = {0.5 * pad.x, 0, 0};  // 1.25 m apart, in rows on top of each other
    const auto formation = build(mission);
    ASSERT_FALSE(formation.ok());
    EXPECT_THAT(formation.error().message,
                HasSubstr("show.toml:9: keyframe[1]: only 10 of 20 spare drones have a place"));
}

TEST(Spares, WingsStandLeftAndRightInTheFormationsHeights) {
    const Mission mission = with_spares({part_of(shape(ShapeKind::sphere), 100)}, 31, Spares::wings);
    const Formation formation = build(mission).value();
    const Box box = box_of({formation.points_m.begin(), formation.points_m.begin() + 100});
    int left = 0, right = 0;
    for (std::size_t i = 100; i < 131; ++i) {
        const Vec3& p = formation.points_m[i];
        left += p.x < box.low.x;
        right += p.x > box.high.x;
        EXPECT_GE(p.z, box.low.z - 1e-9);
        EXPECT_LE(p.z, box.high.z + 1e-9);
    }
    EXPECT_EQ(left, 16);
    EXPECT_EQ(right, 15);
    EXPECT_EQ(formation.note, "31 spare drones wait in columns beside the formation");
}

TEST(Spares, OverflowStandsBehind) {
    const Mission mission = with_spares({part_of(shape(ShapeKind::sphere), 100)}, 12, Spares::overflow);
    const Formation formation = build(mission).value();
    const Box box = box_of({formation.points_m.begin(), formation.points_m.begin() + 100});
    for (std::size_t i = 100; i < 112; ++i) EXPECT_NEAR(formation.points_m[i].y, box.high.y + 4.4, 1e-9);
    EXPECT_EQ(formation.note, "12 spare drones wait in a sheet behind the formation");
}

TEST(Thinned, Property1And2CountIsExactAndTheSmallestDistanceGrows) {
    for (std::uint64_t seed = 1; seed <= cases(20); ++seed) {
        Random random(seed);
        Points points;
        for (int i = 0; i < 300; ++i) points.push_back(random.point(10.0) * Vec3(1, seed % 2 == 0 ? 0 : 1, 1));
        points[7] = points[8];  // duplicates go first
        double before = 0.0;
        for (const std::size_t count : {299U, 150U, 40U, 2U}) {
            const auto left = thinned(points, count);
            ASSERT_EQ(left.size(), count);
            EXPECT_TRUE(std::is_sorted(left.begin(), left.end()));
            Points kept;
            for (const std::size_t i : left) kept.push_back(points[i]);
            const double now = closest_pair(kept, {}).distance_m;
            EXPECT_GE(now, before) << "seed " << seed;
            before = now;
        }
        EXPECT_EQ(thinned(points, 40), thinned(points, 40));
    }
}

/// Takes a point of the closest pair away again and again, by all pairs.
std::vector<std::size_t> thinned_by_brute_force(const Points& points, std::size_t count) {
    std::vector<std::size_t> left(points.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
    while (left.size() > count) {
        std::tuple<double, double, std::size_t> best{1e300, 0, 0};
        std::size_t worst = 0;
        for (std::size_t k = 0; k < left.size(); ++k) {
            std::vector<double> squared;
            for (const std::size_t j : left) {
                const Vec3 d = points[j] - points[left[k]];
                if (j != left[k]) squared.push_back(glm::dot(d, d));
            }
            std::partial_sort(squared.begin(), squared.begin() + 2, squared.end());
            const std::tuple now{squared[0], squared[1], points.size() - left[k]};
            if (now < best) {
                best = now;
                worst = k;
            }
        }
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(worst));
    }
    return left;
}

TEST(Thinned, AgreesWithBruteForce) {
    for (std::uint64_t seed = 1; seed <= cases(10); ++seed) {
        Random random(seed);
        Points points;
        for (int i = 0; i < 60; ++i) points.push_back(random.point(5.0));
        EXPECT_EQ(thinned(points, 20), thinned_by_brute_force(points, 20)) << "seed " << seed;
    }
}

TEST(CsvFigure, MorePointsThanDronesAreResampledAndFewerLeaveSpares) {
    const auto file = std::filesystem::path(::testing::TempDir()) / "points.csv";
    {
        std::ofstream out(file);
        out << "x,y,z,Red,Green,Blue\n";
        for (int i = 0; i < 12; ++i) out << 3 * i << ",0,0," << i << ",0,0\n";
    }
    const Formation fewer = build(with_spares({part_of(CsvSource{file}, 6)}, 0, Spares::wings)).value();
    EXPECT_EQ(fewer.points_m.size(), 6U);
    EXPECT_GE(fewer.smallest_spacing_m, 5.9);
    EXPECT_EQ(fewer.note, "resampled from 12 points");
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(fewer.colors[i].r * 255.0, fewer.points_m[i].x / 3.0, 1e-9);
    const Formation more = build(with_spares({part_of(CsvSource{file}, 15)}, 0, Spares::wings)).value();
    EXPECT_EQ(more.points_m.size(), 15U);
    EXPECT_EQ(std::count(more.spare.begin(), more.spare.end(), true), 3);
    EXPECT_EQ(more.note, "3 spare drones wait in columns beside the formation");
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace aerogram::planner::testing
