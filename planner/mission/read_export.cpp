#include "planner/mission/sections.hpp"

namespace aerogram::planner {
namespace {

void take(TableReader& in, std::string_view key, const Range& range, std::optional<double>& value) {
    if (const auto given = in.number(key, range)) value = given;
}
void take(TableReader& in, std::string_view key, const Range& range, double& value) {
    value = in.number(key, range).value_or(value);
}

}  // namespace

void read_export(TableReader& root, Mission& mission) {
    auto in = root.table("export");
    if (!in) return;
    ExportWishes& wishes = mission.exporting;
    wishes.timing = in->choice<WaypointTiming>("timing", {{"none", WaypointTiming::none},
                                                          {"absolute", WaypointTiming::absolute},
                                                          {"speed", WaypointTiming::speed}})
                        .value_or(wishes.timing);
    if (const auto text = in->text("start_utc")) {
        wishes.start_utc_s = parse_utc(*text);
        if (!wishes.start_utc_s) in->bad("start_utc", R"(must be a moment such as "2026-12-31T22:00:00Z")");
    }
    wishes.autopilot =
        in->choice<Autopilot>("autopilot", {{"ardupilot", Autopilot::ardupilot}, {"px4", Autopilot::px4}})
            .value_or(wishes.autopilot);
    wishes.mission_items = static_cast<std::size_t>(
        in->integer("mission_items", 2, 65'535).value_or(static_cast<std::int64_t>(wishes.mission_items)));
    take(*in, "leg_speed_mps", more_than(0.0, 100.0), wishes.leg_speed_mps);
    take(*in, "leg_speed_up_mps", more_than(0.0, 100.0), wishes.leg_speed_up_mps);
    take(*in, "leg_speed_down_mps", more_than(0.0, 100.0), wishes.leg_speed_down_mps);
    take(*in, "leg_acceleration_mps2", more_than(0.0, 100.0), wishes.leg_acceleration_mps2);
    take(*in, "leg_jerk_mps3", more_than(0.0, 10'000.0), wishes.leg_jerk_mps3);
    take(*in, "slack_s", at_least(0.0, 600.0), wishes.slack_s);
    wishes.vviz = in->choice<VvizFlavour>("vviz", {{"verge", VvizFlavour::verge}, {"finale", VvizFlavour::finale}})
                      .value_or(wishes.vviz);
    in->finish();
}

void read_report(TableReader& root, Mission& mission) {
    auto in = root.table("report");
    if (!in) return;
    ReportWishes& wishes = mission.reporting;
    take(*in, "wind_mps", at_least(0.0, 50.0), wishes.wind_mps);
    take(*in, "reserve_percent", at_least(0.0, 90.0), wishes.reserve_percent);
    take(*in, "return_altitude_m", more_than(0.0, 10'000.0), wishes.return_altitude_m);
    const Limits& l = mission.limits;
    if (wishes.return_altitude_m &&
        (*wishes.return_altitude_m < l.min_navigation_altitude_m || *wishes.return_altitude_m > l.ceiling_m)) {
        in->bad("return_altitude_m", "must be from " + shown(l.min_navigation_altitude_m) +
                                         ", min_navigation_altitude_m, to " + shown(l.ceiling_m) + ", the ceiling");
    }
    take(*in, "return_layer_m", at_least(0.0, 100.0), wishes.return_layer_m);
    take(*in, "return_speed_mps", more_than(0.0, 100.0), wishes.return_speed_mps);
    take(*in, "land_speed_mps", more_than(0.0, 100.0), wishes.land_speed_mps);
    take(*in, "volume_gps_m", at_least(0.0, 100.0), wishes.volume_gps_m);
    take(*in, "volume_path_m", at_least(0.0, 100.0), wishes.volume_path_m);
    take(*in, "volume_map_m", at_least(0.0, 100.0), wishes.volume_map_m);
    take(*in, "volume_reaction_s", at_least(0.0, 60.0), wishes.volume_reaction_s);
    take(*in, "volume_bank_deg", Range{1.0, 80.0}, wishes.volume_bank_deg);
    in->finish();
}

}  // namespace aerogram::planner
