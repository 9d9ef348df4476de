#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "planner/assignment/coordinates.hpp"

namespace aerogram::planner {

/// Points by what the products 2 x·y with the others can tell of them: along an axis in which the others do not spread
/// at all, nothing. (About barycentres the others stand at zero there, but for rounding.)
Coordinates seen_by(const Coordinates& others, const Coordinates& points);

/// Points in classes of equal ones.
struct Classes {
    std::vector<std::uint32_t> members;  ///< class after class, ascending in each
    std::vector<std::uint32_t> begin;    ///< by class, where its members begin; and the end

    [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t c) const {
        return {members.data() + begin[c], members.data() + begin[c + 1]};
    }
};
Classes classes_of(const Coordinates& points);

}  // namespace aerogram::planner
