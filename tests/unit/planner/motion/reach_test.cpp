#include "planner/motion/reach.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/random.hpp"
#include "planner/motion/profile.hpp"

namespace aerogram::planner {
namespace {

geo::ShowFrame somewhere(Random& random) {
    return geo::ShowFrame({{random.between(-90.0, 90.0), random.between(-180.0, 180.0), random.between(-100.0, 4000.0)},
                           random.between(0.0, 360.0),
                           std::nullopt});
}

Vec3 point(double half_m, Random& random) {
    return {random.between(-half_m, half_m), random.between(-half_m, half_m), random.between(-20.0, 150.0)};
}

Lattice random_lattice(std::size_t n, std::size_t rows, double half_m, Random& random) {
    Lattice lattice{n, Points(n * rows)};
    for (Vec3& p : lattice.points_m) p = point(half_m, random);
    return lattice;
}

TEST(Heights, AreWithinTheirErrorOfGeodeticOnes) {
    Random random(5);
    for (int round = 0; round < 60; ++round) {
        const geo::ShowFrame frame = somewhere(random);
        const Heights heights(frame);
        const double half_m = std::pow(10.0, random.between(1.0, 4.0));
        for (int k = 0; k < 20; ++k) {
            const Vec3 a = point(half_m, random), b = point(half_m, random);
            const double error_m = Heights::error_m(std::sqrt(2.0) * half_m, 150.0);
            EXPECT_NEAR(heights(b) - heights(a), frame.altitude_above(a, b), error_m) << half_m;
        }
    }
}

/// The oracle: a geodetic conversion of every Bézier control point. Shows of 10 m to 10 km.
TEST(Reaches, AltitudesOfLatticesAreThoseOfTheirBezierControlPoints) {
    Random random(6);
    for (int round = 0; round < 30; ++round) {
        const geo::ShowFrame frame = somewhere(random);
        const double half_m = std::pow(10.0, random.between(1.0, 4.0));
        const std::size_t n = 1 + random.below(9);
        const Motion motion = random_lattice(n, 7 + random.below(20), half_m, random);
        Points pads(n);
        for (Vec3& pad : pads) pad = point(half_m, random);
        const Reaches found = reaches(motion, frame, pads, {});
        EXPECT_LE(found.error_m, 2e-5);
        for (std::size_t i = 0; i < n; ++i) {
            double low_m = 1e300, high_m = -1e300;
            for (std::size_t m = 0; m < interval_count(motion); ++m) {
                for (const Vec3& p : bezier(motion, m, i)) {
                    low_m = std::min(low_m, frame.altitude_above(pads[i], p));
                    high_m = std::max(high_m, frame.altitude_above(pads[i], p));
                }
            }
            EXPECT_NEAR(found.altitude_low_m[i], low_m, 2e-5);
            EXPECT_NEAR(found.altitude_high_m[i], high_m, 2e-5);
        }
    }
}

TEST(Reaches, AltitudesOfStraightActsAreThoseOfTheSegment) {
    Random random(7);
    for (int round = 0; round < 30; ++round) {
        const geo::ShowFrame frame = somewhere(random);
        const double half_m = std::pow(10.0, random.between(1.0, 3.3));
        Straight straight{Points(4), Points(4), profile_rows(ProfileKind::minimum_jerk, 43)};
        for (Vec3& p : straight.from_m) p = point(half_m, random);
        for (Vec3& p : straight.to_m) p = point(half_m, random);
        straight.to_m[3].z = straight.from_m[3].z;  // a level chord is lowest in between
        const Points pads(4, point(half_m, random));
        const Reaches found = reaches(straight, frame, pads, {});
        for (std::size_t i = 0; i < 4; ++i) {
            double low_m = 1e300, high_m = -1e300;
            for (int s = 0; s <= 400; ++s) {
                const Vec3 p = straight.from_m[i] + (s / 400.0) * (straight.to_m[i] - straight.from_m[i]);
                low_m = std::min(low_m, frame.altitude_above(pads[i], p));
                high_m = std::max(high_m, frame.altitude_above(pads[i], p));
            }
            EXPECT_NEAR(found.altitude_low_m[i], low_m, 3e-5);
            EXPECT_NEAR(found.altitude_high_m[i], high_m, 3e-5);
        }
    }
}

/// More drones than are looked at together, and a number that is no multiple of four.
TEST(Reaches, BoxesHoldThePathsOfAllDrones) {
    Random random(8);
    const std::size_t n = 523;
    const Act act{"x", ActRole::transit, Timing::free, 0, 10000, random_lattice(n, 12, 50.0, random)};
    const geo::ShowFrame frame = somewhere(random);
    const Points pads(n);
    const Reaches found = reaches(act.motion, frame, pads, {});
    Points now(n);
    for (int s = 0; s <= 100; ++s) {
        positions(act, 0.1 * s, now);
        for (std::size_t i = 0; i < n; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(now[i][axis], found.low_m[i][axis] - 1e-9);
                EXPECT_LE(now[i][axis], found.high_m[i][axis] + 1e-9);
            }
        }
    }
    aerogram::Run two;
    two.threads = 2;
    const Reaches again = reaches(act.motion, frame, pads, two);
    EXPECT_EQ(again.low_m, found.low_m);
    EXPECT_EQ(again.high_m, found.high_m);
    EXPECT_EQ(again.altitude_low_m, found.altitude_low_m);
    EXPECT_EQ(again.altitude_high_m, found.altitude_high_m);
}

TEST(Reaches, OfAHoldIsThePlace) {
    Random random(9);
    const geo::ShowFrame frame = somewhere(random);
    const Vec3 place = point(100.0, random), pad = point(100.0, random);
    const Reaches found = reaches(Hold{{place}}, frame, {pad}, {});
    EXPECT_EQ(found.low_m[0], place);
    EXPECT_EQ(found.high_m[0], place);
    EXPECT_NEAR(found.altitude_low_m[0], frame.altitude_above(pad, place), 1e-6);
    EXPECT_TRUE(found.stays_over(0, {place.x, place.y, 0.0}, 0.0));
    EXPECT_FALSE(found.stays_over(0, {place.x + 1e-5, place.y, 0.0}, 1e-6));
    EXPECT_FALSE(found.moves_sideways(0, 0.0));
}

}  // namespace
}  // namespace aerogram::planner
