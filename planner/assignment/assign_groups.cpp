#include <algorithm>

#include "planner/assignment/assignment.hpp"
#include "planner/assignment/shortest.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

Error infeasible(std::string message) {
    return {ErrorCode::infeasible, std::move(message)};
}
std::string count_of(std::size_t n, const char* what) {
    return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
}
std::string group_name(std::size_t g) {
    return "group " + std::to_string(g + 1);
}
std::string set_name(std::size_t s) {
    return "slot set " + std::to_string(s + 1);
}

/// Which set each drone or slot is in; contract: the sets are disjoint and hold all.
template <class Id>
std::vector<std::size_t> set_of_each(const std::vector<std::vector<Id>>& sets, std::size_t n) {
    std::vector<std::size_t> set_of(n, kNone);
    std::size_t total = 0;
    for (std::size_t s = 0; s < sets.size(); ++s)
        for (const Id id : sets[s]) {
            AEROGRAM_REQUIRE(id.value < n && set_of[id.value] == kNone, s, id.value, n);
            set_of[id.value] = s;
            ++total;
        }
    AEROGRAM_REQUIRE(total == n, total, n);
    return set_of;
}

template <class Id>
Vec3 barycentre(std::span<const Vec3> points_m, const std::vector<Id>& ids) {
    Vec3 sum{};
    for (const Id id : ids) sum += points_m[id.value] / static_cast<double>(ids.size());
    return sum;
}

/// The slot set that each group must take, by the designer's word or by a pin of one of its drones.
Result<std::vector<std::size_t>> required_sets(const GroupMatch& groups, const std::map<DroneId, SlotId>& pins,
                                               std::size_t n) {
    const std::vector<std::size_t> group_of = set_of_each(groups.drones, n), set_of = set_of_each(groups.slots, n);
    std::vector<std::size_t> required(groups.drones.size(), kNone), taken_by(groups.slots.size(), kNone);
    for (std::size_t g = 0; g < groups.wanted.size(); ++g)
        if (groups.wanted[g]) {
            AEROGRAM_REQUIRE(*groups.wanted[g] < groups.slots.size(), g, *groups.wanted[g]);
            required[g] = *groups.wanted[g];
        }
    for (const auto& [drone, slot] : pins) {
        std::size_t& wish = required[group_of[drone.value]];
        if (wish != kNone && wish != set_of[slot.value])
            return infeasible("pin " + std::to_string(drone.number()) + " = " + std::to_string(slot.number()) +
                              " leaves its group: " + group_name(group_of[drone.value]) + " flies to " +
                              set_name(wish) + ", the slot is in " + set_name(set_of[slot.value]));
        wish = set_of[slot.value];
    }
    for (std::size_t g = 0; g < required.size(); ++g) {
        if (required[g] == kNone) continue;
        const std::size_t drones = groups.drones[g].size(), slots = groups.slots[required[g]].size();
        if (drones != slots)
            return infeasible(group_name(g) + " has " + count_of(drones, "drone") + ", but " + set_name(required[g]) +
                              " that it must take has " + count_of(slots, "slot"));
        std::size_t& owner = taken_by[required[g]];
        if (owner != kNone)
            return infeasible(group_name(owner) + " and " + group_name(g) + " must both take " + set_name(required[g]));
        owner = g;
    }
    return required;
}

/// Matches what is not required by barycentre, one size after the other.
Result<std::vector<std::size_t>> matched_sets(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                                              const GroupMatch& groups, std::vector<std::size_t> taken,
                                              const SeparationMetric& metric, const Run& run) {
    std::map<std::size_t, std::pair<std::vector<std::size_t>, std::vector<std::size_t>>> by_size;
    for (std::size_t g = 0; g < groups.drones.size(); ++g)
        if (taken[g] == kNone) by_size[groups.drones[g].size()].first.push_back(g);
    for (std::size_t s = 0; s < groups.slots.size(); ++s)
        if (std::find(taken.begin(), taken.end(), s) == taken.end())
            by_size[groups.slots[s].size()].second.push_back(s);
    for (const auto& [size, both] : by_size) {
        const auto& [free_groups, free_sets] = both;
        if (free_groups.size() != free_sets.size())
            return infeasible(count_of(free_groups.size(), "group") + " of " + count_of(size, "drone") + " but " +
                              count_of(free_sets.size(), "slot set") +
                              " of that size: make the sizes equal or name who goes where");
        Points group_m, set_m;
        for (const std::size_t g : free_groups) group_m.push_back(barycentre(from_m, groups.drones[g]));
        for (const std::size_t s : free_sets) set_m.push_back(barycentre(to_m, groups.slots[s]));
        const Result<Assignment> matched = assign_shortest(group_m, set_m, {}, metric, run);
        if (!matched) return matched.error();
        for (std::size_t k = 0; k < free_groups.size(); ++k)
            taken[free_groups[k]] = free_sets[matched->slot_of[k].value];
    }
    return taken;
}

}  // namespace

Result<Assignment> assign_groups(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const GroupMatch& groups,
                                 const std::map<DroneId, SlotId>& pins, const SeparationMetric& metric,
                                 const Run& run) {
    require_sound(from_m, to_m, pins);
    AEROGRAM_REQUIRE(groups.wanted.empty() || groups.wanted.size() == groups.drones.size(), groups.wanted.size());
    Result<std::vector<std::size_t>> required = required_sets(groups, pins, from_m.size());
    if (!required) return required.error();
    const Result<std::vector<std::size_t>> taken = matched_sets(from_m, to_m, groups, *required, metric, run);
    if (!taken) return taken.error();
    std::vector<SlotId> slot_of(from_m.size());
    double gap_m2 = 0.0;
    for (std::size_t g = 0; g < groups.drones.size(); ++g) {
        const auto gap =
            match_shortest(from_m, to_m, groups.drones[g], groups.slots[(*taken)[g]], pins, metric, slot_of, run);
        if (!gap) return stopped_error();
        gap_m2 += *gap;
    }
    return reported(from_m, to_m, std::move(slot_of), gap_m2, metric);
}

}  // namespace aerogram::planner
