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

/// The sets of one level: those of the mission, or those inside one matched pair of sets.
struct Level {
    GroupMatch groups;
    std::string path;   ///< before the names of groups and sets inside others: "2."
    bool rest = false;  ///< the last group and the last set are what the others left of the outer ones

    [[nodiscard]] std::string group_name(std::size_t g) const {
        if (rest && g + 1 == groups.drones.size()) return "the rest of group " + path.substr(0, path.size() - 1);
        return "group " + path + std::to_string(g + 1);
    }
    [[nodiscard]] std::string set_name(std::size_t s) const {
        if (rest && s + 1 == groups.slots.size()) return "the rest of its slot set";
        return "slot set " + path + std::to_string(s + 1);
    }
};

/// Which set each drone or slot of this level is in; contract: the sets are disjoint and hold ids below n.
template <class Id>
std::vector<std::size_t> set_of_each(const std::vector<std::vector<Id>>& sets, std::size_t n) {
    std::vector<std::size_t> set_of(n, kNone);
    for (std::size_t s = 0; s < sets.size(); ++s)
        for (const Id id : sets[s]) {
            AEROGRAM_REQUIRE(id.value < n && set_of[id.value] == kNone, s, id.value, n);
            set_of[id.value] = s;
        }
    return set_of;
}
template <class Id>
std::size_t count_in(const std::vector<std::vector<Id>>& sets) {
    std::size_t total = 0;
    for (const auto& set : sets) total += set.size();
    return total;
}

template <class Id>
Vec3 barycentre(std::span<const Vec3> points_m, const std::vector<Id>& ids) {
    Vec3 sum{};
    for (const Id id : ids) sum += points_m[id.value] / static_cast<double>(ids.size());
    return sum;
}

/// The slot set that each group must take, by the designer's word or by a pin of one of its drones.
Result<std::vector<std::size_t>> required_sets(const Level& level, const std::map<DroneId, SlotId>& pins,
                                               std::size_t n) {
    const GroupMatch& groups = level.groups;
    const std::vector<std::size_t> group_of = set_of_each(groups.drones, n), set_of = set_of_each(groups.slots, n);
    std::vector<std::size_t> required(groups.drones.size(), kNone), taken_by(groups.slots.size(), kNone);
    for (std::size_t g = 0; g < groups.wanted.size(); ++g)
        if (groups.wanted[g]) {
            AEROGRAM_REQUIRE(*groups.wanted[g] < groups.slots.size(), g, *groups.wanted[g]);
            required[g] = *groups.wanted[g];
        }
    for (const auto& [drone, slot] : pins) {
        if (group_of[drone.value] == kNone) continue;
        std::size_t& wish = required[group_of[drone.value]];
        // Inside a pair of sets that the outer level has matched, every pin's slot is in one of the sets.
        if (wish != kNone && wish != set_of[slot.value])
            return infeasible("pin " + std::to_string(drone.number()) + " = " + std::to_string(slot.number()) +
                              " leaves its group: " + level.group_name(group_of[drone.value]) + " flies to " +
                              level.set_name(wish) + ", the slot is in " + level.set_name(set_of[slot.value]));
        wish = set_of[slot.value];
    }
    for (std::size_t g = 0; g < required.size(); ++g) {
        if (required[g] == kNone) continue;
        const std::size_t drones = groups.drones[g].size(), slots = groups.slots[required[g]].size();
        if (drones != slots)
            return infeasible(level.group_name(g) + " has " + count_of(drones, "drone") + ", but " +
                              level.set_name(required[g]) + " that it must take has " + count_of(slots, "slot"));
        std::size_t& owner = taken_by[required[g]];
        if (owner != kNone)
            return infeasible(level.group_name(owner) + " and " + level.group_name(g) + " must both take " +
                              level.set_name(required[g]));
        owner = g;
    }
    return required;
}

struct Problem {
    std::span<const Vec3> from_m, to_m;
    const MatchRules& rules;
    const SeparationMetric& metric;
    const Run& run;
};

