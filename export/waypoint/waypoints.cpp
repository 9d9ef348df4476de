#include "export/waypoint/waypoints.hpp"

#include <cmath>

#include "export/bytes/decimal.hpp"
#include "export/bytes/files.hpp"
#include "export/waypoint/mission_items.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::string_view kFirstLine = "QGC WPL 110";
constexpr std::string_view kEnding = ".waypoints";
constexpr std::size_t kMostItems = 65'536;
constexpr double kAny = 1e9;

struct Line {
    std::size_t seq = 0;
    int frame = mav::kGlobalRelative, command = mav::kWaypoint;
    double hold_s = 0.0;
    geo::Geodetic place;
    double altitude_m = 0.0;
};

void append(std::string& out, const Line& line) {
    out += std::to_string(line.seq) + '\t' + (line.seq == 0 ? '1' : '0') + '\t' + std::to_string(line.frame) + '\t' +
           std::to_string(line.command) + '\t';
    append_fixed(out, line.hold_s, 0);
    out += "\t0\t0\t0\t";
    append_fixed(out, line.place.latitude_deg, 8);
    out += '\t';
    append_fixed(out, line.place.longitude_deg, 8);
    out += '\t';
    append_fixed(out, line.altitude_m, 3);
    out += "\t1\n";
}

int command_of(Waypoint::Kind kind) {
    if (kind == Waypoint::Kind::takeoff) return mav::kTakeoff;
    return kind == Waypoint::Kind::land ? mav::kLand : mav::kWaypoint;
}

std::string text_of(const DroneMission& mission) {
    std::string out(kFirstLine);
    out += '\n';
    append(out, {0, mav::kGlobal, mav::kWaypoint, 0.0, mission.home, mission.home_amsl_m});
    for (std::size_t k = 0; k < mission.items.size(); ++k) {
        const Waypoint& item = mission.items[k];
        append(out, {k + 1, mav::kGlobalRelative, command_of(item.kind), item.hold_s, item.place,
                     item.altitude_above_home_m});
    }
    return out;
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal&, const std::filesystem::path& folder,
                                       const Run& run) {
    const auto missions = drone_missions(show);
    if (!missions) return Error{missions.error().code, "waypoints: " + missions.error().message};
    std::vector<std::string> files;
    for (const DroneMission& mission : *missions) {
        if (run.stopped()) return stopped_error();
        files.push_back("waypoints/" + mission.name + std::string(kEnding));
        if (const Status written = write_file(folder / files.back(), text_of(mission)); !written)
            return written.error();
        run.report("waypoints", static_cast<double>(files.size()) / static_cast<double>(missions->size()));
    }
    return files;
}

/// One file, line by line; the first problem is kept with its line.
class Reader {
  public:
    explicit Reader(const FileBytes& file) : path_(file.path), lines_(without_blank_end(file.bytes), '\n') {}

    Result<RecordedDrone> read() {
        if (line() != kFirstLine) fail("must be \"" + std::string(kFirstLine) + "\"");
        RecordedDrone drone;
        const std::size_t slash = path_.rfind('/'), start = slash == std::string_view::npos ? 0 : slash + 1;
        drone.name = std::string(path_.substr(start, path_.rfind('.') > start ? path_.rfind('.') - start : path_.npos));
        double home_amsl_m = 0.0;
        for (std::size_t seq = 0; problem_.empty(); ++seq) {
            const auto text = line();
            if (!text) break;
            const MissionItem item = parsed(*text, seq);
            if (!problem_.empty()) break;
            if (seq == 0) {
                drone.home = geo::Geodetic{item.params[4], item.params[5], 0.0};
                drone.home_amsl_m = home_amsl_m = item.params[6];
            }
            const auto waypoint = waypoint_of(item, drone.home.value_or(geo::Geodetic{}), home_amsl_m);
            if (!waypoint) {
                fail(waypoint.error().message);
            } else if (seq > 0 && *waypoint) {
                drone.waypoints.push_back(**waypoint);
            }
        }
        if (problem_.empty() && drone.waypoints.empty()) fail("needs a home and at least one place to fly to");
        if (!problem_.empty()) return Error{ErrorCode::invalid_input, problem_};
        return drone;
    }

  private:
    static std::string_view without_blank_end(std::string_view text) {
        const std::size_t last = text.find_last_not_of("\r\n");
        return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
    }

    std::optional<std::string_view> line() {
        auto text = lines_.next();
        ++number_;
        if (text && text->ends_with('\r')) text->remove_suffix(1);
        return text;
    }

    MissionItem parsed(std::string_view text, std::size_t seq) {
        Fields fields(text, '\t');
        MissionItem item;
        if (static_cast<std::size_t>(whole(fields, "seq", kMostItems)) != seq)
            fail("seq: must be " + std::to_string(seq));
        whole(fields, "current", 1);
        item.frame = static_cast<int>(whole(fields, "frame", 255));
        item.command = static_cast<int>(whole(fields, "command", 65'535));
        for (double& param : item.params) param = number(fields);
        whole(fields, "autocontinue", 1);
        if (fields.next()) fail("must be 12 fields split by single tabs");
        const bool is_home =
            item.command == mav::kWaypoint && (item.frame == mav::kGlobal || item.frame == mav::kGlobalInt);
        if (seq == 0 && !is_home) fail("item 0 must be the home: frame 0, command 16");
        return item;
    }

    std::int64_t whole(Fields& fields, const char* key, std::int64_t highest) {
        const auto text = fields.next();
        const auto value = text ? parse_whole(*text, 0, highest) : std::nullopt;
        if (!value)
            fail(std::string(key) + " = " + shown(text.value_or("")) + ": must be a whole number from 0 to " +
                 std::to_string(highest));
        return value.value_or(0);
    }

    double number(Fields& fields) {
        const auto text = fields.next();
        const auto value = text ? parse_number(*text, kAny) : std::nullopt;
        if (!value) fail(shown(text.value_or("")) + ": must be a number");
        return value.value_or(0.0);
    }

    void fail(const std::string& what) {
        if (problem_.empty()) problem_ = std::string(path_) + ':' + std::to_string(number_) + ": " + what;
    }

    std::string_view path_;
    Fields lines_;
    std::size_t number_ = 0;
    std::string problem_;
};

bool recognises(std::string_view, std::string_view first_bytes) {
    return first_bytes.starts_with("QGC WPL");
}

constexpr Format kWaypoints{"waypoints", "QGC WPL 110 missions, one a drone: places without times",
                            "none",      "curves, times, lights, yaw, events, cues, limits, fence and show hash",
                            write,       read_waypoints,
                            recognises,  unsuited_for_missions};

}  // namespace

Result<RecordedShow> read_waypoints(std::span<const FileBytes> files) {
    if (files.empty()) return Error{ErrorCode::invalid_input, "waypoints: needs at least one file"};
    RecordedShow show;
    show.format = "waypoints";
    show.timed = false;
    show.rounding = mission_rounding();
    for (const FileBytes& file : files) {
        auto drone = Reader(file).read();
        if (!drone) return drone.error();
        show.drones.push_back(std::move(*drone));
    }
    return show;
}

const Format& waypoints_format() {
    return kWaypoints;
}

}  // namespace aerogram::exporter
