#include "geo/airspace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::geo {
namespace {

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }

  private:
    std::mt19937_64 engine_;
};

int cases(int usual) {
    const char* asked = std::getenv("AEROGRAM_TEST_N");
    return asked != nullptr ? std::max(1, std::stoi(asked)) : usual;
}

Polygon square(double half) {
    return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

/// A star-shaped ring about the origin: simple by construction, usually not convex.
Polygon star_ring(Random& random, int corners) {
    Polygon ring;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2.0 * kPi * (i + random.between(0.0, 0.9)) / corners;
        const double radius = random.between(2.0, 20.0);
        ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return ring;
}

/// Oracle: how often the ring winds round p, by adding up angles.
bool winds_round(const Polygon& ring, const Vec2& p) {
    double total = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i] - p, b = ring[(i + 1) % ring.size()] - p;
        total += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
    }
    return std::abs(total) > kPi;
}

/// Oracle: distance to the ring by walking along its edges; at most half a step too far.
double sampled_distance(const Polygon& ring, const Vec2& p) {
    double best = HUGE_VAL;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        for (int step = 0; step <= 2000; ++step) {
            best = std::min(best, glm::distance(p, glm::mix(ring[i], ring[(i + 1) % ring.size()], step / 2000.0)));
        }
    }
    return best;
}

TEST(SignedDistance, IsPositiveInsideAndExactOnASquare) {
    EXPECT_DOUBLE_EQ(signed_distance(square(10.0), {0.0, 0.0}), 10.0);
    EXPECT_DOUBLE_EQ(signed_distance(square(10.0), {7.0, 0.0}), 3.0);
    EXPECT_DOUBLE_EQ(signed_distance(square(10.0), {13.0, 0.0}), -3.0);
    EXPECT_DOUBLE_EQ(signed_distance(square(10.0), {13.0, 14.0}), -5.0);
    EXPECT_DOUBLE_EQ(std::abs(signed_distance(square(10.0), {10.0, 4.0})), 0.0);
}

TEST(SignedDistance, RaysThroughVerticesCountOnce) {
    const Polygon diamond{{0.0, -5.0}, {5.0, 0.0}, {0.0, 5.0}, {-5.0, 0.0}};
    EXPECT_GT(signed_distance(diamond, {0.0, 0.0}), 0.0);        // the ray leaves through a vertex
    EXPECT_LT(signed_distance(diamond, {-9.0, 0.0}), 0.0);       // enters and leaves through vertices
    EXPECT_LT(signed_distance(diamond, {-9.0, 5.0}), 0.0);       // grazes the top
    EXPECT_LT(signed_distance(square(5.0), {-9.0, -5.0}), 0.0);  // runs along an edge
}

TEST(SignedDistance, NotchOfAnLIsOutside) {
    const Polygon ell{{0.0, 0.0}, {10.0, 0.0}, {10.0, 4.0}, {4.0, 4.0}, {4.0, 10.0}, {0.0, 10.0}};
    EXPECT_DOUBLE_EQ(signed_distance(ell, {7.0, 7.0}), -3.0);
    EXPECT_DOUBLE_EQ(signed_distance(ell, {2.0, 2.0}), 2.0);
    EXPECT_NEAR(signed_distance(ell, {3.0, 3.0}), std::sqrt(2.0), 1e-15);  // the inner corner is nearest
}

TEST(SignedDistance, AgreesWithWindingAndSampledEdges) {
    Random random(11);
    for (int trial = 0; trial < cases(60); ++trial) {
        Polygon ring = star_ring(random, 3 + trial % 9);
        if (trial % 2 == 1) std::ranges::reverse(ring);  // either orientation
        for (int k = 0; k < 10; ++k) {
            const Vec2 p{random.between(-25.0, 25.0), random.between(-25.0, 25.0)};
            const double distance = signed_distance(ring, p);
            EXPECT_EQ(distance > 0.0, winds_round(ring, p)) << "seed 11, trial " << trial;
            EXPECT_NEAR(std::abs(distance), sampled_distance(ring, p), 2e-2) << "seed 11, trial " << trial;
        }
    }
}

