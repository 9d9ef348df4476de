#include <algorithm>
#include <charconv>
#include <iterator>

#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

SpectralOptions read_spectral(TableReader& arrive, SpectralOptions out) {
    auto in = arrive.table("spectral");
    if (!in) return out;
    out.align = in->choice<Align>("align", {{"pca", Align::pca}, {"kabsch", Align::kabsch}, {"none", Align::none}})
                    .value_or(out.align);
    out.reorder = in->choice<Reorder>("reorder", {{"greedy", Reorder::greedy},
                                                  {"max-min", Reorder::max_min},
                                                  {"optimal", Reorder::optimal},
                                                  {"none", Reorder::none}})
                      .value_or(out.reorder);
    out.inflate = in->flag("inflate").value_or(out.inflate);
    in->finish();
    return out;
}

void read_flow(TableReader& arrive, FlowOptions& out) {
    auto in = arrive.table("flow");
    if (!in) return;
    out.tension = in->number("tension", {0.0, 1.0}).value_or(out.tension);
    out.corner = in->flag("corner").value_or(out.corner);
    out.of =
        in->choice<FlowOf>("of", {{"positions", FlowOf::positions}, {"spectral", FlowOf::spectral}}).value_or(out.of);
    in->finish();
}

// `pins = { 3 = 17 }`: drone 3 flies to slot 17.
std::map<DroneId, SlotId> read_pins(TableReader& arrive, std::size_t fleet) {
    std::map<DroneId, SlotId> pins;
    std::map<SlotId, DroneId> taken;
    auto in = arrive.table("pins");
    if (!in) return pins;
    const auto most = fleet == 0 ? std::size_t{100000} : fleet;
    const std::string up_to = "from 1 to " + std::to_string(most);
    for (const TomlEntry& entry : in->entries()) {
        const auto wrong = [&](const std::string& what) {
            arrive.problems().add(entry.line,
                                  in->path() + "." + in_quotes(entry.key) + " = " + shown(entry.value) + ": " + what);
        };
        std::size_t drone = 0;
        const char* last = entry.key.data() + entry.key.size();
        const auto [end, error] = std::from_chars(entry.key.data(), last, drone);
        const auto* slot = std::get_if<std::int64_t>(&entry.value.data);
        if (error != std::errc{} || end != last || drone < 1 || drone > most) {
            wrong("the key must be a drone number " + up_to);
        } else if (!slot || *slot < 1 || *slot > static_cast<std::int64_t>(most)) {
            wrong("must be a slot number " + up_to);
        } else if (pins.contains(DroneId::from_number(drone))) {
            wrong("drone " + std::to_string(drone) + " is pinned already");
        } else {
            const SlotId place = SlotId::from_number(static_cast<std::size_t>(*slot));
            const auto [other, is_new] = taken.emplace(place, DroneId::from_number(drone));
            if (!is_new)
                wrong("drone " + std::to_string(other->second.number()) + " is pinned to slot " +
                      std::to_string(*slot) + " already");
            if (is_new) pins.emplace(DroneId::from_number(drone), place);
        }
    }
    return pins;
}

void read_choices(TableReader& in, Arrive& out) {
    out.method = in.choice<Method>("method", {{"straight", Method::straight},
                                              {"spectral", Method::spectral},
                                              {"flow", Method::flow},
                                              {"rigid", Method::rigid},
                                              {"steered", Method::steered},
                                              {"auto", Method::automatic}})
                     .value_or(out.method);
    out.assign = in.choice<Assign>("assign", {{"shortest", Assign::shortest},
                                              {"keep", Assign::keep},
                                              {"groups", Assign::groups},
                                              {"bottleneck", Assign::bottleneck},
                                              {"slots", Assign::slots},
                                              {"formation_coordinates", Assign::formation_coordinates}})
                     .value_or(out.assign);
    out.profile = in.choice<ProfileKind>("profile", {{"minimum-jerk", ProfileKind::minimum_jerk},
                                                     {"trapezoid", ProfileKind::trapezoid},
                                                     {"s-curve", ProfileKind::s_curve}})
                      .value_or(out.profile);
    out.separation = in.choice<SeparationMethod>("separation", {{"projection", SeparationMethod::projection},
                                                                {"none", SeparationMethod::none},
                                                                {"social_force", SeparationMethod::social_force}})
                         .value_or(out.separation);
}

