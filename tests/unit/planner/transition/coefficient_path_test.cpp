#include "planner/transition/coefficient_path.hpp"

#include <gtest/gtest.h>

#include "geo/units.hpp"
#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

constexpr Vec3 kUp{0, 0, 1};

TEST(CoefficientPath, Property1And2EndsAndNormsForRandomAndDegenerateDirections) {
    const int count = tries(200);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const Vec3 from = random.in_cube(5.0);
        Vec3 to = random.in_cube(5.0);
        if (seed % 4 == 1) to = -from * random.between(0.1, 3.0);
        if (seed % 4 == 2) to = from * random.between(0.1, 3.0);
        if (seed % 4 == 3) to = -from + std::pow(10.0, random.between(-14.0, -4.0)) * random.in_cube(1.0);
        const CoefficientPath path(from, to, kUp, 1e-10);
        EXPECT_LT(glm::distance(path.at(0.0), from), 1e-14);
        EXPECT_LT(glm::distance(path.at(1.0), to), 1e-14);
        for (const double t : {0.1, 0.5, 0.77}) {
            EXPECT_NEAR(glm::length(path.at(t)), (1 - t) * glm::length(from) + t * glm::length(to), 1e-13);
        }
    }
}

TEST(CoefficientPath, DirectionTurnsAtEvenSpeedInOnePlane) {
    const CoefficientPath path({2, 0, 0}, {0, 2, 0}, kUp, 1e-10);
    EXPECT_LT(glm::distance(path.at(1.0 / 3.0), Vec3(2 * std::cos(kPi / 6), 2 * std::sin(kPi / 6), 0)), 1e-14);
}

TEST(CoefficientPath, OppositeDirectionsTurnAboutTheAxis) {
    const CoefficientPath path({3, 0, 0}, {-3, 0, 0}, kUp, 1e-10);
    EXPECT_LT(glm::distance(path.at(0.5), Vec3(0, 3, 0)), 1e-14);
    // The axis is along the direction: show y takes its place, and for a direction along y show x.
    EXPECT_LT(glm::distance(CoefficientPath({0, 0, 3}, {0, 0, -3}, kUp, 1e-10).at(0.5), Vec3(3, 0, 0)), 1e-14);
    EXPECT_LT(glm::distance(CoefficientPath({0, 3, 0}, {0, -3, 0}, {0, 1, 0}, 1e-10).at(0.5), Vec3(0, 0, 3)), 1e-14);
}

TEST(CoefficientPath, ZeroHasNoDirection) {
    const CoefficientPath out_of_zero({0, 0, 0}, {0, 4, 0}, kUp, 1e-10);
    EXPECT_EQ(out_of_zero.at(0.25), Vec3(0, 1, 0));
    const CoefficientPath out_of_noise({1e-13, 0, 0}, {0, 4, 0}, kUp, 1e-10);
    EXPECT_LT(glm::distance(out_of_noise.at(0.25), Vec3(0, 1, 0)), 1e-12);
    EXPECT_EQ(CoefficientPath({0, 0, 0}, {0, 0, 0}, kUp, 0.0).at(0.5), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace aerogram::planner
