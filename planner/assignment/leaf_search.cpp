#include "planner/assignment/leaf_search.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "geo/vectorized.hpp"

// The loops are written once, with the compiler's vector types, and compiled for each processor as part of the two
// functions at the end; the same operations in the same order give the same bits on all.

namespace aerogram::planner {
namespace {

#define AEROGRAM_INLINE inline __attribute__((always_inline))

using Doubles = double __attribute__((vector_size(32)));
using Floats = float __attribute__((vector_size(32)));
using Integers = std::int64_t __attribute__((vector_size(32)));

constexpr std::size_t kLeafSize = PriceLeaves::kLeafSize;
constexpr std::size_t kLanes = 4;
constexpr double kWorst = -std::numeric_limits<double>::infinity();
using Values = std::array<Doubles, kLeafSize / kLanes>;

AEROGRAM_INLINE void load(const std::vector<double>& from, std::size_t k, Doubles& to) {
    __builtin_memcpy(&to, from.data() + k, sizeof to);
}
AEROGRAM_INLINE void load(const std::vector<float>& from, std::size_t k, Floats& to) {
    __builtin_memcpy(&to, from.data() + k, sizeof to);
}

/// Values of one leaf's targets.
AEROGRAM_INLINE void evaluate(const PriceLeaves::Tables& t, std::size_t begin, const Vec3& x, Values& values) {
    const Doubles x2 = Doubles{} + 2.0 * x.x, y2 = Doubles{} + 2.0 * x.y, z2 = Doubles{} + 2.0 * x.z;
    for (std::size_t k = 0; k < values.size(); ++k) {
        Doubles ax, ay, az, price;
        load(t.at.x, begin + kLanes * k, ax);
        load(t.at.y, begin + kLanes * k, ay);
        load(t.at.z, begin + kLanes * k, az);
        load(t.price, begin + kLanes * k, price);
        values[k] = x2 * ax + y2 * ay + z2 * az - price;
    }
}

/// Those not allowed are worth nothing.
AEROGRAM_INLINE void strike(const PriceLeaves::Tables& t, std::size_t begin, const Vec3& x, const BidderLimits& limits,
                            Values& values) {
    for (std::size_t k = 0; k < values.size(); ++k) {
        Doubles ax, ay, az;
        load(t.at.x, begin + kLanes * k, ax);
        load(t.at.y, begin + kLanes * k, ay);
        load(t.at.z, begin + kLanes * k, az);
        const Doubles dx = x.x - ax, dy = x.y - ay, dz = (x.z - az) * limits.downwash;
        values[k] = dx * dx + dy * dy + dz * dz <= limits.reach2_m2 ? values[k] : Doubles{} + kWorst;
    }
    for (auto f = std::lower_bound(limits.forbidden.begin(), limits.forbidden.end(), begin);
         f != limits.forbidden.end() && *f < begin + kLeafSize; ++f)
        values[(*f - begin) / kLanes][(*f - begin) % kLanes] = kWorst;
}

/// Takes the values into the offer.
AEROGRAM_INLINE void consider(const Values& values, std::size_t begin, PriceLeaves::Offer& offer) {
    Doubles first = Doubles{} + kWorst, second = first;
    for (const Doubles& v : values) {
        const Doubles low = first < v ? first : v;
        first = first < v ? v : first;
        second = second < low ? low : second;
    }
    double best = first[0], next = second[0];
    for (std::size_t l = 1; l < kLanes; ++l) {
        next = std::max(next, std::max(std::min(best, first[l]), second[l]));
        best = std::max(best, first[l]);
    }
    if (best <= offer.second) return;
    if (best <= offer.value) {
        offer.second = best;
        return;
    }
    offer.second = std::max(offer.value, next);
    offer.value = best;
    std::size_t k = 0;
    while (values[k / kLanes][k % kLanes] != best) ++k;
    offer.place = static_cast<std::uint32_t>(begin + k);
}

/// Bounds of the leaves [block, block + 8).
AEROGRAM_INLINE void bound(const PriceLeaves::Tables& t, std::size_t block, const Vec3& x, Floats& bounds) {
    const auto along = [&](double component, const std::vector<float>& m, const std::vector<float>& h,
                           const std::vector<float>& g, Floats& sum) __attribute__((always_inline)) {
        const Floats twice = Floats{} + static_cast<float>(2.0 * component);
        Floats center, half, slope;
        load(m, block, center);
        load(h, block, half);
        load(g, block, slope);
        const Floats d = twice - slope;
        sum += twice * center + (d < 0.0F ? -d : d) * half;
    };
    Floats offset;
    load(t.offset, block, offset);
    bounds = -offset;
    along(x.x, t.mx, t.hx, t.gx, bounds);
    along(x.y, t.my, t.hy, t.gy, bounds);
    along(x.z, t.mz, t.hz, t.gz, bounds);
}

template <class Scan>
AEROGRAM_INLINE void visit(const PriceLeaves::Tables& t, const Vec3& x, double rounding, std::size_t first,
                           PriceLeaves::Offer& offer, const Scan& scan) {
    scan(first);
    auto limit = static_cast<float>(offer.second - rounding);
    for (std::size_t block = 0; block < t.offset.size(); block += kSearchLanes) {
        Floats bounds;
        bound(t, block, x, bounds);
        const auto above = reinterpret_cast<Integers>(bounds > limit);
        if (((above[0] | above[1]) | (above[2] | above[3])) == 0) continue;
        for (std::size_t l = 0; l < kSearchLanes; ++l) {
            if (!(bounds[l] > limit) || block + l == first) continue;
            scan(block + l);
            limit = static_cast<float>(offer.second - rounding);
        }
    }
}

}  // namespace

AEROGRAM_VECTORIZED void search(const PriceLeaves::Tables& tables, const Vec3& x, double rounding, std::size_t first,
                                PriceLeaves::Offer& offer) {
    visit(
        tables, x, rounding, first, offer, [&](std::size_t leaf) __attribute__((always_inline)) {
            Values values;
            evaluate(tables, leaf * kLeafSize, x, values);
            consider(values, leaf * kLeafSize, offer);
        });
}

AEROGRAM_VECTORIZED void search_allowed(const PriceLeaves::Tables& tables, const Vec3& x, double rounding,
                                        std::size_t first, const BidderLimits& limits, PriceLeaves::Offer& offer) {
    visit(
        tables, x, rounding, first, offer, [&](std::size_t leaf) __attribute__((always_inline)) {
            Values values;
            evaluate(tables, leaf * kLeafSize, x, values);
            strike(tables, leaf * kLeafSize, x, limits, values);
            consider(values, leaf * kLeafSize, offer);
        });
}

}  // namespace aerogram::planner
