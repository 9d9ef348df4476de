#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// A uniform hash grid over points: finds every pair that may be closer than the cell, never all pairs.
class NeighbourGrid {
  public:
    /// @param points  finite; z already divided by the downwash where that is the metric.  @param cell_m  > 0.
    NeighbourGrid(std::span<const Vec3> points, double cell_m);

    /// Calls visit(i, j), i < j, once for each pair in the same or touching cells: all pairs closer than cell_m are
    /// among them. The order depends on the points alone.
    template <class Visit>
    void for_each_pair(Visit visit) const {
        for (std::size_t c = 0; c + 1 < starts_.size(); ++c) {
            for (std::uint32_t a = starts_[c]; a < starts_[c + 1]; ++a) {
                for (std::uint32_t b = a + 1; b < starts_[c + 1]; ++b) visit_ordered(visit, order_[a], order_[b]);
            }
            for (const std::uint32_t other : later_neighbours(c)) {
                for (std::uint32_t a = starts_[c]; a < starts_[c + 1]; ++a) {
                    for (std::uint32_t b = starts_[other]; b < starts_[other + 1]; ++b) {
                        visit_ordered(visit, order_[a], order_[b]);
                    }
                }
            }
        }
    }

  private:
    template <class Visit>
    static void visit_ordered(Visit& visit, std::uint32_t a, std::uint32_t b) {
        a < b ? visit(std::size_t{a}, std::size_t{b}) : visit(std::size_t{b}, std::size_t{a});
    }
    /// The 13 of a cell's 26 neighbours that come after it, as far as they hold points.
    [[nodiscard]] std::span<const std::uint32_t> later_neighbours(std::size_t cell) const;

    std::vector<std::uint32_t> order_;     ///< point indices, cell by cell
    std::vector<std::uint32_t> starts_;    ///< cell c holds order_[starts_[c] .. starts_[c + 1])
    std::vector<std::uint32_t> touching_;  ///< cells, listed for each cell in turn
    std::vector<std::uint32_t> touching_starts_;
};

}  // namespace aerogram::planner
