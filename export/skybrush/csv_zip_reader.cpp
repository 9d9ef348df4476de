#include "export/skybrush/csv_zip_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "export/bytes/decimal.hpp"
#include "export/bytes/text_cursor.hpp"
#include "export/bytes/zip.hpp"
#include "export/skybrush/csv_zip.hpp"
#include "export/skybrush/skybrush_frame.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::array<std::string_view, 7> kColumns{"time [msec]", "x [m]", "y [m]", "z [m]", "red", "green", "blue"};
constexpr std::int64_t kLongest_ms = 86'400'000;
constexpr double kFarthest_m = 1e6;
constexpr double kHalfMillimetre_m = 0.0005;

struct Row {
    Millis time_ms = 0;
    Vec3 position_m{};
    Rgb8 color;
};

/// One CSV of the archive, line by line; the first problem is kept with its line.
class CsvFile {
  public:
    CsvFile(std::string_view where, std::string_view text) : where_(where), lines_(without_blank_end(text), '\n') {}

    /// @param rows  replaced.
    Status read(std::vector<Row>& rows) {
        header();
        rows.clear();
        while (problem_.empty()) {
            const auto text = line();
            if (!text) break;
            const Row row = quickly_parsed(*text);
            if (problem_.empty() && !rows.empty() && row.time_ms <= rows.back().time_ms)
                fail("time [msec] = " + std::to_string(row.time_ms) + ": must be above the row before, " +
                     std::to_string(rows.back().time_ms));
            rows.push_back(row);
        }
        if (problem_.empty() && rows.size() < 2) fail("needs at least two rows");
        if (!problem_.empty()) return Error{ErrorCode::invalid_input, problem_};
        return Done{};
    }

  private:
    static std::string_view without_blank_end(std::string_view text) {
        const std::size_t last = text.find_last_not_of("\r\n");
        return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
    }

    void fail(const std::string& what) {
        if (problem_.empty()) problem_ = std::string(where_) + ':' + std::to_string(number_) + ": " + what;
    }

    std::optional<std::string_view> line() {
        auto text = lines_.next();
        ++number_;
        if (text && text->ends_with('\r')) text->remove_suffix(1);
        return text;
    }

    void header() {
        auto text = line().value_or("");
        if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
        Fields fields(text, ',');
        for (const std::string_view column : kColumns) {
            const std::string_view name = trimmed(fields.next().value_or(""));
            const bool same = std::ranges::equal(name, column, {}, [](char c) { return lower(c); });
            if (!same) return fail("column " + shown(name) + ": must be \"" + std::string(column) + "\"");
        }
    }

    static char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

    /// A row as most writers leave it; any other is for the careful reader.
    Row quickly_parsed(std::string_view text) {
        TextCursor cursor(text);
        Row row;
        row.time_ms = cursor.whole(kLongest_ms);
        Vec3 p{};
        for (double* const coordinate : {&p.x, &p.y, &p.z}) {
            cursor.expect(",");
            *coordinate = cursor.number(kFarthest_m);
        }
        for (std::uint8_t* const component : {&row.color.r, &row.color.g, &row.color.b}) {
            cursor.expect(",");
            *component = static_cast<std::uint8_t>(cursor.whole(255));
        }
        if (!cursor.ok() || !cursor.at_end()) return parsed(text);
        row.position_m = from_skybrush(p);
        return row;
    }

    Row parsed(std::string_view text) {
        Fields fields(text, ',');
        Row row;
        row.time_ms = whole(fields, 0, kLongest_ms);
        const double x = coordinate(fields, 1), y = coordinate(fields, 2), z = coordinate(fields, 3);
        row.position_m = from_skybrush({x, y, z});
        row.color.r = static_cast<std::uint8_t>(whole(fields, 4, 255));
        row.color.g = static_cast<std::uint8_t>(whole(fields, 5, 255));
        row.color.b = static_cast<std::uint8_t>(whole(fields, 6, 255));
        return row;
    }

    std::int64_t whole(Fields& fields, std::size_t column, std::int64_t highest) {
        const auto text = fields.next();
        const auto value = text ? parse_whole(*text, 0, highest) : std::nullopt;
        if (!value)
            fail(std::string(kColumns[column]) + " = " + shown(text.value_or("")) +
                 ": must be a whole number from 0 to " + std::to_string(highest));
        return value.value_or(0);
    }

