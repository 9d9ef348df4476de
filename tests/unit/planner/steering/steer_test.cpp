#include "planner/steering/steer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

Points upright_grid(std::size_t columns, std::size_t rows, double spacing, const Vec3& middle) {
    Points out;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c)
            out.push_back(middle + spacing * Vec3(static_cast<double>(c) - 0.5 * static_cast<double>(columns - 1), 0.0,
                                                  static_cast<double>(r) - 0.5 * static_cast<double>(rows - 1)));
    return out;
}

SteerTask task_of(Points from_m, Points to_m) {
    SteerTask task;
    task.from_m = std::move(from_m);
    task.to_m = std::move(to_m);
    task.space.floor_z_m = 2.5;
    task.space.ceiling_z_m = 100.0;
    return task;
}

/// Rows of the motion at `count` + 1 equal shares.
std::vector<Points> rows_of(const Interpolation& motion, std::size_t drones, int count) {
    std::vector<Points> rows;
    for (int k = 0; k <= count; ++k) {
        rows.emplace_back(drones);
        motion(static_cast<double>(k) / count, rows.back());
    }
    return rows;
}

Vec3 mean(const Points& points) {
    Vec3 sum{};
    for (const Vec3& p : points) sum += p;
    return sum / static_cast<double>(points.size());
}

TEST(Steer, Property1And2_EndsAreExactAndTheSameTwice) {
    const SteerTask task = task_of(upright_grid(6, 4, 2.5, {-30, 0, 30}), upright_grid(4, 6, 2.5, {30, 10, 40}));
    const auto motion = steer(task, {}), again = steer(task, {});
    ASSERT_TRUE(motion.ok() && again.ok());
    const auto rows = rows_of(*motion, 24, 50);
    EXPECT_EQ(rows.front(), task.from_m);
    EXPECT_EQ(rows.back(), task.to_m);
    EXPECT_EQ(rows, rows_of(*again, 24, 50));
}

/// Found by missions/steered.toml: thinning the rows of a long flight lost the first one.
TEST(Steer, LongFlightsAreThinnedAndKeepTheirEnds) {
    const SteerTask task = task_of(upright_grid(3, 2, 2.5, {-300, 0, 30}), upright_grid(2, 3, 2.5, {300, 10, 40}));
    const auto motion = steer(task, {});
    ASSERT_TRUE(motion.ok());
    const auto rows = rows_of(*motion, 6, 100);
    EXPECT_EQ(rows.front(), task.from_m);
    EXPECT_EQ(rows.back(), task.to_m);
    for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_LT(glm::distance(rows[k][0], rows[k - 1][0]), 15.0);
}

TEST(Steer, Property3_MovingTheTaskMovesTheMotion) {
    const Vec3 shift(12, -7, 5);
    SteerTask task = task_of(upright_grid(5, 4, 2.5, {-30, 0, 30}), upright_grid(4, 5, 2.5, {30, 10, 40}));
    const auto motion = steer(task, {});
    for (Points* points : {&task.from_m, &task.to_m})
        for (Vec3& p : *points) p += shift;
    const auto moved = steer(task, {});
    const auto rows = rows_of(*motion, 20, 20), there = rows_of(*moved, 20, 20);
    for (std::size_t k = 0; k < rows.size(); ++k)
        for (std::size_t d = 0; d < 20; ++d) EXPECT_LT(glm::distance(rows[k][d] + shift, there[k][d]), 1e-6);
}

/// In open space the formation stays in shape: every drone keeps its offset from the middle all the way.
TEST(Steer, AShapeThatOnlyMovesStaysInShape) {
    const SteerTask task = task_of(upright_grid(6, 4, 3.5, {-40, 0, 30}), upright_grid(6, 4, 3.5, {40, 20, 35}));
    const auto motion = steer(task, {});
    ASSERT_TRUE(motion.ok());
    for (const Points& row : rows_of(*motion, 24, 40)) {
        const Vec3 middle = mean(row);
        for (std::size_t d = 0; d < 24; ++d)
            EXPECT_LT(glm::distance(row[d] - middle, task.from_m[d] - mean(task.from_m)), 0.05);
    }
}

/// Figure 6 of the paper: the group passes a wall as a whole, on one side, instead of being split by it.
TEST(Steer, AGroupPassesAWallAsAWhole) {
    SteerTask task = task_of(upright_grid(5, 4, 2.5, {0, -40, 20}), upright_grid(4, 5, 2.5, {0, 40, 20}));
    task.space.airspace.obstacles.push_back({"wall", geo::Prism{{{-12, -2}, {16, -2}, {16, 2}, {-12, 2}}}, 0.0, 90.0});
    const auto motion = steer(task, {});
    ASSERT_TRUE(motion.ok());
    std::size_t left = 0, right = 0;
    std::vector<Vec3> before = task.from_m;
    for (const Points& row : rows_of(*motion, 20, 400)) {
        for (std::size_t d = 0; d < 20; ++d) {
            EXPECT_GT(geo::clearance(task.space.airspace.obstacles[0], row[d]), 0.3) << "drone " << d;
            if (before[d].y < 0.0 && row[d].y >= 0.0) ++(row[d].x < 0.0 ? left : right);
        }
        before = row;
    }
    EXPECT_EQ(std::min(left, right), 0U) << left << " pass left, " << right << " right";
}

