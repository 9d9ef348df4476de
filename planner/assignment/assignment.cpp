#include "planner/assignment/assignment.hpp"

#include "planner/assignment/shortest.hpp"

namespace aerogram::planner {

Result<Assignment> assign_shortest(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const MatchRules& rules,
                                   const SeparationMetric& metric, const Run& run) {
    require_sound(from_m, to_m, rules);
    const std::size_t n = from_m.size();
    std::vector<SlotId> slot_of(n);
    const auto gap_m2 =
        match_shortest(from_m, to_m, first_ids<DroneId>(n), first_ids<SlotId>(n), rules, metric, slot_of, run);
    if (!gap_m2) return gap_m2.error();
    return reported(from_m, to_m, std::move(slot_of), *gap_m2, metric, run);
}

Result<Assignment> assign_keep(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const MatchRules& rules,
                               const SeparationMetric& metric, const Run& run) {
    require_sound(from_m, to_m, rules);
    const std::size_t n = from_m.size();
    std::vector<SlotId> slot_of = first_ids<SlotId>(n);
    std::vector<bool> taken(n, false), settled(n, false);
    for (const auto& [drone, slot] : rules.pins) {
        slot_of[drone.value] = slot;
        taken[slot.value] = settled[drone.value] = true;
    }
    for (std::size_t i = 0; i < n; ++i)
        if (!settled[i] && !taken[i]) taken[i] = settled[i] = true;
    std::size_t vacated = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (settled[i]) continue;
        while (taken[vacated]) ++vacated;
        slot_of[i] = SlotId(vacated);
        taken[vacated] = true;
    }
    for (const auto& [drone, slot] : rules.forbid)
        if (slot_of[drone.value] == slot)
            return Error{ErrorCode::infeasible, "drone " + std::to_string(drone.number()) + " would fly to slot " +
                                                    std::to_string(slot.number()) + ", which is forbidden to it"};
    return reported(from_m, to_m, std::move(slot_of), 0.0, metric, run);
}

}  // namespace aerogram::planner
