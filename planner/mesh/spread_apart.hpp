#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "geo/run.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

/// How a point may move: not at all, along a line, in a plane, or anywhere.
struct Freedom {
    enum class Kind { none, line, plane, space } kind = Kind::space;
    Vec3 axis{};  ///< of length 1: along the line, or across the plane

    /// The part of a displacement that is allowed.
    [[nodiscard]] Vec3 of(const Vec3& v) const {
        switch (kind) {
            case Kind::none:
                return {};
            case Kind::line:
                return glm::dot(v, axis) * axis;
            case Kind::plane:
                return v - glm::dot(v, axis) * axis;
            case Kind::space:
                break;
        }
        return v;
    }
};

/// What holds points on a surface, on lines or in a volume.
struct Ground {
    std::function<Freedom(std::size_t i)> freedom;
    /// Moves point i as near to `wanted` as its ground allows, and says where it is.
    std::function<Vec3(std::size_t i, const Vec3& wanted)> move;
};

/// The smallest distance of two points as a multiple of the smaller of their reaches; infinite for fewer than two.
[[nodiscard]] double smallest_share(const Points& points, const std::vector<double>& reach);

/// How many rounds `count` points deserve: more when there are few.
[[nodiscard]] std::size_t spread_rounds(std::size_t count);

/// Which distances to try for, as multiples of the reaches.
struct Targets {
    double first = 1.0, last = 0.4;
};
/// Around the gaps that points already have which are about evenly spread.
[[nodiscard]] Targets targets_for(const Points& points, const std::vector<double>& reach);

/// Widens the smallest distance in space of points that are about evenly spread, as push_apart.hpp does in the plane:
/// pairs nearer than a target slide apart on their ground, the target falling from the first to
/// the last; the round with the widest smallest distance is kept. Points on the two sides of a thin wall come to
/// stand alternately.
/// @param reach  one a point, > 0: targets in proportion to it, so that dense parts stay dense.
/// Properties: (1) the smallest share never falls (2) deterministic. Cost: O(n) a round.
void spread_apart(Points& points, const std::vector<double>& reach, const Ground& ground, const Targets& targets,
                  std::size_t rounds, const Run& run);

}  // namespace aerogram::planner
