#include "export/scene/glb_nodes.hpp"

#include <cmath>

namespace aerogram::exporter {
namespace {

constexpr double kFarthest = 1e6;
constexpr std::size_t kDeepest = 64;

double number(const JsonNode& list, std::size_t k) {
    return list.at(k).number(-kFarthest, kFarthest);
}

Affine from_matrix(const JsonNode& m) {
    if (m.size() != 16) m.fail("must be 16 numbers");
    Affine a;
    for (std::size_t c = 0; c < 3; ++c) a.columns[c] = {number(m, 4 * c), number(m, 4 * c + 1), number(m, 4 * c + 2)};
    a.shift = {number(m, 12), number(m, 13), number(m, 14)};
    return a;
}

/// A unit quaternion's turn. @param q  x, y, z, w.
std::array<Vec3, 3> turn(const JsonNode& q) {
    const double x = number(q, 0), y = number(q, 1), z = number(q, 2), w = number(q, 3);
    const double n = x * x + y * y + z * z + w * w;
    if (std::abs(n - 1.0) > 1e-2) q.fail("must have length 1");
    const double s = n > 0.0 ? 2.0 / n : 0.0;
    return {Vec3{1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)},
            Vec3{s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)},
            Vec3{s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)}};
}

}  // namespace

GlbNodes::GlbNodes(const JsonNode& root) : root_(root), list_(root["nodes"]) {
    parents_.assign(list_.size(), kNone);
    for (std::size_t n = 0; n < parents_.size() && !root.problem().found(); ++n) {
        const auto children = list_.at(n).find("children");
        for (std::size_t k = 0; children && k < children->size() && !root.problem().found(); ++k) {
            const auto child =
                static_cast<std::size_t>(children->at(k).whole(0, static_cast<std::int64_t>(size()) - 1));
            if (root.problem().found()) return;
            if (parents_[child] != kNone) children->at(k).fail("has two parents");
            parents_[child] = n;
        }
    }
}

Affine GlbNodes::own(std::size_t n) const {
    const JsonNode node = list_.at(n);
    if (const auto matrix = node.find("matrix")) return from_matrix(*matrix);
    Affine a;
    if (const auto q = node.find("rotation")) a.columns = turn(*q);
    if (const auto s = node.find("scale"))
        for (std::size_t c = 0; c < 3; ++c) a.columns[c] *= number(*s, c);
    if (const auto t = node.find("translation")) a.shift = t->point(kFarthest);
    return a;
}

Affine GlbNodes::above(std::size_t node, const std::vector<bool>& moves) const {
    Affine whole;
    std::size_t depth = 0;
    for (std::size_t n = parents_[node]; n != kNone && !root_.problem().found(); n = parents_[n]) {
        if (++depth > kDeepest) list_.at(node).fail("stands below more than 64 others, or in a circle");
        if (moves[n]) list_.at(node).fail("stands below a node that moves");
        const Affine parent = own(n);
        for (Vec3& column : whole.columns) column = parent.turned(column);
        whole.shift = parent(whole.shift);
    }
    return whole;
}

}  // namespace aerogram::exporter
