#include "planner/assignment/price_leaves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/assignment/leaf_search.hpp"

namespace aerogram::planner {
namespace {

constexpr std::uint32_t kLeafSize = PriceLeaves::kLeafSize;
constexpr std::uint32_t kChangesPerFit = 64;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Above the rounding of a bound in single precision (some ten operations), relative to the sum of its terms' sizes.
constexpr double kBoundRounding = 1e-6;

/// Solves the symmetric positive definite 3x3 system s g = b.
Vec3 solved(const std::array<double, 6>& s, const Vec3& b) {
    const auto [xx, xy, xz, yy, yz, zz] = s;
    const double a = yy * zz - yz * yz, c = xz * yz - xy * zz, e = xy * yz - xz * yy;
    const double determinant = xx * a + xy * c + xz * e;
    return Vec3{a * b.x + c * b.y + e * b.z, c * b.x + (xx * zz - xz * xz) * b.y + (xy * xz - xx * yz) * b.z,
                e * b.x + (xy * xz - xx * yz) * b.y + (xx * yy - xy * xy) * b.z} /
           determinant;
}

/// The slope of the least-squares plane through the prices of places [begin, end).
Vec3 slope_of(const Coordinates& at, const std::vector<double>& price, std::size_t begin, std::size_t end) {
    const auto n = static_cast<double>(end - begin);
    Vec3 mean{};
    double mean_price = 0.0;
    for (std::size_t k = begin; k < end; ++k) {
        mean += at[k];
        mean_price += price[k];
    }
    mean /= n;
    mean_price /= n;
    std::array<double, 6> s{};
    Vec3 b{};
    for (std::size_t k = begin; k < end; ++k) {
        const Vec3 d = at[k] - mean;
        const std::array<double, 6> products{d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z};
        for (std::size_t e = 0; e < 6; ++e) s[e] += products[e];
        b += d * (price[k] - mean_price);
    }
    // Leaves of flat formations say nothing of the slope across them: any will do, so none.
    const double ridge = 1e-6 * (s[0] + s[3] + s[5]) + std::numeric_limits<double>::min();
    for (const std::size_t e : {0U, 3U, 5U}) s[e] += ridge;
    const Vec3 slope = solved(s, b);
    return is_finite(slope) ? slope : Vec3{};
}

}  // namespace

PriceLeaves::PriceLeaves(const Coordinates& targets, std::span<const double> price, const Vec3& weight)
    : order_(kd_order(targets, kLeafSize, weight)), place_(targets.size()) {
    const std::size_t leaves = (targets.size() + kLeafSize - 1) / kLeafSize;
    Tables& t = tables_;
    t.at = Coordinates(leaves * kLeafSize);
    t.price.assign(leaves * kLeafSize, kInfinity);
    for (std::size_t k = 0; k < order_.size(); ++k) {
        t.at.set(k, targets[order_[k]]);
        t.price[k] = price.empty() ? glm::dot(t.at[k], t.at[k]) : price[order_[k]];
        place_[order_[k]] = static_cast<std::uint32_t>(k);
    }
    changes_.resize(leaves);
    const std::size_t filled = (leaves + kSearchLanes - 1) / kSearchLanes * kSearchLanes;
    for (auto* floats : {&t.mx, &t.my, &t.mz, &t.hx, &t.hy, &t.hz, &t.gx, &t.gy, &t.gz}) floats->assign(filled, 0.0F);
    t.offset.assign(filled, std::numeric_limits<float>::infinity());
    for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
        const std::size_t begin = leaf * kLeafSize;
        const Box box = box_of(targets, order_, begin, std::min(begin + kLeafSize, order_.size()));
        const Vec3 m = box.center(), h = box.half();
        t.mx[leaf] = static_cast<float>(m.x);
        t.my[leaf] = static_cast<float>(m.y);
        t.mz[leaf] = static_cast<float>(m.z);
        t.hx[leaf] = static_cast<float>(h.x);
        t.hy[leaf] = static_cast<float>(h.y);
        t.hz[leaf] = static_cast<float>(h.z);
        reach_ = std::max(reach_, glm::length(m) + glm::length(h));
        fit(leaf);
    }
}

void PriceLeaves::fit(std::size_t leaf) {
    Tables& t = tables_;
    const std::size_t begin = leaf * kLeafSize, end = std::min(begin + kLeafSize, order_.size());
    const Vec3 g = slope_of(t.at, t.price, begin, end);
    double least = kInfinity;
    for (std::size_t k = begin; k < end; ++k) least = std::min(least, t.price[k] - glm::dot(g, t.at[k]));
    const Vec3 m{t.mx[leaf], t.my[leaf], t.mz[leaf]};
    const double offset = glm::dot(g, m) + least;
    t.gx[leaf] = static_cast<float>(g.x);
    t.gy[leaf] = static_cast<float>(g.y);
    t.gz[leaf] = static_cast<float>(g.z);
    t.offset[leaf] = static_cast<float>(offset);
    scale_ = std::max(scale_, std::abs(offset) + glm::length(g) * reach_);
    changes_[leaf] = 0;
}

double PriceLeaves::rounding(const Vec3& x) const {
    return kBoundRounding * (4.0 * glm::length(x) * reach_ + scale_);
}

PriceLeaves::Offer PriceLeaves::best(const Vec3& x, std::uint32_t start) const {
    Offer offer{start, -kInfinity, -kInfinity};
    search(tables_, x, rounding(x), start / kLeafSize, offer);
    return offer;
}

PriceLeaves::Offer PriceLeaves::best(const Vec3& x, std::uint32_t start, std::uint32_t bidder,
                                     const Allowed& allowed) const {
    if (allowed.everything()) return best(x, start);
    std::vector<std::uint32_t> forbidden;
    for (const std::uint32_t target : allowed.forbidden_to(bidder)) forbidden.push_back(place_[target]);
    std::sort(forbidden.begin(), forbidden.end());
    Offer offer{start, -kInfinity, -kInfinity};
    search_allowed(tables_, x, rounding(x), start / kLeafSize, {forbidden, allowed.reach2_m2, allowed.downwash}, offer);
    return offer;
}

void PriceLeaves::raise(std::uint32_t place, double price) {
    tables_.price[place] = price;
    const std::uint32_t leaf = place / kLeafSize;
    if (++changes_[leaf] >= kChangesPerFit) fit(leaf);
}

}  // namespace aerogram::planner
