#include <algorithm>
#include <cmath>

#include "planner/mission/pads.hpp"
#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

constexpr std::size_t kMostDrones = 100000;
constexpr double kClosestPads_m = 0.2;

std::string pad_name(std::size_t index) {
    return "pad " + std::to_string(index + 1);
}

// rows, columns, spacing_m, center_m: all pads, spare ones too; empty when something is wrong.
Points read_grid(TableReader& pads, std::size_t drones) {
    pads.need("rows", "write pads = { rows = 2, columns = 5, spacing_m = 2.5 }");
    pads.need("columns", "write pads = { rows = 2, columns = 5, spacing_m = 2.5 }");
    pads.need("spacing_m", "write the distance between neighbouring pads in metres");
    const auto rows = pads.integer("rows", 1, std::int64_t{kMostDrones});
    const auto columns = pads.integer("columns", 1, std::int64_t{kMostDrones});
    const auto spacing_m = pads.number("spacing_m", at_least(kClosestPads_m, 1000.0));
    const Vec2 center_m = pads.vec2("center_m").value_or(Vec2{});
    if (!rows || !columns || !spacing_m || drones == 0) return {};
    const auto places = static_cast<std::size_t>(*rows * *columns);
    if (places < drones) {
        pads.bad("columns",
                 "rows x columns must be >= " + std::to_string(drones) + " drones, is " + std::to_string(places));
        return {};
    }
    return grid_pads({static_cast<std::size_t>(*rows), static_cast<std::size_t>(*columns), *spacing_m, center_m},
                     std::min(places, kMostDrones));
}

Points read_listed(TableReader& pads, std::size_t drones) {
    const auto file = pads.file("csv", "a CSV file with the header x_m,y_m[,z_m]");
    if (!file) return {};
    Result<Points> listed = read_pads_csv(*file);
    if (!listed) {
        pads.problems().add_elsewhere(pads.line_of("csv"), listed.error().message);
        return {};
    }
    if (listed->size() < drones) {
        pads.bad("csv", "must list >= " + std::to_string(drones) + " pads, one for each drone, lists " +
                            std::to_string(listed->size()));
        return {};
    }
    return *listed;
}

/// Pads closer than the separation are legal: the fleet then leaves and lands in layers, one after the other.
void check_spacing(TableReader& fleet, const Points& pads_m, const Limits& limits) {
    // Rounding of a regular grid must not make pads at exactly the distance too tight.
    const auto tight = find_tight_pads(pads_m, SeparationMetric{limits.downwash}, kClosestPads_m - 1e-9);
    if (!tight) return;
    fleet.bad("pads", pad_name(tight->first) + " and " + pad_name(tight->second) + " are " +
                          shown(std::round(tight->distance_m * 1000.0) / 1000.0) +
                          " m apart; must be >= " + shown(kClosestPads_m) + " m");
}

Points read_pads(TableReader& fleet, std::size_t drones) {
    if (!fleet.need("pads", "write pads = { rows = 2, columns = 5, spacing_m = 2.5 } or pads = { csv = \"pads.csv\" }"))
        return {};
    auto pads = fleet.table("pads");
    if (!pads) return {};
    const bool listed = pads->has("csv");
    const bool grid = pads->has("rows") || pads->has("columns") || pads->has("spacing_m") || pads->has("center_m");
    Points out;
    if (listed && grid) {
        pads->know({"rows", "columns", "spacing_m", "center_m"});
        pads->bad("csv",
                  "must not stand beside rows, columns, spacing_m or center_m: one or the other says where pads are");
    } else {
        out = listed ? read_listed(*pads, drones) : read_grid(*pads, drones);
    }
    pads->finish();
    return out;
}

}  // namespace

void read_fleet(TableReader& root, Mission& mission) {
    if (!root.need("fleet", "write [fleet] with drones and pads")) return;
    auto fleet = root.table("fleet");
    if (!fleet) return;
    mission.fleet.line = fleet->line();
    fleet->need("drones", "write drones = 10");
    mission.fleet.drones = static_cast<std::size_t>(fleet->integer("drones", 1, std::int64_t{kMostDrones}).value_or(0));
    mission.fleet.vehicle = fleet->choice<Vehicle>("vehicle", {{"copter", Vehicle::copter}, {"plane", Vehicle::plane}})
                                .value_or(mission.fleet.vehicle);
    if (auto spares = fleet->table("spares")) {
        mission.fleet.spares =
            spares
                ->choice<Spares>("where",
                                 {{"pads", Spares::pads}, {"wings", Spares::wings}, {"overflow", Spares::overflow}})
                .value_or(mission.fleet.spares);
        spares->finish();
    }
    mission.fleet.endurance_s =
        fleet->number("endurance_s", more_than(0.0, 86400.0)).value_or(mission.fleet.endurance_s);
    Points& pads_m = mission.fleet.pads_m;
    pads_m = read_pads(*fleet, mission.fleet.drones);
    check_spacing(*fleet, pads_m, mission.limits);
    if (pads_m.size() > mission.fleet.drones) {
        const auto first_spare = pads_m.begin() + static_cast<std::ptrdiff_t>(mission.fleet.drones);
        mission.fleet.spare_pads_m.assign(first_spare, pads_m.end());
        pads_m.erase(first_spare, pads_m.end());
    }
    fleet->finish();
}

}  // namespace aerogram::planner