/// Whether the rules let these drones take these slots.
Result<bool> fits(const Problem& p, const std::vector<DroneId>& drones, const std::vector<SlotId>& slots) {
    const bool concerned = std::any_of(drones.begin(), drones.end(), [&](const DroneId d) {
        const auto at = p.rules.forbid.lower_bound({d, SlotId(0)});
        return at != p.rules.forbid.end() && at->first == d;
    });
    if (!concerned) return true;
    std::vector<SlotId> slot_of(p.from_m.size());
    const auto match = free_match(p.from_m, p.to_m, drones, slots, {{}, p.rules.forbid}, p.metric, slot_of);
    if (!match) return match.error();
    const auto found = any_matching(*match, p.run);
    if (!found && found.error().code == ErrorCode::stopped) return found.error();
    return found.ok();
}

/// Groups and slot sets of one size, both as many, to each other by barycentre.
Status match_sets(const Problem& p, const Level& level, const std::vector<std::size_t>& free_groups,
                  const std::vector<std::size_t>& free_sets, std::vector<std::size_t>& taken) {
    Points group_m, set_m;
    for (const std::size_t g : free_groups) group_m.push_back(barycentre(p.from_m, level.groups.drones[g]));
    for (const std::size_t s : free_sets) set_m.push_back(barycentre(p.to_m, level.groups.slots[s]));
    MatchRules rules;
    for (std::size_t g = 0; g < free_groups.size(); ++g)
        for (std::size_t s = 0; !p.rules.forbid.empty() && s < free_sets.size(); ++s) {
            const auto may = fits(p, level.groups.drones[free_groups[g]], level.groups.slots[free_sets[s]]);
            if (!may) return may.error();
            if (!*may) rules.forbid.emplace(DroneId(g), SlotId(s));
        }
    const Result<Assignment> matched = assign_shortest(group_m, set_m, rules, p.metric, p.run);
    if (!matched && matched.error().code == ErrorCode::infeasible)
        return infeasible("the forbidden pairs leave " + count_of(free_groups.size(), "group") + " of " +
                          count_of(level.groups.drones[free_groups[0]].size(), "drone") +
                          " no way to take the slot sets of that size");
    if (!matched) return matched.error();
    for (std::size_t k = 0; k < free_groups.size(); ++k) taken[free_groups[k]] = free_sets[matched->slot_of[k].value];
    return Done{};
}

/// Matches what is not required by barycentre, one size after the other.
Result<std::vector<std::size_t>> matched_sets(const Problem& p, const Level& level, std::vector<std::size_t> taken) {
    std::map<std::size_t, std::pair<std::vector<std::size_t>, std::vector<std::size_t>>> by_size;
    for (std::size_t g = 0; g < level.groups.drones.size(); ++g)
        if (taken[g] == kNone) by_size[level.groups.drones[g].size()].first.push_back(g);
    for (std::size_t s = 0; s < level.groups.slots.size(); ++s)
        if (std::find(taken.begin(), taken.end(), s) == taken.end())
            by_size[level.groups.slots[s].size()].second.push_back(s);
    for (const auto& [size, both] : by_size) {
        const auto& [free_groups, free_sets] = both;
        if (free_groups.size() != free_sets.size())
            return infeasible(
                (level.path.empty() ? "" : "inside group " + level.path.substr(0, level.path.size() - 1) + ": ") +
                count_of(free_groups.size(), "group") + " of " + count_of(size, "drone") + " but " +
                count_of(free_sets.size(), "slot set") + " of that size: make the sizes equal or name who goes where");
        if (const Status done = match_sets(p, level, free_groups, free_sets, taken); !done) return done.error();
    }
    return taken;
}

/// Adds the ids that no set holds as one more set; whether there were any.
template <class Id>
bool add_rest(const std::vector<Id>& all, std::vector<std::vector<Id>>& sets) {
    std::vector<Id> held, rest;
    for (const auto& set : sets) held.insert(held.end(), set.begin(), set.end());
    std::sort(held.begin(), held.end());
    for (const Id id : all)
        if (!std::binary_search(held.begin(), held.end(), id)) rest.push_back(id);
    AEROGRAM_REQUIRE(held.size() + rest.size() == all.size(), held.size(), rest.size(), all.size());
    if (!rest.empty()) sets.push_back(std::move(rest));
    return held.size() < all.size();
}

