#include "planner/assignment/price_leaves.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace aerogram::planner {
namespace {

constexpr std::uint32_t kLeafSize = 32;
constexpr std::uint32_t kChangesPerFit = 64;

/// Solves the symmetric positive definite 3x3 system s g = b.
Vec3 solved(const std::array<double, 6>& s, const Vec3& b) {
    const auto [xx, xy, xz, yy, yz, zz] = s;
    const double a = yy * zz - yz * yz, c = xz * yz - xy * zz, e = xy * yz - xz * yy;
    const double determinant = xx * a + xy * c + xz * e;
    return Vec3{a * b.x + c * b.y + e * b.z, c * b.x + (xx * zz - xz * xz) * b.y + (xy * xz - xx * yz) * b.z,
                e * b.x + (xy * xz - xx * yz) * b.y + (xx * yy - xy * xy) * b.z} /
           determinant;
}

struct Box {
    Vec3 low{}, high{};
};
Box box_of(const Coordinates& points, const std::uint32_t* begin, const std::uint32_t* end) {
    Box box{points[*begin], points[*begin]};
    for (const std::uint32_t* i = begin; i != end; ++i) {
        box.low = glm::min(box.low, points[*i]);
        box.high = glm::max(box.high, points[*i]);
    }
    return box;
}

/// Parts order[begin, end) at the median of its box's longest side; returns the middle.
std::uint32_t halve(const Coordinates& points, std::vector<std::uint32_t>& order, std::uint32_t begin,
                    std::uint32_t end) {
    const Box box = box_of(points, order.data() + begin, order.data() + end);
    const Vec3 size = box.high - box.low;
    const std::vector<double>& along = size.x >= size.y && size.x >= size.z ? points.x
                                       : size.y >= size.z                   ? points.y
                                                                            : points.z;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return std::pair(along[a], a) < std::pair(along[b], b); });
    return middle;
}

void sort_kd(const Coordinates& points, std::vector<std::uint32_t>& order, std::uint32_t begin, std::uint32_t end) {
    if (end - begin < 2) return;
    const std::uint32_t middle = halve(points, order, begin, end);
    sort_kd(points, order, begin, middle);
    sort_kd(points, order, middle, end);
}

}  // namespace

std::vector<std::uint32_t> kd_order(const Coordinates& points) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    sort_kd(points, order, 0, static_cast<std::uint32_t>(order.size()));
    return order;
}

PriceLeaves::PriceLeaves(const Coordinates& targets)
    : order_(targets.size()), at_(targets.size()), price_(targets.size()), leaf_of_(targets.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    split(targets, 0, static_cast<std::uint32_t>(order_.size()));
    for (std::size_t k = 0; k < order_.size(); ++k) {
        at_.set(k, targets[order_[k]]);
        price_[k] = glm::dot(at_[k], at_[k]);
    }
    center_ = half_ = slope_ = Coordinates(leaves_.size());
    offset_.resize(leaves_.size());
    for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
        const Box box = box_of(targets, order_.data() + leaves_[leaf].begin, order_.data() + leaves_[leaf].end);
        center_.set(leaf, (box.low + box.high) / 2.0);
        // A hair wider than the box, so that rounding cannot make the bound fall short of a value.
        half_.set(leaf, (box.high - box.low) * (0.5 + 1e-12));
        fit(leaf);
    }
}

void PriceLeaves::split(const Coordinates& targets, std::uint32_t begin, std::uint32_t end) {
    if (end - begin > kLeafSize) {
        const std::uint32_t middle = halve(targets, order_, begin, end);
        split(targets, begin, middle);
        split(targets, middle, end);
        return;
    }
    for (std::uint32_t k = begin; k < end; ++k) leaf_of_[k] = static_cast<std::uint32_t>(leaves_.size());
    leaves_.push_back({begin, end, 0});
}

void PriceLeaves::fit(std::size_t leaf) {
    const auto [begin, end, changes] = leaves_[leaf];
    const double n = end - begin;
    Vec3 mean{};
    double mean_price = 0.0;
    for (std::uint32_t k = begin; k < end; ++k) {
        mean += at_[k] / n;
        mean_price += price_[k] / n;
    }
    std::array<double, 6> s{};
    Vec3 b{};
    for (std::uint32_t k = begin; k < end; ++k) {
        const Vec3 d = at_[k] - mean;
        const std::array<double, 6> products{d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z};
        for (std::size_t e = 0; e < 6; ++e) s[e] += products[e];
        b += d * (price_[k] - mean_price);
    }
    // Leaves of flat formations say nothing of the slope across them: any will do, so none.
    const double ridge = 1e-6 * (s[0] + s[3] + s[5]) + std::numeric_limits<double>::min();
    for (const std::size_t e : {0U, 3U, 5U}) s[e] += ridge;
    Vec3 g = solved(s, b);
    if (!is_finite(g)) g = Vec3{};
    double least = std::numeric_limits<double>::infinity(), scale = 0.0;
    for (std::uint32_t k = begin; k < end; ++k) {
        least = std::min(least, price_[k] - glm::dot(g, at_[k]));
        scale = std::max(scale, std::abs(price_[k]) + glm::length(g) * glm::length(at_[k]));
    }
    slope_.set(leaf, g);
    offset_[leaf] = least - 1e-14 * scale;
    leaves_[leaf].changes = 0;
}

void PriceLeaves::scan(std::size_t leaf, const Vec3& x, Offer& offer) const {
    const auto [begin, end, changes] = leaves_[leaf];
    std::array<double, kLeafSize> value{};
    for (std::uint32_t k = begin; k < end; ++k)
        value[k - begin] = 2.0 * (x.x * at_.x[k] + x.y * at_.y[k] + x.z * at_.z[k]) - price_[k];
    for (std::uint32_t k = begin; k < end; ++k) {
        const double v = value[k - begin];
        if (v <= offer.second) continue;
        if (v > offer.value) {
            offer = {k, v, offer.value};
        } else {
            offer.second = v;
        }
    }
}

PriceLeaves::Offer PriceLeaves::best(const Vec3& x, std::uint32_t start) const {
    constexpr double kWorst = -std::numeric_limits<double>::infinity();
    constexpr std::size_t kBlock = 64;
    Offer offer{start, kWorst, kWorst};
    const std::size_t first = leaf_of_[start];
    scan(first, x, offer);
    std::array<double, kBlock> bound{};
    for (std::size_t from = 0; from < leaves_.size(); from += kBlock) {
        const std::size_t count = std::min(kBlock, leaves_.size() - from);
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t leaf = from + k;
            const double dx = 2.0 * x.x - slope_.x[leaf], dy = 2.0 * x.y - slope_.y[leaf],
                         dz = 2.0 * x.z - slope_.z[leaf];
            bound[k] = dx * center_.x[leaf] + std::abs(dx) * half_.x[leaf] + dy * center_.y[leaf] +
                       std::abs(dy) * half_.y[leaf] + dz * center_.z[leaf] + std::abs(dz) * half_.z[leaf] -
                       offset_[leaf];
        }
        for (std::size_t k = 0; k < count; ++k)
            if (bound[k] > offer.second && from + k != first) scan(from + k, x, offer);
    }
    return offer;
}

void PriceLeaves::raise(std::uint32_t place, double price) {
    price_[place] = price;
    const std::uint32_t leaf = leaf_of_[place];
    if (++leaves_[leaf].changes >= kChangesPerFit) fit(leaf);
}

}  // namespace aerogram::planner
