#include "export/skybrush/csv_zip.hpp"

#include <algorithm>
#include <cmath>

#include "export/bytes/decimal.hpp"
#include "export/bytes/zip.hpp"
#include "export/bytes/zip_peek.hpp"
#include "export/outgoing/polyline.hpp"
#include "export/skybrush/csv_zip_reader.hpp"
#include "export/skybrush/skybrush_frame.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr const char* kFile = "csv.zip";
constexpr double kRowBytes = 40.0;
constexpr double kLargestArchive = 4.0e9;  ///< unpacked; what our own reader accepts (UnzipLimits)

void append_color(std::string& out, const Rgb8& color) {
    for (const std::uint8_t component : {color.r, color.g, color.b}) {
        out += ',';
        append_units(out, component, 0);
    }
}

/// A row's time, which is the same for all drones.
struct RowTime {
    std::string text;
    double time_s = 0.0;
};

std::vector<RowTime> rows_of(const OutgoingFacts& facts) {
    std::vector<RowTime> rows;
    for (const Millis time_ms : sampling_times(facts.duration_ms, *csv_row_step_ms(facts))) {
        rows.push_back({{}, seconds_from_ms(time_ms)});
        append_units(rows.back().text, time_ms, 0);
    }
    return rows;
}

void append_csv(std::string& out, const OutgoingShow& show, std::size_t drone, const std::vector<RowTime>& rows) {
    const std::vector<LightKey>& lights = show.tracks(drone).lights;
    const Flight flight = show.flight(drone);
    FlightCursor cursor(flight);
    out += "Time [msec],x [m],y [m],z [m],Red,Green,Blue\n";
    std::size_t places_at = 0, places_length = 0;  // of the row before, for drones that stand
    Vec3 before{};
    for (const RowTime& row : rows) {
        out += row.text;
        const Vec3 p = to_skybrush(cursor.position_at(row.time_s));
        const std::size_t at = out.size();
        if (places_length > 0 && p == before) {
            out.append(out, places_at, places_length);
        } else {
            for (const double coordinate : {p.x, p.y, p.z}) {
                out += ',';
                append_fixed(out, coordinate, 3);
            }
        }
        before = p;
        places_at = at;
        places_length = out.size() - at;
        append_color(out, quantised(light_at(lights, row.time_s)));
        out += '\n';
    }
}

std::string unsuited(const OutgoingShow& show) {
    const auto step_ms = csv_row_step_ms(show.facts());
    if (!step_ms)
        return "export_margin_m leaves no room for millimetres and straight lines between rows; 0.01 would do for most "
               "shows";
    const double rows =
        static_cast<double>(show.facts().duration_ms / *step_ms + 2) * static_cast<double>(show.drones());
    if (rows * kRowBytes > kLargestArchive)
        return "about " + std::to_string(std::llround(rows * kRowBytes / 1e9)) +
               " GB of text; 4 GB is the most we read back";
    return {};
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal&, const std::filesystem::path& folder,
                                       const Run& run) {
    if (std::string why = unsuited(show); !why.empty()) return Error{ErrorCode::invalid_input, "csv: " + why};
    const std::vector<RowTime> rows = rows_of(show.facts());
    std::vector<PackedEntry> entries(show.drones());
    parallel_for(show.drones(), run, "csv", [&](std::size_t i) {
        thread_local std::string text;
        text.clear();
        append_csv(text, show, i, rows);
        entries[i] = packed_entry(show.facts().drones[i].name + ".csv", text);
    });
    if (run.stopped()) return stopped_error();
    if (const Status written = write_zip(folder / kFile, entries); !written) return written.error();
    return std::vector<std::string>{kFile};
}

bool recognises(std::string_view path, std::string_view first_bytes) {
    const auto entry = first_zip_entry(first_bytes);
    return entry && (entry->ends_with(".csv") || (path.ends_with(kFile) && *entry != "show.json"));
}

constexpr Format kCsv{
    "csv",      "Skybrush CSV in a zip: a row of time, place and colour every 250 ms or less",
    "linear",   "yaw, payload events, cues, origin, limits, airspace and show hash; lights between rows",
    write,      read_csv_zip,
    recognises, unsuited};

}  // namespace

std::optional<Millis> csv_row_step_ms(const OutgoingFacts& facts) {
    const double allowed_m = std::min(facts.limits.export_margin_m, kCsvPairCost_m) - std::sqrt(3.0) * 0.001;
    for (const Millis step_ms : {250, 200, 125, 100, 50, 40, 25, 20, 10}) {
        const double dt_s = seconds_from_ms(step_ms);
        if (facts.acceleration_mps2 * dt_s * dt_s / 4.0 <= allowed_m) return step_ms;
    }
    return std::nullopt;
}

const Format& csv_format() {
    return kCsv;
}

}  // namespace aerogram::exporter
