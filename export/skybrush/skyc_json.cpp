#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "export/bytes/base64.hpp"
#include "export/bytes/decimal.hpp"
#include "export/bytes/zip.hpp"
#include "export/bytes/zip_peek.hpp"
#include "export/outgoing/facts_json.hpp"
#include "export/skybrush/light_program.hpp"
#include "export/skybrush/skybrush_frame.hpp"
#include "export/skybrush/skyc.hpp"
#include "export/skybrush/skyc_audio.hpp"
#include "export/skybrush/skyc_trajectory.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using Json = nlohmann::ordered_json;

/// The drones of one file: a fleet too large for one goes out as several.
struct Part {
    std::size_t number = 1, parts = 1;  ///< from 1
    std::size_t first = 0, end = 0;     ///< drones, 0-based
};

std::size_t part_count(const OutgoingShow& show) {
    return (show.drones() + kSkycDrones - 1) / kSkycDrones;
}
Part part_of(const OutgoingShow& show, std::size_t number) {
    const std::size_t parts = part_count(show);
    return {number, parts, (number - 1) * show.drones() / parts, number * show.drones() / parts};
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
Json audience_camera(const OutgoingFacts& facts) {
    Vec3 low = facts.drones.front().home_m, high = low;
    const auto include = [&](const Vec3& p) { low = glm::min(low, p), high = glm::max(high, p); };
    for (const OutgoingDrone& drone : facts.drones) include(drone.home_m);
    for (const OutgoingKeyframe& keyframe : facts.keyframes) std::ranges::for_each(keyframe.places_m, include);
    const Vec3 center = 0.5 * (low + high);
    const double back_m = std::max(20.0, 1.2 * std::max(high.x - low.x, high.z - low.z));
    const Vec3 eye{center.x, low.y - back_m, kEyeHeight_m};
    const double turn = kPi / 2.0 + std::atan2(center.z - eye.z, center.y - eye.y);
    const double c = std::sqrt(0.5) * std::cos(turn / 2.0), s = std::sqrt(0.5) * std::sin(turn / 2.0);
    return {{"name", "Audience"},     {"type", "perspective"},
            {"position", point(eye)}, {"orientation", {rounded(c, 6), rounded(s, 6), rounded(-s, 6), rounded(-c, 6)}},
            {"focalLength", 36},      {"default", true}};
}

Json environment(const OutgoingFacts& facts) {
    Json result{{"type", "outdoor"}};
    if (facts.origin && facts.origin->geoid_undulation_m) {
        const geo::Geodetic& ground = facts.origin->ground;
        double orientation_deg = std::fmod(facts.origin->heading_deg, 360.0);
        if (orientation_deg < 0.0) orientation_deg += 360.0;
        const double amsl_m = geo::ShowFrame(*facts.origin).amsl_m(Vec3{}).value();
        result["location"] = {
            {"origin", {in_units(ground.latitude_deg, 7), in_units(ground.longitude_deg, 7), in_units(amsl_m, 3)}},
            {"orientation", orientation_deg}};
    }
    result["cameras"] = Json::array({audience_camera(facts)});
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

/// The show's three parts: climbing, what is between, sinking.
Json segments(const OutgoingFacts& facts) {
    const Millis up_ms = facts.takeoff_end_ms, down_ms = facts.landing_begin_ms, end_ms = facts.duration_ms;
    Json result = Json::object();
    if (up_ms > 0) result["takeoff"] = {seconds(0), seconds(up_ms)};
    if (down_ms > up_ms) result["show"] = {seconds(up_ms), seconds(down_ms)};
    if (end_ms > down_ms) result["landing"] = {seconds(down_ms), seconds(end_ms)};
    return result;
}

Json meta(const OutgoingFacts& facts, const Seal& seal, const Part& part) {
    std::string title = facts.title;
    if (!seal.certified) title.insert(0, kUncertifiedTitle);
    if (!facts.origin || !facts.origin->geoid_undulation_m) title += kNoLocationTitle;
    Json own{{"certified", seal.certified},
             {"downwash", facts.limits.downwash},
             {"formationSpacing", facts.limits.formation_spacing_m},
             {"exportMargin", facts.limits.export_margin_m},
             {"maxJerk", facts.limits.jerk_mps3}};
    if (facts.origin && facts.origin->geoid_undulation_m) own["geoidUndulation"] = *facts.origin->geoid_undulation_m;
    if (part.parts > 1) own["part"] = {part.number, part.parts};
    const Json all = Json::parse(facts_json(facts, seal));
    own["facts"] = {{"endurance_s", all["endurance_s"]}, {"airspace", all["airspace"]}};
    return {{"title", title}, {"id", seal.show_hash}, {"segments", segments(facts)}, {"aerogram", own}};
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

Json drone_settings(const OutgoingDrone& drone, const Tracks& tracks) {
    Json settings{{"name", drone.name},
                  {"home", point(drone.home_m)},
                  {"landAt", point(drone.land_m)},
                  {"trajectory", reference("drones/" + drone.name + "/trajectory.json")},
                  {"lights", reference("drones/" + drone.name + "/lights.json")}};
    if (!tracks.yaw.empty()) settings["yawControl"] = yaw_control(tracks.yaw);
    if (Json events = pyro(tracks.events); !events.is_null()) settings["pyro"] = std::move(events);
    return {{"type", "generic"}, {"settings", settings}};
}

std::string show_json(const OutgoingShow& show, const Seal& seal, const Part& part,
                      const std::optional<SkycAudio>& audio) {
    const OutgoingFacts& facts = show.facts();
    Json drones = Json::array();
    for (std::size_t i = part.first; i < part.end; ++i)
        drones.push_back(drone_settings(facts.drones[i], show.tracks(i)));
    Json json{{"version", 1},
              {"swarm", {{"drones", std::move(drones)}}},
              {"environment", environment(facts)},
              {"settings", {{"cues", reference("cues.json")}, {"validation", validation(facts.limits)}}},
              {"meta", meta(facts, seal, part)}};
    if (audio)
        json["media"] = {{"audio",
                          {{"data", {{"$ref", "./" + audio->entry}}},
                           {"filename", audio->entry},
                           {"mediaType", audio->media_type},
                           {"startTime", 0}}}};
    return text_of(json);
}

std::string cues_json(const std::vector<Cue>& cues) {
    Json items = Json::array();
    for (const Cue& cue : cues) items.push_back(Json{{"name", cue.name}, {"time", seconds(cue.time_ms)}});
    return text_of(Json{{"version", 1}, {"items", items}});
}

std::string lights_json(const OutgoingShow& show, std::size_t i) {
    const auto program = light_program(show.tracks(i).lights, show.facts().duration_ms);
    return text_of(Json{{"version", 1}, {"data", base64_encoded(program)}});
}

std::string unsuited(const OutgoingShow& show) {
    if (show.facts().limits.plane) return "planes: the format is for drones that take off, hover and land";
    if (std::string why = skyc_audio_problem(show.facts().audio); !why.empty()) return why;
    return skyc_misfit(show);
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    const auto audio = skyc_audio(show.facts().audio);
    if (!audio) return audio.error();
    std::vector<std::string> files;
    for (std::size_t number = 1; number <= part_count(show); ++number) {
        const Part part = part_of(show, number);
        auto trajectories = skyc_trajectories(show, part.first, part.end, run);
        if (!trajectories) return trajectories.error();
        std::vector<PackedEntry> entries(2 + 2 * trajectories->size());
        entries[0] = packed_entry("show.json", show_json(show, seal, part, *audio));
        entries[1] = packed_entry("cues.json", cues_json(show.facts().cues));
        parallel_for(trajectories->size(), run, "skyc", [&](std::size_t k) {
            const std::size_t i = part.first + k;
            const std::string place = "drones/" + show.facts().drones[i].name + "/";
            entries[2 + 2 * k] = packed_entry(place + "trajectory.json", (*trajectories)[k]);
            entries[3 + 2 * k] = packed_entry(place + "lights.json", lights_json(show, i));
        });
        if (run.stopped()) return stopped_error();
        if (*audio) entries.push_back(packed_entry((*audio)->entry, (*audio)->bytes));
        files.push_back(file_of(part));
        if (const Status written = write_zip(folder / files.back(), entries); !written) return written.error();
    }
    return files;
}

bool recognises(std::string_view path, std::string_view first_bytes) {
    const auto entry = first_zip_entry(first_bytes);
    return entry && (path.ends_with(".skyc") || *entry == "show.json");
}

constexpr Format kSkyc{"skyc",     "Skybrush compiled show: curves, lights, yaw, pyro, cues, music, cameras",
                       "exact",    "payload events that switch off; other readers see no airspace and no endurance",
                       write,      read_skyc,
                       recognises, unsuited};

}  // namespace

const Format& skyc_format() {
    return kSkyc;
}

}  // namespace aerogram::exporter
