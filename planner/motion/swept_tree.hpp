#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Eight points of a SweptTree, component by component; places without a point hold NaN.
struct alignas(32) SweptLeaf {
    double from[3][8];
    double to[3][8];
    double stray[8];
    std::uint32_t index[8];
    std::uint32_t count = 0;
};

/// Points that all run from one place to another in a straight line and in the same rhythm, each at most its own stray
/// off that line; so the difference of two runs along a segment, at most both strays off. A kd-tree over the six
/// coordinates (from, to), in which every pair that may come close is found by descending two nodes at a time. A wild
/// map only makes it slower.
class SweptTree {
  public:
    /// The order of the points in the tree. @param to  as many as `from`; all finite.
    SweptTree(std::span<const Vec3> from, std::span<const Vec3> to);
    /// The same order for other places: nodes fit the points again.
    /// @param stray_m  one a point, or empty for none.
    void place(std::span<const Vec3> from, std::span<const Vec3> to, std::span<const double> stray_m);

    /// Calls visit(i, j), i < j, for pairs that may come closer than visitor.limit_m(); each at most once, none closer
    /// left out. The limit may fall while this runs, and is asked for again for every two nodes. The order depends on
    /// the points alone.
    template <class Visitor>
    void for_each_close_pair(Visitor& visitor) const {
        for (std::uint32_t leaf = 0; leaf < leaves_.size(); ++leaf) visit_leaves(leaf, leaf, visitor);
        if (!nodes_.empty()) visit_within(0, visitor);
    }
    /// As above, for those pairs alone that share a leaf: a few of the closest, fast.
    template <class Visitor>
    void for_some_close_pairs(Visitor& visitor) const {
        for (std::uint32_t leaf = 0; leaf < leaves_.size(); ++leaf) visit_leaves(leaf, leaf, visitor);
    }

  private:
    struct Node {
        Vec3 from_center{}, from_half{}, to_center{}, to_half{};
        double stray = 0.0;
        double size = 0.0;       ///< to choose which of two nodes is opened
        std::uint32_t left = 0;  ///< nodes; for a leaf left = right = 0
        std::uint32_t right = 0;
        std::uint32_t leaf = 0;
    };
    struct Keyed {
        double key;
        std::uint32_t index;
    };

    std::uint32_t build(std::span<Keyed> points, std::span<const Vec3> from, std::span<const Vec3> to);
    void fit(Node& node) const;
    /// No two of the nodes' points come closer than this.
    static double apart_m(const Node& a, const Node& b, double reach_m);
    /// Bit 8 a + b is set where point a of the first leaf and b of the second may be closer than limit_m.
    static std::uint64_t close_bits(const SweptLeaf& a, const SweptLeaf& b, double limit_m);

    template <class Visitor>
    void visit_within(std::uint32_t at, Visitor& visitor) const {
        const Node& node = nodes_[at];
        if (node.left == node.right) return;
        visit_within(node.left, visitor);
        visit_within(node.right, visitor);
        visit_between(node.left, node.right, visitor);
    }
    template <class Visitor>
    void visit_between(std::uint32_t a, std::uint32_t b, Visitor& visitor) const {
        const Node &first = nodes_[a], &second = nodes_[b];
        const double reach_m = visitor.limit_m() + first.stray + second.stray;
        if (apart_m(first, second, reach_m) >= reach_m) return;
        const bool first_leaf = first.left == first.right, second_leaf = second.left == second.right;
        if (first_leaf && second_leaf) return visit_leaves(first.leaf, second.leaf, visitor);
        if (second_leaf || (!first_leaf && first.size >= second.size)) {
            visit_between(first.left, b, visitor);
            visit_between(first.right, b, visitor);
        } else {
            visit_between(a, second.left, visitor);
            visit_between(a, second.right, visitor);
        }
    }
    template <class Visitor>
    void visit_leaves(std::uint32_t a, std::uint32_t b, Visitor& visitor) const {
        std::uint64_t close = close_bits(leaves_[a], leaves_[b], visitor.limit_m());
        if (a == b) close &= kAboveDiagonal;
        for (; close != 0; close &= close - 1) {
            const auto bit = static_cast<unsigned>(std::countr_zero(close));
            const std::uint32_t i = leaves_[a].index[bit / 8], j = leaves_[b].index[bit % 8];
            i < j ? visitor.visit(i, j) : visitor.visit(j, i);
        }
    }

    static constexpr std::uint64_t kAboveDiagonal = 0x0080C0E0F0F8FCFEULL;  ///< bits 8 a + b with a < b
    std::vector<SweptLeaf> leaves_;
    std::vector<Node> nodes_;  ///< the root first; children after their parents
};

}  // namespace aerogram::planner
