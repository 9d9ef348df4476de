#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "export/base64.hpp"
#include "export/decimal.hpp"
#include "export/light_program.hpp"
#include "export/skybrush_frame.hpp"
#include "export/skyc.hpp"
#include "export/skyc_trajectory.hpp"
#include "export/zip.hpp"
#include "export/zip_peek.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::ordered_json;
using planner::ActRole, planner::FlightPlan;

/// The drones of one file: a fleet too large for one goes out as several.
struct Part {
    std::size_t number = 1, parts = 1;  ///< from 1
    std::size_t first = 0, end = 0;     ///< drones, 0-based
};

std::size_t part_count(const FlightPlan& plan) {
    return (plan.drones() + kSkycDrones - 1) / kSkycDrones;
}
Part part_of(const FlightPlan& plan, std::size_t number) {
    const std::size_t parts = part_count(plan);
    return {number, parts, (number - 1) * plan.drones() / parts, number * plan.drones() / parts};
}
std::string file_of(const Part& part) {
    return part.parts == 1 ? "show.skyc" : "show-" + std::to_string(part.number) + ".skyc";
}

constexpr double kEyeHeight_m = 1.7;

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

double rounded(double value, int digits) {
    return static_cast<double>(in_units(value, digits)) / std::pow(10.0, digits);
}

Json point(const Vec3& show_m) {
    const Vec3 p = to_skybrush(show_m);
    return {rounded(p.x, 3), rounded(p.y, 3), rounded(p.z, 3)};
}

Json seconds(Millis time_ms) {
    return seconds_from_ms(time_ms);
}

Json reference(const std::string& path) {
    return {{"$ref", "./" + path + "#"}};
}

/// A spectator in the middle, far enough back to see pads and keyframes, looking at their centre. A camera looks along
/// its -Z with +Y up: turned by 90° + pitch about X, then by -90° about Z, it looks along the show's +X with Z up.
Json audience_camera(const FlightPlan& plan) {
    Vec3 low = plan.pads_m.front(), high = low;
    const auto include = [&](const Points& points) {
        for (const Vec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
    };
    include(plan.pads_m);
    for (const planner::PlannedKeyframe& keyframe : plan.keyframes) include(keyframe.formation_m);
    const Vec3 center = 0.5 * (low + high);
    const double back_m = std::max(20.0, 1.2 * std::max(high.x - low.x, high.z - low.z));
    const Vec3 eye{center.x, low.y - back_m, kEyeHeight_m};
    const double turn = kPi / 2.0 + std::atan2(center.z - eye.z, center.y - eye.y);
    const double c = std::sqrt(0.5) * std::cos(turn / 2.0), s = std::sqrt(0.5) * std::sin(turn / 2.0);
    return {{"name", "Audience"},     {"type", "perspective"},
            {"position", point(eye)}, {"orientation", {rounded(c, 6), rounded(s, 6), rounded(-s, 6), rounded(-c, 6)}},
            {"focalLength", 36},      {"default", true}};
}

Json environment(const FlightPlan& plan) {
    Json result{{"type", "outdoor"}};
    const geo::ShowFrame frame(plan.origin);
    if (const auto amsl_m = frame.amsl_m(Vec3{})) {
        const geo::Geodetic& ground = plan.origin.ground;
        double orientation_deg = std::fmod(plan.origin.heading_deg, 360.0);
        if (orientation_deg < 0.0) orientation_deg += 360.0;
        result["location"] = {
            {"origin", {in_units(ground.latitude_deg, 7), in_units(ground.longitude_deg, 7), in_units(*amsl_m, 3)}},
            {"orientation", orientation_deg}};
    }
    result["cameras"] = Json::array({audience_camera(plan)});
    return result;
}

Json validation(const Limits& limits) {
    return {{"maxAltitude", limits.ceiling_m},
            {"maxVelocityXY", limits.speed_horizontal_mps},
            {"maxVelocityZ", limits.speed_down_mps},
            {"maxVelocityZUp", limits.speed_up_mps},
            {"maxAccelerationXY", limits.acceleration_mps2},
            {"maxAccelerationZ", limits.acceleration_mps2},
            {"minDistance", limits.min_separation_m},
            {"minNavAltitude", limits.min_navigation_altitude_m}};
}

/// The show's three parts: leading take-off acts, closing landing acts, and what is between.
Json segments(const FlightPlan& plan) {
    const auto not_takeoff = std::ranges::find_if(plan.acts, [](const auto& a) { return a.role != ActRole::takeoff; });
    const auto last = std::find_if(plan.acts.rbegin(), std::make_reverse_iterator(not_takeoff),
                                   [](const auto& a) { return a.role != ActRole::landing; });
    const Millis up_ms = not_takeoff == plan.acts.begin() ? 0 : std::prev(not_takeoff)->end_ms();
    const Millis down_ms = last.base() == plan.acts.end() ? plan.duration_ms() : last.base()->start_ms;
    Json result = Json::object();
    if (up_ms > 0) result["takeoff"] = {seconds(0), seconds(up_ms)};
    if (down_ms > up_ms) result["show"] = {seconds(up_ms), seconds(down_ms)};
    if (plan.duration_ms() > down_ms) result["landing"] = {seconds(down_ms), seconds(plan.duration_ms())};
    return result;
}

Json meta(const FlightPlan& plan, const Seal& seal, const Part& part) {
    std::string title = plan.name;
    if (!seal.certified) title.insert(0, kUncertifiedTitle);
    if (!plan.origin.geoid_undulation_m) title += kNoLocationTitle;
    Json own{{"certified", seal.certified},
             {"downwash", plan.limits.downwash},
             {"formationSpacing", plan.limits.formation_spacing_m},
             {"exportMargin", plan.limits.export_margin_m},
             {"maxJerk", plan.limits.jerk_mps3}};
    if (plan.origin.geoid_undulation_m) own["geoidUndulation"] = *plan.origin.geoid_undulation_m;
    if (part.parts > 1) own["part"] = {part.number, part.parts};
    return {{"title", title}, {"id", seal.show_hash}, {"segments", segments(plan)}, {"aerogram", own}};
}

/// Clockwise from +X, degrees; of keys at one time the last.
Json yaw_control(const std::vector<YawKey>& keys) {
    Json setpoints = Json::array();
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (k + 1 < keys.size() && keys[k + 1].time_ms == keys[k].time_ms) continue;
        setpoints.push_back({seconds(keys[k].time_ms), rounded(-degrees(keys[k].yaw_rad), 3)});
    }
    return {{"version", 1}, {"setpoints", setpoints}};
}

