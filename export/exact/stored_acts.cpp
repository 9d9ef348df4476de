#include "export/exact/stored_acts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "export/exact/knot_pieces.hpp"
#include "export/exact/trajectories_bin.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter::trajectories {
namespace {

enum Kind : std::uint32_t { kHold, kStraight, kLattice, kKinds };

void read_motion(PayloadCursor& in, std::size_t drones, StoredAct& act) {
    const std::uint32_t kind = in.one_of(kKinds);
    const std::size_t row_bytes = 3 * in.scalar_bytes() * drones;
    std::size_t rows_stored = 1;
    if (kind != kHold) {
        act.rows = in.count(kind == kStraight ? in.scalar_bytes() : row_bytes);
        if (act.rows < 4 || (kind == kStraight && act.rows > kMaxProfileRows)) in.complain("rows out of range", 4);
        if (!in.ok()) return;
        if (kind == kStraight) act.profile.resize(act.rows);
        for (double& s : act.profile) s = in.scalar(2.0);
        rows_stored = kind == kStraight ? 2 : act.rows;
    }
    act.points_offset = in.offset();
    act.points = in.bytes(rows_stored * row_bytes);
}

void add_hold(const std::vector<Vec3>& stand, double start_s, double duration_s, std::vector<RecordedDrone>& drones) {
    for (std::size_t i = 0; i < drones.size(); ++i) {
        const auto control = static_cast<std::uint32_t>(drones[i].controls_m.size());
        drones[i].pieces.push_back({start_s, duration_s, control, 0});
        drones[i].controls_m.push_back(stand[i]);
    }
}

void add_spline(PayloadCursor& in, const StoredAct& act, double start_s, double step_s,
                std::vector<RecordedDrone>& drones) {
    KnotPieces pieces(drones, start_s, step_s);
    if (act.profile.empty()) {
        for (std::size_t k = 0; k < act.rows && in.ok(); ++k) pieces.add_row(in.points(drones.size()));
        return;
    }
    const std::vector<Vec3> from = in.points(drones.size()), to = in.points(drones.size());
    for (std::size_t k = 0; k < act.rows && in.ok(); ++k) {
        std::vector<Vec3> row(drones.size());
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = from[i] + act.profile[k] * (to[i] - from[i]);
        pieces.add_row(std::move(row));
    }
}

}  // namespace

std::vector<StoredAct> read_acts(PayloadCursor& in, std::size_t drones) {
    const std::size_t count = in.count(24 + 3 * in.scalar_bytes());
    if (count == 0) in.complain("no acts", 4);
    std::vector<StoredAct> acts;
    std::int64_t clock_ms = 0;
    for (std::size_t a = 0; a < count && in.ok(); ++a) {
        in.text();
        in.one_of(4);  // role
        in.one_of(2);  // timing
        StoredAct act;
        act.start_ms = in.number<std::int32_t>();
        if (act.start_ms != clock_ms) in.complain("an act that does not begin where the one before ended", 4);
        act.duration_ms = in.number<std::int32_t>();
        clock_ms += act.duration_ms;
        if (act.duration_ms <= 0 || clock_ms > std::numeric_limits<std::int32_t>::max()) {
            in.complain("a duration out of range", 4);
        }
        read_motion(in, drones, act);
        acts.push_back(std::move(act));
    }
    return acts;
}

std::string add_pieces(const std::vector<StoredAct>& acts, std::size_t scalar_bytes,
                       std::vector<RecordedDrone>& drones) {
    std::size_t pieces = 0, controls = 0;
    for (const StoredAct& act : acts) {
        pieces += act.intervals();
        controls += act.rows == 0 ? 1 : 3 * act.intervals() + 1;
    }
    if (controls > std::numeric_limits<std::uint32_t>::max()) return "more knot intervals than can be counted";
    for (RecordedDrone& drone : drones) {
        drone.pieces.reserve(pieces);
        drone.controls_m.reserve(controls);
    }
    for (const StoredAct& act : acts) {
        PayloadCursor in(act.points, act.points_offset, scalar_bytes);
        const double start_s = seconds_from_ms(act.start_ms), duration_s = seconds_from_ms(act.duration_ms);
        if (act.rows == 0) {
            add_hold(in.points(drones.size()), start_s, duration_s, drones);
        } else {
            add_spline(in, act, start_s, duration_s / static_cast<double>(act.intervals()), drones);
        }
        if (!in.ok()) return in.problem();
    }
    return {};
}

Rounding stated_rounding(const std::vector<StoredAct>& acts, std::size_t scalar_bytes,
                         const std::vector<RecordedDrone>& drones) {
    double largest_m = 1.0;
    for (const RecordedDrone& drone : drones) {
        for (const Vec3& p : drone.controls_m) {
            largest_m = std::max({largest_m, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        }
    }
    double step_s = std::numeric_limits<double>::infinity();
    for (const StoredAct& act : acts) {
        if (act.rows != 0)
            step_s = std::min(step_s, seconds_from_ms(act.duration_ms) / static_cast<double>(act.intervals()));
    }
    // Floats: a straight act's row is from + s (to - from), three rounded numbers; speeds are differences of two rows,
    // accelerations of three, with weights that sum to 2 and 4. Doubles: the Bézier points' own rounding, 3 and 6 times
    // differences of two and three of them.
    const bool exact = scalar_bytes == 8;
    Rounding rounding;
    rounding.position_m = largest_m * (exact ? 0x1p-50 : 0x1p-22);
    rounding.speed_allowance_mps = (exact ? 12.0 : 4.0) * rounding.position_m / step_s;
    rounding.acceleration_allowance_mps2 = (exact ? 48.0 : 8.0) * rounding.position_m / (step_s * step_s);
    return rounding;
}

}  // namespace aerogram::exporter::trajectories
