#pragma once
#include <cstdint>
#include <vector>

#include "planner/assignment/coordinates.hpp"

namespace aerogram::planner {

/// Indices in the order of a kd tree's leaves: near ones close together, each run of `leaf` (the last may be shorter)
/// in a box of its own.
/// @param weight  how much a metre along each axis counts when the longest side is chosen.
std::vector<std::uint32_t> kd_order(const Coordinates& points, std::uint32_t leaf = 1,
                                    const Vec3& weight = {1.0, 1.0, 1.0});

/// Weights for points that are only ever looked at along others' positions (2 x·y): how far those spread along each
/// axis from the origin, the largest 1, none below 1e-3.
Vec3 weights_by_spread(const Coordinates& others);

struct Box {
    Vec3 low{}, high{};
    [[nodiscard]] Vec3 center() const { return (low + high) / 2.0; }
    [[nodiscard]] Vec3 half() const { return (high - low) / 2.0; }
};
/// Around the points order[begin, end), at least one.
Box box_of(const Coordinates& points, const std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end);

}  // namespace aerogram::planner
