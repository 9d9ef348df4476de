#include <algorithm>
#include <array>
#include <cmath>

#include "geo/vectorized.hpp"
#include "planner/assignment/crossing.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kBlock = Flights::kBlock;

double size_of(const Coordinates& c) {
    return c.size() == 0 ? 0.0 : 2.0 * radius_of(c);
}

/// One component of the difference of two points, each in a box.
struct Interval {
    double low, high;
};
Interval difference(double low_a, double high_a, double low_b, double high_b) {
    return {low_a - high_b, high_a - low_b};
}
double least_product(const Interval& a, const Interval& b) {
    return std::min(std::min(a.low * b.low, a.low * b.high), std::min(a.high * b.low, a.high * b.high));
}

struct Row {
    const double *ax, *ay, *az, *bx, *by, *bz;
};

/// The smallest product of a place with kBlock others.
AEROGRAM_VECTORIZED double least_of_block(const Row& row, const Vec3& a, const Vec3& b) {
    std::array<double, 4> least{};
    for (std::size_t l = 0; l < 4; ++l) least[l] = HUGE_VAL;
    for (std::size_t k = 0; k < kBlock; k += 4)
        for (std::size_t l = 0; l < 4; ++l) {
            const std::size_t q = k + l;
            const double product = (a.x - row.ax[q]) * (b.x - row.bx[q]) + (a.y - row.ay[q]) * (b.y - row.by[q]) +
                                   (a.z - row.az[q]) * (b.z - row.bz[q]);
            least[l] = product < least[l] ? product : least[l];
        }
    return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

}  // namespace

Flights::Flights(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::span<const SlotId> slot_of,
                 const SeparationMetric& metric)
    : from_(slot_of.size()), to_(slot_of.size()) {
    const Coordinates drones = centred(from_m, metric), slots = centred(to_m, metric);
    order_ = kd_order(drones, kBlock);
    for (std::size_t p = 0; p < order_.size(); ++p) {
        from_.set(p, drones[order_[p]]);
        to_.set(p, slots[slot_of[order_[p]].value]);
    }
    tolerance_m2_ = kCrossingTolerance * size_of(drones) * size_of(slots);
    box_.resize((size() + kBlock - 1) / kBlock);
    for (std::size_t block = 0; block < box_.size(); ++block) box_again(block);
}

void Flights::box_again(std::size_t block) {
    const std::size_t begin = block * kBlock, end = std::min(begin + kBlock, size());
    Boxes boxes{{from_[begin], from_[begin]}, {to_[begin], to_[begin]}};
    for (std::size_t p = begin; p < end; ++p) {
        boxes.from = {glm::min(boxes.from.low, from_[p]), glm::max(boxes.from.high, from_[p])};
        boxes.to = {glm::min(boxes.to.low, to_[p]), glm::max(boxes.to.high, to_[p])};
    }
    box_[block] = boxes;
}

bool Flights::may_be_below(std::size_t a, std::size_t b, double limit_m2) const {
    const Box &from_a = box_[a].from, &from_b = box_[b].from, &to_a = box_[a].to, &to_b = box_[b].to;
    // Component by component, which is sharp for maps along the axes.
    double by_axis = 0.0;
    for (int k = 0; k < 3; ++k)
        by_axis += least_product(difference(from_a.low[k], from_a.high[k], from_b.low[k], from_b.high[k]),
                                 difference(to_a.low[k], to_a.high[k], to_b.low[k], to_b.high[k]));
    // Between balls around the boxes, which is sharp for turned ones.
    const Vec3 from = from_a.center() - from_b.center(), to = to_a.center() - to_b.center();
    const double from_r = glm::length(from_a.half()) + glm::length(from_b.half()), from_d = glm::length(from);
    const double to_r = glm::length(to_a.half()) + glm::length(to_b.half()), to_d = glm::length(to);
    const double by_ball = glm::dot(from, to) - from_d * to_r - to_d * from_r - from_r * to_r;
    const double rounding = 1e-14 * (from_d + from_r) * (to_d + to_r);
    return std::max(by_axis, by_ball) - rounding < limit_m2;
}

double Flights::product_m2(std::size_t p, std::size_t q) const {
    return (from_.x[p] - from_.x[q]) * (to_.x[p] - to_.x[q]) + (from_.y[p] - from_.y[q]) * (to_.y[p] - to_.y[q]) +
           (from_.z[p] - from_.z[q]) * (to_.z[p] - to_.z[q]);
}

std::size_t Flights::first_below(std::size_t p, std::size_t begin, std::size_t end, double limit_m2) const {
    if (end - begin == kBlock) {
        const Row row{from_.x.data() + begin, from_.y.data() + begin, from_.z.data() + begin,
                      to_.x.data() + begin,   to_.y.data() + begin,   to_.z.data() + begin};
        if (!(least_of_block(row, from_[p], to_[p]) < limit_m2)) return end;
    }
    for (std::size_t q = begin; q < end; ++q)
        if (product_m2(p, q) < limit_m2) return q;
    return end;
}

void Flights::swap_targets(std::size_t p, std::size_t q) {
    const Vec3 to = to_[p];
    to_.set(p, to_[q]);
    to_.set(q, to);
}

}  // namespace aerogram::planner
