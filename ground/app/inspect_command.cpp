#include <array>
#include <cmath>
#include <iostream>
#include <sstream>

#include "export/files.hpp"
#include "export/format.hpp"
#include "geo/color.hpp"
#include "geo/units.hpp"
#include "ground/app/answers.hpp"
#include "ground/app/commands.hpp"
#include "ground/app/exit_status.hpp"
#include "ground/app/words.hpp"

namespace aerogram::ground {
namespace {

using exporter::RecordedDrone;
using exporter::RecordedShow;

Result<RecordedShow> read_any(const std::filesystem::path& file) {
    auto bytes = exporter::read_file(file);
    if (!bytes) return bytes.error();
    const exporter::Format* format = exporter::recognise(file.filename().string(), *bytes);
    if (format == nullptr) {
        std::string known;
        for (const auto& each : exporter::formats()) known += (known.empty() ? "" : ", ") + std::string(each.name);
        return Error{ErrorCode::invalid_input, file.string() + ": not a format we read (" + known + ")"};
    }
    const std::array<exporter::FileBytes, 1> files{{{file.filename().string(), std::move(*bytes)}}};
    return format->read(files);
}

std::string place(const Vec3& p) {
    return decimals(p.x, 3) + ", " + decimals(p.y, 3) + ", " + decimals(p.z, 3);
}

std::string overview(const RecordedShow& show) {
    std::ostringstream text;
    text << show.format << (show.title.empty() ? "" : ": " + show.title) << "\n";
    text << "drones         " << show.drones.size() << "\n";
    if (show.timed) {
        text << "duration       " << decimals(show.duration_s, 3) << " s\n";
    } else {
        text << "timing         none: waypoints say where, not when\n";
    }
    if (show.show_hash) text << "show hash      " << *show.show_hash << "\n";
    if (show.certified) text << "certified      " << (*show.certified ? "yes, says the file" : "NO") << "\n";
    if (show.origin) {
        text << "origin         " << decimals(show.origin->ground.latitude_deg, 7) << ", "
             << decimals(show.origin->ground.longitude_deg, 7) << ", heading " << decimals(show.origin->heading_deg, 2)
             << " deg\n";
    }
    text << "rounding       " << decimals(1000.0 * show.rounding.position_m, 2) << " mm, fit "
         << decimals(1000.0 * show.rounding.fit_m, 2) << " mm\n";
    for (const Cue& cue : show.cues)
        text << "cue            " << decimals(seconds_from_ms(cue.time_ms), 2) << " s  " << cue.name << "\n";
    return text.str();
}

std::string drones_text(const RecordedShow& show, const std::vector<double>& at_s) {
    std::ostringstream text;
    for (const RecordedDrone& drone : show.drones) {
        text << drone.name << ": " << drone.pieces.size() << " pieces, " << drone.waypoints.size() << " waypoints, "
             << drone.tracks.lights.size() << " light keys" << (drone.home_m ? ", home " + place(*drone.home_m) : "")
             << "\n";
        if (drone.pieces.empty()) continue;
        for (const double t_s : at_s) {
            text << "  " << decimals(t_s, 3) << " s  " << place(exporter::position_at(drone, t_s)) << " m  "
                 << hex_from_rgb(light_at(drone.tracks.lights, t_s)) << "\n";
        }
    }
    return text.str();
}

}  // namespace

int run_inspect(const InspectCommand& command, const Session& session) {
    for (const double t_s : command.at_s) {
        if (!std::isfinite(t_s))
            return report_error({ErrorCode::invalid_input, "--at: must be a time in seconds"}, session);
    }
    const auto show = read_any(command.file);
    if (!show) return report_error(show.error(), session);
    session.console.clear_line();
    if (session.json) {
        std::cout << inspect_answer(*show, command.at_s);
    } else {
        std::cout << overview(*show) << drones_text(*show, command.at_s);
    }
    return kDone;
}

}  // namespace aerogram::ground
