#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>

#include "export/bytes/files.hpp"
#include "export/open_show.hpp"
#include "export/picture/strip_picture.hpp"
#include "geo/color.hpp"
#include "geo/units.hpp"
#include "ground/app/answers.hpp"
#include "ground/app/commands.hpp"
#include "ground/app/exit_status.hpp"
#include "ground/app/words.hpp"

namespace aerogram::ground {
namespace {

using exporter::OpenedShow;
using exporter::RecordedDrone;
using exporter::RecordedShow;

std::string place(const Vec3& p) {
    return decimals(p.x, 3) + ", " + decimals(p.y, 3) + ", " + decimals(p.z, 3);
}

/// Drones that are listed one by one without --at: a glance, not a list of thousands.
constexpr std::size_t kMostListed = 20;

std::string limits_line(const Limits& l) {
    return decimals(l.min_separation_m, 2) + " m apart, " + decimals(l.speed_horizontal_mps, 1) + " m/s sideways, " +
           decimals(l.speed_up_mps, 1) + " up, " + decimals(l.speed_down_mps, 1) + " down, " +
           decimals(l.acceleration_mps2, 1) + " m/s², up to " + decimals(l.ceiling_m, 1) + " m";
}

std::string totals(const RecordedShow& show) {
    std::size_t pieces = 0, waypoints = 0, lights = 0, yaw = 0, events = 0;
    for (const RecordedDrone& drone : show.drones) {
        pieces += drone.pieces.size(), waypoints += drone.waypoints.size(), lights += drone.tracks.lights.size();
        yaw += drone.tracks.yaw.size(), events += drone.tracks.events.size();
    }
    std::string text = show.timed ? counted(pieces, "piece") : counted(waypoints, "waypoint");
    return text + ", " + counted(lights, "light key") + ", " + counted(yaw, "yaw key") + ", " +
           counted(events, "payload event");
}

std::string overview(const OpenedShow& opened) {
    const RecordedShow& show = opened.show;
    std::ostringstream text;
    text << show.format << (show.title.empty() ? "" : ": " + show.title) << "\n";
    text << "drones         " << show.drones.size() << " (" << totals(show) << ")\n";
    if (opened.files.size() > 1) text << "files          " << opened.files.size() << "\n";
    if (show.timed) {
        text << "duration       " << decimals(show.duration_s, 3) << " s\n";
    } else {
        text << "timing         "
             << (show.timing.empty() ? "none: waypoints say where, not when"
                                     : show.timing + ": waypoints wait for times")
             << "\n";
    }
    if (show.show_hash) text << "show hash      " << *show.show_hash << "\n";
    if (show.certified) text << "certified      " << (*show.certified ? "yes, says the file" : "NO") << "\n";
    if (show.origin) {
        text << "origin         " << decimals(show.origin->ground.latitude_deg, 7) << ", "
             << decimals(show.origin->ground.longitude_deg, 7) << ", height "
             << decimals(show.origin->ground.height_m, 3) << " m, heading " << decimals(show.origin->heading_deg, 2)
             << " deg\n";
    }
    if (show.limits) text << "limits         " << limits_line(*show.limits) << "\n";
    if (show.airspace) {
        text << "airspace       geofence of " << counted(show.airspace->geofence_m.size(), "corner") << ", "
             << counted(show.airspace->audience_m.size(), "audience area") << ", "
             << counted(show.airspace->obstacles.size(), "obstacle") << "\n";
    }
    if (show.endurance_s) text << "endurance      " << decimals(*show.endurance_s, 0) << " s\n";
    if (!opened.completed_from.empty()) text << "completed      from " << opened.completed_from << "\n";
    text << "rounding       " << decimals(1000.0 * show.rounding.position_m, 2) << " mm, fit "
         << decimals(1000.0 * show.rounding.fit_m, 2) << " mm\n";
    for (const Cue& cue : show.cues)
        text << "cue            " << decimals(seconds_from_ms(cue.time_ms), 2) << " s  " << cue.name << "\n";
    return text.str();
}

std::string item_line(const exporter::Waypoint& waypoint, std::size_t number) {
    constexpr std::array kKinds{"take off", "fly to  ", "land    "};
    std::ostringstream text;
    text << "  " << number << "  " << kKinds[static_cast<std::size_t>(waypoint.kind)] << "  "
         << decimals(waypoint.place.latitude_deg, 7) << ", " << decimals(waypoint.place.longitude_deg, 7) << "  "
         << decimals(waypoint.altitude_above_home_m, 3) << " m above home";
    if (waypoint.hold_s > 0.0) text << ", holds " << decimals(waypoint.hold_s, 1) << " s";
    if (waypoint.until_s) text << ", until " << decimals(*waypoint.until_s, 3) << " s";
    if (waypoint.speed_mps) text << ", at " << decimals(*waypoint.speed_mps, 2) << " m/s";
    return text.str() + "\n";
}

std::string drones_text(const RecordedShow& show, const std::vector<double>& at_s) {
    std::ostringstream text;
    const std::size_t listed = at_s.empty() ? std::min(show.drones.size(), kMostListed) : show.drones.size();
    for (std::size_t i = 0; i < listed; ++i) {
        const RecordedDrone& drone = show.drones[i];
        text << drone.name << ": " << drone.pieces.size() << " pieces, " << drone.waypoints.size() << " waypoints, "
             << drone.tracks.lights.size() << " light keys" << (drone.home_m ? ", home " + place(*drone.home_m) : "")
             << "\n";
        for (std::size_t k = 0; k < drone.waypoints.size(); ++k) text << item_line(drone.waypoints[k], k + 1);
        if (drone.pieces.empty()) continue;
        for (const double t_s : at_s) {
            text << "  " << decimals(t_s, 3) << " s  " << place(exporter::position_at(drone, t_s)) << " m  "
                 << hex_from_rgb(light_at(drone.tracks.lights, t_s)) << "\n";
        }
    }
    if (listed < show.drones.size())
        text << "... and " << show.drones.size() - listed << " more (all with --at, or --json)\n";
    return text.str();
}

bool is_mission(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return extension == ".toml";
}

std::optional<Error> unfit(const InspectCommand& command) {
    for (const double t_s : command.at_s) {
        if (!std::isfinite(t_s)) return Error{ErrorCode::invalid_input, "--at: must be a time in seconds"};
    }
    const bool mission = is_mission(command.file);
    if (mission && !command.at_s.empty()) {
        return Error{ErrorCode::invalid_input,
                     "--at: a mission has no times before it is planned; plan it and inspect " +
                         std::string("its trajectories.bin, or name a --keyframe")};
    }
    if (!mission && command.keyframe) {
        return Error{ErrorCode::invalid_input,
                     "--keyframe: exported files hold no keyframes; inspect the mission, or name times with --at"};
    }
    if (command.png && (mission ? !command.keyframe : command.at_s.empty())) {
        return Error{ErrorCode::invalid_input,
                     mission ? "--png: name the --keyframe to draw" : "--png: name the times to draw with --at"};
    }
    if (command.png && command.at_s.size() > exporter::kMostStripFrames) {
        return Error{ErrorCode::invalid_input, "--png: draws at most " + std::to_string(exporter::kMostStripFrames) +
                                                   " times, not " + std::to_string(command.at_s.size())};
    }
    return std::nullopt;
}

/// The show from the front at each time, lamps as they are then.
Result<std::string> strip_of(const RecordedShow& show, const InspectCommand& command) {
    if (!show.timed || show.drones.empty()) {
        return Error{ErrorCode::invalid_input, command.file.string() + ": " +
                                                   (show.timed ? "holds no drones" : "says where, not when") +
                                                   "; --png needs an export with times"};
    }
    std::vector<exporter::StripFrame> frames;
    for (const double t_s : command.at_s) {
        exporter::StripFrame frame{decimals(t_s, 2) + " s", {}};
        for (const RecordedDrone& drone : show.drones)
            frame.drones.push_back({exporter::position_at(drone, t_s), light_at(drone.tracks.lights, t_s)});
        frames.push_back(std::move(frame));
    }
    const std::string title = show.title.empty() ? command.file.filename().string() : show.title;
    return exporter::strip_picture(
        title, counted(show.drones.size(), "drone") + ", " + decimals(show.duration_s, 1) + " s, from the front, m",
        frames, command.width_px);
}

}  // namespace

Status write_picture(const InspectCommand& command, const Result<std::string>& png) {
    if (!png) return png.error();
    std::error_code differs;
    if (std::filesystem::equivalent(*command.png, command.file, differs)) {
        return Error{ErrorCode::invalid_input, "--png " + command.png->string() + ": would replace what is inspected"};
    }
    return exporter::replace_file(*command.png, *png);
}

int run_inspect(const InspectCommand& command, const Session& session) {
    if (const auto error = unfit(command)) return report_error(*error, session);
    if (is_mission(command.file)) return run_inspect_mission(command, session);
    const auto opened = exporter::open_show(command.file, session.run);
    if (!opened) return report_error(opened.error(), session);
    const RecordedShow* const show = &opened->show;
    if (command.png) {
        if (const Status written = write_picture(command, strip_of(*show, command)); !written)
            return report_error(written.error(), session);
    }
    session.console.clear_line();
    if (session.json) {
        std::cout << inspect_answer(*opened, command.at_s, command.png);
    } else {
        std::cout << overview(*opened);
        if (command.png) std::cout << "picture        " << command.png->string() << "\n";
        std::cout << drones_text(*show, command.at_s);
    }
    return kDone;
}

}  // namespace aerogram::ground
