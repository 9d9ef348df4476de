#include "planner/motion/profile.hpp"

#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"
#include "planner/motion/act.hpp"

namespace aerogram::planner {
namespace {

double minimum_jerk(double u) {
    return u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}

/// Constant acceleration for the first third, cruise at 3/2, constant deceleration for the last.
double trapezoid(double u) {
    if (u > 0.5) return 1.0 - trapezoid(1.0 - u);
    if (u < 1.0 / 3.0) return 2.25 * u * u;
    return 0.25 + 1.5 * (u - 1.0 / 3.0);
}

/// The trapezoid whose acceleration rises and falls linearly over a quarter of its phase at each end (jerk-limited).
/// Phase length p = 1/3, ramp r = p/4: cruise speed 3/2 = a (p - r), so a = 6.
double s_curve(double u) {
    if (u > 0.5) return 1.0 - s_curve(1.0 - u);
    constexpr double p = 1.0 / 3.0, r = p / 4.0, a = 6.0;
    if (u < r) return a * u * u * u / (6.0 * r);
    if (u < p - r) {
        const double v = u - r;
        return a * r * r / 6.0 + a * r / 2.0 * v + a * v * v / 2.0;
    }
    if (u < p) {
        const double v = p - u;  // mirrored: from cruise backwards
        return 0.25 - 1.5 * v + a * v * v * v / (6.0 * r);
    }
    return 0.25 + 1.5 * (u - p);
}

}  // namespace

double profile_value(ProfileKind kind, double u) {
    if (u <= 0.0) return 0.0;
    if (u >= 1.0) return 1.0;
    switch (kind) {
        case ProfileKind::minimum_jerk:
            return minimum_jerk(u);
        case ProfileKind::trapezoid:
            return trapezoid(u);
        case ProfileKind::s_curve:
            return s_curve(u);
    }
    AEROGRAM_REQUIRE(false, static_cast<int>(kind));
    return 0.0;
}

std::vector<double> profile_rows(ProfileKind kind, std::size_t rows) {
    AEROGRAM_REQUIRE(rows >= 7, rows);
    std::vector<double> s(rows);
    for (std::size_t k = 0; k < rows; ++k) {
        s[k] = k == 0 ? 0.0 : profile_value(kind, static_cast<double>(k - 1) / static_cast<double>(rows - 3));
    }
    std::fill(s.begin(), s.begin() + 3, 0.0);
    std::fill(s.end() - 3, s.end(), 1.0);
    return s;
}

double time_share_at(const std::vector<double>& rows, double s) {
    if (s <= 0.0) return 0.0;
    double low = 0.0, high = 1.0;
    const Act unit{"", ActRole::transit, Timing::free, 0, 1000, Straight{{Vec3{}}, {Vec3{1, 0, 0}}, rows}};
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        (kinematics(unit, DroneId{}, middle).position_m.x < s ? low : high) = middle;
    }
    return high;
}

}  // namespace aerogram::planner