// `forbid = [[4, 9]]`: drone 4 may not fly to slot 9.
std::set<std::pair<DroneId, SlotId>> read_forbid(TableReader& arrive, const Arrive& out, std::size_t fleet) {
    std::set<std::pair<DroneId, SlotId>> forbidden;
    if (!arrive.has("forbid")) return forbidden;
    const auto* pairs = std::get_if<TomlArray>(&arrive.find("forbid")->data);
    const auto most = static_cast<std::int64_t>(fleet == 0 ? std::size_t{100000} : fleet);
    const std::string form = "must be a list of [drone, slot] pairs, numbers from 1 to " + std::to_string(most);
    if (!pairs) arrive.bad("forbid", form);
    for (std::size_t k = 0; pairs && k < pairs->size(); ++k) {
        const auto* pair = std::get_if<TomlArray>(&(*pairs)[k].data);
        const auto number = [&](std::size_t i) {
            const auto* n = pair && pair->size() == 2 ? std::get_if<std::int64_t>(&(*pair)[i].data) : nullptr;
            return n && *n >= 1 && *n <= most ? static_cast<std::size_t>(*n) : std::size_t{0};
        };
        if (number(0) == 0 || number(1) == 0) {
            arrive.bad("forbid", form);
            break;
        }
        const std::pair<DroneId, SlotId> place{DroneId::from_number(number(0)), SlotId::from_number(number(1))};
        const auto pin = out.pins.find(place.first);
        if (pin != out.pins.end() && pin->second == place.second) {
            arrive.bad("forbid",
                       "drone " + std::to_string(number(0)) + " is pinned to slot " + std::to_string(number(1)));
        }
        forbidden.insert(place);
    }
    return forbidden;
}

// Method, blend and spectral options of one level of a hierarchy; what is not said is as for the fleet.
GroupMove read_move(TableReader& in, const Arrive& fleet) {
    GroupMove move;
    const Method usual =
        fleet.method == Method::spectral || fleet.method == Method::rigid ? fleet.method : Method::straight;
    move.method =
        in.choice<Method>("method",
                          {{"straight", Method::straight}, {"spectral", Method::spectral}, {"rigid", Method::rigid}})
            .value_or(usual);
    move.blend = in.number("blend", {0.0, 1.0}).value_or(1.0);
    move.spectral = read_spectral(in, fleet.spectral);
    return move;
}

void add_levels(const Mission& mission, std::size_t parent, std::span<const GroupMove> levels, Arrive& out) {
    if (levels.empty()) return;
    for (const std::size_t child : mission.groups[parent].inside) {
        const bool named = std::ranges::find(out.groups, child, &GroupMove::group) != out.groups.end();
        if (!named) {
            out.groups.push_back(levels.front());
            out.groups.back().group = child;
        }
        add_levels(mission, child, levels.subspan(1), out);
    }
}

bool overlap_partly(const std::vector<DroneId>& a, const std::vector<DroneId>& b) {
    std::vector<DroneId> both;
    std::ranges::set_intersection(a, b, std::back_inserter(both));
    return !both.empty() && both.size() != a.size() && both.size() != b.size();
}