/// Only what switches on: a reader would fire at every event.
Json pyro(const std::vector<PayloadEvent>& events) {
    Json list = Json::array(), payloads = Json::object();
    for (const PayloadEvent& event : events) {
        if (!event.on) continue;
        const std::string key = "channel-" + std::to_string(event.channel);
        list.push_back({seconds(event.time_ms), event.channel, key});
        payloads[key] = {{"name", "channel " + std::to_string(event.channel)}};
    }
    if (list.empty()) return {};
    return {{"version", 1}, {"events", list}, {"payloads", payloads}};
}

Json drone(const FlightPlan& plan, std::size_t i) {
    const std::string name = drone_name(i + 1, plan.drones());
    const Tracks tracks = i < plan.tracks.size() ? plan.tracks[i] : Tracks{};
    Json settings{{"name", name},
                  {"home", point(plan.pads_m[i])},
                  {"landAt", point(plan.pads_m[i])},
                  {"trajectory", reference("drones/" + name + "/trajectory.json")},
                  {"lights", reference("drones/" + name + "/lights.json")}};
    if (!tracks.yaw.empty()) settings["yawControl"] = yaw_control(tracks.yaw);
    if (Json events = pyro(tracks.events); !events.is_null()) settings["pyro"] = std::move(events);
    return {{"type", "generic"}, {"settings", settings}};
}

std::string show_json(const FlightPlan& plan, const Seal& seal, const Part& part) {
    Json drones = Json::array();
    for (std::size_t i = part.first; i < part.end; ++i) drones.push_back(drone(plan, i));
    const Json show{{"version", 1},
                    {"swarm", {{"drones", std::move(drones)}}},
                    {"environment", environment(plan)},
                    {"settings", {{"cues", reference("cues.json")}, {"validation", validation(plan.limits)}}},
                    {"meta", meta(plan, seal, part)}};
    return text_of(show);
}

std::string cues_json(const std::vector<Cue>& cues) {
    Json items = Json::array();
    for (const Cue& cue : cues) items.push_back(Json{{"name", cue.name}, {"time", seconds(cue.time_ms)}});
    return text_of(Json{{"version", 1}, {"items", items}});
}

std::string lights_json(const FlightPlan& plan, std::size_t i) {
    const std::vector<LightKey> keys = i < plan.tracks.size() ? plan.tracks[i].lights : std::vector<LightKey>{};
    return text_of(Json{{"version", 1}, {"data", base64_encoded(light_program(keys, plan.duration_ms()))}});
}

std::string unsuited(const FlightPlan& plan) {
    if (plan.limits.plane) return "planes: the format is for drones that take off, hover and land";
    return skyc_misfit(plan);
}

Result<std::vector<std::string>> write(const FlightPlan& plan, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    std::vector<std::string> files;
    for (std::size_t number = 1; number <= part_count(plan); ++number) {
        const Part part = part_of(plan, number);
        auto trajectories = skyc_trajectories(plan, part.first, part.end, run);
        if (!trajectories) return trajectories.error();
        std::vector<PackedEntry> entries(2 + 2 * trajectories->size());
        entries[0] = packed_entry("show.json", show_json(plan, seal, part));
        entries[1] = packed_entry("cues.json", cues_json(plan.cues));
        parallel_for(trajectories->size(), run, "skyc", [&](std::size_t k) {
            const std::size_t i = part.first + k;
            const std::string place = "drones/" + drone_name(i + 1, plan.drones()) + "/";
            entries[2 + 2 * k] = packed_entry(place + "trajectory.json", (*trajectories)[k]);
            entries[3 + 2 * k] = packed_entry(place + "lights.json", lights_json(plan, i));
        });
        if (run.stopped()) return stopped_error();
        files.push_back(file_of(part));
        if (const Status written = write_zip(folder / files.back(), entries); !written) return written.error();
    }
    return files;
}

bool recognises(std::string_view path, std::string_view first_bytes) {
    const auto entry = first_zip_entry(first_bytes);
    return entry && (path.ends_with(".skyc") || *entry == "show.json");
}

constexpr Format kSkyc{
    "skyc",  "Skybrush compiled show: curves, lights, yaw, pyro, cues, cameras", "exact", write, read_skyc, recognises,
    unsuited};

}  // namespace

const Format& skyc_format() {
    return kSkyc;
}

}  // namespace aerogram::exporter
