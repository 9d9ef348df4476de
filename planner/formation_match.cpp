#include "planner/formation_match.hpp"

#include <algorithm>

#include "planner/assignment/shortest.hpp"
#include "planner/sketch/correspondences.hpp"
#include "planner/sketch/formation_coordinates.hpp"
#include "planner/sketch/rim.hpp"

namespace aerogram::planner {
namespace {

struct Coordinated {
    std::vector<FormationCoordinate> drones, slots;
};

/// Both in their planes, or both in space.
Coordinated coordinates_of(std::span<const Vec3> from_m, const Points& shown_m) {
    DrawingPlane of_drones, of_slots;
    if (!is_flat(from_m, of_drones) || !is_flat(shown_m, of_slots))
        return {coordinates_in(space_frame(from_m), from_m), coordinates_in(space_frame(shown_m), shown_m)};
    const auto seen = [](const DrawingPlane& plane, std::span<const Vec3> points_m) {
        std::vector<Vec2> out;
        for (const Vec3& p : points_m) out.push_back(plane.seen(p));
        return coordinates_in(plane_frame(out), out);
    };
    return {seen(of_drones, from_m), seen(of_slots, shown_m)};
}

/// The slots that are shown, those on the rim first.
struct Order {
    std::vector<std::uint32_t> slots;  ///< by point
    std::size_t first = 0;             ///< points that take their drones before drones take points
};

Order order_of(std::span<const Vec3> to_m, const std::vector<bool>& spare) {
    Order order;
    for (std::uint32_t s = 0; s < to_m.size(); ++s)
        if (spare.empty() || !spare[s]) order.slots.push_back(s);
    Points shown_m;
    for (const std::uint32_t s : order.slots) shown_m.push_back(to_m[s]);
    const std::vector<bool> rim = rim_of(shown_m);
    std::vector<std::uint32_t> by_rim;
    for (const bool on_rim : {true, false}) {
        for (std::size_t k = 0; k < rim.size(); ++k)
            if (rim[k] == on_rim) by_rim.push_back(order.slots[k]);
        if (on_rim) order.first = by_rim.size();
    }
    if (by_rim.size() < to_m.size()) order.first = by_rim.size();
    order.slots = std::move(by_rim);
    return order;
}

CorrespondenceRules rules_for(const Order& order, const MatchRules& rules, std::size_t n) {
    std::vector<std::uint32_t> point_of_slot(n, kNobody);
    for (std::uint32_t p = 0; p < order.slots.size(); ++p) point_of_slot[order.slots[p]] = p;
    CorrespondenceRules out;
    if (!rules.forbid.empty()) {
        out.forbidden_points.resize(n);
        out.forbidden_agents.resize(order.slots.size());
        for (const auto& [drone, slot] : rules.forbid) {
            const std::uint32_t point = point_of_slot[slot.value];
            if (point == kNobody) continue;
            out.forbidden_points[drone.value].push_back(point);
            out.forbidden_agents[point].push_back(drone.value);
        }
        for (auto& points : out.forbidden_points) std::sort(points.begin(), points.end());
    }
    if (!rules.pins.empty()) out.taken_point_of.assign(n, kNobody);
    for (const auto& [drone, slot] : rules.pins) {
        const std::uint32_t point = point_of_slot[slot.value];
        out.taken_point_of[drone.value] = point != kNobody ? point : kElsewhere;
    }
    return out;
}

/// Drones left over to the spare slots, where the rules let them; who finds none stays without.
Status send_to_spares(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const std::vector<bool>& spare,
                      const MatchRules& rules, const SeparationMetric& metric, std::vector<std::uint32_t>& slot_of,
                      const Run& run) {
    std::vector<bool> taken(to_m.size(), false);
    for (const std::uint32_t slot : slot_of)
        if (slot != kNobody) taken[slot] = true;
    std::vector<DroneId> drones;
    std::vector<SlotId> slots;
    for (std::size_t d = 0; d < slot_of.size(); ++d)
        if (slot_of[d] == kNobody) drones.emplace_back(d);
    for (std::size_t s = 0; s < to_m.size(); ++s)
        if (!taken[s] && spare[s]) slots.emplace_back(s);
    if (drones.size() != slots.size()) return Done{};
    std::vector<SlotId> matched(to_m.size());
    const MatchRules forbidden{{}, rules.forbid};
    const auto gap = match_shortest(from_m, to_m, drones, slots, forbidden, metric, matched, run);
    if (!gap) return gap.error().code == ErrorCode::stopped ? Status(gap.error()) : Status(Done{});
    for (const DroneId d : drones) slot_of[d.value] = matched[d.value].value;
    return Done{};
}

/// Makes room for drones without slot. @param match  of all drones and slots that no pin holds.
Status make_room(const FreeMatch& match, std::vector<std::uint32_t>& slot_of, const Run& run) {
    std::vector<std::uint32_t> target_of_slot(slot_of.size(), kUnmatched), start;
    for (std::uint32_t t = 0; t < match.slots.size(); ++t) target_of_slot[match.slots[t].value] = t;
    for (const DroneId d : match.drones)
        start.push_back(slot_of[d.value] == kNobody ? kUnmatched : target_of_slot[slot_of[d.value]]);
    const auto found = maximum_matching(match.x, match.y, match.allowed, start, run);
    if (!found) return stopped_error();
    AEROGRAM_REQUIRE(found->is_complete());
    for (std::size_t k = 0; k < match.drones.size(); ++k)
        slot_of[match.drones[k].value] = match.slots[found->target_of[k]].value;
    return Done{};
}

}  // namespace

Result<Assignment> assign_formation_coordinates(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                                                const std::vector<bool>& spare, const MatchRules& rules,
                                                const SeparationMetric& metric, const Run& run) {
    require_sound(from_m, to_m, rules);
    const std::size_t n = from_m.size();
    std::vector<SlotId> pinned(n);
    const auto all_free = free_match(from_m, to_m, first_ids<DroneId>(n), first_ids<SlotId>(n), rules, metric, pinned);
    if (!all_free) return all_free.error();
    if (!rules.forbid.empty()) {
        if (const auto possible = any_matching(*all_free, run); !possible) return possible.error();
    }
    const Order order = order_of(to_m, spare);
    Points shown_m;
    for (const std::uint32_t s : order.slots) shown_m.push_back(to_m[s]);
    std::vector<std::uint32_t> slot_of(n, kNobody);
    for (const auto& [drone, slot] : rules.pins) slot_of[drone.value] = slot.value;

    // Pinned drones and slots are part of their formations, but take no part in the search.
    if (!shown_m.empty()) {
        const Coordinated all = coordinates_of(from_m, shown_m);
        const auto point_of = find_correspondences(all.drones, all.slots, order.first, rules_for(order, rules, n));
        for (std::size_t d = 0; d < n; ++d)
            if (slot_of[d] == kNobody && point_of[d] != kNobody) slot_of[d] = order.slots[point_of[d]];
    }
    if (order.slots.size() < n) {
        if (const auto sent = send_to_spares(from_m, to_m, spare, rules, metric, slot_of, run); !sent)
            return sent.error();
    }
    if (std::find(slot_of.begin(), slot_of.end(), kNobody) != slot_of.end()) {
        if (const auto done = make_room(*all_free, slot_of, run); !done) return done.error();
    }
    std::vector<SlotId> result;
    for (const std::uint32_t slot : slot_of) result.emplace_back(slot);
    return reported(from_m, to_m, std::move(result), 0.0, metric, run);
}

}  // namespace aerogram::planner
