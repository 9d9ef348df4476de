#include <algorithm>
#include <cmath>

#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

constexpr std::int64_t kMostGroups = 10000;

std::optional<std::size_t> group_named(const Mission& mission, std::string_view name) {
    const auto found = std::ranges::find(mission.groups, name, &Group::name);
    if (name.empty() || found == mission.groups.end()) return std::nullopt;
    return static_cast<std::size_t>(found - mission.groups.begin());
}

// One member of `drones = [1, 2, "wing-left"]`: a number joins the list, a name adds that group; false when wrong.
bool read_member(TableReader& in, const TomlValue& item, const Mission& mission, std::string& list, Group& group) {
    if (const auto* name = std::get_if<std::string>(&item.data)) {
        const auto index = group_named(mission, *name);
        if (!index) {
            in.bad("drones", "no [[group]] before this one is called " + in_quotes(*name));
            return false;
        }
        group.inside.push_back(*index);
        const auto& members = mission.groups[*index].drones;
        if (members.empty() && mission.fleet.drones > 0) {
            in.bad("drones", in_quotes(*name) + " is filled by cluster: groups around it are not in this version");
            return false;
        }
        group.drones.insert(group.drones.end(), members.begin(), members.end());
        return true;
    }
    const auto* number = std::get_if<std::int64_t>(&item.data);
    list += (list.empty() ? "" : ",") + (number ? std::to_string(*number) : std::string("?"));
    return true;
}

// `drones = "1-5,8"`, `drones = [1, 2, 8]` or `drones = ["wing-left", "wing-right", 9]`; empty when wrong.
void read_drones(TableReader& in, const Mission& mission, Group& group) {
    const TomlValue& value = *in.find("drones");
    std::string list;
    if (const auto* text = std::get_if<std::string>(&value.data)) list = *text;
    const auto* array = std::get_if<TomlArray>(&value.data);
    for (std::size_t i = 0; array && i < array->size(); ++i) {
        if (!read_member(in, (*array)[i], mission, list, group)) {
            group.drones.clear();
            return;
        }
    }
    if (!list.empty() || group.inside.empty()) {
        Result<std::vector<DroneId>> listed = parse_drone_list(list, mission.fleet.drones);
        if (!listed) {
            in.bad("drones", listed.error().message);
            group.drones.clear();
            return;
        }
        group.drones.insert(group.drones.end(), listed->begin(), listed->end());
    }
    std::sort(group.drones.begin(), group.drones.end());
    const auto twice = std::adjacent_find(group.drones.begin(), group.drones.end());
    if (twice == group.drones.end()) return;
    in.bad("drones", "holds drone " + std::to_string(twice->number()) + " twice");
    group.drones.clear();
}

// `split = [35, 6]`: consecutive groups of equal size, 35 of them, each of 6 more. `parent` is already in the mission.
void split(TableReader& in, Mission& mission, std::size_t parent, std::span<const std::int64_t> counts) {
    if (counts.empty()) return;
    const auto count = static_cast<std::size_t>(counts.front());
    const std::size_t size = mission.groups[parent].drones.size();
    if (size % count != 0) {
        in.bad("split", "must divide the " + std::to_string(size) + " drones of " +
                            in_quotes(mission.groups[parent].name) + " into equal groups");
        return;
    }
    for (std::size_t k = 0; k < count; ++k) {
        Group part;
        part.name = mission.groups[parent].name + "-" + std::to_string(k + 1);
        part.weight = mission.groups[parent].weight;
        part.line = mission.groups[parent].line;
        const auto first = mission.groups[parent].drones.begin() + static_cast<std::ptrdiff_t>(k * (size / count));
        part.drones.assign(first, first + static_cast<std::ptrdiff_t>(size / count));
        mission.groups[parent].inside.push_back(mission.groups.size());
        mission.groups.push_back(std::move(part));
        split(in, mission, mission.groups.size() - 1, counts.subspan(1));
    }
}

void read_split(TableReader& in, Mission& mission, std::size_t parent) {
    if (!in.has("split")) return;
    const auto numbers = in.numbers("split", 1, 8, "counts of groups, level by level: [35, 6]", {1.0, 10000.0});
    if (!numbers || mission.groups[parent].drones.empty()) return;
    std::vector<std::int64_t> counts;
    double total = 1.0;
    for (const double count : *numbers) {
        counts.push_back(std::llround(count));
        total *= count;
        if (std::abs(count - std::round(count)) > 0.0 || total > static_cast<double>(kMostGroups)) {
            in.bad("split", "must be whole numbers that make at most " + std::to_string(kMostGroups) + " groups");
            return;
        }
    }
    split(in, mission, parent, counts);
}

