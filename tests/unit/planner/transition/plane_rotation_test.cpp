#include "planner/transition/plane_rotation.hpp"

#include <gtest/gtest.h>

#include "geo/units.hpp"
#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

/// exp(t a) of the skew matrix a = sum of angle (v uᵀ - u vᵀ) over planes: Taylor, with scaling and squaring.
dense::Matrix exponential(const dense::Matrix& basis, const std::vector<double>& angles, double t) {
    const std::size_t n = basis.rows;
    constexpr int kHalvings = 8;
    dense::Matrix a(n, n);
    for (std::size_t p = 0; p < angles.size(); ++p) {
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t i = 0; i < n; ++i) {
                a(i, j) += t * angles[p] *
                           (basis(i, 2 * p + 1) * basis(j, 2 * p) - basis(i, 2 * p) * basis(j, 2 * p + 1)) /
                           static_cast<double>(1 << kHalvings);
            }
        }
    }
    dense::Matrix sum = identity(n), term = identity(n);
    for (int k = 1; k <= 14; ++k) {
        term = times(term, a);
        for (std::size_t i = 0; i < term.values.size(); ++i) {
            term.values[i] /= k;
            sum.values[i] += term.values[i];
        }
    }
    for (int k = 0; k < kHalvings; ++k) sum = times(sum, sum);
    return sum;
}

struct Case {
    const char* name;
    std::size_t n;
    std::vector<double> angles;
    double tolerance = 1e-11;  // rounding over the gap of e^{iθ} to its conjugate decides what any method can do
};
const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        {"generic", 9, {0.3, 1.1, 2.0, 2.9}},
        {"identity", 6, {0, 0, 0}},
        {"repeated", 12, {1.2, 1.2, 1.2, 0.4, 0.4, 2.5}},
        {"nearly repeated", 10, {1.2, 1.2 + 1e-9, 1.2 + 1e-5, 1.2 + 3e-4, 0.7}},
        {"opposite orientations", 8, {1.0, -1.0, 1.0, -1.0}},
        {"tiny", 9, {1e-3, 1e-6, 1e-9, 1e-13}},
        {"near half turns", 10, {kPi - 1e-3, kPi - 1e-5, kPi - 1e-8, 0.2, kPi - 3e-5}, 1e-9},
        {"quarter turns", 9, {kPi / 2, kPi / 2, kPi / 2, kPi / 2}},
        {"plane", 2, {2.2}},
        {"space", 3, {0.8}},
    };
    return all;
}

TEST(PlaneRotation, PowersAreTheExponentialOfTheScaledLogarithm) {
    for (const Case& c : cases()) {
        Random random(21);
        const dense::Matrix basis = random_basis(random, c.n);
        const PlaneRotation rotation(exponential(basis, c.angles, 1.0));
        for (const double t : {-0.2, 0.0, 0.25, 0.5, 0.8, 1.0, 1.3}) {
            EXPECT_LT(largest_difference(rotation.power(t), exponential(basis, c.angles, t)), c.tolerance)
                << c.name << " " << t;
        }
    }
}

TEST(PlaneRotation, Property1And2HoldForHalfTurnsWhosePlanesAreNotUnique) {
    for (const std::vector<double>& angles : {std::vector<double>{kPi},
                                              {kPi, kPi, kPi},
                                              {kPi, 0.5, kPi, 0.5},
                                              {kPi, kPi - 1e-12, 1.0},
                                              {kPi, kPi - 1e-10, 0.0}}) {
        Random random(22);
        const dense::Matrix basis = random_basis(random, 2 * angles.size() + 1);
        const dense::Matrix r = rotation_in_planes(basis, angles, 1.0);
        const PlaneRotation rotation(r);
        EXPECT_LT(largest_difference(rotation.power(1.0), r), 1e-10);
        const dense::Matrix half = rotation.power(0.5);
        EXPECT_LT(largest_difference(times(half, half), r), 1e-10);
        EXPECT_LT(largest_difference(times(rotation.power(0.3), rotation.power(0.4)), rotation.power(0.7)), 1e-12);
    }
}

TEST(PlaneRotation, HalfTurnsDoNotDependOnRounding) {
    Random random(23);
    const dense::Matrix basis = random_basis(random, 7);
    const dense::Matrix r = rotation_in_planes(basis, {kPi, kPi, 0.4}, 1.0);
    dense::Matrix shaken = r;
    for (double& x : shaken.values) x += random.between(-1e-15, 1e-15);
    EXPECT_LT(largest_difference(PlaneRotation(r).power(0.5), PlaneRotation(shaken).power(0.5)), 1e-9);
}

TEST(PlaneRotation, Property3RandomRotationsStayRotations) {
    const int count = tries(60);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 2 + random.below(40);
        std::vector<double> angles(n / 2);
        for (double& a : angles) a = random.below(4) == 0 ? kPi / 3 : random.between(0.0, kPi);
        const dense::Matrix basis = random_basis(random, n);
        const dense::Matrix r = rotation_in_planes(basis, angles, 1.0);
        const PlaneRotation rotation(r);
        EXPECT_LT(largest_difference(rotation.power(1.0), r), 1e-10);
        const double t = random.between(0.0, 1.0);
        const dense::Matrix power = rotation.power(t);
        EXPECT_LT(largest_difference(times(power, transposed(power)), identity(n)), 1e-12);
        EXPECT_LT(largest_difference(power, rotation_in_planes(basis, angles, t)), 1e-10);
    }
}

TEST(PlaneRotation, WorksInNoAndOneDimension) {
    EXPECT_EQ(PlaneRotation(dense::Matrix{}).power(0.5).values.size(), 0U);
    EXPECT_EQ(PlaneRotation(identity(1)).power(0.5).values, std::vector<double>{1.0});
}

TEST(PlaneRotation, RefusesAReflection) {
    dense::Matrix mirror = identity(3);
    mirror(0, 0) = -1.0;
    EXPECT_THROW(PlaneRotation{mirror}, ContractViolation);
}

}  // namespace
}  // namespace aerogram::planner
