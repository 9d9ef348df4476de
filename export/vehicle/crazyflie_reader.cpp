#include <algorithm>
#include <cmath>

#include "export/bytes/decimal.hpp"
#include "export/outgoing/curve_fit.hpp"
#include "export/vehicle/companion.hpp"
#include "export/vehicle/crazyflie.hpp"
#include "export/vehicle/septic.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kFarthest_m = 1e6, kLongest_s = 86'400.0, kLargest = 1e30;
constexpr std::size_t kColumns = 33;
constexpr std::size_t kYawSteps = 32;

/// Lines of one file as pieces.
class CsvFile {
  public:
    explicit CsvFile(const FileBytes& file) : where_(file.path), text_(file.bytes) {}

    Result<std::vector<SepticPiece>> read() {
        Fields lines(text_, '\n');
        std::vector<SepticPiece> pieces;
        double end_s = 0.0;
        for (number_ = 1; problem_.empty(); ++number_) {
            const auto line = lines.next();
            if (!line) break;
            const std::string_view text = line->ends_with('\r') ? line->substr(0, line->size() - 1) : *line;
            if (number_ == 1) {
                if (!text.starts_with("duration,x^0") && !text.starts_with("Duration,x^0"))
                    fail("must be the header duration,x^0,...");
            } else if (!trimmed(text).empty()) {
                pieces.push_back(piece(text));
                end_s += static_cast<double>(pieces.back().duration_s);
                if (problem_.empty() && end_s > kLongest_s) fail("ends after more than a day");
            }
        }
        if (problem_.empty() && pieces.empty()) fail("holds no piece");
        if (!problem_.empty()) return Error{ErrorCode::invalid_input, problem_};
        return pieces;
    }

  private:
    void fail(const std::string& what) {
        if (problem_.empty()) problem_ = std::string(where_) + ": line " + std::to_string(number_) + ": " + what;
    }

    SepticPiece piece(std::string_view text) {
        Fields fields(text, ',');
        SepticPiece piece;
        piece.duration_s = number(fields, 0);
        if (problem_.empty() && !(piece.duration_s >= 1e-3F)) fail("column 1: a duration must be at least 0.001 s");
        std::size_t column = 1;
        for (Powers* powers : {&piece.place[0], &piece.place[1], &piece.place[2], &piece.yaw})
            for (float& c : *powers) c = number(fields, column++);
        if (!problem_.empty()) return piece;
        const Bezier curve = curve_of(piece);
        for (const Vec3& p : curve.controls())
            if (!is_finite(p) || std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kFarthest_m)
                fail("flies beyond 1000 km");
        return piece;
    }

    float number(Fields& fields, std::size_t column) {
        const auto field = fields.next();
        const auto value = field ? parse_number(*field, kLargest) : std::nullopt;
        if (!value)
            fail("column " + std::to_string(column + 1) + " of " + std::to_string(kColumns) + " = " +
                 shown(field.value_or("")) + ": must be a number");
        return static_cast<float>(value.value_or(0.0));
    }

    std::string_view where_, text_;
    std::size_t number_ = 1;
    std::string problem_;
};

/// Straight yaw as two keys, bent yaw as steps.
void add_yaw(std::vector<YawKey>& keys, const SepticPiece& piece, double start_s) {
    const bool straight = std::all_of(piece.yaw.begin() + 2, piece.yaw.end(), [](float c) { return c == 0.0F; });
    const std::size_t steps = straight ? 1 : kYawSteps;
    for (std::size_t k = 0; k <= steps; ++k) {
        const double t = static_cast<double>(piece.duration_s) * static_cast<double>(k) / static_cast<double>(steps);
        double yaw_rad = 0.0;
        for (std::size_t i = kSepticTerms; i-- > 0;) yaw_rad = yaw_rad * t + static_cast<double>(piece.yaw[i]);
        if (!(std::abs(yaw_rad) < 1e6)) yaw_rad = 0.0;
        const YawKey key{std::llround(1000.0 * (start_s + t)), yaw_rad};
        if (keys.empty() || keys.back() != key) keys.push_back(key);
    }
}

void add_flight(RecordedDrone& drone, const std::vector<SepticPiece>& pieces) {
    double at_s = 0.0;
    for (const SepticPiece& piece : pieces) {
        const Bezier curve = curve_of(piece);
        const double duration_s = static_cast<double>(piece.duration_s);
        drone.pieces.push_back({at_s, duration_s, static_cast<std::uint32_t>(drone.controls_m.size()),
                                static_cast<std::uint8_t>(curve.degree)});
        drone.controls_m.insert(drone.controls_m.end(), curve.control.begin(), curve.control.end());
        add_yaw(drone.tracks.yaw, piece, at_s);
        at_s += duration_s;
    }
    std::vector<YawKey>& yaw = drone.tracks.yaw;
    if (std::ranges::all_of(yaw, [](const YawKey& key) { return key.yaw_rad == 0.0; })) yaw.clear();
}

}  // namespace

Result<RecordedShow> read_crazyflie(std::span<const FileBytes> files) {
    Companion companion;
    for (const FileBytes& file : files) {
        if (!is_companion("crazyflie", file.bytes)) continue;
        auto read = read_companion(file, "crazyflie");
        if (!read) return read.error();
        companion = std::move(*read);
    }
    RecordedShow show = std::move(companion.show);
    show.format = "crazyflie";
    std::array<double, 3> worst{};
    for (const FileBytes* file : in_order_of_numbers(files)) {
        if (is_companion("crazyflie", file->bytes)) continue;
        const auto pieces = CsvFile(*file).read();
        if (!pieces) return pieces.error();
        const std::string name = file_name(file->path);
        const auto told = companion.drones.find(name);
        RecordedDrone drone;
        if (told != companion.drones.end()) drone = std::move(told->second);
        if (drone.name.empty()) drone.name = name.substr(0, name.rfind('.'));
        add_flight(drone, *pieces);
        for (const SepticPiece& piece : *pieces) {
            const auto rounding = rounding_of(piece);
            for (std::size_t k = 0; k < 3; ++k) worst[k] = std::max(worst[k], rounding[k]);
        }
        show.duration_s = std::max(show.duration_s, end_s(drone));
        show.drones.push_back(std::move(drone));
    }
    if (show.drones.empty())
        return Error{ErrorCode::invalid_input,
                     (files.empty() ? "crazyflie" : files.front().path) + ": no file of a drone beside it"};
    Rounding& r = show.rounding;
    r.position_m = worst[0];
    r.fit_m = kFitPosition_m;
    r.time_s = show.duration_s / (1 << 24);
    r.speed_allowance_mps = kFitSpeed_mps + 2.0 * std::sqrt(3.0) * worst[1];
    r.acceleration_allowance_mps2 =
        kFitAccelerationShare * show.limits.value_or(Limits{}).acceleration_mps2 + 2.0 * std::sqrt(3.0) * worst[2];
    return show;
}

}  // namespace aerogram::exporter
