#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "geo/contract.hpp"
#include "planner/assignment/matching.hpp"
#include "planner/assignment/price_leaves.hpp"

// Legend: value of target j to bidder i: v_ij = 2 x_i·y_j - price_j; worth u_i = max_j v_ij; slack_ij = u_i - v_ij >=
// 0. A matching on pairs without slack is optimal.

namespace aerogram::planner {
namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double value(const Vec3& x, const Coordinates& y, double price, std::size_t j) {
    return 2.0 * (x.x * y.x[j] + x.y * y.y[j] + x.z * y.z[j]) - price;
}

/// The smallest of values[from, end), four lanes at a time.
double smallest(const std::vector<double>& values, std::size_t from) {
    std::array<double, 4> lane{kInfinity, kInfinity, kInfinity, kInfinity};
    std::size_t k = from;
    for (; k + 4 <= values.size(); k += 4)
        for (std::size_t l = 0; l < 4; ++l) lane[l] = values[k + l] < lane[l] ? values[k + l] : lane[l];
    for (; k < values.size(); ++k) lane[0] = std::min(lane[0], values[k]);
    return std::min(std::min(lane[0], lane[1]), std::min(lane[2], lane[3]));
}

/// Targets in an order of their own: those already reached by the current search first.
class Augmenter {
  public:
    Augmenter(const Coordinates& bidders, const Coordinates& targets, std::vector<double> price, const Allowed& allowed)
        : allowed_(allowed),
          x_(bidders),
          y_(targets),
          price_(std::move(price)),
          id_(targets.size()),
          owner_(targets.size(), kNobody),
          distance_(targets.size()),
          from_(targets.size()),
          worth_(bidders.size()),
          target_of_(bidders.size(), kNobody),
          place_(targets.size()) {
        std::iota(id_.begin(), id_.end(), 0U);
        std::iota(place_.begin(), place_.end(), 0U);
    }

    /// Gives a bidder its wish when that has no slack, else its best target, if free.
    void start(std::uint32_t i, std::uint32_t wish) {
        double best = -kInfinity;
        std::uint32_t best_j = 0;
        for (std::uint32_t j = 0; j < y_.size(); ++j) {
            const double v = value(x_[i], y_, price_[j], j);
            if (v > best && allowed_(x_, y_, i, j)) {
                best = v;
                best_j = j;
            }
        }
        worth_[i] = best;
        if (wish != kNobody && allowed_(x_, y_, i, wish) && owner_[wish] == kNobody &&
            value(x_[i], y_, price_[wish], wish) == best)
            best_j = wish;
        if (owner_[best_j] != kNobody) return;
        owner_[best_j] = i;
        target_of_[i] = best_j;
    }
    [[nodiscard]] bool is_matched(std::uint32_t i) const { return target_of_[i] != kNobody; }

    /// One shortest augmenting path from a free bidder: one more pair, prices raised so that slack stays >= 0.
    void join(std::uint32_t bidder) {
        std::fill(distance_.begin(), distance_.end(), kInfinity);
        std::size_t reached = 0;
        double so_far = 0.0;
        for (std::uint32_t i = bidder; i != kNobody; i = owner_[reached++]) {
            relax(i, so_far, reached);
            so_far = smallest(distance_, reached);
            swap_places(nearest(so_far, reached), reached);
        }
        for (std::size_t k = 0; k < reached; ++k) {
            const double rise = so_far - distance_[k];
            price_[k] += rise;
            if (owner_[k] != kNobody) worth_[owner_[k]] -= rise;
        }
        worth_[bidder] -= so_far;
        for (std::uint32_t id = id_[reached - 1]; id != kNobody;) {
            const auto i = static_cast<std::uint32_t>(from_[place_[id]]);
            owner_[place_[id]] = i;
            std::swap(target_of_[i], id);
        }
    }

    [[nodiscard]] Matching result() const {
        Matching matching{target_of_, std::vector<double>(price_.size())};
        for (std::size_t k = 0; k < price_.size(); ++k) matching.price[id_[k]] = price_[k];
        return matching;
    }

