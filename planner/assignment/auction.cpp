#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/contract.hpp"
#include "planner/assignment/alike.hpp"
#include "planner/assignment/matching.hpp"
#include "planner/assignment/price_leaves.hpp"

namespace aerogram::planner {
namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr double kEpsilonFactor = 5.0;
constexpr std::size_t kBidsPerStopCheck = 1024;
/// From this many bidders on the first prices come from a coarse auction between cells of so many; it ends at this
/// share of a cell's size, and the fine one begins at that one. The time hardly depends on any of the four.
constexpr std::size_t kCoarsenFrom = 1000;
constexpr std::uint32_t kCell = 8;
constexpr double kCoarseLastEpsilon = 0.1, kFineFirstEpsilon = 1.0;

/// Targets that are alike to every bidder are copies of one thing: bidders want the cheapest copy, whose price is the
/// thing's, and outbid the second-best thing, not the next copy. (Bertsekas and Castañon 1989: similar objects.)
class Copies {
  public:
    struct Copy {
        double price;
        std::uint32_t target, owner;
    };

    explicit Copies(const Classes& things) : begin_(things.begin), copies_(things.members.size()) {
        for (std::size_t k = 0; k < copies_.size(); ++k) copies_[k] = {0.0, things.members[k], kNobody};
    }
    /// All free, at their thing's price.
    void set_free(std::size_t thing, double price) {
        for (std::uint32_t k = begin_[thing]; k < begin_[thing + 1]; ++k) {
            copies_[k].price = price;
            copies_[k].owner = kNobody;
        }
    }
    /// The bidder gets the cheapest copy at a new price. @returns the owner until now.
    std::uint32_t sell(std::size_t thing, double price, std::uint32_t bidder) {
        Copy sold = copies_[begin_[thing]];
        const std::uint32_t before = sold.owner;
        sold.price = price;
        sold.owner = bidder;
        const std::size_t count = begin_[thing + 1] - begin_[thing];
        Copy* heap = copies_.data() + begin_[thing];
        std::size_t at = 0;
        for (std::size_t child = 1; child < count; child = 2 * at + 1) {
            if (child + 1 < count && heap[child + 1].price < heap[child].price) ++child;
            if (!(heap[child].price < price)) break;
            heap[at] = heap[child];
            at = child;
        }
        heap[at] = sold;
        return before;
    }
    /// Of the cheapest copy.
    [[nodiscard]] double price(std::size_t thing) const { return copies_[begin_[thing]].price; }
    [[nodiscard]] std::size_t things() const { return begin_.size() - 1; }
    [[nodiscard]] std::span<const Copy> of(std::size_t thing) const {
        return {copies_.data() + begin_[thing], copies_.data() + begin_[thing + 1]};
    }

  private:
    std::vector<std::uint32_t> begin_;  ///< by thing: where its copies begin, a heap with the cheapest on top
    std::vector<Copy> copies_;
};

/// Limits tell copies apart.
Classes things_of(const Coordinates& bidders, const Coordinates& targets, const Allowed& allowed) {
    if (allowed.everything()) return classes_of(seen_by(bidders, targets));
    Classes each;
    for (std::uint32_t j = 0; j < targets.size(); ++j) {
        each.members.push_back(j);
        each.begin.push_back(j);
    }
    each.begin.push_back(static_cast<std::uint32_t>(targets.size()));
    return each;
}
Coordinates one_of_each(const Classes& things, const Coordinates& targets) {
    Coordinates points(things.size());
    for (std::size_t t = 0; t < things.size(); ++t) points.set(t, targets[things.of(t)[0]]);
    return points;
}
std::vector<double> one_of_each(const Classes& things, const std::vector<double>& price) {
    std::vector<double> prices;
    for (std::size_t t = 0; !price.empty() && t < things.size(); ++t) prices.push_back(price[things.of(t)[0]]);
    return prices;
}

class Auction {
  public:
    Auction(const Coordinates& bidders, const Coordinates& targets, const std::vector<double>& price, const Run& run,
            const Allowed& allowed)
        : Auction(bidders, targets, things_of(bidders, targets, allowed), price, run, allowed) {}

    /// Everybody bids until everybody has a target whose value is within epsilon of the best. False when stopped.
    bool phase(double epsilon) {
        for (std::uint32_t place = 0; place < copies_.things(); ++place)
            copies_.set_free(leaves_.index_at(place), leaves_.price(place));
        for (const std::uint32_t first : order_)
            for (std::uint32_t bidder = first; bidder != kNobody;) {
                if (++bids_ % kBidsPerStopCheck == 0 && run_.stopped()) return false;
                const PriceLeaves::Offer offer = leaves_.best(bidders_[bidder], last_[bidder], bidder, allowed_);
                AEROGRAM_REQUIRE(std::isfinite(offer.value), bidder);
                // A bidder without a second choice raises as far as values lie apart, not for ever.
                const double ahead = std::min(offer.value - offer.second, most_);
                const std::uint32_t thing = leaves_.index_at(offer.place);
                last_[bidder] = offer.place;
                bidder = copies_.sell(thing, leaves_.price(offer.place) + ahead + epsilon, bidder);
                if (const double price = copies_.price(thing); price > leaves_.price(offer.place))
                    leaves_.raise(offer.place, price);
            }
        return true;
    }

    [[nodiscard]] Matching result() const {
        Matching matching{std::vector<std::uint32_t>(bidders_.size()), std::vector<double>(bidders_.size())};
        for (std::size_t thing = 0; thing < copies_.things(); ++thing)
            for (const Copies::Copy& copy : copies_.of(thing)) {
                matching.target_of[copy.owner] = copy.target;
                matching.price[copy.target] = copies_.price(thing);
            }
        return matching;
    }

