#include "planner/motion/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

struct Cell {
    std::int64_t x = 0, y = 0, z = 0;
    auto operator<=>(const Cell&) const = default;
};

std::int64_t cell_coordinate(double value_m, double origin_m, double cell_m) {
    return static_cast<std::int64_t>(std::floor((value_m - origin_m) / cell_m));
}

/// Half of the neighbourhood: those offsets that are after (0, 0, 0) in lexicographic order.
std::array<Cell, 13> later_offsets() {
    std::array<Cell, 13> offsets{};
    std::size_t count = 0;
    for (std::int64_t x = -1; x <= 1; ++x) {
        for (std::int64_t y = -1; y <= 1; ++y) {
            for (std::int64_t z = -1; z <= 1; ++z) {
                if (Cell{x, y, z} > Cell{}) offsets[count++] = {x, y, z};
            }
        }
    }
    return offsets;
}

}  // namespace

NeighbourGrid::NeighbourGrid(std::span<const Vec3> points, double cell_m) : order_(points.size()) {
    AEROGRAM_REQUIRE(cell_m > 0.0 && points.size() < std::numeric_limits<std::uint32_t>::max(), cell_m, points.size());
    Vec3 low{};
    if (!points.empty()) low = points[0];
    for (const Vec3& p : points) low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    std::vector<std::pair<Cell, std::uint32_t>> keyed(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        keyed[i] = {{cell_coordinate(points[i].x, low.x, cell_m), cell_coordinate(points[i].y, low.y, cell_m),
                     cell_coordinate(points[i].z, low.z, cell_m)},
                    static_cast<std::uint32_t>(i)};
    }
    std::sort(keyed.begin(), keyed.end());

    std::vector<Cell> cells;
    for (std::size_t k = 0; k < keyed.size(); ++k) {
        if (cells.empty() || cells.back() != keyed[k].first) {
            cells.push_back(keyed[k].first);
            starts_.push_back(static_cast<std::uint32_t>(k));
        }
        order_[k] = keyed[k].second;
    }
    starts_.push_back(static_cast<std::uint32_t>(keyed.size()));

    // Cells are sorted, so the neighbour at a fixed offset only moves forward: one sweep for each offset.
    const auto offsets = later_offsets();
    std::array<std::size_t, 13> cursor{};
    for (const Cell& cell : cells) {
        touching_starts_.push_back(static_cast<std::uint32_t>(touching_.size()));
        for (std::size_t o = 0; o < offsets.size(); ++o) {
            const Cell wanted{cell.x + offsets[o].x, cell.y + offsets[o].y, cell.z + offsets[o].z};
            while (cursor[o] < cells.size() && cells[cursor[o]] < wanted) ++cursor[o];
            if (cursor[o] < cells.size() && cells[cursor[o]] == wanted) {
                touching_.push_back(static_cast<std::uint32_t>(cursor[o]));
            }
        }
    }
    touching_starts_.push_back(static_cast<std::uint32_t>(touching_.size()));
}

std::span<const std::uint32_t> NeighbourGrid::later_neighbours(std::size_t cell) const {
    return std::span(touching_).subspan(touching_starts_[cell], touching_starts_[cell + 1] - touching_starts_[cell]);
}

}  // namespace aerogram::planner
