/// bound_separation on maps of every kind, against all pairs. Its numbered properties are tested in
/// certificate_test.cpp too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "geo/random.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/profile.hpp"

namespace aerogram::planner {
namespace {

Vec3 point(double half_m, Random& random) {
    return {random.between(-half_m, half_m), random.between(-half_m, half_m), random.between(-half_m, half_m)};
}
Points scattered(std::size_t n, double half_m, Random& random) {
    Points points(n);
    for (Vec3& p : points) p = point(half_m, random);
    return points;
}
Points grid(std::size_t side, double spacing_m) {
    Points points;
    for (std::size_t i = 0; i < side * side; ++i) {
        points.push_back({spacing_m * static_cast<double>(i % side), spacing_m * static_cast<double>(i / side), 10.0});
    }
    return points;
}
Straight straight_between(Points from, Points to) {
    return {std::move(from), std::move(to), profile_rows(ProfileKind::minimum_jerk, 43)};
}

/// All pairs in closed form, in long double; the first of equal ones.
struct Pair {
    double distance_m = 1e300;
    std::size_t first = 0, second = 0;
};
Pair closest_pair(const Straight& straight, const SeparationMetric& metric) {
    Pair best;
    for (std::size_t i = 0; i < straight.from_m.size(); ++i) {
        for (std::size_t j = i + 1; j < straight.from_m.size(); ++j) {
            const Vec3 a = metric.scaled(straight.from_m[j]) - metric.scaled(straight.from_m[i]);
            const Vec3 b = metric.scaled(straight.to_m[j]) - metric.scaled(straight.to_m[i]);
            long double along = 0.0L, squared = 0.0L, distance = 0.0L;
            for (int axis = 0; axis < 3; ++axis) {
                along -= static_cast<long double>(a[axis]) * (static_cast<long double>(b[axis]) - a[axis]);
                squared +=
                    (static_cast<long double>(b[axis]) - a[axis]) * (static_cast<long double>(b[axis]) - a[axis]);
            }
            const long double s = squared > 0.0L ? std::clamp(along / squared, 0.0L, 1.0L) : 0.0L;
            for (int axis = 0; axis < 3; ++axis) {
                const long double x = a[axis] + s * (static_cast<long double>(b[axis]) - a[axis]);
                distance += x * x;
            }
            const auto distance_m = static_cast<double>(std::sqrt(distance));
            if (distance_m < best.distance_m) best = {distance_m, i, j};
        }
    }
    return best;
}

void expect_closed_form(const Straight& straight, const SeparationMetric& metric, const std::string& what) {
    const Pair best = closest_pair(straight, metric);
    const auto bound = bound_separation(straight, 7.0, metric, 1e4, {}).value();
    ASSERT_TRUE(bound.closest) << what;
    EXPECT_NEAR(bound.closest->distance_m, best.distance_m, 1e-9) << what;
    EXPECT_LE(bound.lower_bound_m, best.distance_m) << what;
    EXPECT_GE(bound.lower_bound_m, best.distance_m - 3e-9) << what;
    EXPECT_LT(bound.closest->first, bound.closest->second) << what;
}

TEST(BoundSeparation, StraightMapsOfEveryKindAgreeWithAllPairs) {
    Random random(51);
    const Points sheet = grid(9, 2.0);
    std::vector<std::size_t> any(81);
    std::iota(any.begin(), any.end(), 0U);
    for (std::size_t i = 80; i > 0; --i) std::swap(any[i], any[random.below(i + 1)]);
    Points shuffled, opposite, swapped = sheet, turned, point_like, together = sheet;
    for (std::size_t i = 0; i < 81; ++i) {
        shuffled.push_back(sheet[any[i]]);
        opposite.push_back(Vec3{16, 16, 20} - sheet[i]);  // everyone through one point
        turned.push_back({-sheet[i].y, sheet[i].x, sheet[i].z + 3.0});
        point_like.push_back(1e-6 * sheet[i]);
    }
    for (std::size_t i = 0; i + 1 < 81; i += 2) std::swap(swapped[i], swapped[i + 1]);
    together[40] = together[70];
    for (const double downwash : {1.0, 2.5}) {
        const SeparationMetric metric{downwash};
        expect_closed_form(straight_between(sheet, shuffled), metric, "shuffled");
        expect_closed_form(straight_between(sheet, opposite), metric, "through one point");
        expect_closed_form(straight_between(sheet, swapped), metric, "neighbours swap");
        expect_closed_form(straight_between(sheet, turned), metric, "a quarter turn");
        expect_closed_form(straight_between(sheet, point_like), metric, "nearly to one point");
        expect_closed_form(straight_between(point_like, point_like), metric, "micrometres apart");
        expect_closed_form(straight_between(sheet, together), metric, "two land together");
        expect_closed_form(straight_between(Points(30, Vec3{1, 2, 3}), Points(30, Vec3{4, 5, 6})), metric,
                           "all together");
        for (int round = 0; round < 10; ++round) {
            const std::size_t n = 2 + random.below(150);
            expect_closed_form(straight_between(scattered(n, 20.0, random), scattered(n, 20.0, random)), metric,
                               "wild");
            const Points from = scattered(n, 20.0, random);
            Points to = from;
            for (Vec3& p : to) p = 1.3 * p + point(0.4, random);
            expect_closed_form(straight_between(from, to), metric, "sane");
        }
    }
}

TEST(BoundSeparation, OfEqualDistancesTheFirstPairIsNamed) {
    const Points sheet = grid(20, 2.0);
    const auto hold = bound_separation(Hold{sheet}, 1.0, {}, 10.0, {}).value();
    EXPECT_EQ(hold.closest->first, DroneId(0U));
    EXPECT_EQ(hold.closest->second, DroneId(1U));
    EXPECT_EQ(hold.closest->distance_m, 2.0);
    Points moved = sheet;
    for (Vec3& p : moved) p += Vec3{64, 32, 16};
    const auto straight = bound_separation(straight_between(sheet, moved), 1.0, {}, 10.0, {}).value();
    EXPECT_EQ(straight.closest->first, DroneId(0U));
    EXPECT_EQ(straight.closest->second, DroneId(1U));
}

/// A hundred kilometres from the origin.
TEST(BoundSeparation, FarFromTheOriginNothingChangesButRounding) {
    Random random(52);
    const Vec3 away{8e4, -6e4, 500.0};
    for (int round = 0; round < 10; ++round) {
        const Points from = scattered(60, 12.0, random);
        Points to = scattered(60, 12.0, random), far_from = from, far_to;
        for (Vec3& p : far_from) p += away;
        for (const Vec3& p : to) far_to.push_back(p + away);
        const auto near = bound_separation(straight_between(from, to), 1.0, {1.5}, 50.0, {}).value();
        const auto far = bound_separation(straight_between(far_from, far_to), 1.0, {1.5}, 50.0, {}).value();
        EXPECT_NEAR(near.lower_bound_m, far.lower_bound_m, 1e-9);
    }
}

/// Smooth motion, so slow between knots that blocks of every length occur; not at rest at its ends.
Lattice drifting(std::size_t n, std::size_t intervals, double pace, double half_m, Random& random) {
    Lattice lattice{n, Points(n * (intervals + 3))};
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 center = point(half_m, random), size = point(6.0, random), phase = point(3.0, random);
        for (std::size_t k = 0; k < intervals + 3; ++k) {
            const double a = pace * static_cast<double>(k);
            lattice.at(k, i) =
                center + Vec3{30.0 * std::sin(0.3 * a), 20.0 * std::cos(0.2 * a), 0.0} +  // all together
                size * Vec3{std::sin(a + phase.x), std::sin(1.3 * a + phase.y), std::sin(0.7 * a + phase.z)};
        }
    }
    return lattice;
}

double sampled_m(const Lattice& lattice, const SeparationMetric& metric, std::size_t per_interval) {
    const Act act{"x", ActRole::transit, Timing::free, 0, 1000, lattice};
    const std::size_t samples = per_interval * interval_count(act.motion);
    double least_m = 1e300;
    Points now(lattice.drones);
    for (std::size_t s = 0; s <= samples; ++s) {
        positions(act, static_cast<double>(s) / static_cast<double>(samples), now);
        for (std::size_t i = 0; i < now.size(); ++i) {
            for (std::size_t j = i + 1; j < now.size(); ++j)
                least_m = std::min(least_m, metric.distance(now[i], now[j]));
        }
    }
    return least_m;
}

TEST(BoundSeparation, Property1And2_LatticesInBlocksOfEveryLengthBracketADenseSampling) {
    Random random(53);
    for (const auto& [intervals, pace] :
         {std::pair{4, 0.4}, {7, 0.3}, {30, 0.2}, {70, 0.08}, {130, 0.03}, {260, 0.012}}) {
        for (int round = 0; round < 3; ++round) {
            const SeparationMetric metric{1.0 + 0.7 * round};
            const Lattice lattice = drifting(40, static_cast<std::size_t>(intervals), pace, 12.0, random);
            const double least_m = sampled_m(lattice, metric, static_cast<std::size_t>(2000 / intervals + 4));
            const auto bound = bound_separation(lattice, 1.0, metric, 100.0, {}).value();
            EXPECT_LE(bound.lower_bound_m, least_m) << intervals;
            EXPECT_GE(bound.lower_bound_m, 0.98 * least_m - 0.02) << intervals;  // what the sampling misses near zero
            EXPECT_GE(bound.lower_bound_m, bound.closest->distance_m * (1.0 - 3e-6) - 3e-6) << intervals;
            const Act act{"x", ActRole::transit, Timing::free, 0, 1000, lattice};
            const auto at = [&](DroneId drone) { return kinematics(act, drone, bound.closest->time_s).position_m; };
            EXPECT_NEAR(metric.distance(at(bound.closest->first), at(bound.closest->second)), bound.closest->distance_m,
                        1e-9);
        }
    }
}

/// In a fleet that hardly moves, and so is taken in long blocks, one drone darts towards another and back.
TEST(BoundSeparation, AShortApproachInsideALongBlockIsFound) {
    Random random(58);
    for (int round = 0; round < 12; ++round) {
        const Points sheet = grid(7, 6.0);
        const std::size_t intervals = 130, n = sheet.size();
        const std::size_t darting = 7 * random.below(7) + random.below(6), other = darting + 1,
                          middle = 5 + random.below(120);
        const double reach_m = random.between(3.0, 5.5);
        Lattice lattice{n, {}};
        for (std::size_t k = 0; k < intervals + 3; ++k) {
            for (std::size_t i = 0; i < n; ++i) {
                const double from_middle = (static_cast<double>(k) - static_cast<double>(middle)) / 4.0;
                const double share = i == darting ? std::exp(-from_middle * from_middle) : 0.0;
                lattice.points_m.push_back(sheet[i] + share * reach_m * glm::normalize(sheet[other] - sheet[darting]) +
                                           0.01 * static_cast<double>(k) * Vec3{1, 1, 0});
            }
        }
        const double least_m = sampled_m(lattice, {}, 10);
        ASSERT_LT(least_m, 4.0);
        const auto bound = bound_separation(lattice, 1.0, {}, 12.0, {}).value();
        EXPECT_LE(bound.lower_bound_m, least_m);
        EXPECT_GE(bound.lower_bound_m, least_m - 1e-3);
        EXPECT_TRUE(bound.closest->first == DroneId(darting) || bound.closest->second == DroneId(darting));
    }
}

TEST(BoundSeparation, LatticeOfAStraightActAgreesWithItAtAnyScale) {
    Random random(54);
    for (const std::size_t rows : {9U, 43U, 203U}) {
        const Points from = grid(12, 2.2);
        Points to;
        for (const Vec3& p : from) to.push_back({0.6 * p.x - p.y, 0.8 * p.y + p.x, p.z + 0.2 * p.x + 8.0});
        const Straight straight{from, to, profile_rows(ProfileKind::minimum_jerk, rows)};
        Lattice lattice{from.size(), {}};
        for (std::size_t k = 0; k < rows; ++k) {
            for (std::size_t i = 0; i < from.size(); ++i) lattice.points_m.push_back(control_point(straight, k, i));
        }
        const auto closed = bound_separation(straight, 1.0, {1.5}, 4.4, {}).value();
        const auto general = bound_separation(lattice, 1.0, {1.5}, 4.4, {}).value();
        EXPECT_NEAR(general.lower_bound_m, closed.lower_bound_m, 1e-4);
        EXPECT_LE(general.lower_bound_m, closed.lower_bound_m + 2e-9);
    }
}

TEST(BoundSeparation, Property5_ThreadsChangeNothing) {
    Random random(55);
    aerogram::Run two;
    two.threads = 2;
    for (const auto& [intervals, pace] : {std::pair{60, 0.1}, {300, 0.01}}) {
        const Lattice lattice = drifting(150, static_cast<std::size_t>(intervals), pace, 20.0, random);
        const auto one = bound_separation(lattice, 9.0, {1.3}, 30.0, {}).value();
        const auto other = bound_separation(lattice, 9.0, {1.3}, 30.0, two).value();
        EXPECT_EQ(one.lower_bound_m, other.lower_bound_m);
        EXPECT_EQ(one.closest->distance_m, other.closest->distance_m);
        EXPECT_EQ(one.closest->first, other.closest->first);
        EXPECT_EQ(one.closest->second, other.closest->second);
        EXPECT_EQ(one.closest->time_s, other.closest->time_s);
    }
}

TEST(BoundSeparation, DronesInOnePlaceAreAtZero) {
    Random random(56);
    Lattice lattice = drifting(30, 40, 0.1, 10.0, random);
    for (std::size_t k = 0; k < lattice.rows(); ++k) lattice.at(k, 17) = lattice.at(k, 4);
    const auto bound = bound_separation(lattice, 1.0, {}, 4.0, {}).value();
    EXPECT_EQ(bound.lower_bound_m, 0.0);
    EXPECT_EQ(bound.closest->distance_m, 0.0);
    EXPECT_EQ(bound.closest->first, DroneId(4U));
    EXPECT_EQ(bound.closest->second, DroneId(17U));
}

/// As if they were not there; the others keep their names.
TEST(BoundSeparation, ExcusedDronesAreLeftOutOfEveryMotion) {
    Random random(57);
    const std::size_t n = 40;
    std::vector<std::uint8_t> excused(n);
    std::vector<std::size_t> names;
    for (std::size_t i = 0; i < n; ++i) {
        excused[i] = random.below(3) == 0 ? 1 : 0;
        if (excused[i] == 0) names.push_back(i);
    }
    const Lattice lattice = drifting(n, 30, 0.1, 10.0, random);
    const Straight straight = straight_between(scattered(n, 9.0, random), scattered(n, 9.0, random));
    Lattice fewer{names.size(), {}};
    for (std::size_t k = 0; k < lattice.rows(); ++k) {
        for (const std::size_t i : names) fewer.points_m.push_back(lattice.at(k, i));
    }
    Straight few{{}, {}, straight.profile};
    for (const std::size_t i : names) {
        few.from_m.push_back(straight.from_m[i]);
        few.to_m.push_back(straight.to_m[i]);
    }
    const std::vector<std::pair<Motion, Motion>> cases = {
        {lattice, fewer}, {straight, few}, {Hold{straight.from_m}, Hold{few.from_m}}};
    for (const auto& [all, some] : cases) {
        const auto a = bound_separation(all, 3.0, {}, 50.0, {}, excused).value();
        const auto b = bound_separation(some, 3.0, {}, 50.0, {}).value();
        EXPECT_EQ(a.lower_bound_m, b.lower_bound_m);
        EXPECT_EQ(a.closest->first.value, names[b.closest->first.value]);
        EXPECT_EQ(a.closest->second.value, names[b.closest->second.value]);
        EXPECT_EQ(a.closest->time_s, b.closest->time_s);
    }
    const auto nobody = bound_separation(lattice, 3.0, {}, 5.0, {}, std::vector<std::uint8_t>(n, 1)).value();
    EXPECT_FALSE(nobody.closest);
    EXPECT_NEAR(nobody.lower_bound_m, 5.0, 1e-6);
}

}  // namespace
}  // namespace aerogram::planner
