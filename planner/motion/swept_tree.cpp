#include "planner/motion/swept_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geo/contract.hpp"
#include "geo/vectorized.hpp"
#include "planner/motion/lanes.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kLeaf = 8;

Vec3 lower(const Vec3& a, const Vec3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 upper(const Vec3& a, const Vec3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

struct Box {
    Vec3 low, high;
    explicit Box(const Vec3& p) : low(p), high(p) {}
    void take(const Vec3& p) {
        low = lower(low, p);
        high = upper(high, p);
    }
};

/// Coordinate 0..5 of a point's (from, to).
double coordinate(const Vec3& from, const Vec3& to, int axis) {
    return axis < 3 ? from[axis] : to[axis - 3];
}

/// Distance of the segment [w, u] from the origin, squared, for four pairs; less than `reach` gives all bits.
inline void closer(const Lanes (&w)[3], const Lanes (&u)[3], const Lanes& reach, LaneBits& answer) {
    const Lanes x = u[0] - w[0], y = u[1] - w[1], z = u[2] - w[2];
    const Lanes along = -(w[0] * x + w[1] * y + w[2] * z);
    const Lanes squared = x * x + y * y + z * z;
    const Lanes zero = {0.0, 0.0, 0.0, 0.0}, one = {1.0, 1.0, 1.0, 1.0}, least = {1e-300, 1e-300, 1e-300, 1e-300};
    Lanes s = along / (squared > least ? squared : least);
    s = s > zero ? s : zero;
    s = s < one ? s : one;
    const Lanes nx = w[0] + s * x, ny = w[1] + s * y, nz = w[2] + s * z;
    answer = nx * nx + ny * ny + nz * nz < reach * reach;
}

/// Bit i is set where point i of the leaf may come closer than `reach_m` to some point between the boxes.
inline unsigned near_boxes(const SweptLeaf& a, const SweptBoxes& b, double reach_m) {
    unsigned near = 0;
    for (unsigned half = 0; half < 2; ++half) {
        const Lanes zero = {0.0, 0.0, 0.0, 0.0};
        Lanes squared = zero;
        for (int axis = 0; axis < 3; ++axis) {
            Lanes w, u;
            load(a.from[axis] + 4 * half, w);
            load(a.to[axis] + 4 * half, u);
            w = b.from_center[axis] - w;
            u = b.to_center[axis] - u;
            const Lanes w_low = w - b.from_half[axis], u_low = u - b.to_half[axis];
            const Lanes w_high = w + b.from_half[axis], u_high = u + b.to_half[axis];
            const Lanes low = w_low < u_low ? w_low : u_low, high = w_high > u_high ? w_high : u_high;
            Lanes gap = low > -high ? low : -high;
            gap = gap > zero ? gap : zero;
            squared += gap * gap;
        }
        Lanes reach;
        load(a.stray + 4 * half, reach);
        reach += reach_m + b.stray;
        reach = reach > zero ? reach : zero;
        const LaneBits place = {1, 2, 4, 8};
        const LaneBits bits = (squared < reach * reach) & place;
        near |= static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]) << (4 * half);
    }
    return near;
}

AEROGRAM_VECTORIZED
std::uint64_t close_points(const SweptLeaf& a, const SweptLeaf& b, const SweptBoxes& boxes, double limit_m) {
    LaneBits bits = {0, 0, 0, 0};
    for (unsigned near = near_boxes(a, boxes, limit_m); near != 0; near &= near - 1) {
        const auto i = static_cast<unsigned>(std::countr_zero(near));
        for (unsigned half = 0; half < 2; ++half) {
            Lanes w[3], u[3], reach;
            for (int axis = 0; axis < 3; ++axis) {
                load(b.from[axis] + 4 * half, w[axis]);
                load(b.to[axis] + 4 * half, u[axis]);
                w[axis] -= a.from[axis][i];
                u[axis] -= a.to[axis][i];
            }
            load(b.stray + 4 * half, reach);
            reach += limit_m + a.stray[i];
            const Lanes zero = {0.0, 0.0, 0.0, 0.0};
            reach = reach > zero ? reach : zero;
            LaneBits answer;
            closer(w, u, reach, answer);
            const LaneBits place = {1, 2, 4, 8};
            bits |= answer & (place << static_cast<std::int64_t>(8 * i + 4 * half));
        }
    }
    return static_cast<std::uint64_t>(bits[0] | bits[1] | bits[2] | bits[3]);
}

}  // namespace

SweptTree::SweptTree(std::span<const Vec3> from, std::span<const Vec3> to) {
    AEROGRAM_REQUIRE(from.size() == to.size() && from.size() < std::numeric_limits<std::uint32_t>::max(), from.size(),
                     to.size());
    if (from.empty()) return;
    std::vector<Keyed> points(from.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i].index = static_cast<std::uint32_t>(i);
    leaves_.reserve(from.size() / kLeaf + 1);
    nodes_.reserve(2 * leaves_.capacity());
    build(points, from, to);
    place(from, to, {});
}

