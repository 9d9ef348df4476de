#include "planner/assignment/shortest.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

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
/// The gap at which an auction of more drones may end.
constexpr double kEnoughGap = 1e-7;

std::optional<Matching> matched(const FreeMatch& m, const Run& run) {
    if (m.x.size() < kAuctionFrom || radius_of(m.y) == 0.0) return augment(m.x, m.y, {}, run, m.allowed);
    const bool exact = m.x.size() <= kAugmentUpTo;
    const AuctionEnd end{kLastEpsilon * value_range_m2(m.x, m.y), exact ? 0.0 : kEnoughGap};
    std::optional<Matching> matching = auction(m.x, m.y, end, run, m.allowed);
    if (!matching || !exact) return matching;
    const double cost = cost_m2(m.x, m.y, matching->target_of);
    if (duality_gap_m2(m.x, m.y, *matching, m.allowed) <= kExactGap * cost) return matching;
    return augment(m.x, m.y, std::move(*matching), run, m.allowed);
}

Points points_of(const Coordinates& coordinates) {
    Points points(coordinates.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = coordinates[i];
    return points;
}

/// "drones 1, 2 and 5 others" for people.
std::string list(const char* what, const std::vector<std::size_t>& numbers) {
    constexpr std::size_t kShown = 5;
    std::ostringstream text;
    text << what << (numbers.size() == 1 ? " " : "s ");
    const std::size_t shown = numbers.size() <= kShown + 1 ? numbers.size() : kShown;
    for (std::size_t k = 0; k < shown; ++k)
        text << (k == 0 ? "" : k + 1 == numbers.size() ? " and " : ", ") << numbers[k];
    if (shown < numbers.size()) text << " and " << numbers.size() - shown << " others";
    return text.str();
}

Error too_few_slots(const FreeMatch& match, const MaximumMatching& found) {
    std::vector<std::size_t> drones, slots;
    for (const std::uint32_t i : found.stuck_bidders) drones.push_back(match.drones[i].number());
    for (const std::uint32_t j : found.their_targets) slots.push_back(match.slots[j].number());
    const std::string who = list("drone", drones);
    if (slots.empty()) return {ErrorCode::infeasible, who + " may not take any of the slots: forbid fewer pairs"};
    return {ErrorCode::infeasible, who + " may take only " + list("slot", slots) + (drones.size() > 2 ? ", " : ": ") +
                                       "one too few: forbid fewer pairs"};
}

}  // namespace

void require_sound(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const MatchRules& rules) {
    const std::size_t n = to_m.size();
    AEROGRAM_REQUIRE(from_m.size() == n, from_m.size(), n);
    for (std::size_t i = 0; i < n; ++i) AEROGRAM_REQUIRE(is_finite(from_m[i]) && is_finite(to_m[i]), i);
    std::set<SlotId> taken;
    for (const auto& [drone, slot] : rules.pins) {
        AEROGRAM_REQUIRE(drone.value < n && slot.value < n, drone.value, slot.value, n);
        AEROGRAM_REQUIRE(taken.insert(slot).second, slot.value);
    }
    for (const auto& [drone, slot] : rules.forbid)
        AEROGRAM_REQUIRE(drone.value < n && slot.value < n, drone.value, slot.value, n);
}

