#include "planner/assignment/crossing.hpp"

#include <algorithm>

#include "planner/assignment/alike.hpp"
#include "planner/assignment/assignment.hpp"

namespace aerogram::planner {
namespace {

constexpr int kRoundsOfTies = 16, kRoundsOfSorting = 200;

/// Changes slots of pairs until a look at every pair finds nothing to change. Only pairs of blocks are looked at again
/// of which one has changed since.
class Swapper {
  public:
    Swapper(Flights& flights, std::vector<SlotId>& slot_of, const MaySwap& may_swap)
        : flights_(flights), slot_of_(slot_of), may_swap_(may_swap), changed_(flights.blocks(), 0) {}

    /// False when stopped.
    bool run(const Run& run) {
        for (int round = 1;; ++round) {
            const std::size_t before = swaps_;
            const bool ties = round <= kRoundsOfTies;
            for (std::size_t a = 0; a < flights_.blocks(); ++a) {
                if (run.stopped()) return false;
                for (std::size_t b = a; b < flights_.blocks(); ++b)
                    if (std::max(changed_[a], changed_[b]) >= round - 1) look(a, b, round, ties);
            }
            if (swaps_ == before) return true;
        }
    }

  private:
    void look(std::size_t a, std::size_t b, int round, bool ties) {
        const double limit_m2 = (ties ? 1.0 : -1.0) * flights_.tolerance_m2();
        if (!flights_.may_be_below(a, b, limit_m2)) return;
        const std::size_t before = swaps_;
        const std::size_t end_a = std::min((a + 1) * Flights::kBlock, flights_.size());
        const std::size_t begin_b = b * Flights::kBlock, end_b = std::min(begin_b + Flights::kBlock, flights_.size());
        for (std::size_t p = a * Flights::kBlock; p < end_a; ++p)
            for (std::size_t q = flights_.first_below(p, a == b ? p + 1 : begin_b, end_b, limit_m2); q < end_b;
                 q = flights_.first_below(p, q + 1, end_b, limit_m2))
                settle(p, q);
        if (swaps_ == before) return;
        changed_[a] = changed_[b] = round;
        flights_.box_again(a);
        flights_.box_again(b);
    }

    /// A pair that crosses swaps; one whose swap costs nothing does so when that sorts it.
    void settle(std::size_t p, std::size_t q) {
        const std::size_t i = flights_.drone_at(p), j = flights_.drone_at(q);
        const bool crosses = flights_.product_m2(p, q) < -flights_.tolerance_m2();
        if (!crosses && (i < j) == (slot_of_[i] < slot_of_[j])) return;
        if (may_swap_ && !may_swap_(i, j)) return;
        flights_.swap_targets(p, q);
        std::swap(slot_of_[i], slot_of_[j]);
        ++swaps_;
    }

    Flights& flights_;
    std::vector<SlotId>& slot_of_;
    const MaySwap& may_swap_;
    std::vector<int> changed_;  ///< by block: the last round that swapped in it
    std::size_t swaps_ = 0;
};

/// Sorts what the members of each class hold; whether that changed anything.
bool sort_within(const Classes& classes, std::vector<std::uint32_t>& held) {
    bool changed = false;
    std::vector<std::uint32_t> values;
    for (std::size_t c = 0; c < classes.size(); ++c) {
        const std::span<const std::uint32_t> members = classes.of(c);
        values.clear();
        for (const std::uint32_t i : members) values.push_back(held[i]);
        if (std::is_sorted(values.begin(), values.end())) continue;
        std::sort(values.begin(), values.end());
        for (std::size_t k = 0; k < members.size(); ++k) held[members[k]] = values[k];
        changed = true;
    }
    return changed;
}

/// Ties by the formations' shape (pads under upright letters: a whole row of either is alike to the other), all at
/// once; one pair after the other they would take long.
void sort_alike(const Coordinates& from, const Coordinates& to, std::vector<SlotId>& slot_of) {
    const Classes drone_classes = classes_of(seen_by(to, from)), slot_classes = classes_of(seen_by(from, to));
    std::vector<std::uint32_t> slots, drones(slot_of.size());
    for (const SlotId s : slot_of) slots.push_back(s.value);
    bool changed = true;
    for (int round = 0; changed && round < kRoundsOfSorting; ++round) {
        changed = sort_within(drone_classes, slots);
        for (std::uint32_t d = 0; d < slots.size(); ++d) drones[slots[d]] = d;
        changed = sort_within(slot_classes, drones) || changed;
        for (std::uint32_t s = 0; s < drones.size(); ++s) slots[drones[s]] = s;
    }
    for (std::uint32_t d = 0; d < slots.size(); ++d) slot_of[d] = SlotId(slots[d]);
}

}  // namespace

bool uncross(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::vector<SlotId>& slot_of,
             const SeparationMetric& metric, const Run& run, const MaySwap& may_swap) {
    if (!may_swap) sort_alike(centred(from_m, metric), centred(to_m, metric), slot_of);
    Flights flights(from_m, to_m, slot_of, metric);
    return Swapper(flights, slot_of, may_swap).run(run);
}

std::optional<CrossingPair> find_crossing(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                                          std::span<const SlotId> slot_of, const SeparationMetric& metric,
                                          const Run& run) {
    AEROGRAM_REQUIRE(from_m.size() == to_m.size() && from_m.size() == slot_of.size(), from_m.size(), to_m.size(),
                     slot_of.size());
    const Flights flights(from_m, to_m, slot_of, metric);
    const double limit_m2 = -flights.tolerance_m2();
    using Pair = std::pair<std::size_t, std::size_t>;
    const Pair none{slot_of.size(), slot_of.size()};
    std::vector<Pair> lowest(flights.blocks(), none);
    Run own = run;  // a result that depends on when one stops is no result: the check is short, and runs to its end
    own.stop = {};
    parallel_for(flights.blocks(), own, {}, [&](std::size_t a) {
        const std::size_t end_a = std::min((a + 1) * Flights::kBlock, flights.size());
        for (std::size_t b = a; b < flights.blocks(); ++b) {
            if (!flights.may_be_below(a, b, limit_m2)) continue;
            const std::size_t begin_b = b * Flights::kBlock,
                              end_b = std::min(begin_b + Flights::kBlock, flights.size());
            for (std::size_t p = a * Flights::kBlock; p < end_a; ++p)
                for (std::size_t q = flights.first_below(p, a == b ? p + 1 : begin_b, end_b, limit_m2); q < end_b;
                     q = flights.first_below(p, q + 1, end_b, limit_m2)) {
                    const std::size_t i = flights.drone_at(p), j = flights.drone_at(q);
                    lowest[a] = std::min(lowest[a], {std::min(i, j), std::max(i, j)});
                }
        }
    });
    const Pair first = lowest.empty() ? none : *std::min_element(lowest.begin(), lowest.end());
    if (first == none) return std::nullopt;
    return CrossingPair{DroneId(first.first), DroneId(first.second)};
}

}  // namespace aerogram::planner
