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

/// Where the points of a node begin and end, middle and half size, and the largest stray.
struct SweptBoxes {
    Vec3 from_center{}, from_half{}, to_center{}, to_half{};
    double stray = 0.0;
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
        for (const Node& node : nodes_) {
            if (node.is_leaf()) visit_leaves(node, node, visitor);  // first, to lower the limit
        }
        if (!nodes_.empty()) visit_within(nodes_[0], visitor);
    }

  private:
    struct Node : SweptBoxes {
        double size = 0.0;       ///< to choose which of two nodes is opened
        std::uint32_t left = 0;  ///< nodes; equal in a leaf
        std::uint32_t right = 0;
        std::uint32_t leaf = 0;

        [[nodiscard]] bool is_leaf() const { return left == right; }
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
    [[nodiscard]] std::uint64_t close_bits(const Node& a, const Node& b, double limit_m) const;

    template <class Visitor>
    void visit_within(const Node& node, Visitor& visitor) const {
        if (node.is_leaf()) return;
        visit_within(nodes_[node.left], visitor);
        visit_within(nodes_[node.right], visitor);
        visit_between(nodes_[node.left], nodes_[node.right], visitor);
    }
    template <class Visitor>
    void visit_between(const Node& a, const Node& b, Visitor& visitor) const {
        const double reach_m = visitor.limit_m() + a.stray + b.stray;
        if (apart_m(a, b, reach_m) >= reach_m) return;
        if (a.is_leaf() && b.is_leaf()) {
            visit_leaves(a, b, visitor);
        } else if (b.is_leaf() || (!a.is_leaf() && a.size >= b.size)) {
            visit_between(nodes_[a.left], b, visitor);
            visit_between(nodes_[a.right], b, visitor);
        } else {
            visit_between(a, nodes_[b.left], visitor);
            visit_between(a, nodes_[b.right], visitor);
        }
    }
    template <class Visitor>
    void visit_leaves(const Node& a, const Node& b, Visitor& visitor) const {
        std::uint64_t close = close_bits(a, b, visitor.limit_m());
        if (&a == &b) close &= kAboveDiagonal;
        for (; close != 0; close &= close - 1) {
            const auto bit = static_cast<unsigned>(std::countr_zero(close));
            const std::uint32_t i = leaves_[a.leaf].index[bit / 8], j = leaves_[b.leaf].index[bit % 8];
            i < j ? visitor.visit(i, j) : visitor.visit(j, i);
        }
    }

    static constexpr std::uint64_t kAboveDiagonal = 0x0080C0E0F0F8FCFEULL;  ///< bits 8 a + b with a < b
    std::vector<SweptLeaf> leaves_;
    std::vector<Node> nodes_;  ///< the root first; children after their parents
};

}  // namespace aerogram::planner
