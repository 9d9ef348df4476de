#include "planner/assignment/shortest.hpp"

#include <algorithm>
#include <set>

#include "planner/assignment/crossing.hpp"
#include "planner/assignment/matching.hpp"

namespace aerogram::planner {
namespace {

/// Below this many drones augmenting from scratch is as fast as an auction.
constexpr std::size_t kAuctionFrom = 32;
/// The auction's last bid step, as a share of the range of values: hundreds of times their rounding.
constexpr double kLastEpsilon = 1e-13;
/// A gap above this share of the cost is closed by augmenting paths, up to this many drones: their cost is cubic at
/// worst.
constexpr double kExactGap = 1e-12;
constexpr std::size_t kAugmentUpTo = 3000;
/// Gaps are given relative to the cost, or to this share of the product of the formations' sizes a drone where the cost
/// is smaller: below it they would show rounding alone.
constexpr double kLeastCost = 1e-3;

std::optional<Matching> matched(const Coordinates& x, const Coordinates& y, const Run& run) {
    if (x.size() < kAuctionFrom || radius_of(y) == 0.0) return augment(x, y, {}, run);
    std::optional<Matching> matching = auction(x, y, kLastEpsilon * value_range_m2(x, y), run);
    if (!matching || x.size() > kAugmentUpTo) return matching;
    double cost_m2 = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3 d = y[matching->target_of[i]] - x[i];
        cost_m2 += glm::dot(d, d);
    }
    if (duality_gap_m2(x, y, *matching) <= kExactGap * cost_m2) return matching;
    return augment(x, y, std::move(*matching), run);
}

}  // namespace

void require_sound(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const std::map<DroneId, SlotId>& pins) {
    AEROGRAM_REQUIRE(from_m.size() == to_m.size(), from_m.size(), to_m.size());
    for (std::size_t i = 0; i < from_m.size(); ++i) AEROGRAM_REQUIRE(is_finite(from_m[i]) && is_finite(to_m[i]), i);
    std::set<SlotId> taken;
    for (const auto& [drone, slot] : pins) {
        AEROGRAM_REQUIRE(drone.value < from_m.size() && slot.value < to_m.size(), drone.value, slot.value, to_m.size());
        AEROGRAM_REQUIRE(taken.insert(slot).second, slot.value);
    }
}

std::optional<double> match_shortest(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                                     std::span<const DroneId> drones, std::span<const SlotId> slots,
                                     const std::map<DroneId, SlotId>& pins, const SeparationMetric& metric,
                                     std::vector<SlotId>& slot_of, const Run& run) {
    std::vector<std::uint32_t> free_drones, free_slots;
    std::set<SlotId> pinned;
    for (const DroneId d : drones) {
        const auto pin = pins.find(d);
        if (pin == pins.end()) {
            free_drones.push_back(d.value);
        } else {
            slot_of[d.value] = pin->second;
            pinned.insert(pin->second);
        }
    }
    for (const SlotId s : slots)
        if (!pinned.contains(s)) free_slots.push_back(s.value);
    AEROGRAM_REQUIRE(free_drones.size() == free_slots.size(), free_drones.size(), free_slots.size());
    if (free_drones.empty()) return 0.0;
    std::sort(free_drones.begin(), free_drones.end());
    std::sort(free_slots.begin(), free_slots.end());
    Points free_from_m, free_to_m;
    for (const std::uint32_t d : free_drones) free_from_m.push_back(from_m[d]);
    for (const std::uint32_t s : free_slots) free_to_m.push_back(to_m[s]);
    const Coordinates x = centred(free_from_m, metric), y = centred(free_to_m, metric);
    std::optional<Matching> matching = matched(x, y, run);
    if (!matching) return std::nullopt;

    std::vector<SlotId> local;
    for (const std::uint32_t target : matching->target_of) local.emplace_back(target);
    if (!uncross(free_from_m, free_to_m, local, metric, run)) return std::nullopt;
    for (std::size_t k = 0; k < local.size(); ++k) {
        matching->target_of[k] = local[k].value;
        slot_of[free_drones[k]] = SlotId(free_slots[local[k].value]);
    }
    return duality_gap_m2(x, y, *matching);
}

Assignment reported(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::vector<SlotId> slot_of,
                    double gap_m2, const SeparationMetric& metric) {
    Assignment assignment;
    for (std::size_t d = 0; d < slot_of.size(); ++d) {
        const Vec3 flight = metric.scaled(to_m[slot_of[d].value] - from_m[d]);
        assignment.cost_m2 += glm::dot(flight, flight);
    }
    if (gap_m2 > 0.0) {
        const double sizes_m2 = 4.0 * radius_of(centred(from_m, metric)) * radius_of(centred(to_m, metric));
        const double least_m2 = kLeastCost * sizes_m2 * static_cast<double>(slot_of.size());
        assignment.duality_gap = gap_m2 / std::max(assignment.cost_m2, least_m2);
    }
    assignment.crossing = find_crossing(from_m, to_m, slot_of, metric);
    assignment.pairwise = !assignment.crossing;
    assignment.slot_of = std::move(slot_of);
    return assignment;
}

}  // namespace aerogram::planner