TEST(SignedDistance, NeverChangesFasterThanThePointMoves) {
    Random random(12);
    for (int trial = 0; trial < cases(20000); ++trial) {
        const Polygon ring = star_ring(random, 3 + trial % 7);
        const Vec2 p{random.between(-25.0, 25.0), random.between(-25.0, 25.0)};
        const Vec2 q = p + Vec2{random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
        EXPECT_LE(std::abs(signed_distance(ring, p) - signed_distance(ring, q)), glm::distance(p, q) + 1e-12)
            << "seed 12, trial " << trial;
    }
}

TEST(SignedDistance, FewerThanThreeVerticesIsABug) {
    EXPECT_THROW((void)signed_distance({{0.0, 0.0}, {1.0, 0.0}}, {0.0, 0.0}), ContractViolation);
}

TEST(Clearance, OfACylinderBesideAboveInsideAndAcrossTheRim) {
    const Obstacle tower{"tower", Cylinder{{30.0, 10.0}, 4.0}, 0.0, 25.0};
    EXPECT_DOUBLE_EQ(clearance(tower, {40.0, 10.0, 12.0}), 6.0);
    EXPECT_DOUBLE_EQ(clearance(tower, {30.0, 10.0, 27.5}), 2.5);
    EXPECT_DOUBLE_EQ(clearance(tower, {30.0, 10.0, 24.0}), -1.0);
    EXPECT_DOUBLE_EQ(clearance(tower, {33.0, 10.0, 12.0}), -1.0);
    EXPECT_DOUBLE_EQ(clearance(tower, {37.0, 10.0, 29.0}), 5.0);
    EXPECT_DOUBLE_EQ(clearance(tower, {30.0, 10.0, -2.0}), 2.0);
}

TEST(Clearance, OfAPrismOnARaisedBase) {
    const Obstacle bridge{"bridge", Prism{square(5.0)}, 10.0, 5.0};
    EXPECT_DOUBLE_EQ(clearance(bridge, {0.0, 0.0, 8.0}), 2.0);  // one may pass below
    EXPECT_DOUBLE_EQ(clearance(bridge, {0.0, 0.0, 12.0}), -2.0);
    EXPECT_DOUBLE_EQ(clearance(bridge, {8.0, 9.0, 12.0}), 5.0);
    EXPECT_DOUBLE_EQ(clearance(bridge, {8.0, 5.0, 19.0}), 5.0);
}

TEST(Clearance, NeverChangesFasterThanThePointMovesAndVanishesOnlyOnTheSurface) {
    Random random(13);
    for (int trial = 0; trial < cases(20000); ++trial) {
        Obstacle obstacle{"",
                          Cylinder{{random.between(-5.0, 5.0), random.between(-5.0, 5.0)}, random.between(0.5, 8.0)},
                          random.between(-2.0, 5.0), random.between(0.5, 20.0)};
        if (trial % 2 == 0) obstacle.shape = Prism{star_ring(random, 3 + trial % 6)};
        const Vec3 p{random.between(-25.0, 25.0), random.between(-25.0, 25.0), random.between(-10.0, 30.0)};
        const Vec3 q = p + Vec3{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
        EXPECT_LE(std::abs(clearance(obstacle, p) - clearance(obstacle, q)), glm::distance(p, q) + 1e-12)
            << "seed 13, trial " << trial;
    }
}

TEST(IsSimple, AcceptsRingsOfEitherOrientation) {
    Random random(14);
    for (int trial = 0; trial < cases(500); ++trial) {
        Polygon ring = star_ring(random, 3 + trial % 20);
        EXPECT_TRUE(is_simple(ring)) << "seed 14, trial " << trial;
        std::ranges::reverse(ring);
        EXPECT_TRUE(is_simple(ring)) << "seed 14, trial " << trial;
    }
}

TEST(IsSimple, RefusesCrossingTouchingAndFlatRings) {
    EXPECT_FALSE(is_simple({}));
    EXPECT_FALSE(is_simple({{0.0, 0.0}, {1.0, 0.0}}));
    EXPECT_FALSE(is_simple({{0.0, 0.0}, {4.0, 4.0}, {4.0, 0.0}, {0.0, 4.0}}));              // bow tie
    EXPECT_FALSE(is_simple({{0.0, 0.0}, {2.0, 0.0}, {4.0, 0.0}}));                          // no area
    EXPECT_FALSE(is_simple({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {4.0, 4.0}}));              // a vertex twice in a row
    EXPECT_FALSE(is_simple({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 0.0}}));              // closed explicitly
    EXPECT_FALSE(is_simple({{0.0, 0.0}, {4.0, 0.0}, {2.0, 0.0}, {2.0, 3.0}}));              // folds back on itself
    EXPECT_FALSE(is_simple({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {2.0, 0.0}, {0.0, 4.0}}));  // touches an edge
    EXPECT_FALSE(is_simple({{0.0, 0.0}, {2.0, 2.0}, {4.0, 0.0}, {4.0, 4.0}, {2.0, 2.0}, {0.0, 4.0}}));  // pinched
    EXPECT_FALSE(is_simple({{0.0, 0.0}, {4.0, 0.0}, {std::nan(""), 4.0}}));
}

TEST(IsSimple, AcceptsAStraightAngle) {
    EXPECT_TRUE(is_simple({{0.0, 0.0}, {2.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}}));
}

/// Oracle: two open segments cross when each one's ends lie strictly on both sides of the other.
bool properly_crosses(const Polygon& ring) {
    const auto turn = [](const Vec2& a, const Vec2& b, const Vec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const Vec2 &a = ring[i], &b = ring[(i + 1) % n], &c = ring[j], &d = ring[(j + 1) % n];
            if (turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0) return true;
        }
    }
    return false;
}

TEST(IsSimple, AgreesWithBruteForceOnRandomRings) {
    Random random(15);
    int simple = 0;
    for (int trial = 0; trial < cases(5000); ++trial) {
        Polygon ring;
        for (int i = 0; i < 4 + trial % 4; ++i) ring.emplace_back(random.between(0.0, 1.0), random.between(0.0, 1.0));
        EXPECT_EQ(is_simple(ring), !properly_crosses(ring)) << "seed 15, trial " << trial;
        simple += is_simple(ring) ? 1 : 0;
    }
    EXPECT_TRUE(simple > 0 || cases(5000) < 100);
}

}  // namespace
}  // namespace aerogram::geo
