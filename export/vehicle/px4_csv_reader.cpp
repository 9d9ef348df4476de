#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "export/bytes/decimal.hpp"
#include "export/bytes/text_cursor.hpp"
#include "export/vehicle/companion.hpp"
#include "export/vehicle/ned.hpp"
#include "export/vehicle/px4_csv.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::array<std::string_view, 16> kColumns{"idx", "t",  "px", "py",  "pz",   "vx",   "vy",   "vz",
                                                    "ax",  "ay", "az", "yaw", "mode", "ledr", "ledg", "ledb"};
enum Column : std::size_t { kTime = 1, kNorth = 2, kEast = 3, kDown = 4, kYaw = 11, kRed = 13 };
constexpr double kLongest_s = 86'400.0, kFarthest_m = 1e6, kAny = 1e9;
constexpr double kHalfMillimetre_m = 0.0005;

struct Row {
    double time_s = 0.0;
    Vec3 ned_m{};
    std::optional<double> compass_deg;
    Rgb8 color;
};

/// One CSV, line by line; the first problem is kept with its line.
class CsvFile {
  public:
    explicit CsvFile(const FileBytes& file) : where_(file.path), lines_(without_blank_end(file.bytes), '\n') {}

    Result<std::vector<Row>> read() {
        header();
        std::vector<Row> rows;
        while (problem_.empty()) {
            const auto text = line();
            if (!text) break;
            Row row;
            if (!plain_ || !quickly(*text, row)) row = parsed(*text);
            if (problem_.empty() && !rows.empty() && !(row.time_s > rows.back().time_s))
                fail("t must be above the row before");
            if (problem_.empty()) rows.push_back(row);
        }
        if (problem_.empty() && rows.size() < 2) fail("needs at least two rows");
        if (!problem_.empty()) return Error{ErrorCode::invalid_input, problem_};
        return rows;
    }

  private:
    static std::string_view without_blank_end(std::string_view text) {
        const std::size_t last = text.find_last_not_of("\r\n");
        return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
    }
    void fail(const std::string& what) {
        if (problem_.empty()) problem_ = std::string(where_) + ": line " + std::to_string(number_) + ": " + what;
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
        while (const auto field = fields.next()) {
            const auto known = std::ranges::find(kColumns, trimmed(*field));
            roles_.push_back(static_cast<std::size_t>(known - kColumns.begin()));
            if (roles_.size() > 200) return fail("more than 200 columns");
        }
        for (std::size_t column = 0; column < kColumns.size(); ++column) {
            const auto count = std::ranges::count(roles_, column);
            if (count > 1) fail("two columns " + std::string(kColumns[column]));
            if (count == 0 && column >= kTime && column <= kDown) fail("no column " + std::string(kColumns[column]));
            has_[column] = count == 1;
        }
        plain_ = roles_.size() == kColumns.size();
        for (std::size_t k = 0; plain_ && k < roles_.size(); ++k) plain_ = roles_[k] == k;
    }

    /// A row as our own writer leaves it.
    bool quickly(std::string_view text, Row& row) {
        TextCursor cursor(text);
        std::array<double, kColumns.size()> values{};
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (k > 0) cursor.expect(",");
            values[k] = cursor.number(kAny);
        }
        if (!cursor.ok() || !cursor.at_end()) return false;
        return from_values(values, row);
    }

    Row parsed(std::string_view text) {
        Fields fields(text, ',');
        std::array<double, kColumns.size()> values{};
        for (const std::size_t role : roles_) {
            const auto field = fields.next();
            if (role >= kColumns.size() || role == kTime - 1) continue;
            const auto value = field ? parse_number(*field, kAny) : std::nullopt;
            const bool needed = role <= kDown || role >= kYaw;
            if (!value && needed)
                fail(std::string(kColumns[role]) + " = " + shown(field.value_or("")) + ": must be a number");
            values[role] = value.value_or(0.0);
        }
        Row row;
        if (problem_.empty() && !from_values(values, row)) fail("t or a place is out of range");
        return row;
    }

    bool from_values(const std::array<double, kColumns.size()>& values, Row& row) const {
        row.time_s = values[kTime];
        row.ned_m = {values[kNorth], values[kEast], values[kDown]};
        if (has_[kYaw]) row.compass_deg = values[kYaw];
        const auto channel = [](double x) { return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0, 255.0))); };
        row.color = {channel(values[kRed]), channel(values[kRed + 1]), channel(values[kRed + 2])};
        const Vec3 away = glm::abs(row.ned_m);
        return row.time_s >= 0.0 && row.time_s <= kLongest_s && std::max({away.x, away.y, away.z}) <= kFarthest_m;
    }

    std::string_view where_;
    Fields lines_;
    std::size_t number_ = 0;
    std::string problem_;
    std::vector<std::size_t> roles_;  ///< of the file's columns; kColumns.size(): unknown
    std::array<bool, kColumns.size()> has_{};
    bool plain_ = false;  ///< the columns are ours, in our order
};