std::uint32_t SweptTree::build(std::span<Keyed> points, std::span<const Vec3> from, std::span<const Vec3> to) {
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    if (points.size() <= kLeaf) {
        nodes_[at].leaf = static_cast<std::uint32_t>(leaves_.size());
        SweptLeaf& leaf = leaves_.emplace_back();
        for (const Keyed& point : points) leaf.index[leaf.count++] = point.index;
        return at;
    }
    Box source(from[points[0].index]), target(to[points[0].index]);
    for (const Keyed& point : points) {
        source.take(from[point.index]);
        target.take(to[point.index]);
    }
    int widest = 0;
    double width_m = -1.0;
    for (int axis = 0; axis < 6; ++axis) {
        const double here_m = coordinate(source.high, target.high, axis) - coordinate(source.low, target.low, axis);
        if (here_m <= width_m) continue;
        width_m = here_m;
        widest = axis;
    }
    for (Keyed& point : points) point.key = coordinate(from[point.index], to[point.index], widest);
    const std::size_t half = (points.size() + 2 * kLeaf - 1) / (2 * kLeaf) * kLeaf;  // full leaves, but for the last
    std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(half), points.end(),
                     [](const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; });
    const std::uint32_t left = build(points.first(half), from, to);
    const std::uint32_t right = build(points.subspan(half), from, to);
    nodes_[at].left = left;
    nodes_[at].right = right;
    return at;
}

void SweptTree::place(std::span<const Vec3> from, std::span<const Vec3> to, std::span<const double> stray_m) {
    for (SweptLeaf& leaf : leaves_) {
        for (std::uint32_t k = 0; k < kLeaf; ++k) {
            const bool empty = k >= leaf.count;
            const std::uint32_t i = leaf.index[k];
            for (int axis = 0; axis < 3; ++axis) {
                leaf.from[axis][k] = empty ? std::numeric_limits<double>::quiet_NaN() : from[i][axis];
                leaf.to[axis][k] = empty ? std::numeric_limits<double>::quiet_NaN() : to[i][axis];
            }
            leaf.stray[k] = empty || stray_m.empty() ? 0.0 : stray_m[i];
        }
    }
    for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) fit(*node);
}

void SweptTree::fit(Node& node) const {
    if (node.is_leaf()) {
        const SweptLeaf& leaf = leaves_[node.leaf];
        const auto from = [&](std::uint32_t k) { return Vec3{leaf.from[0][k], leaf.from[1][k], leaf.from[2][k]}; };
        const auto to = [&](std::uint32_t k) { return Vec3{leaf.to[0][k], leaf.to[1][k], leaf.to[2][k]}; };
        Box source(from(0)), target(to(0));
        node.stray = leaf.stray[0];
        for (std::uint32_t k = 1; k < leaf.count; ++k) {
            source.take(from(k));
            target.take(to(k));
            node.stray = std::max(node.stray, leaf.stray[k]);
        }
        node.from_center = 0.5 * (source.low + source.high);
        node.from_half = 0.5 * (source.high - source.low);
        node.to_center = 0.5 * (target.low + target.high);
        node.to_half = 0.5 * (target.high - target.low);
    } else {
        const Node &a = nodes_[node.left], &b = nodes_[node.right];
        const auto join = [](const Vec3& ca, const Vec3& ha, const Vec3& cb, const Vec3& hb, Vec3& center, Vec3& half) {
            const Vec3 low = lower(ca - ha, cb - hb), high = upper(ca + ha, cb + hb);
            center = 0.5 * (low + high);
            half = 0.5 * (high - low);
        };
        join(a.from_center, a.from_half, b.from_center, b.from_half, node.from_center, node.from_half);
        join(a.to_center, a.to_half, b.to_center, b.to_half, node.to_center, node.to_half);
        node.stray = std::max(a.stray, b.stray);
    }
    node.size = glm::dot(node.from_half, node.from_half) + glm::dot(node.to_half, node.to_half);
}

/// The difference runs along a segment between two boxes. Their common box bounds its distance from the origin, and so
/// does any plane; the one tried faces the segment between the middles.
double SweptTree::apart_m(const Node& a, const Node& b, double reach_m) {
    const Vec3 w = b.from_center - a.from_center, u = b.to_center - a.to_center;
    const Vec3 w_half = a.from_half + b.from_half, u_half = a.to_half + b.to_half;
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = std::min(w[axis] - w_half[axis], u[axis] - u_half[axis]);
        const double high = std::max(w[axis] + w_half[axis], u[axis] + u_half[axis]);
        const double gap = std::max({0.0, low, -high});
        squared += gap * gap;
    }
    const double boxes_m = std::sqrt(squared);
    if (boxes_m >= reach_m) return boxes_m;
    const Vec3 way = u - w;
    const double length_squared = glm::dot(way, way);
    const double s = length_squared > 0.0 ? std::clamp(-glm::dot(w, way) / length_squared, 0.0, 1.0) : 0.0;
    const Vec3 nearest = w + s * way;
    const double length = glm::length(nearest);
    if (length < reach_m) return boxes_m;
    const Vec3 n = nearest / length, size = glm::abs(n);
    return std::max(boxes_m,
                    std::min(glm::dot(n, w) - glm::dot(size, w_half), glm::dot(n, u) - glm::dot(size, u_half)));
}

std::uint64_t SweptTree::close_bits(const Node& a, const Node& b, double limit_m) const {
    return close_points(leaves_[a.leaf], leaves_[b.leaf], b, limit_m);
}

}  // namespace aerogram::planner
