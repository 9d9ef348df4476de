#include "planner/separation/fleet_curves.hpp"

#include <algorithm>
#include <cstring>

#include "geo/contract.hpp"
#include "geo/vectorized.hpp"
#include "planner/motion/lanes.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kVector = 4;  ///< doubles side by side
static_assert(sizeof(Lanes) == kVector * sizeof(double));

std::size_t padded(std::size_t count) {
    return (count + kVector) / kVector * kVector;  // at least one place more
}

/// Every third bit of the result carries one of the ten bits of v.
std::uint32_t every_third(std::uint32_t v) {
    std::uint32_t spread = 0;
    for (std::uint32_t bit = 0; bit < 10; ++bit) spread |= ((v >> bit) & 1U) << (3 * bit);
    return spread;
}

AEROGRAM_VECTORIZED
void weigh(const double* rows, double w0, double w1, double w2, double w3, std::size_t count, double* out) {
    for (std::size_t m = 0; m < count; ++m) {
        out[m] = (w0 * rows[m] + w1 * rows[m + 1]) + (w2 * rows[m + 2] + w3 * rows[m + 3]);
    }
}

AEROGRAM_VECTORIZED
void add_times(const double* __restrict from, double factor, std::size_t count, double* __restrict to) {
    for (std::size_t m = 0; m < count; ++m) to[m] += factor * from[m];
}

}  // namespace

std::vector<std::uint32_t> neighbourly_order(const Lattice& lattice) {
    const std::size_t n = lattice.drones, middle = lattice.rows() / 2;
    Vec3 low = lattice.at(middle, 0), high = low;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3& p = lattice.at(middle, i);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-9});
    const auto bits = [&](double v) { return every_third(static_cast<std::uint32_t>(1023.0 * v / extent)); };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 p = lattice.at(middle, i) - low;
        keyed[i] = {bits(p.x) | bits(p.y) << 1 | bits(p.z) << 2, static_cast<std::uint32_t>(i)};
    }
    std::sort(keyed.begin(), keyed.end());
    std::vector<std::uint32_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = keyed[i].second;
    return order;
}

ControlCurves curves_of(const Lattice& lattice, const std::vector<std::uint32_t>& order) {
    const std::size_t n = lattice.drones, rows = lattice.rows();
    ControlCurves curves{n, rows, padded(rows), {}};
    curves.values.assign(3 * n * curves.stride, 0.0);
    constexpr std::size_t kBlock = 16;
    for (std::size_t first = 0; first < n; first += kBlock) {
        for (std::size_t k = 0; k < rows; ++k) {
            for (std::size_t i = first; i < std::min(n, first + kBlock); ++i) {
                const Vec3& p = lattice.at(k, order[i]);
                for (std::size_t a = 0; a < 3; ++a) curves.axis(i, a)[k] = p[static_cast<int>(a)];
            }
        }
    }
    return curves;
}

Lattice lattice_of(const ControlCurves& curves, const std::vector<std::uint32_t>& order) {
    Lattice lattice{curves.drones, Points(curves.drones * curves.rows)};
    constexpr std::size_t kBlock = 16;
    for (std::size_t first = 0; first < curves.drones; first += kBlock) {
        for (std::size_t k = 0; k < curves.rows; ++k) {
            for (std::size_t i = first; i < std::min(curves.drones, first + kBlock); ++i) {
                lattice.at(k, order[i]) = curves.at(k, i);
            }
        }
    }
    return lattice;
}

Sampling::Sampling(std::size_t rows, std::size_t per_interval)
    : rows_(rows), per_(per_interval), stride_(padded(rows - 2)) {
    AEROGRAM_REQUIRE(rows >= 7 && per_interval >= 1, rows, per_interval);
    for (std::size_t q = 0; q < per_; ++q) {
        const double u = static_cast<double>(q) / static_cast<double>(per_), v = 1.0 - u;
        weight_.push_back({v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
                           (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0, u * u * u / 6.0});
    }
}

void Sampling::evaluate(const double* rows, double scale, double* samples) const {
    for (std::size_t q = 0; q < per_; ++q) {
        const auto& w = weight_[q];
        const std::size_t count = intervals() + (q == 0 ? 1 : 0);
        weigh(rows, scale * w[0], scale * w[1], scale * w[2], scale * w[3], count, samples + q * stride_);
    }
}

void Sampling::spread_back(double* samples, double share, double* rows) const {
    for (std::size_t q = 0; q < per_; ++q) {
        const std::size_t count = intervals() + (q == 0 ? 1 : 0);
        for (std::size_t t = 0; t < (q == 0 ? 3U : 4U); ++t) {
            add_times(samples + q * stride_, share * weight_[q][t], count, rows + t);
        }
    }
    std::fill_n(samples, axis_stride(), 0.0);
}

AEROGRAM_VECTORIZED
void closest_approaches(const double* i, const double* j, std::size_t axis_stride, std::size_t before,
                        std::size_t after, std::size_t count, double* squared, double* share) {
    const Lanes zero{}, one = zero + 1.0;
    for (std::size_t m = 0; m < count; m += kVector) {
        Lanes b[3], w[3];
        for (std::size_t a = 0; a < 3; ++a) {
            Lanes ib, jb, ia, ja;
            load(i + a * axis_stride + before + m, ib);
            load(j + a * axis_stride + before + m, jb);
            load(i + a * axis_stride + after + m, ia);
            load(j + a * axis_stride + after + m, ja);
            b[a] = jb - ib;
            w[a] = (ja - ia) - b[a];
        }
        const Lanes way = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) + 1e-300;
        Lanes where = -(b[0] * w[0] + b[1] * w[1] + b[2] * w[2]) / way;
        where = where > zero ? where : zero;
        where = where < one ? where : one;
        const Lanes nx = b[0] + where * w[0], ny = b[1] + where * w[1], nz = b[2] + where * w[2];
        const Lanes apart = nx * nx + ny * ny + nz * nz;
        std::memcpy(squared + m, &apart, sizeof(Lanes));
        std::memcpy(share + m, &where, sizeof(Lanes));
    }
}

AEROGRAM_VECTORIZED
double smallest(const double* values, std::size_t count) {
    const Lanes first = Lanes{} + values[0];
    Lanes least = first;
    std::size_t m = 0;
    for (; m + kVector <= count; m += kVector) {
        Lanes here;
        load(values + m, here);
        least = here < least ? here : least;
    }
    double result = std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
    for (; m < count; ++m) result = std::min(result, values[m]);
    return result;
}

AEROGRAM_VECTORIZED
void squared_steps(const double* before, const double* after, std::size_t axis_stride, std::size_t count,
                   double* squared) {
    for (std::size_t m = 0; m < count; ++m) {
        const double x = after[m] - before[m], y = after[m + axis_stride] - before[m + axis_stride],
                     z = after[m + 2 * axis_stride] - before[m + 2 * axis_stride];
        squared[m] = x * x + y * y + z * z;
    }
}

}  // namespace aerogram::planner
