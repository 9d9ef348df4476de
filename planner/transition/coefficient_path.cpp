#include "planner/transition/coefficient_path.hpp"

#include <algorithm>
#include <cmath>

#include "geo/units.hpp"
#include "planner/transition/turn.hpp"

namespace aerogram::planner {
namespace {
constexpr double kOpposite = 1e-7;  // rad from pi
}

CoefficientPath::CoefficientPath(const Vec3& from_m, const Vec3& to_m, const Vec3& axis, double zero_m)
    : from_m_(from_m), to_m_(to_m), from_length_m_(glm::length(from_m)), to_length_m_(glm::length(to_m)) {
    straight_ = std::min(from_length_m_, to_length_m_) <= zero_m;
    if (straight_) return;
    start_ = from_m / from_length_m_;
    const Vec3 end = to_m / to_length_m_;
    const Vec3 across = end - glm::dot(end, start_) * start_;
    const double sine = glm::length(across);
    angle_rad_ = std::atan2(sine, glm::dot(end, start_));
    if (kPi - angle_rad_ < kOpposite) {
        angle_rad_ = kPi;
        side_ = glm::cross(square_to(start_, axis), start_);
    } else if (sine > 0.0) {
        side_ = across / sine;
    }
    miss_ = end - (std::cos(angle_rad_) * start_ + std::sin(angle_rad_) * side_);
}

Vec3 CoefficientPath::at(double t) const {
    if (straight_) return (1.0 - t) * from_m_ + t * to_m_;
    const Vec3 direction = std::cos(angle_rad_ * t) * start_ + std::sin(angle_rad_ * t) * side_ + t * miss_;
    return ((1.0 - t) * from_length_m_ + t * to_length_m_) * glm::normalize(direction);
}

}  // namespace aerogram::planner