// `cluster = { count = 6, method = "spectral" }`: groups NAME-1 .. NAME-6, filled by the planner.
void read_cluster(TableReader& in, Mission& mission, std::size_t parent) {
    auto cluster = in.table("cluster");
    if (!cluster) return;
    cluster->need("count", "write how many groups to find: count = 6");
    cluster->choice<int>("method", {{"spectral", 0}});
    const auto most = static_cast<std::int64_t>(std::max<std::size_t>(1, mission.groups[parent].drones.size()));
    const auto count = cluster->integer("count", 1, std::min(kMostGroups, most));
    cluster->finish();
    if (!count) return;
    mission.groups[parent].cluster = Cluster{static_cast<std::size_t>(*count)};
    for (std::int64_t k = 0; k < *count; ++k) {
        Group part;
        part.name = mission.groups[parent].name + "-" + std::to_string(k + 1);
        part.weight = mission.groups[parent].weight;
        part.line = mission.groups[parent].line;
        mission.groups[parent].inside.push_back(mission.groups.size());
        mission.groups.push_back(std::move(part));
    }
}

std::optional<AdjacencyEnd> read_end(const TomlValue& value, const Mission& mission) {
    if (const auto* name = std::get_if<std::string>(&value.data)) {
        const auto group = group_named(mission, *name);
        return group ? std::optional(AdjacencyEnd{*group}) : std::nullopt;
    }
    const auto* number = std::get_if<std::int64_t>(&value.data);
    const bool in_fleet = number && *number >= 1 &&
                          (mission.fleet.drones == 0 || static_cast<std::size_t>(*number) <= mission.fleet.drones);
    if (!in_fleet) return std::nullopt;
    return AdjacencyEnd{DroneId::from_number(static_cast<std::size_t>(*number))};
}

// Whether the two ends have a drone in common and nothing else.
bool same_end(const AdjacencyEnd& a, const AdjacencyEnd& b) {
    const auto* drone_a = std::get_if<DroneId>(&a.who);
    const auto* drone_b = std::get_if<DroneId>(&b.who);
    return drone_a && drone_b && *drone_a == *drone_b;
}

void read_edit(TableReader& in, Mission& mission) {
    AdjacencyEdit edit;
    edit.line = in.line();
    in.need("between", "write between = [\"wing-left\", 7]");
    in.need("weight", "write weight = 4; 0 cuts");
    edit.weight = in.number("weight", at_least(0.0, 1e6)).value_or(1.0);
    if (const TomlValue* between = in.find("between")) {
        const auto* ends = std::get_if<TomlArray>(&between->data);
        const auto first = ends && ends->size() == 2 ? read_end((*ends)[0], mission) : std::nullopt;
        const auto second = first ? read_end((*ends)[1], mission) : std::nullopt;
        if (!first || !second) {
            const std::string most =
                mission.fleet.drones > 0 ? " from 1 to " + std::to_string(mission.fleet.drones) : "";
            in.bad("between", "must be two of: a group's name, a drone number" + most);
        } else if (same_end(*first, *second)) {
            in.bad("between", "must be two different drones");
        } else {
            edit.first = *first;
            edit.second = *second;
            mission.adjacency.push_back(edit);
        }
    }
    in.finish();
}

}  // namespace

void read_groups(TableReader& root, Mission& mission) {
    for (TableReader& in : root.tables("group")) {
        Group group;
        group.line = in.line();
        in.need("name", "write name = \"wing-left\"");
        group.name = in.name("name").value_or("");
        if (in.has("drones")) {
            read_drones(in, mission, group);
        } else if (in.has("cluster") || in.has("split")) {
            for (std::size_t d = 0; d < mission.fleet.drones; ++d) group.drones.emplace_back(d);
        } else {
            in.need("drones", "write drones = \"1-5,8\", drones = [1, 2, 8] or cluster = { count = 6 }");
        }
        group.weight = in.number("weight", more_than(0.0, 1e6)).value_or(group.weight);
        if (in.has("cluster") && in.has("split")) in.bad("split", "must not stand beside cluster");
        if (const auto other = group_named(mission, group.name)) {
            in.bad("name", "must be unique; line " + std::to_string(mission.groups[*other].line) + " has it too");
            group.name.clear();
        }
        mission.groups.push_back(std::move(group));
        const std::size_t parent = mission.groups.size() - 1;
        read_split(in, mission, parent);
        if (!in.has("split")) read_cluster(in, mission, parent);
        in.finish();
    }
}

void read_cues(TableReader& root, Mission& mission) {
    for (TableReader& in : root.tables("cue")) {
        in.need("name", "write name = \"finale\"");
        in.need("at_s", "write the show time in seconds: at_s = 95.0");
        Cue cue;
        cue.name = in.name("name").value_or("");
        cue.time_ms = std::llround(1000.0 * in.number("at_s", at_least(0.0, 86400.0)).value_or(0.0));
        in.finish();
        mission.cues.push_back(std::move(cue));
    }
    std::stable_sort(mission.cues.begin(), mission.cues.end(),
                     [](const Cue& a, const Cue& b) { return a.time_ms < b.time_ms; });
}

void read_adjacency(TableReader& root, Mission& mission) {
    for (TableReader& in : root.tables("adjacency")) read_edit(in, mission);
}

}  // namespace aerogram::planner
