#include "export/waypoint/waypoints.hpp"

#include <cmath>

#include "export/bytes/decimal.hpp"
#include "export/waypoint/mission_items.hpp"
#include "export/waypoint/mission_reading.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::string_view kFirstLine = "QGC WPL 110", kFirstLineWithoutHome = "QGC WPL 120";
constexpr std::size_t kMostItems = 65'536;
constexpr double kAny = 1e9;

void append_parameter(std::string& out, double value) {
    append_fixed(out, value, value == std::floor(value) ? 0 : 3);
    out += '\t';
}

void append_item(std::string& out, std::size_t seq, const MissionItem& item) {
    constexpr std::size_t kLatitude = 4, kLongitude = 5, kAltitude = 6;
    out += std::to_string(seq) + '\t' + (seq == 0 ? '1' : '0') + '\t' + std::to_string(item.frame) + '\t' +
           std::to_string(item.command) + '\t';
    for (std::size_t k = 0; k < kLatitude; ++k) append_parameter(out, item.params[k]);
    append_fixed(out, item.params[kLatitude], 8);
    out += '\t';
    append_fixed(out, item.params[kLongitude], 8);
    out += '\t';
    append_fixed(out, item.params[kAltitude], 3);
    out += "\t1\n";
}

/// Of PX4, which has no home item, the version that says so.
std::string text_of(const FleetMissions& fleet, const DroneMission& drone) {
    std::string out(fleet.px4 ? kFirstLineWithoutHome : kFirstLine);
    out += '\n';
    std::size_t seq = 0;
    if (!fleet.px4)
        append_item(out, seq++,
                    {mav::kGlobal,
                     mav::kWaypoint,
                     {0.0, 0.0, 0.0, 0.0, drone.home.latitude_deg, drone.home.longitude_deg, drone.home_amsl_m}});
    for (const MissionItem& item : mission_items(fleet, drone)) append_item(out, seq++, item);
    return out;
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal&, const std::filesystem::path& folder,
                                       const Run& run) {
    const auto fleet = fleet_missions(show);
    if (!fleet) return Error{fleet.error().code, "waypoints: " + fleet.error().message};
    return write_missions(*fleet, "waypoints", ".waypoints", folder, run,
                          [&](const DroneMission& drone) { return text_of(*fleet, drone); });
}

/// One file, line by line; the first problem is kept with its line.
class Reader {
  public:
    explicit Reader(const FileBytes& file) : path_(file.path), lines_(without_blank_end(file.bytes), '\n') {}

    Result<RecordedDrone> read() {
        const auto first = line();
        has_home_ = first == kFirstLine;
        if (!has_home_ && first != kFirstLineWithoutHome)
            fail("must be \"" + std::string(kFirstLine) + "\" or \"" + std::string(kFirstLineWithoutHome) + "\"");
        MissionReading reading({}, {});
        for (std::size_t seq = 0; problem_.empty(); ++seq) {
            const auto text = line();
            if (!text) break;
            const MissionItem item = parsed(*text, seq);
            if (!problem_.empty()) break;
            const Status taken = seq == 0 && has_home_ ? begin_at(item, reading) : reading.take(item);
            if (!taken) fail(taken.error().message);
        }
        RecordedDrone drone = reading.drone();
        const std::size_t slash = path_.rfind('/'), start = slash == std::string_view::npos ? 0 : slash + 1;
        drone.name = std::string(path_.substr(start, path_.rfind('.') > start ? path_.rfind('.') - start : path_.npos));
        if (problem_.empty() && drone.waypoints.empty()) fail("needs a home and at least one place to fly to");
        if (!problem_.empty()) return Error{ErrorCode::invalid_input, problem_};
        return drone;
    }

  private:
    static std::string_view without_blank_end(std::string_view text) {
        const std::size_t last = text.find_last_not_of("\r\n");
        return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
    }

    /// Home is checked like a waypoint, and is none.
    static Status begin_at(const MissionItem& home, MissionReading& reading) {
        const geo::Geodetic place{home.params[4], home.params[5], 0.0};
        MissionReading alone(place, home.params[6]);
        reading = alone;
        return alone.take(home);
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
        if (seq == 0 && has_home_ && !is_home) fail("item 0 must be the home: frame 0, command 16");
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
    bool has_home_ = true;
    std::string problem_;
};

bool recognises(std::string_view, std::string_view first_bytes) {
    return first_bytes.starts_with("QGC WPL");
}

constexpr Format kWaypoints{
    "waypoints", "QGC WPL 110 missions, one a drone: keyframe places (timing none, absolute or speed)",
    "none",      "curves, lights, yaw, events, cues, limits, fence, show hash; of times all but the waits of absolute",
    write,       read_waypoints,
    recognises,  unsuited_for_missions,
    true};

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
    settle_times(show, {});
    return show;
}

const Format& waypoints_format() {
    return kWaypoints;
}

}  // namespace aerogram::exporter
