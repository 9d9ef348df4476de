#include "export/vehicle/px4_csv.hpp"

#include <cmath>

#include "export/bytes/decimal.hpp"
#include "export/bytes/files.hpp"
#include "export/outgoing/polyline.hpp"
#include "export/vehicle/companion.hpp"
#include "export/vehicle/ned.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::string_view kName = "px4-csv";
constexpr const char* kFolder = "px4/";
constexpr double kRowBytes = 100.0, kLargest = 1e9;
constexpr int kClimbing = 10, kShowing = 70, kLanding = 100;
constexpr double kHalfMillimetre_m = 0.0005;

std::string file_of(const OutgoingShow& show, std::size_t i) {
    return "Drone " + std::to_string(show.facts().drones[i].number) + ".csv";
}

int mode_at(const OutgoingFacts& facts, Millis time_ms) {
    if (time_ms < facts.takeoff_end_ms) return kClimbing;
    return time_ms < facts.landing_begin_ms ? kShowing : kLanding;
}

std::string csv(const OutgoingShow& show, std::size_t drone, const std::vector<Millis>& times_ms) {
    const OutgoingFacts& facts = show.facts();
    const NedFrame frame(facts.origin ? facts.origin->heading_deg : 0.0);
    const Flight flight = show.flight(drone);
    const Tracks& tracks = show.tracks(drone);
    FlightCursor cursor(flight);
    std::string out = "idx,t,px,py,pz,vx,vy,vz,ax,ay,az,yaw,mode,ledr,ledg,ledb\n";
    out.reserve(times_ms.size() * static_cast<std::size_t>(kRowBytes));
    for (std::size_t k = 0; k < times_ms.size(); ++k) {
        const double t_s = seconds_from_ms(times_ms[k]);
        const FlightState state = cursor.state_at(t_s);
        append_units(out, static_cast<std::int64_t>(k), 0);
        out += ',';
        append_units(out, times_ms[k], 3);
        for (const Vec3& show_frame : {state.position_m, state.velocity_mps, state.acceleration_mps2}) {
            const Vec3 v = frame.to_ned(show_frame);
            for (const double component : {v.x, v.y, v.z}) {
                out += ',';
                append_fixed(out, component, 3);
            }
        }
        out += ',';
        append_fixed(out, frame.to_compass_deg(yaw_at(tracks.yaw, t_s)), 3);
        out += ',';
        append_units(out, mode_at(facts, times_ms[k]), 0);
        const Rgb8 color = quantised(light_at(tracks.lights, t_s));
        for (const std::uint8_t channel : {color.r, color.g, color.b}) {
            out += ',';
            append_units(out, channel, 0);
        }
        out += '\n';
    }
    return out;
}

std::string unsuited(const OutgoingShow& show) {
    const OutgoingFacts& facts = show.facts();
    if (facts.limits.plane) return "planes: the format is for drones that take off, hover and land";
    const double dt_s = 1.5 * seconds_from_ms(kPx4Step_ms);  // the longest interval, at the end
    const double most_mps2 = 8.0 * kPx4Chord_m / (dt_s * dt_s);
    if (facts.acceleration_mps2 > most_mps2) {
        std::string text = "accelerations above ";
        append_fixed(text, most_mps2, 1);
        return text + " m/s²: straight lines between rows of 20 Hz would miss the flight by more than 4 mm";
    }
    if (2.0 * (kPx4Chord_m + std::sqrt(3.0) * kHalfMillimetre_m) > facts.limits.export_margin_m)
        return "export_margin_m leaves no room for millimetres and rows of 20 Hz; 0.01 would do";
    const double rows = static_cast<double>(facts.duration_ms / kPx4Step_ms + 2) * static_cast<double>(show.drones());
    if (rows * kRowBytes <= kLargest) return {};
    std::string text = "about ";
    append_fixed(text, rows * kRowBytes / 1e9, 1);
    return text + " GB of text; 1 GB is the most that is written";
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    if (std::string why = unsuited(show); !why.empty()) return Error{ErrorCode::invalid_input, "px4-csv: " + why};
    const std::vector<Millis> times_ms = sampling_times(show.facts().duration_ms, kPx4Step_ms);
    std::vector<Status> written(show.drones(), Done{});
    parallel_for(show.drones(), run, kName, [&](std::size_t i) {
        const std::string name = kFolder + file_of(show, i);
        written[i] = write_file(folder / name, csv(show, i, times_ms));
    });
    if (run.stopped()) return stopped_error();
    std::vector<std::string> files{kFolder + std::string(kCompanionName)};
    for (std::size_t i = 0; i < show.drones(); ++i) {
        if (!written[i]) return written[i].error();
        files.push_back(kFolder + file_of(show, i));
    }
    const Status told = write_file(folder / files.front(),
                                   companion_text(show, seal, kName, [&](std::size_t i) { return file_of(show, i); }));
    if (!told) return told.error();
    return files;
}

bool recognises(std::string_view, std::string_view first_bytes) {
    return is_companion(kName, first_bytes) || first_bytes.starts_with("idx,t,px,py,pz,");
}

constexpr Format kPx4{
    kName,      "PX4 setpoints for mavsdk_drone_show, a CSV a drone: 20 Hz, north-east-down, yaw, lights",
    "linear",   "audio; lights between rows",
    write,      read_px4_csv,
    recognises, unsuited,
    true};

}  // namespace

const Format& px4_csv_format() {
    return kPx4;
}

}  // namespace aerogram::exporter