/// What is inside set g of a level and the slot set s that it takes; nothing to match whole when one side has no sets.
std::optional<Level> inside(const Level& outer, std::size_t g, std::size_t s) {
    const GroupMatch& groups = outer.groups;
    if (groups.drones_inside.empty() || groups.slots_inside.empty()) return std::nullopt;
    const Subsets<DroneId>& drones = groups.drones_inside[g];
    const Subsets<SlotId>& slots = groups.slots_inside[s];
    if (drones.sets.empty() || slots.sets.empty()) return std::nullopt;
    Level level{{drones.sets, slots.sets, {}, drones.inside, slots.inside}, outer.path + std::to_string(g + 1) + "."};
    AEROGRAM_REQUIRE(drones.inside.empty() || drones.inside.size() == drones.sets.size(), drones.inside.size());
    AEROGRAM_REQUIRE(slots.inside.empty() || slots.inside.size() == slots.sets.size(), slots.inside.size());
    const bool rest = add_rest(groups.drones[g], level.groups.drones);
    const bool slots_rest = add_rest(groups.slots[s], level.groups.slots);
    if (rest && !drones.inside.empty()) level.groups.drones_inside.emplace_back();
    if (slots_rest && !slots.inside.empty()) level.groups.slots_inside.emplace_back();
    level.rest = rest && slots_rest;
    if (level.rest) {
        level.groups.wanted.resize(level.groups.drones.size());
        level.groups.wanted.back() = level.groups.slots.size() - 1;
    }
    return level;
}

/// Matches a level and all that is inside it into slot_of. @returns the sum of the certified gaps, m².
Result<double> match_level(const Problem& p, const Level& level, std::vector<SlotId>& slot_of) {
    const Result<std::vector<std::size_t>> required = required_sets(level, p.rules.pins, p.from_m.size());
    if (!required) return required.error();
    const Result<std::vector<std::size_t>> taken = matched_sets(p, level, *required);
    if (!taken) return taken.error();
    double gap_m2 = 0.0;
    for (std::size_t g = 0; g < level.groups.drones.size(); ++g) {
        const std::size_t s = (*taken)[g];
        const std::optional<Level> next = inside(level, g, s);
        const Result<double> gap = next ? match_level(p, *next, slot_of)
                                        : match_shortest(p.from_m, p.to_m, level.groups.drones[g],
                                                         level.groups.slots[s], p.rules, p.metric, slot_of, p.run);
        if (!gap && gap.error().code == ErrorCode::infeasible && !next)
            return infeasible(level.group_name(g) + ": " + gap.error().message);
        if (!gap) return gap.error();
        gap_m2 += *gap;
    }
    return gap_m2;
}

}  // namespace

Result<Assignment> assign_groups(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const GroupMatch& groups,
                                 const MatchRules& rules, const SeparationMetric& metric, const Run& run) {
    require_sound(from_m, to_m, rules);
    AEROGRAM_REQUIRE(groups.wanted.empty() || groups.wanted.size() == groups.drones.size(), groups.wanted.size());
    AEROGRAM_REQUIRE(groups.drones_inside.empty() || groups.drones_inside.size() == groups.drones.size(),
                     groups.drones_inside.size());
    AEROGRAM_REQUIRE(groups.slots_inside.empty() || groups.slots_inside.size() == groups.slots.size(),
                     groups.slots_inside.size());
    AEROGRAM_REQUIRE(count_in(groups.drones) == from_m.size() && count_in(groups.slots) == to_m.size(),
                     count_in(groups.drones), count_in(groups.slots), from_m.size());
    std::vector<SlotId> slot_of(from_m.size());
    const Result<double> gap_m2 = match_level({from_m, to_m, rules, metric, run}, {groups, {}}, slot_of);
    if (!gap_m2) return gap_m2.error();
    return reported(from_m, to_m, std::move(slot_of), *gap_m2, metric, run);
}

}  // namespace aerogram::planner
