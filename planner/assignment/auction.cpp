#include <cmath>
#include <limits>

#include "geo/contract.hpp"
#include "planner/assignment/matching.hpp"
#include "planner/assignment/price_leaves.hpp"

namespace aerogram::planner {
namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr double kEpsilonFactor = 5.0;
constexpr std::size_t kBidsPerStopCheck = 1024;

class Auction {
  public:
    Auction(const Coordinates& bidders, const Coordinates& targets, const Run& run)
        : bidders_(bidders),
          leaves_(targets),
          order_(kd_order(bidders)),
          owner_(targets.size()),
          last_(bidders.size()),
          run_(run) {}

    /// Everybody bids until everybody has a target whose value is within epsilon of the best. False when stopped.
    bool phase(double epsilon) {
        owner_.assign(owner_.size(), kNobody);
        for (const std::uint32_t first : order_)
            for (std::uint32_t bidder = first; bidder != kNobody;) {
                if (++bids_ % kBidsPerStopCheck == 0 && run_.stopped()) return false;
                const PriceLeaves::Offer offer = leaves_.best(bidders_[bidder], last_[bidder]);
                leaves_.raise(offer.place, leaves_.price(offer.place) + (offer.value - offer.second) + epsilon);
                last_[bidder] = offer.place;
                std::swap(bidder, owner_[offer.place]);
            }
        return true;
    }

    [[nodiscard]] Matching result() const {
        Matching matching{std::vector<std::uint32_t>(owner_.size()), std::vector<double>(owner_.size())};
        for (std::uint32_t place = 0; place < owner_.size(); ++place) {
            matching.target_of[owner_[place]] = leaves_.index_at(place);
            matching.price[leaves_.index_at(place)] = leaves_.price(place);
        }
        return matching;
    }

  private:
    const Coordinates& bidders_;
    PriceLeaves leaves_;
    std::vector<std::uint32_t> order_, owner_, last_;
    const Run& run_;
    std::size_t bids_ = 0;
};

}  // namespace

double value_range_m2(const Coordinates& bidders, const Coordinates& targets) {
    return radius_of(targets) * (4.0 * radius_of(bidders) + radius_of(targets));
}

std::optional<Matching> auction(const Coordinates& bidders, const Coordinates& targets, double last_epsilon,
                                const Run& run) {
    Auction auction(bidders, targets, run);
    AEROGRAM_REQUIRE(last_epsilon > 1e-15 * value_range_m2(bidders, targets), last_epsilon);
    const double first_epsilon = value_range_m2(bidders, targets) / kEpsilonFactor;
    for (double epsilon = first_epsilon;; epsilon = std::max(epsilon / kEpsilonFactor, last_epsilon)) {
        if (!auction.phase(epsilon)) return std::nullopt;
        if (epsilon <= last_epsilon) return auction.result();
        run.report("assign", std::log(first_epsilon / epsilon) / std::log(first_epsilon / last_epsilon));
    }
}

}  // namespace aerogram::planner
