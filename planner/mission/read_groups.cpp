#include <algorithm>
#include <cmath>

#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

// `drones = "1-5,8"` or `drones = [1, 2, 8]`; empty when wrong.
std::vector<DroneId> read_drones(TableReader& group, std::size_t fleet) {
    if (group.later("cluster", "list the drones: drones = \"1-5,8\"")) return {};
    if (!group.need("drones", "write drones = \"1-5,8\" or drones = [1, 2, 8]")) return {};
    const TomlValue& value = *group.find("drones");
    std::string list;
    if (const auto* text = std::get_if<std::string>(&value.data)) {
        list = *text;
    } else if (const auto* array = std::get_if<TomlArray>(&value.data)) {
        for (const TomlValue& item : *array) {
            if (std::holds_alternative<std::string>(item.data)) {
                group.bad("drones",
                          "groups inside groups are not in this version; must be drone numbers such as [1, 2, 8]");
                return {};
            }
            const auto* number = std::get_if<std::int64_t>(&item.data);
            list += (list.empty() ? "" : ",") + (number ? std::to_string(*number) : std::string("?"));
        }
    }
    Result<std::vector<DroneId>> drones = parse_drone_list(list, fleet);
    if (drones) return std::move(drones).value();
    group.bad("drones", drones.error().message);
    return {};
}

std::optional<AdjacencyEnd> read_end(const TomlValue& value, const Mission& mission) {
    if (const auto* name = std::get_if<std::string>(&value.data)) {
        for (std::size_t i = 0; i < mission.groups.size(); ++i) {
            if (mission.groups[i].name == *name) return AdjacencyEnd{i};
        }
        return std::nullopt;
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
        group.drones = read_drones(in, mission.fleet.drones);
        group.weight = in.number("weight", more_than(0.0, 1e6)).value_or(group.weight);
        in.later("groups", "list the drones: drones = \"1-5,8\"");
        for (const Group& other : mission.groups) {
            if (!group.name.empty() && group.name == other.name) {
                in.bad("name", "must be unique; line " + std::to_string(other.line) + " has it too");
                group.name.clear();
            }
            const auto shared =
                std::find_first_of(group.drones.begin(), group.drones.end(), other.drones.begin(), other.drones.end());
            if (shared == group.drones.end()) continue;
            in.bad("drones", "drone " + std::to_string(shared->number()) + " is in group " + in_quotes(other.name) +
                                 " too; overlapping groups are not in this version");
            group.drones.clear();
        }
        in.finish();
        mission.groups.push_back(std::move(group));
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

void refuse_later_sections(TableReader& root) {
    for (TableReader& light : root.tables("light")) {
        root.problems().add(light.line(), light.path() + ": light effects are not in this version; remove [[light]]");
        light.need("effect", "write effect = \"sweep\"");
        light.text("effect");
        light.text("keyframe");
    }
    if (auto carrier = root.table("carrier")) {
        root.problems().add(carrier->line(), "carrier: not in this version; remove [carrier]");
        carrier->know({"waypoints_m"});
        carrier->number("speed_mps", more_than(0.0));
        carrier->finish();
    }
}

}  // namespace aerogram::planner
