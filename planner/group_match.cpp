#include "planner/group_match.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

namespace aerogram::planner {
namespace {

using Indices = std::vector<std::size_t>;

bool holds(const Group& outer, const Group& inner) {
    return outer.drones.size() > inner.drones.size() && std::ranges::includes(outer.drones, inner.drones);
}

/// The groups that count at a keyframe: those that its arrival names, else all; empty ones do not.
Indices groups_in_play(const std::vector<Group>& groups, const Keyframe& keyframe) {
    Indices named;
    for (const GroupMove& move : keyframe.arrive.groups) named.push_back(move.group);
    if (named.empty()) {
        named.resize(groups.size());
        std::iota(named.begin(), named.end(), std::size_t{0});
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const bool called = std::ranges::find(keyframe.parts, groups[g].name, &Part::group) != keyframe.parts.end();
        if (called && std::ranges::find(named, g) == named.end()) named.push_back(g);
    }
    std::erase_if(named, [&](std::size_t g) { return groups[g].drones.empty(); });
    return named;
}

/// The outermost groups in play, or inner ones where a part calls them by name.
Indices whole_groups(const std::vector<Group>& groups, const Keyframe& keyframe, const Indices& in_play) {
    const auto is_called = [&](std::size_t g) {
        return std::ranges::find(keyframe.parts, groups[g].name, &Part::group) != keyframe.parts.end();
    };
    Indices wholes;
    for (const std::size_t g : in_play) {
        const auto is_around = [&](std::size_t o) { return holds(groups[o], groups[g]); };
        const auto is_inside_and_called = [&](std::size_t i) { return holds(groups[g], groups[i]) && is_called(i); };
        const bool outermost = std::ranges::none_of(in_play, is_around);
        if ((outermost && std::ranges::none_of(in_play, is_inside_and_called)) || is_called(g)) wholes.push_back(g);
    }
    return wholes;
}

Subsets<DroneId> drones_inside(const std::vector<Group>& groups, std::size_t group, const Indices& in_play) {
    Subsets<DroneId> out;
    for (const std::size_t child : groups[group].inside) {
        if (std::ranges::find(in_play, child) == in_play.end()) continue;
        out.sets.push_back(groups[child].drones);
        out.inside.push_back(drones_inside(groups, child, in_play));
    }
    return out;
}

/// Slots in order, dealt out in runs as long as the drone sets.
Subsets<SlotId> runs(const std::vector<SlotId>& slots, const Subsets<DroneId>& drones) {
    Subsets<SlotId> out;
    auto next = slots.begin();
    for (std::size_t s = 0; s < drones.sets.size(); ++s) {
        const auto end = next + static_cast<std::ptrdiff_t>(drones.sets[s].size());
        out.sets.emplace_back(next, end);
        out.inside.push_back(runs(out.sets.back(), drones.inside[s]));
        next = end;
    }
    return out;
}

/// Which slot set each part is, and which set a whole group must take by its parts' word.
struct PartSets {
    Indices set_of_part;
    std::size_t count = 0;
};
PartSets sets_of_parts(const std::vector<Group>& groups, const Keyframe& keyframe, const Indices& wholes,
                       std::vector<std::optional<std::size_t>>& wanted) {
    PartSets sets;
    for (const Part& part : keyframe.parts) {
        const auto whole = std::ranges::find_if(wholes, [&](std::size_t g) { return groups[g].name == part.group; });
        const bool named = whole != wholes.end();
        const auto index = static_cast<std::size_t>(whole - wholes.begin());
        sets.set_of_part.push_back(named && wanted[index] ? *wanted[index] : sets.count);
        if (sets.set_of_part.back() == sets.count) ++sets.count;
        if (named) wanted[index] = sets.set_of_part.back();
    }
    return sets;
}

}  // namespace

Result<GroupMatch> match_groups(const std::vector<Group>& groups, const Keyframe& keyframe, const Formation& formation,
                                std::size_t drones) {
    for (const Part& part : keyframe.parts) {
        const auto group = std::ranges::find(groups, part.group, &Group::name);
        if (group == groups.end() || !group->drones.empty()) continue;
        return Error{ErrorCode::infeasible, "group \"" + group->name +
                                                "\" is found by clustering the first keyframe: parts may take it from "
                                                "the second on"};
    }
    GroupMatch match;
    const Indices in_play = groups_in_play(groups, keyframe), wholes = whole_groups(groups, keyframe, in_play);
    std::vector<bool> grouped(drones, false);
    for (const std::size_t g : wholes) {
        match.drones.push_back(groups[g].drones);
        match.drones_inside.push_back(drones_inside(groups, g, in_play));
        for (const DroneId drone : groups[g].drones) {
            if (grouped[drone.value]) {
                return Error{ErrorCode::infeasible,
                             "assign = \"groups\": group \"" + groups[g].name + "\" shares drone " +
                                 std::to_string(drone.number()) +
                                 " with another; name in arrive.groups those that fly as wholes here"};
            }
            grouped[drone.value] = true;
        }
    }
    std::vector<DroneId> rest;
    for (std::size_t d = 0; d < drones; ++d) {
        if (!grouped[d]) rest.emplace_back(d);
    }
    if (!rest.empty()) {
        match.drones.push_back(rest);
        match.drones_inside.emplace_back();
    }
    match.wanted.resize(match.drones.size());

    const bool has_spares = !formation.spare.empty() && formation.spare.back();
    if (keyframe.parts.size() == 1 && keyframe.parts[0].group.empty() && !has_spares && match.drones.size() > 1) {
        std::vector<SlotId> all;
        for (std::size_t s = 0; s < formation.points_m.size(); ++s) all.emplace_back(s);
        Subsets<SlotId> dealt = runs(all, {match.drones, match.drones_inside});
        match.slots = std::move(dealt.sets);
        match.slots_inside = std::move(dealt.inside);
        return match;
    }
    PartSets sets = sets_of_parts(groups, keyframe, wholes, match.wanted);
    match.slots.resize(sets.count + (has_spares ? 1 : 0));
    sets.set_of_part.push_back(sets.count);  // spare slots are a set of their own
    for (std::size_t s = 0; s < formation.part.size(); ++s)
        match.slots[sets.set_of_part[formation.part[s]]].emplace_back(s);
    for (const std::vector<SlotId>& slots : match.slots) {
        const auto same_size = std::ranges::find(match.drones, slots.size(), &std::vector<DroneId>::size);
        match.slots_inside.push_back(
            same_size == match.drones.end()
                ? Subsets<SlotId>{}
                : runs(slots, match.drones_inside[static_cast<std::size_t>(same_size - match.drones.begin())]));
    }
    return match;
}

}  // namespace aerogram::planner
