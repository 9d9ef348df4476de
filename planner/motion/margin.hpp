#pragma once
#include <functional>
#include <limits>

#include "geo/run.hpp"
#include "planner/motion/act.hpp"
#include "planner/motion/reach.hpp"

namespace aerogram::planner {

/// A distance to keep, 1-Lipschitz in its place; upright ones do not depend on height.
struct Margin {
    std::function<double(const Vec3&)> at;
    bool upright = false;

    [[nodiscard]] double radius_m(const Vec3& offset) const {
        return upright ? glm::length(Vec2(offset)) : glm::length(offset);
    }
};

/// Where a margin is smallest.
struct Worst {
    double margin_m = std::numeric_limits<double>::infinity();  ///< never more than the true smallest
    std::size_t drone = 0;
    double time_s = 0.0;  ///< act-local
};

/// The smallest value of a margin over all drones and instants, to a millimetre near zero and to a thousandth
/// elsewhere. An unfinished search (a stop was asked for) is for the caller to throw away.
/// @param reaches  of the same act.
/// Cost: one evaluation a drone, more for those that come near the smallest.
[[nodiscard]] Worst smallest_margin(const Act& act, const Reaches& reaches, const Margin& margin, const Run& run);

}  // namespace aerogram::planner
