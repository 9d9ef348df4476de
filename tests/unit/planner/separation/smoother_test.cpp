#include "planner/separation/smoother.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kLanes = SobolevSmoother::kLanes;

std::vector<double> random_block(std::size_t rows, std::uint64_t seed) {
    Random random(seed);
    std::vector<double> block(rows * kLanes);
    for (double& v : block) v = random.between(-1.0, 1.0);
    return block;
}

TEST(SobolevSmoother, SolvesItsEquationAndKeepsFixedRows) {
    constexpr std::size_t rows = 20;
    constexpr double lambda = 37.0;
    std::vector<bool> fixed(rows, false);
    for (const std::size_t k : {0u, 1u, 2u, 9u, 17u, 18u, 19u}) fixed[k] = true;
    const auto right = random_block(rows, 3);
    auto x = right;
    SobolevSmoother(fixed, lambda).apply(x.data());
    for (std::size_t k = 0; k < rows; ++k) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const auto at = [&](std::size_t row) { return x[row * kLanes + lane]; };
            if (fixed[k]) {
                EXPECT_EQ(at(k), 0.0);
                continue;
            }
            double left = at(k);  // (I + lambda D₂ᵀD₂) x, term by term
            for (std::size_t d = 0; d + 2 < rows; ++d) {
                if (k < d || k > d + 2) continue;
                left += lambda * (k == d + 1 ? -2.0 : 1.0) * (at(d) - 2.0 * at(d + 1) + at(d + 2));
            }
            EXPECT_NEAR(left, right[k * kLanes + lane], 1e-10) << k;
        }
    }
}

/// With Lagrange multipliers the filtered rows are the minimiser of |X - C|² + lambda |D₂X|² among those that are zero
/// at the held knots: nudging them along any direction that keeps the knots does not lower it.
TEST(SobolevSmoother, HeldKnotsStayZeroAndTheRestIsOptimal) {
    constexpr std::size_t rows = 30;
    constexpr double lambda = 50.0;
    std::vector<bool> fixed(rows, false);
    for (const std::size_t k : {0u, 1u, 2u, 27u, 28u, 29u}) fixed[k] = true;
    const std::vector<std::size_t> held = {8, 15};
    const auto right = random_block(rows, 6);
    auto x = right;
    SobolevSmoother(fixed, lambda, held).apply(x.data());
    for (std::size_t lane = 0; lane < kLanes; lane += 5) {
        std::vector<double> own(rows);
        for (std::size_t k = 0; k < rows; ++k) own[k] = x[k * kLanes + lane];
        for (const std::size_t k : held) EXPECT_NEAR(own[k] + 4.0 * own[k + 1] + own[k + 2], 0.0, 1e-11);
        const auto energy = [&](const std::vector<double>& at) {
            double sum = 0.0;
            for (std::size_t k = 3; k + 3 < rows; ++k) sum += std::pow(at[k] - right[k * kLanes + lane], 2);
            for (std::size_t k = 0; k + 2 < rows; ++k) sum += lambda * std::pow(at[k] - 2.0 * at[k + 1] + at[k + 2], 2);
            return sum;
        };
        Random random(lane + 1);
        for (int round = 0; round < 100; ++round) {
            std::vector<double> nudge(rows, 0.0);
            for (std::size_t k = 3; k + 3 < rows; ++k) nudge[k] = random.between(-1, 1);
            for (const std::size_t k : held) nudge[k + 1] = (-nudge[k] - nudge[k + 2]) / 4.0;
            auto moved = own;
            for (std::size_t k = 0; k < rows; ++k) moved[k] += 1e-3 * nudge[k];
            EXPECT_GE(energy(moved), energy(own));
        }
    }
}

}  // namespace
}  // namespace aerogram::planner