Millis millis(double time_s) {
    return std::llround(1000.0 * time_s);
}

/// Each colour holds until the next row.
std::vector<LightKey> lights(const std::vector<Row>& rows) {
    std::vector<LightKey> keys;
    for (const Row& row : rows)
        if (keys.empty() || keys.back().color != from_8bit(row.color))
            keys.push_back({millis(row.time_s), from_8bit(row.color), false});
    return keys;
}

/// Keys where the yaw bends; none when the nose stays along +y.
std::vector<YawKey> yaw(const std::vector<Row>& rows, const NedFrame& frame) {
    std::vector<YawKey> keys;
    if (!rows.front().compass_deg) return keys;
    double before_rad = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        double yaw_rad = frame.from_compass_deg(*rows[k].compass_deg);
        if (k > 0) yaw_rad = before_rad + std::remainder(yaw_rad - before_rad, 2.0 * kPi);
        const bool same = k > 0 && rows[k].compass_deg == rows[k - 1].compass_deg;
        const bool stays = k + 1 < rows.size() && rows[k].compass_deg == rows[k + 1].compass_deg;
        if (!same || !stays) keys.push_back({millis(rows[k].time_s), yaw_rad});
        before_rad = yaw_rad;
    }
    const bool along = std::ranges::all_of(keys, [](const YawKey& key) { return std::abs(key.yaw_rad) < 1e-5; });
    return along ? std::vector<YawKey>{} : keys;
}

void add_flight(RecordedDrone& drone, const std::vector<Row>& rows, const NedFrame& frame) {
    drone.controls_m.reserve(rows.size());
    drone.pieces.reserve(rows.size() - 1);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        drone.controls_m.push_back(frame.from_ned(rows[k].ned_m));
        if (k + 1 < rows.size())
            drone.pieces.push_back(
                {rows[k].time_s, rows[k + 1].time_s - rows[k].time_s, static_cast<std::uint32_t>(k), 1});
    }
    drone.tracks.lights = lights(rows);
    drone.tracks.yaw = yaw(rows, frame);
}

void state_rounding(RecordedShow& show) {
    double shortest_s = 1.0;
    for (const RecordedDrone& drone : show.drones)
        for (const Piece& piece : drone.pieces) shortest_s = std::min(shortest_s, piece.duration_s);
    // Millimetres are along north and east: along the show's axes they may be √2 as much.
    show.rounding.position_m = std::sqrt(2.0) * kHalfMillimetre_m;
    show.rounding.fit_m = kPx4Chord_m;
    show.rounding.speed_allowance_mps = 2.0 * kHalfMillimetre_m * std::sqrt(3.0) / shortest_s;
    show.rounding.has_acceleration = false;
}

}  // namespace

Result<RecordedShow> read_px4_csv(std::span<const FileBytes> files) {
    Companion companion;
    for (const FileBytes& file : files) {
        if (!is_companion("px4-csv", file.bytes)) continue;
        auto read = read_companion(file, "px4-csv");
        if (!read) return read.error();
        companion = std::move(*read);
    }
    RecordedShow show = std::move(companion.show);
    show.format = "px4-csv";
    const NedFrame frame(show.origin ? show.origin->heading_deg : 0.0);
    for (const FileBytes* file : in_order_of_numbers(files)) {
        if (is_companion("px4-csv", file->bytes)) continue;
        const auto rows = CsvFile(*file).read();
        if (!rows) return rows.error();
        const std::string name = file_name(file->path);
        const auto told = companion.drones.find(name);
        RecordedDrone drone;
        if (told != companion.drones.end()) drone = std::move(told->second);
        if (drone.name.empty()) drone.name = name.substr(0, name.rfind('.'));
        add_flight(drone, *rows, frame);
        show.duration_s = std::max(show.duration_s, rows->back().time_s);
        show.drones.push_back(std::move(drone));
    }
    if (show.drones.empty())
        return Error{ErrorCode::invalid_input,
                     (files.empty() ? "px4-csv" : files.front().path) + ": no file of a drone beside it"};
    state_rounding(show);
    return show;
}

}  // namespace aerogram::exporter
