#include "planner/separation/smoother.hpp"

#include <cmath>

#include "geo/contract.hpp"
#include "geo/vectorized.hpp"

namespace aerogram::planner {
namespace {

constexpr double kKnotWeight[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
constexpr std::size_t kLanes = SobolevSmoother::kLanes;

/// row = factor row - one * other - two * another, lane by lane.
AEROGRAM_VECTORIZED
void eliminate(double* __restrict row, double factor, double one, const double* other, double two,
               const double* another) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        row[lane] = factor * row[lane] - one * other[lane] - two * another[lane];
    }
}

}  // namespace

SobolevSmoother::SobolevSmoother(const std::vector<bool>& fixed, double lambda, std::vector<std::size_t> held_knots)
    : rows_(fixed.size()),
      free_(rows_, 1.0),
      inverse_pivot_(rows_, 1.0),
      below_one_(rows_),
      below_two_(rows_),
      held_(std::move(held_knots)) {
    std::vector<double> diagonal(rows_, 1.0), one(rows_, 0.0), two(rows_, 0.0), pivot(rows_, 1.0);
    for (std::size_t k = 0; k + 2 < rows_; ++k) {  // each second difference (1, -2, 1) adds its outer product
        diagonal[k] += lambda;
        diagonal[k + 1] += 4.0 * lambda;
        diagonal[k + 2] += lambda;
        one[k] -= 2.0 * lambda;
        one[k + 1] -= 2.0 * lambda;
        two[k] += lambda;
    }
    const auto free = [&](std::size_t k) { return k < rows_ && !fixed[k]; };
    for (std::size_t k = 0; k < rows_; ++k) {
        free_[k] = free(k) ? 1.0 : 0.0;
        if (!free(k)) diagonal[k] = 1.0;
        if (!free(k) || !free(k + 1)) one[k] = 0.0;
        if (!free(k) || !free(k + 2)) two[k] = 0.0;
    }
    for (std::size_t k = 0; k < rows_; ++k) {
        pivot[k] = diagonal[k];
        if (k >= 1) pivot[k] -= below_one_[k - 1] * below_one_[k - 1] * pivot[k - 1];
        if (k >= 2) pivot[k] -= below_two_[k - 2] * below_two_[k - 2] * pivot[k - 2];
        below_one_[k] = (one[k] - (k >= 1 ? below_two_[k - 1] * pivot[k - 1] * below_one_[k - 1] : 0.0)) / pivot[k];
        below_two_[k] = two[k] / pivot[k];
        inverse_pivot_[k] = 1.0 / pivot[k];
    }

    std::vector<double> block(rows_ * kLanes);
    for (const std::size_t knot : held_) {
        std::fill(block.begin(), block.end(), 0.0);
        for (std::size_t m = 0; m < 3; ++m) block[(knot + m) * kLanes] = kKnotWeight[m];
        filter(block.data());
        std::vector<double> spread(rows_);
        for (std::size_t k = 0; k < rows_; ++k) spread[k] = block[k * kLanes];
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

void SobolevSmoother::apply(double* block) const {
    filter(block);
    const std::size_t held = held_.size();
    std::vector<double> y(held);
    for (std::size_t lane = 0; lane < kLanes && held > 0; ++lane) {
        // The multipliers that bring the column back to zero at its held knots: gram y = value, by the Cholesky factor.
        for (std::size_t h = 0; h < held; ++h) {
            y[h] = 0.0;
            for (std::size_t m = 0; m < 3; ++m) y[h] += kKnotWeight[m] * block[(held_[h] + m) * kLanes + lane];
            for (std::size_t q = 0; q < h; ++q) y[h] -= gram_[h * held + q] * y[q];
            y[h] /= gram_[h * held + h];
        }
        for (std::size_t h = held; h-- > 0;) {
            for (std::size_t q = h + 1; q < held; ++q) y[h] -= gram_[q * held + h] * y[q];
            y[h] /= gram_[h * held + h];
        }
        for (std::size_t h = 0; h < held; ++h) {
            for (std::size_t k = 0; k < rows_; ++k) block[k * kLanes + lane] -= spread_[h][k] * y[h];
        }
    }
}

void SobolevSmoother::filter(double* block) const {
    const std::vector<double> none(kLanes, 0.0);
    const auto row = [&](std::size_t k) { return block + k * kLanes; };
    for (std::size_t k = 0; k < rows_; ++k) {
        eliminate(row(k), free_[k], k >= 1 ? below_one_[k - 1] : 0.0, k >= 1 ? row(k - 1) : none.data(),
                  k >= 2 ? below_two_[k - 2] : 0.0, k >= 2 ? row(k - 2) : none.data());
    }
    for (std::size_t k = rows_; k-- > 0;) {
        const bool one = k + 1 < rows_, two = k + 2 < rows_;
        eliminate(row(k), inverse_pivot_[k], one ? below_one_[k] : 0.0, one ? row(k + 1) : none.data(),
                  two ? below_two_[k] : 0.0, two ? row(k + 2) : none.data());
    }
}

}  // namespace aerogram::planner