  private:
    Auction(const Coordinates& bidders, const Coordinates& targets, const Classes& things,
            const std::vector<double>& price, const Run& run, const Allowed& allowed)
        : bidders_(bidders),
          copies_(things),
          leaves_(one_of_each(things, targets), one_of_each(things, price), weights_by_spread(bidders)),
          order_(kd_order(bidders)),
          last_(bidders.size()),
          most_(value_range_m2(bidders, targets)),
          run_(run),
          allowed_(allowed) {}

    const Coordinates& bidders_;
    Copies copies_;
    PriceLeaves leaves_;  ///< of things
    std::vector<std::uint32_t> order_, last_;
    double most_;
    const Run& run_;
    const Allowed& allowed_;
    std::size_t bids_ = 0;
};

/// Barycentres of cells of kCell points, and the mean square distance from them.
struct Cells {
    Coordinates center;
    double size2_m2 = 0.0;
};
Cells cells_of(const Coordinates& points) {
    const std::vector<std::uint32_t> order = kd_order(points, kCell);
    Cells cells{Coordinates((points.size() + kCell - 1) / kCell)};
    for (std::size_t c = 0; c < cells.center.size(); ++c) {
        const std::size_t begin = c * kCell, end = std::min<std::size_t>(begin + kCell, points.size());
        Vec3 sum{};
        for (std::size_t k = begin; k < end; ++k) sum += points[order[k]];
        const Vec3 center = sum / static_cast<double>(end - begin);
        for (std::size_t k = begin; k < end; ++k) {
            const Vec3 d = points[order[k]] - center;
            cells.size2_m2 += glm::dot(d, d) / static_cast<double>(points.size());
        }
        cells.center.set(c, center);
    }
    return cells;
}

/// By point y: the most that any of the priced points x offers, 2 x·y - price.
std::vector<double> best_values(const Coordinates& priced, const std::vector<double>& price,
                                const Coordinates& points) {
    const PriceLeaves leaves(priced, price);
    std::vector<double> best(points.size());
    for (std::size_t i = 0; i < best.size(); ++i) best[i] = leaves.best(points[i], 0).value;
    return best;
}

struct Start {
    std::vector<double> price;  ///< empty: none is known
    double epsilon;
};

std::optional<Matching> solve(const Coordinates& bidders, const Coordinates& targets, const AuctionEnd& end,
                              const Run& run, const Allowed& allowed, std::string_view stage);

/// A coarse matching's prices carry over by the convex function that they define: worth u of each bidders' cell, then
/// price(y) = max (2 x·y - u).
std::optional<Start> start_of(const Coordinates& bidders, const Coordinates& targets, const Run& run) {
    const double range_m2 = value_range_m2(bidders, targets);
    const Cells from = cells_of(bidders), to = cells_of(targets);
    const double size_m2 = std::sqrt(from.size2_m2 * to.size2_m2);
    // Coincident points have cells without size, which say nothing.
    if (bidders.size() < kCoarsenFrom || size_m2 < 1e-9 * range_m2) return Start{{}, range_m2 / kEpsilonFactor};
    const auto coarse = solve(from.center, to.center, {kCoarseLastEpsilon * size_m2}, run, {}, {});
    if (!coarse) return std::nullopt;
    const std::vector<double> worth = best_values(to.center, coarse->price, from.center);
    return Start{best_values(from.center, worth, targets), kFineFirstEpsilon * size_m2};
}

/// @param stage  reported; empty: no reports.
std::optional<Matching> solve(const Coordinates& bidders, const Coordinates& targets, const AuctionEnd& end,
                              const Run& run, const Allowed& allowed, std::string_view stage) {
    const std::optional<Start> start = start_of(bidders, targets, run);
    if (!start) return std::nullopt;
    Auction auction(bidders, targets, start->price, run, allowed);
    const double first = std::max(start->epsilon, end.last_epsilon);
    double last = end.last_epsilon;
    for (double epsilon = first;; epsilon = std::max(epsilon / kEpsilonFactor, last)) {
        if (!auction.phase(epsilon)) return std::nullopt;
        if (end.enough_gap > 0.0) {
            const double gap_m2 =
                end.enough_gap * gap_scale_m2(bidders, targets, cost_m2(bidders, targets, auction.result().target_of));
            last = std::max(end.last_epsilon, gap_m2 / static_cast<double>(bidders.size()));
        }
        if (epsilon <= last) return auction.result();
        if (!stage.empty()) run.report(stage, std::log(first / epsilon) / std::log(first / end.last_epsilon));
    }
}

}  // namespace

double value_range_m2(const Coordinates& bidders, const Coordinates& targets) {
    return radius_of(targets) * (4.0 * radius_of(bidders) + radius_of(targets));
}

double gap_scale_m2(const Coordinates& bidders, const Coordinates& targets, double cost_m2) {
    constexpr double kLeastCost = 1e-3;
    const double sizes_m2 = 4.0 * radius_of(bidders) * radius_of(targets);
    return std::max(cost_m2, kLeastCost * sizes_m2 * static_cast<double>(bidders.size()));
}

double cost_m2(const Coordinates& bidders, const Coordinates& targets, const std::vector<std::uint32_t>& target_of) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bidders.size(); ++i) {
        const Vec3 flight = targets[target_of[i]] - bidders[i];
        sum += glm::dot(flight, flight);
    }
    return sum;
}

std::optional<Matching> auction(const Coordinates& bidders, const Coordinates& targets, const AuctionEnd& end,
                                const Run& run, const Allowed& allowed) {
    AEROGRAM_REQUIRE(end.last_epsilon > 1e-15 * value_range_m2(bidders, targets), end.last_epsilon);
    return solve(bidders, targets, end, run, allowed, "assign");
}

}  // namespace aerogram::planner
