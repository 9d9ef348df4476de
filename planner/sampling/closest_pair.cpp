#include "planner/sampling/closest_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

/// A pair of points; of equally distant pairs the one with the lowest numbers is the closest.
struct Pair {
    double squared = 0.0;
    std::size_t first = 0, second = 0;
    bool operator<(const Pair& other) const {
        return std::tie(squared, first, second) < std::tie(other.squared, other.first, other.second);
    }
};

struct Cell {
    std::int64_t x = 0, y = 0, z = 0;
    bool operator==(const Cell&) const = default;
};

std::uint64_t mixed(std::uint64_t v) {  // splitmix64's output function
    v += 0x9E3779B97F4A7C15U;
    v = (v ^ (v >> 30U)) * 0xBF58476D1CE4E5B9U;
    v = (v ^ (v >> 27U)) * 0x94D049BB133111EBU;
    return v ^ (v >> 31U);
}

struct CellHash {
    std::size_t operator()(const Cell& c) const {
        return mixed(mixed(mixed(static_cast<std::uint64_t>(c.x)) + static_cast<std::uint64_t>(c.y)) +
                     static_cast<std::uint64_t>(c.z));
    }
};

/// Points are added one by one in a shuffled order. Cells are as wide as the smallest distance so far, so each holds
/// few points, and a closer pair, which is found ever more rarely, rebuilds them: O(n) expected, whatever the points.
class Search {
  public:
    Search(const Points& points_m, const SeparationMetric& metric) : points_(points_m), metric_(metric) {
        low_ = high_ = metric.scaled(points_m.front());
        for (const Vec3& p : points_m) {
            low_ = glm::min(low_, metric.scaled(p));
            high_ = glm::max(high_, metric.scaled(p));
        }
        order_.resize(points_m.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        for (std::size_t i = order_.size() - 1; i > 0; --i) std::swap(order_[i], order_[mixed(i) % (i + 1)]);
    }

    Pair run() {
        next_.assign(points_.size(), kNone);
        best_ = pair(order_[0], order_[1]);
        rebuild(1);
        for (std::size_t done = 1; done < order_.size(); ++done) {
            const Pair nearest = nearest_pair(order_[done]);
            const bool closer = nearest.squared < best_.squared;
            best_ = std::min(best_, nearest);
            if (closer) {
                rebuild(done + 1);
            } else {
                insert(order_[done]);
            }
        }
        return best_;
    }

  private:
    Pair pair(std::size_t i, std::size_t j) const {
        const Vec3 d = metric_.scaled(points_[j] - points_[i]);
        return {glm::dot(d, d), std::min(i, j), std::max(i, j)};
    }

    Cell cell_of(const Vec3& p) const {
        const Vec3 c = (metric_.scaled(p) - low_) / cell_;
        return {static_cast<std::int64_t>(c.x), static_cast<std::int64_t>(c.y), static_cast<std::int64_t>(c.z)};
    }

    void insert(std::size_t i) {
        const auto [place, fresh] = heads_.try_emplace(cell_of(points_[i]), i);
        next_[i] = fresh ? kNone : std::exchange(place->second, i);
    }

    void rebuild(std::size_t count) {
        const double extent = glm::length(high_ - low_);
        // Slightly wider than the distance, so that rounding puts no pair of that distance two cells apart.
        cell_ = std::max(std::sqrt(best_.squared) * (1.0 + 1e-9), extent * 1e-12);
        if (cell_ <= 0.0) cell_ = 1.0;
        heads_.clear();
        for (std::size_t k = 0; k < count; ++k) insert(order_[k]);
    }

    Pair nearest_pair(std::size_t i) const {
        Pair nearest = best_;
        const Cell c = cell_of(points_[i]);
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            for (std::int64_t dy = -1; dy <= 1; ++dy) {
                for (std::int64_t dz = -1; dz <= 1; ++dz) {
                    const auto head = heads_.find({c.x + dx, c.y + dy, c.z + dz});
                    for (std::size_t j = head == heads_.end() ? kNone : head->second; j != kNone; j = next_[j]) {
                        nearest = std::min(nearest, pair(i, j));
                    }
                }
            }
        }
        return nearest;
    }

    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    const Points& points_;
    SeparationMetric metric_;
    Vec3 low_{}, high_{};
    std::vector<std::size_t> order_;
    std::vector<std::size_t> next_;  ///< of the same cell
    std::unordered_map<Cell, std::size_t, CellHash> heads_;
    double cell_ = 1.0;
    Pair best_;
};

}  // namespace

ClosestPair closest_pair(const Points& points_m, const SeparationMetric& metric) {
    AEROGRAM_REQUIRE(points_m.size() >= 2, points_m.size());
    AEROGRAM_REQUIRE(std::all_of(points_m.begin(), points_m.end(), is_finite));
    const auto [squared, first, second] = Search(points_m, metric).run();
    return {first, second, metric.distance(points_m[first], points_m[second])};
}

}  // namespace aerogram::planner
