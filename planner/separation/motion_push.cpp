#include "planner/separation/motion_push.hpp"

#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"
#include "geo/vectorized.hpp"

namespace aerogram::planner {
namespace {

/// Squares of horizontal steps and of bends, and the steps up, row by row.
AEROGRAM_VECTORIZED
void differences(const double* x, const double* y, const double* z, std::size_t rows, double* __restrict level,
                 double* __restrict rise, double* __restrict bend) {
    for (std::size_t k = 0; k + 1 < rows; ++k) {
        const double dx = x[k + 1] - x[k], dy = y[k + 1] - y[k];
        level[k] = dx * dx + dy * dy;
        rise[k] = z[k + 1] - z[k];
    }
    for (std::size_t k = 0; k + 2 < rows; ++k) {
        const double bx = x[k] - 2.0 * x[k + 1] + x[k + 2], by = y[k] - 2.0 * y[k + 1] + y[k + 2],
                     bz = z[k] - 2.0 * z[k + 1] + z[k + 2];
        bend[k] = bx * bx + by * by + bz * bz;
    }
}

constexpr double kMostShare = 0.2;  ///< of a difference, taken off in one round

/// Share of a length that is above its limit, as far as one round may go.
double excess(double length, double limit) {
    return std::min(1.0 - limit / length, kMostShare);
}

}  // namespace

MotionPush::MotionPush(const MotionLimits& motion, double width, double gain)
    : horizontal_m_(motion.limits.speed_horizontal_mps * motion.step_s),
      up_m_(motion.limits.speed_up_mps * motion.step_s),
      down_m_(motion.limits.speed_down_mps * motion.step_s),
      bend_m_(motion.limits.acceleration_mps2 * motion.step_s * motion.step_s),
      speed_weight_(2.0 * width * width / gain),
      bend_weight_(width * width * width * width / gain) {
    AEROGRAM_REQUIRE(motion.step_s > 0.0, motion.step_s);
}

double MotionPush::ratio(const double* x, const double* y, const double* z, std::size_t rows) const {
    AEROGRAM_REQUIRE(rows <= kMostRows, rows);
    double level[kMostRows], rise[kMostRows], bend[kMostRows];
    differences(x, y, z, rows, level, rise, bend);
    double most_level = 0.0, most_up = 0.0, most_down = 0.0, most_bend = 0.0;
    for (std::size_t k = 0; k + 1 < rows; ++k) {
        most_level = std::max(most_level, level[k]);
        most_up = std::max(most_up, rise[k]);
        most_down = std::max(most_down, -rise[k]);
    }
    for (std::size_t k = 0; k + 2 < rows; ++k) most_bend = std::max(most_bend, bend[k]);
    return std::max(
        {std::sqrt(most_level) / horizontal_m_, most_up / up_m_, most_down / down_m_, std::sqrt(most_bend) / bend_m_});
}

void MotionPush::push(const double* x, const double* y, const double* z, std::size_t rows, double* cx, double* cy,
                      double* cz) const {
    for (std::size_t k = 0; k + 1 < rows; ++k) {
        const double dx = x[k + 1] - x[k], dy = y[k + 1] - y[k], dz = z[k + 1] - z[k];
        const double level = std::sqrt(dx * dx + dy * dy);
        const double share = level > horizontal_m_ ? speed_weight_ * excess(level, horizontal_m_) : 0.0;
        const double rise = speed_weight_ * dz *
                            (dz > up_m_      ? excess(dz, up_m_)
                             : dz < -down_m_ ? excess(-dz, down_m_)
                                             : 0.0);
        cx[k] += share * dx;
        cy[k] += share * dy;
        cz[k] += rise;
        cx[k + 1] -= share * dx;
        cy[k + 1] -= share * dy;
        cz[k + 1] -= rise;
    }
    for (std::size_t k = 0; k + 2 < rows; ++k) {
        const double bend[3] = {x[k] - 2.0 * x[k + 1] + x[k + 2], y[k] - 2.0 * y[k + 1] + y[k + 2],
                                z[k] - 2.0 * z[k + 1] + z[k + 2]};
        const double length = std::sqrt(bend[0] * bend[0] + bend[1] * bend[1] + bend[2] * bend[2]);
        if (length <= bend_m_) continue;
        const double share = bend_weight_ * excess(length, bend_m_);
        double* const c[3] = {cx, cy, cz};
        for (std::size_t a = 0; a < 3; ++a) {
            c[a][k] -= share * bend[a];
            c[a][k + 1] += 2.0 * share * bend[a];
            c[a][k + 2] -= share * bend[a];
        }
    }
}

}  // namespace aerogram::planner