// `groups = { wing-left = { method = "rigid", blend = 1.0, levels = [{ method = "spectral" }] } }`.
void read_moves(TableReader& arrive, const Mission& mission, Arrive& out) {
    auto in = arrive.table("groups");
    if (!in) return;
    std::vector<std::pair<std::size_t, std::vector<GroupMove>>> deeper;
    for (const TomlEntry& entry : in->entries()) {
        const auto group = std::ranges::find(mission.groups, entry.key, &Group::name);
        auto table = in->table(entry.key);
        if (!table) continue;
        if (group == mission.groups.end()) {
            in->bad(entry.key, "no [[group]] is called " + in_quotes(entry.key));
            continue;
        }
        GroupMove move = read_move(*table, out);
        move.group = static_cast<std::size_t>(group - mission.groups.begin());
        std::vector<GroupMove> levels;
        for (TableReader& level : table->tables("levels")) {
            levels.push_back(read_move(level, out));
            level.finish();
        }
        if (!levels.empty() && group->inside.empty()) {
            table->bad("levels", "the group " + in_quotes(entry.key) + " has no groups inside");
        }
        for (const GroupMove& other : out.groups) {
            if (!overlap_partly(group->drones, mission.groups[other.group].drones)) continue;
            in->bad(entry.key, "shares some drones with " + in_quotes(mission.groups[other.group].name) +
                                   "; groups of one arrival must be apart or one inside the other");
        }
        out.groups.push_back(move);
        deeper.emplace_back(move.group, std::move(levels));
        table->finish();
    }
    for (const auto& [group, levels] : deeper) add_levels(mission, group, levels, out);
    if (!out.groups.empty() && out.method == Method::steered)
        arrive.bad("groups", "a steered fleet has its own groups: those of the mission; leave out groups");
    if (!out.groups.empty() && out.method == Method::flow) {
        arrive.bad("groups", "a flow moves the whole fleet; leave out groups, or choose another method");
    }
}

// `steer = { w1 = 0.4, w2 = 0.2, w3 = 0.3, w4 = 0.1 }`: paper 002, equation 4.
void read_steer(TableReader& arrive, Arrive& out) {
    auto in = arrive.table("steer");
    if (!in) return;
    if (out.method != Method::steered) arrive.bad("steer", "needs method = \"steered\"");
    out.steer.w1 = in->number("w1", {0.0, 1.0, true}).value_or(out.steer.w1);
    out.steer.w2 = in->number("w2", {0.0, 1.0}).value_or(out.steer.w2);
    out.steer.w3 = in->number("w3", {0.0, 1.0, true}).value_or(out.steer.w3);
    out.steer.w4 = in->number("w4", {0.0, 1.0}).value_or(out.steer.w4);
    out.steer.face_course = in->flag("face_course").value_or(false);
    in->finish();
}

void read_timing(TableReader& in, const Mission& mission, Arrive& out) {
    out.duration_s = in.number("duration_s", more_than(0.0, 86400.0));
    out.stagger_s = in.number("stagger_s", at_least(0.0, 3600.0)).value_or(0.0);
    if (out.stagger_s > 0.0 && (out.method != Method::straight || in.has("groups"))) {
        in.bad("stagger_s", "needs method = \"straight\" without groups");
    }
    const double least_m = mission.limits.min_separation_m;
    out.min_separation_m = in.number("min_separation_m", at_least(least_m, 1000.0));
}

}  // namespace

Arrive read_arrive(TableReader& keyframe, const Mission& mission) {
    Arrive out;
    out.line = keyframe.line_of("arrive");
    auto in = keyframe.table("arrive");
    if (!in) return out;
    read_choices(*in, out);
    if (out.assign == Assign::groups && mission.groups.empty()) in->bad("assign", "needs at least one [[group]]");
    out.pins = read_pins(*in, mission.fleet.drones);
    out.forbid = read_forbid(*in, out, mission.fleet.drones);
    read_timing(*in, mission, out);
    out.spectral = read_spectral(*in, out.spectral);
    read_flow(*in, out.flow);
    read_steer(*in, out);
    read_moves(*in, mission, out);
    in->misplaced(source_keys(), "belongs to the keyframe; must stand before [keyframe.arrive]");
    constexpr std::string_view kOfKeyframe[] = {"name", "center_m", "rotate_deg", "color", "at_s", "hold_s", "motion"};
    in->misplaced(kOfKeyframe, "belongs to the keyframe; must stand before [keyframe.arrive]");
    in->finish();
    return out;
}

}  // namespace aerogram::planner