Result<FreeMatch> free_match(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::span<const DroneId> drones,
                             std::span<const SlotId> slots, const MatchRules& rules, const SeparationMetric& metric,
                             std::vector<SlotId>& slot_of) {
    FreeMatch match;
    std::set<SlotId> pinned;
    for (const DroneId d : drones) {
        const auto pin = rules.pins.find(d);
        if (pin == rules.pins.end()) {
            match.drones.push_back(d);
            continue;
        }
        if (rules.forbid.contains(*pin))
            return Error{ErrorCode::infeasible, "drone " + std::to_string(d.number()) + " is pinned to slot " +
                                                    std::to_string(pin->second.number()) +
                                                    ", which is forbidden to it"};
        slot_of[d.value] = pin->second;
        pinned.insert(pin->second);
    }
    for (const SlotId s : slots)
        if (!pinned.contains(s)) match.slots.push_back(s);
    AEROGRAM_REQUIRE(match.drones.size() == match.slots.size(), match.drones.size(), match.slots.size());
    std::sort(match.drones.begin(), match.drones.end());
    std::sort(match.slots.begin(), match.slots.end());
    Points free_from_m, free_to_m;
    for (const DroneId d : match.drones) free_from_m.push_back(from_m[d.value]);
    for (const SlotId s : match.slots) free_to_m.push_back(to_m[s.value]);
    match.x = centred(free_from_m, metric);
    match.y = centred(free_to_m, metric);
    match.allowed.downwash = metric.downwash;
    for (const auto& [drone, slot] : rules.forbid) {
        const auto d = std::lower_bound(match.drones.begin(), match.drones.end(), drone);
        const auto s = std::lower_bound(match.slots.begin(), match.slots.end(), slot);
        if (d == match.drones.end() || *d != drone || s == match.slots.end() || *s != slot) continue;
        match.allowed.forbidden.resize(match.drones.size());
        match.allowed.forbidden[static_cast<std::size_t>(d - match.drones.begin())].push_back(
            static_cast<std::uint32_t>(s - match.slots.begin()));
    }
    return match;
}

Result<MaximumMatching> any_matching(const FreeMatch& match, const Run& run) {
    const auto found = maximum_matching(match.x, match.y, match.allowed, {}, run);
    if (!found) return stopped_error();
    if (!found->is_complete()) return too_few_slots(match, *found);
    return *found;
}

Result<double> solve_shortest(const FreeMatch& match, std::vector<SlotId>& slot_of, const Run& run) {
    if (match.drones.empty()) return 0.0;
    std::optional<Matching> matching = matched(match, run);
    if (!matching) return stopped_error();
    std::vector<SlotId> local;
    for (const std::uint32_t target : matching->target_of) local.emplace_back(target);
    MaySwap may_swap;
    if (!match.allowed.everything())
        may_swap = [&](std::size_t i, std::size_t j) {
            return match.allowed(match.x, match.y, i, local[j].value) &&
                   match.allowed(match.x, match.y, j, local[i].value);
        };
    if (!uncross(points_of(match.x), points_of(match.y), local, SeparationMetric{}, run, may_swap))
        return stopped_error();
    for (std::size_t k = 0; k < local.size(); ++k) {
        matching->target_of[k] = local[k].value;
        slot_of[match.drones[k].value] = match.slots[local[k].value];
    }
    return duality_gap_m2(match.x, match.y, *matching, match.allowed);
}

Result<double> match_shortest(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::span<const DroneId> drones,
                              std::span<const SlotId> slots, const MatchRules& rules, const SeparationMetric& metric,
                              std::vector<SlotId>& slot_of, const Run& run) {
    const Result<FreeMatch> match = free_match(from_m, to_m, drones, slots, rules, metric, slot_of);
    if (!match) return match.error();
    if (!match->allowed.everything())
        if (const auto feasible = any_matching(*match, run); !feasible) return feasible.error();
    return solve_shortest(*match, slot_of, run);
}

Assignment reported(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::vector<SlotId> slot_of,
                    double gap_m2, const SeparationMetric& metric, const Run& run) {
    Assignment assignment;
    for (std::size_t d = 0; d < slot_of.size(); ++d) {
        const Vec3 flight_m = to_m[slot_of[d].value] - from_m[d], flight = metric.scaled(flight_m);
        assignment.cost_m2 += glm::dot(flight, flight);
        assignment.longest_m = std::max(assignment.longest_m, glm::length(flight_m));
    }
    if (gap_m2 > 0.0)
        assignment.duality_gap =
            gap_m2 / gap_scale_m2(centred(from_m, metric), centred(to_m, metric), assignment.cost_m2);
    assignment.crossing = find_crossing(from_m, to_m, slot_of, metric, run);
    assignment.pairwise = !assignment.crossing;
    assignment.slot_of = std::move(slot_of);
    return assignment;
}

}  // namespace aerogram::planner