  private:
    /// Ways from bidder i, whose own target is reached at so_far.
    void relax(std::uint32_t i, double so_far, std::size_t from) {
        if (!allowed_.everything()) {
            relax_allowed(i, so_far, from);
            return;
        }
        const double x = 2.0 * x_.x[i], y = 2.0 * x_.y[i], z = 2.0 * x_.z[i], base = so_far + worth_[i];
        const std::int64_t me = i;
        for (std::size_t k = from; k < y_.size(); ++k) {
            const double d = base - (x * y_.x[k] + y * y_.y[k] + z * y_.z[k]) + price_[k];
            const bool nearer = d < distance_[k];
            distance_[k] = nearer ? d : distance_[k];
            from_[k] = nearer ? me : from_[k];
        }
        // Rounding may put a pair without slack a hair below it.
        for (std::size_t k = from; k < y_.size(); ++k) distance_[k] = distance_[k] < so_far ? so_far : distance_[k];
    }

    void relax_allowed(std::uint32_t i, double so_far, std::size_t from) {
        const auto forbidden = allowed_.forbidden_to(i);
        for (std::size_t k = from; k < y_.size(); ++k) {
            if (allowed_.distance2_m2(x_[i], y_[k]) > allowed_.reach2_m2 ||
                std::binary_search(forbidden.begin(), forbidden.end(), id_[k]))
                continue;
            const double d = std::max(so_far, so_far + worth_[i] - value(x_[i], y_, price_[k], k));
            if (d >= distance_[k]) continue;
            distance_[k] = d;
            from_[k] = i;
        }
    }

    /// Where the smallest distance is; a free target first, then the lowest index.
    [[nodiscard]] std::size_t nearest(double distance, std::size_t from) const {
        std::size_t best = y_.size();
        for (std::size_t k = from; k < y_.size(); ++k) {
            if (distance_[k] != distance) continue;
            if (best == y_.size() ||
                std::pair(owner_[k] != kNobody, id_[k]) < std::pair(owner_[best] != kNobody, id_[best]))
                best = k;
        }
        AEROGRAM_REQUIRE(best < y_.size() && distance < kInfinity, distance);
        return best;
    }

    void swap_places(std::size_t a, std::size_t b) {
        const Vec3 at = y_[a];
        y_.set(a, y_[b]);
        y_.set(b, at);
        std::swap(price_[a], price_[b]);
        std::swap(id_[a], id_[b]);
        std::swap(owner_[a], owner_[b]);
        std::swap(distance_[a], distance_[b]);
        std::swap(from_[a], from_[b]);
        place_[id_[a]] = static_cast<std::uint32_t>(a);
        place_[id_[b]] = static_cast<std::uint32_t>(b);
    }

    const Allowed& allowed_;
    const Coordinates& x_;
    Coordinates y_;
    std::vector<double> price_;
    std::vector<std::uint32_t> id_, owner_;
    std::vector<double> distance_;
    std::vector<std::int64_t>
        from_;  ///< the bidder from which a target is reached; as wide as a distance, for the loops
    std::vector<double> worth_;
    std::vector<std::uint32_t> target_of_, place_;  ///< by bidder: target's index; by target's index: its place
};

}  // namespace

std::optional<Matching> augment(const Coordinates& bidders, const Coordinates& targets, Matching start, const Run& run,
                                const Allowed& allowed) {
    const auto n = static_cast<std::uint32_t>(targets.size());
    AEROGRAM_REQUIRE(bidders.size() == n, bidders.size(), n);
    start.target_of.resize(n, kNobody);
    if (start.price.empty())
        for (std::uint32_t j = 0; j < n; ++j) start.price.push_back(glm::dot(targets[j], targets[j]));
    Augmenter augmenter(bidders, targets, std::move(start.price), allowed);
    for (std::uint32_t i = 0; i < n; ++i) augmenter.start(i, start.target_of[i]);
    for (std::uint32_t i = 0; i < n; ++i) {
        if (run.stopped()) return std::nullopt;
        if (!augmenter.is_matched(i)) augmenter.join(i);
    }
    return augmenter.result();
}

double duality_gap_m2(const Coordinates& bidders, const Coordinates& targets, const Matching& matching,
                      const Allowed& allowed) {
    const PriceLeaves leaves(targets, matching.price, weights_by_spread(bidders));
    double gap_m2 = 0.0;
    for (std::uint32_t i = 0; i < bidders.size(); ++i) {
        const std::uint32_t own = matching.target_of[i];
        const double own_value = value(bidders[i], targets, matching.price[own], own);
        gap_m2 += std::max(0.0, leaves.best(bidders[i], leaves.place_of(own), i, allowed).value - own_value);
    }
    return gap_m2;
}

}  // namespace aerogram::planner
