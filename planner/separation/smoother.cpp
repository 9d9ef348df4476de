#include "planner/separation/smoother.hpp"

#include <cmath>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

constexpr double kKnotWeight[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};

}  // namespace

SobolevSmoother::SobolevSmoother(std::vector<bool> fixed, double lambda, std::vector<std::size_t> held_knots)
    : fixed_(std::move(fixed)),
      pivot_(fixed_.size(), 1.0),
      below_one_(fixed_.size()),
      below_two_(fixed_.size()),
      held_(std::move(held_knots)) {
    const std::size_t rows = fixed_.size();
    std::vector<double> diagonal(rows, 1.0), one(rows, 0.0), two(rows, 0.0);
    for (std::size_t k = 0; k + 2 < rows; ++k) {  // each second difference (1, -2, 1) adds its outer product
        diagonal[k] += lambda;
        diagonal[k + 1] += 4.0 * lambda;
        diagonal[k + 2] += lambda;
        one[k] -= 2.0 * lambda;
        one[k + 1] -= 2.0 * lambda;
        two[k] += lambda;
    }
    const auto free = [&](std::size_t k) { return k < rows && !fixed_[k]; };
    for (std::size_t k = 0; k < rows; ++k) {
        if (!free(k)) diagonal[k] = 1.0;
        if (!free(k) || !free(k + 1)) one[k] = 0.0;
        if (!free(k) || !free(k + 2)) two[k] = 0.0;
    }
    for (std::size_t k = 0; k < rows; ++k) {
        pivot_[k] = diagonal[k];
        if (k >= 1) pivot_[k] -= below_one_[k - 1] * below_one_[k - 1] * pivot_[k - 1];
        if (k >= 2) pivot_[k] -= below_two_[k - 2] * below_two_[k - 2] * pivot_[k - 2];
        below_one_[k] = (one[k] - (k >= 1 ? below_two_[k - 1] * pivot_[k - 1] * below_one_[k - 1] : 0.0)) / pivot_[k];
        below_two_[k] = two[k] / pivot_[k];
    }

    for (const std::size_t knot : held_) {
        Points column(rows);
        for (std::size_t m = 0; m < 3; ++m) column[knot + m].x = kKnotWeight[m];
        filter(column);
        std::vector<double> spread(rows);
        for (std::size_t k = 0; k < rows; ++k) spread[k] = column[k].x;
        spread_.push_back(std::move(spread));
    }
    const std::size_t held = held_.size();
    gram_.assign(held * held, 0.0);
    for (std::size_t i = 0; i < held; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = 0.0;
            for (std::size_t m = 0; m < 3; ++m) sum += kKnotWeight[m] * spread_[j][held_[i] + m];
            for (std::size_t q = 0; q < j; ++q) sum -= gram_[i * held + q] * gram_[j * held + q];
            AEROGRAM_REQUIRE(i != j || sum > 0.0, held_[i]);
            gram_[i * held + j] = i == j ? std::sqrt(sum) : sum / gram_[j * held + j];
        }
    }
}

void SobolevSmoother::apply(std::span<Vec3> c) const {
    filter(c);
    if (held_.empty()) return;
    const std::size_t rows = fixed_.size(), n = c.size() / rows;
    for (std::size_t i = 0; i < n; ++i) {
        const Points force = responses_at(c, i);
        for (std::size_t h = 0; h < held_.size(); ++h) {
            for (std::size_t k = 0; k < rows; ++k) c[k * n + i] -= spread_[h][k] * force[h];
        }
    }
}

/// The multipliers that bring one column back to zero at its held knots: gram y = value, by the Cholesky factor.
Points SobolevSmoother::responses_at(std::span<const Vec3> c, std::size_t column) const {
    const std::size_t held = held_.size(), n = c.size() / fixed_.size();
    Points y(held);
    for (std::size_t h = 0; h < held; ++h) {
        for (std::size_t m = 0; m < 3; ++m) y[h] += kKnotWeight[m] * c[(held_[h] + m) * n + column];
        for (std::size_t q = 0; q < h; ++q) y[h] -= gram_[h * held + q] * y[q];
        y[h] /= gram_[h * held + h];
    }
    for (std::size_t h = held; h-- > 0;) {
        for (std::size_t q = h + 1; q < held; ++q) y[h] -= gram_[q * held + h] * y[q];
        y[h] /= gram_[h * held + h];
    }
    return y;
}

void SobolevSmoother::filter(std::span<Vec3> c) const {
    const std::size_t rows = fixed_.size();
    AEROGRAM_REQUIRE(c.size() % rows == 0, c.size(), rows);
    const std::size_t n = c.size() / rows;
    for (std::size_t k = 0; k < rows; ++k) {
        for (std::size_t i = 0; i < n; ++i) {
            Vec3& x = c[k * n + i];
            if (fixed_[k]) x = Vec3{};
            if (k >= 1) x -= below_one_[k - 1] * c[(k - 1) * n + i];
            if (k >= 2) x -= below_two_[k - 2] * c[(k - 2) * n + i];
        }
    }
    for (std::size_t k = rows; k-- > 0;) {
        for (std::size_t i = 0; i < n; ++i) {
            Vec3& x = c[k * n + i];
            x /= pivot_[k];
            if (k + 1 < rows) x -= below_one_[k] * c[(k + 1) * n + i];
            if (k + 2 < rows) x -= below_two_[k] * c[(k + 2) * n + i];
        }
    }
}

}  // namespace aerogram::planner
