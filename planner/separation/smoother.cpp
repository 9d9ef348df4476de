#include "planner/separation/smoother.hpp"

#include "geo/contract.hpp"

namespace aerogram::planner {

SobolevSmoother::SobolevSmoother(std::vector<bool> fixed, double lambda)
    : fixed_(std::move(fixed)), pivot_(fixed_.size(), 1.0), below_one_(fixed_.size()), below_two_(fixed_.size()) {
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
}

void SobolevSmoother::apply(std::span<Vec3> c) const {
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
