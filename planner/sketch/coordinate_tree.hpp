#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "planner/sketch/formation_coordinates.hpp"

namespace aerogram::planner {

/// Nobody found, or nobody assigned.
inline constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

/// A k-d tree of points in coordinate space (four components) from which points are taken out one by one.
class CoordinateTree {
  public:
    explicit CoordinateTree(std::span<const FormationCoordinate> points);

    [[nodiscard]] std::size_t size() const { return points_.empty() ? 0 : alive_[0]; }

    /// The nearest point that is left (Euclidean), of equally near ones the lowest index; kNobody when none is.
    /// @param except  ascending indices that are passed over.
    [[nodiscard]] std::uint32_t nearest(const FormationCoordinate& to,
                                        std::span<const std::uint32_t> except = {}) const;
    /// Calls visit(index, squared distance) for the points left within a distance, in the tree's order.
    template <class Visit>
    void within(const FormationCoordinate& of, double distance, const Visit& visit) const {
        if (!points_.empty()) within(0, 0, points_.size(), of, distance, visit);
    }
    /// @param index  of a point that is left.
    void remove(std::uint32_t index);

  private:
    static constexpr std::size_t kLeaf = 8;
    struct Search;
    struct Cell {
        std::size_t axis = 0;
        double split = 0.0;
    };

    void build(std::size_t node, std::size_t begin, std::size_t end);
    void search(std::size_t node, std::size_t begin, std::size_t end, Search& s) const;
    static double squared_distance(const FormationCoordinate& a, const FormationCoordinate& b) {
        double sum = 0.0;
        for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
        return sum;
    }
    template <class Visit>
    void within(std::size_t node, std::size_t begin, std::size_t end, const FormationCoordinate& of, double distance,
                const Visit& visit) const {
        if (alive_[node] == 0) return;
        if (end - begin <= kLeaf) {
            for (std::size_t k = begin; k < end; ++k) {
                if (gone_[k]) continue;
                const double d2 = squared_distance(points_[k], of);
                if (d2 <= distance * distance) visit(order_[k], d2);
            }
            return;
        }
        const double side = of[cells_[node].axis] - cells_[node].split;
        const std::size_t middle = begin + (end - begin) / 2;
        if (side <= distance) within(2 * node + 1, begin, middle, of, distance, visit);
        if (side >= -distance) within(2 * node + 2, middle, end, of, distance, visit);
    }

    std::vector<FormationCoordinate> points_;  ///< in the tree's order, in which they are called places
    std::vector<std::uint32_t> order_;         ///< index by place
    std::vector<std::uint32_t> place_;         ///< by index
    std::vector<bool> gone_;                   ///< by place
    std::vector<Cell> cells_;                  ///< by node; node n has 2n + 1 and 2n + 2
    std::vector<std::uint32_t> alive_;         ///< by node
};

}  // namespace aerogram::planner