/// Two groups that change places meet head-on and pass each other on the right.
TEST(Steer, GroupsThatMeetPassOnTheRight) {
    Points from_m = upright_grid(4, 4, 2.5, {-40, 0, 30}), to_m = upright_grid(4, 4, 2.5, {40, 0, 30});
    const Points other_from = to_m, other_to = from_m;
    from_m.insert(from_m.end(), other_from.begin(), other_from.end());
    to_m.insert(to_m.end(), other_to.begin(), other_to.end());
    SteerTask task = task_of(from_m, to_m);
    task.groups.resize(2);
    for (std::size_t d = 0; d < 16; ++d) task.groups[0].emplace_back(d);
    for (std::size_t d = 16; d < 32; ++d) task.groups[1].emplace_back(d);
    const auto motion = steer(task, {});
    ASSERT_TRUE(motion.ok());
    double widest = 0.0, nearest = 1e9;
    for (const Points& row : rows_of(*motion, 32, 200)) {
        const Vec3 a = mean(Points(row.begin(), row.begin() + 16)), b = mean(Points(row.begin() + 16, row.end()));
        if (std::abs(a.x - b.x) < 4.0) widest = std::max(widest, b.y - a.y);
        for (std::size_t i = 0; i < 16; ++i)
            for (std::size_t j = 16; j < 32; ++j) nearest = std::min(nearest, glm::distance(row[i], row[j]));
    }
    EXPECT_GT(widest, 8.0) << "the one that flies to +x is on the side of -y";
    EXPECT_GT(nearest, 1.0);
}

/// The share of V_f decides when the formation is formed: early with much of it, late with little.
TEST(Steer, WeightsBalanceFormingAgainstFlying) {
    const auto spread_at_half = [](double w1, double w3) {
        Points from_m = upright_grid(5, 5, 2.5, {-60, 0, 30}), to_m = upright_grid(5, 5, 6.0, {60, 0, 40});
        SteerTask task = task_of(from_m, to_m);
        task.options.w1 = w1;
        task.options.w3 = w3;
        const auto motion = steer(task, {});
        Points row(25);
        double x = -60.0, spread = 0.0;
        for (int k = 0; k <= 400 && x < 0.0; ++k) {  // where the middle is half-way
            (*motion)(k / 400.0, row);
            x = mean(row).x;
            spread = glm::distance(row[0], row[24]);
        }
        return spread;
    };
    EXPECT_GT(spread_at_half(0.6, 0.1), 1.1 * spread_at_half(0.05, 0.6));
}

TEST(Steer, FacingTheCourseTurnsTheFormationAroundABend) {
    Points from_m, to_m;  // a row along x
    for (int i = 0; i < 9; ++i) {
        from_m.emplace_back(2.5 * (i - 4), -60.0, 20.0);
        to_m.emplace_back(2.5 * (i - 4), 60.0, 20.0);
    }
    SteerTask task = task_of(from_m, to_m);
    task.space.airspace.obstacles.push_back({"wall", geo::Prism{{{-40, -2}, {40, -2}, {40, 2}, {-40, 2}}}, 0.0, 95.0});
    const auto largest_turn = [&](bool face) {
        task.options.face_course = face;
        const auto motion = steer(task, {});
        double most = 0.0;
        for (const Points& row : rows_of(*motion, 9, 200)) {
            const Vec3 along = row[8] - row[0];
            most = std::max(most, std::abs(std::atan2(along.y, along.x)));
        }
        return most;
    };
    EXPECT_LT(largest_turn(false), 0.35);
    EXPECT_GT(largest_turn(true), 0.6);
}

TEST(Steer, AThousandDronesStopWhenAsked) {
    const SteerTask task = task_of(upright_grid(40, 25, 2.5, {-90, 0, 60}), upright_grid(25, 40, 2.5, {90, 0, 60}));
    std::stop_source source;
    source.request_stop();
    aerogram::Run run;
    run.stop = source.get_token();
    const auto motion = steer(task, run);
    ASSERT_FALSE(motion.ok());
    EXPECT_EQ(motion.error().code, ErrorCode::stopped);
}

}  // namespace
}  // namespace aerogram::planner
