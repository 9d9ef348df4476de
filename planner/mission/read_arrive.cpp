#include <algorithm>
#include <charconv>

#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

/// Full eigenbases are n × n and take time n³: beyond this a transition takes minutes and gigabytes.
constexpr std::size_t kMostSpectralDrones = 2000;

void read_spectral(TableReader& arrive, SpectralOptions& out) {
    auto in = arrive.table("spectral");
    if (!in) return;
    out.align = in->choice<Align>("align", {{"pca", Align::pca}, {"kabsch", Align::kabsch}, {"none", Align::none}})
                    .value_or(out.align);
    out.reorder = in->choice<Reorder>("reorder", {{"greedy", Reorder::greedy},
                                                  {"max-min", std::nullopt},
                                                  {"optimal", Reorder::optimal},
                                                  {"none", Reorder::none}})
                      .value_or(out.reorder);
    out.inflate = in->flag("inflate").value_or(out.inflate);
    in->finish();
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
                                              {"rigid", std::nullopt},
                                              {"auto", std::nullopt}})
                     .value_or(out.method);
    out.assign = in.choice<Assign>("assign", {{"shortest", Assign::shortest},
                                              {"keep", Assign::keep},
                                              {"groups", Assign::groups},
                                              {"bottleneck", std::nullopt},
                                              {"formation_coordinates", std::nullopt}})
                     .value_or(out.assign);
    out.profile = in.choice<ProfileKind>("profile", {{"minimum-jerk", ProfileKind::minimum_jerk},
                                                     {"trapezoid", ProfileKind::trapezoid},
                                                     {"s-curve", ProfileKind::s_curve}})
                      .value_or(out.profile);
    out.separation = in.choice<SeparationMethod>("separation", {{"projection", SeparationMethod::projection},
                                                                {"none", SeparationMethod::none},
                                                                {"social_force", std::nullopt}})
                         .value_or(out.separation);
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
    in->later("forbid", "pins say where a drone must fly");
    out.duration_s = in->number("duration_s", more_than(0.0, 86400.0));
    if (in->number("stagger_s", at_least(0.0)).value_or(0.0) > 0.0) in->later("stagger_s", "must be 0");
    read_spectral(*in, out.spectral);
    read_flow(*in, out.flow);
    const bool spectral =
        out.method == Method::spectral || (out.method == Method::flow && out.flow.of == FlowOf::spectral);
    if (spectral && mission.fleet.drones > kMostSpectralDrones) {
        in->bad("method", "spectral motion of more than " + std::to_string(kMostSpectralDrones) +
                              " drones is not in this version; must be \"straight\", or \"flow\" of positions");
    }
    in->later("groups", "one method moves the whole fleet");
    in->misplaced(source_keys(), "belongs to the keyframe; must stand before [keyframe.arrive]");
    constexpr std::string_view kOfKeyframe[] = {"name", "center_m", "rotate_deg", "color", "at_s", "hold_s", "motion"};
    in->misplaced(kOfKeyframe, "belongs to the keyframe; must stand before [keyframe.arrive]");
    in->finish();
    return out;
}

}  // namespace aerogram::planner