    double coordinate(Fields& fields, std::size_t column) {
        const auto text = fields.next();
        const auto value = text ? parse_number(*text, kFarthest_m) : std::nullopt;
        if (!value)
            fail(std::string(kColumns[column]) + " = " + shown(text.value_or("")) + ": must be a number within ±1e6");
        return value.value_or(0.0);
    }

    std::string_view where_;
    Fields lines_;
    std::size_t number_ = 0;
    std::string problem_;
};

/// A light key at every row where the line through the colours bends.
std::vector<LightKey> lights(const std::vector<Row>& rows) {
    std::vector<LightKey> keys;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const bool fade = k + 1 < rows.size() && rows[k + 1].color != rows[k].color;
        const LightKey key{rows[k].time_ms, from_8bit(rows[k].color), fade};
        const bool nothing_new = !keys.empty() && !fade && !keys.back().fade;
        if (!nothing_new) keys.push_back(key);
    }
    return keys;
}

/// Straight from row to row; what stands for several rows is one piece. Exact in size, which matters for large fleets.
RecordedDrone drone_from(std::string name, const std::vector<Row>& rows) {
    thread_local std::vector<Piece> pieces;
    thread_local std::vector<Vec3> controls_m;
    pieces.clear();
    controls_m.assign(1, rows[0].position_m);
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
        const bool stands = rows[k + 1].position_m == rows[k].position_m;
        const auto last = static_cast<std::uint32_t>(controls_m.size() - 1);
        if (stands && !pieces.empty() && pieces.back().degree == 0) {
            pieces.back().duration_s = seconds_from_ms(rows[k + 1].time_ms) - pieces.back().start_s;
            continue;
        }
        pieces.push_back({seconds_from_ms(rows[k].time_ms), seconds_from_ms(rows[k + 1].time_ms - rows[k].time_ms),
                          last, static_cast<std::uint8_t>(stands ? 0 : 1)});
        if (!stands) controls_m.push_back(rows[k + 1].position_m);
    }
    RecordedDrone drone;
    drone.name = std::move(name);
    drone.pieces = pieces;
    drone.controls_m = controls_m;
    drone.tracks.lights = lights(rows);
    drone.tracks.lights.shrink_to_fit();
    return drone;
}

/// "drone-001" of "a/drone-001.csv"; empty for what is no CSV.
std::string drone_of(std::string_view path) {
    if (path.size() < 5 || path.starts_with("__MACOSX/")) return {};
    const std::string_view ending = path.substr(path.size() - 4);
    if (ending != ".csv" && ending != ".CSV") return {};
    const std::size_t slash = path.rfind('/');
    return std::string(path.substr(slash == std::string_view::npos ? 0 : slash + 1, path.size() - 4 - (slash + 1)));
}

double shortest_interval_s(const RecordedShow& show) {
    double shortest = 1.0;
    for (const RecordedDrone& drone : show.drones)
        for (const Piece& piece : drone.pieces)
            if (piece.degree > 0) shortest = std::min(shortest, piece.duration_s);
    return shortest;
}

}  // namespace

Result<RecordedShow> read_csv_zip(std::span<const FileBytes> files) {
    if (files.size() != 1) return Error{ErrorCode::invalid_input, "csv: needs exactly one archive"};
    const std::string& archive = files.front().path;
    const auto entries = ZipArchive::open(files.front().bytes);
    if (!entries) return Error{entries.error().code, archive + ": " + entries.error().message};
    RecordedShow show;
    show.format = "csv";
    std::vector<Row> rows;
    for (std::size_t entry = 0; entry < entries->size(); ++entry) {
        const auto text = entries->unpacked(entry);
        if (!text) return Error{text.error().code, archive + ": " + text.error().message};
        const std::string name = drone_of(entries->path(entry));
        if (name.empty()) continue;
        if (const Status read = CsvFile(archive + ": " + entries->path(entry), *text).read(rows); !read)
            return read.error();
        show.drones.push_back(drone_from(name, rows));
        show.duration_s = std::max(show.duration_s, seconds_from_ms(rows.back().time_ms));
    }
    if (show.drones.empty()) return Error{ErrorCode::invalid_input, archive + ": holds no .csv file"};
    show.rounding.position_m = kHalfMillimetre_m;
    show.rounding.fit_m = kCsvPairCost_m / 2.0;
    show.rounding.speed_allowance_mps = 2.0 * kHalfMillimetre_m * std::sqrt(3.0) / shortest_interval_s(show);
    show.rounding.has_acceleration = false;
    return show;
}

}  // namespace aerogram::exporter
