#include "export/record/stands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

/// Spans are looked for on a grid of half the shortest stand: each holds a whole cell.
constexpr Millis kCell_ms = kShortestStand_ms / 2;
constexpr Millis kTick_ms = 10;
constexpr double kOverPad_m = 0.05;
constexpr double kCreep_mps = 0.05;  ///< who creeps through the tolerance at this speed does not stand

struct Box {
    Vec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void include(const Vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
    [[nodiscard]] double size() const { return low.x > high.x ? 0.0 : glm::length(high - low); }
};

/// A grid over the show in which a cell is 1 while nobody was seen to move in it.
class Cells {
  public:
    explicit Cells(Millis end_ms) : still_(static_cast<std::size_t>(end_ms / kCell_ms + 1), 1) {}

    [[nodiscard]] std::size_t count() const { return still_.size(); }
    [[nodiscard]] bool still(std::size_t cell) const { return still_[cell] != 0; }
    void join(const std::vector<std::uint8_t>& of_one) {
        for (std::size_t c = 0; c < still_.size(); ++c) still_[c] &= of_one[c];
    }

  private:
    std::vector<std::uint8_t> still_;
};

double cell_start_s(std::size_t cell) {
    return seconds_from_ms(static_cast<Millis>(cell) * kCell_ms);
}

std::size_t cell_of(double t_s, std::size_t count) {
    const double cell = std::floor(t_s * 1000.0 / static_cast<double>(kCell_ms));
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
}

/// Takes away the cells in which the drone moves by more than the tolerance.
void take_moves(const RecordedDrone& drone, double tolerance_m, std::vector<std::uint8_t>& still) {
    Box box;
    std::size_t at = 0;
    const auto close_until = [&](std::size_t cell) {
        if (cell == at) return;
        if (box.size() > tolerance_m) still[at] = 0;
        at = cell;
        box = {};
    };
    for (const Piece& piece : drone.pieces) {
        const std::size_t first = cell_of(piece.start_s, still.size());
        const std::size_t last = cell_of(piece.start_s + piece.duration_s, still.size());
        const Bezier curve = curve_of(drone, piece);
        Box whole;
        for (const Vec3& p : curve.controls()) whole.include(p);
        const bool stays = whole.size() == 0.0;
        for (std::size_t cell = first; cell <= last; ++cell) {
            close_until(cell);
            const double from = std::clamp((cell_start_s(cell) - piece.start_s) / piece.duration_s, 0.0, 1.0);
            const double to = std::clamp((cell_start_s(cell + 1) - piece.start_s) / piece.duration_s, 0.0, 1.0);
            if (stays || (from == 0.0 && to == 1.0) || to <= 0.0) {
                for (const Vec3& p : to <= 0.0 ? std::span(&curve.control[0], 1) : curve.controls()) box.include(p);
                continue;
            }
            const Bezier part = restricted(curve, from, to);
            for (const Vec3& p : part.controls()) box.include(p);
        }
    }
    close_until(still.size());
}

Result<Cells> still_cells(const RecordedShow& show, Millis end_ms, double tolerance_m, const Run& run) {
    Cells cells(end_ms);
    std::mutex joining;
    constexpr std::size_t kChunk = 64;
    parallel_for((show.drones.size() + kChunk - 1) / kChunk, run, "formations", [&](std::size_t chunk) {
        std::vector<std::uint8_t> still(cells.count(), 1);
        for (std::size_t d = chunk * kChunk; d < std::min(show.drones.size(), (chunk + 1) * kChunk); ++d)
            take_moves(show.drones[d], tolerance_m, still);
        const std::scoped_lock lock(joining);
        cells.join(still);
    });
    if (run.stopped()) return stopped_error();
    return cells;
}

Points places_at(const RecordedShow& show, double t_s) {
    Points places_m;
    for (const RecordedDrone& drone : show.drones) places_m.push_back(position_at(drone, t_s));
    return places_m;
}

bool everybody_at(const RecordedShow& show, const Points& places_m, double t_s, double tolerance_m) {
    for (std::size_t d = 0; d < places_m.size(); ++d)
        if (glm::length(position_at(show.drones[d], t_s) - places_m[d]) > tolerance_m) return false;
    return true;
}

/// The longest span around a still cell's middle in which everybody is where they are then: whole still cells first,
/// then ticks.
Stand widened(const RecordedShow& show, const Cells& cells, std::size_t cell, Millis end_ms, double tolerance_m) {
    Stand stand;
    const Millis middle_ms = std::min(static_cast<Millis>(cell) * kCell_ms + kCell_ms / 2, end_ms);
    stand.places_m = places_at(show, seconds_from_ms(middle_ms));
    const auto stays = [&](Millis ms) { return everybody_at(show, stand.places_m, seconds_from_ms(ms), tolerance_m); };
    const auto edge_ms = [](std::size_t c) { return static_cast<Millis>(c) * kCell_ms; };
    std::size_t first = cell, last = cell;
    while (first > 0 && cells.still(first - 1) && stays(edge_ms(first - 1))) --first;
    while (last + 1 < cells.count() && cells.still(last + 1) && edge_ms(last + 2) <= end_ms && stays(edge_ms(last + 2)))
        ++last;
    stand.from_ms = std::min(first < cell ? edge_ms(first) : middle_ms, middle_ms);
    stand.to_ms = std::max(last > cell ? edge_ms(last + 1) : middle_ms, middle_ms);
    while (stand.from_ms > 0 && stays(std::max<Millis>(0, stand.from_ms - kTick_ms)))
        stand.from_ms = std::max<Millis>(0, stand.from_ms - kTick_ms);
    while (stand.to_ms < end_ms && stays(std::min(end_ms, stand.to_ms + kTick_ms)))
        stand.to_ms = std::min(end_ms, stand.to_ms + kTick_ms);
    return stand;
}

/// A fleet that creeps into a formation or out of it seems to stand beside where it stands: of spans that follow each
/// other so closely in time and place the longest counts.
void leave_out_creeping(std::vector<Stand>& found) {
    constexpr Millis kClose_ms = 1000;
    constexpr double kClose_m = 0.3;
    const auto creeps = [&](const Stand& a, const Stand& b) {
        if (b.from_ms - a.to_ms > kClose_ms) return false;
        for (std::size_t d = 0; d < a.places_m.size(); ++d)
            if (glm::length(a.places_m[d] - b.places_m[d]) > kClose_m) return false;
        return true;
    };
    std::vector<Stand> kept;
    Stand before;
    for (Stand& stand : found) {
        const bool goes_on = !kept.empty() && creeps(before, stand);
        before = stand;
        if (!goes_on) {
            kept.push_back(std::move(stand));
        } else if (stand.to_ms - stand.from_ms > kept.back().to_ms - kept.back().from_ms) {
            kept.back() = std::move(stand);
        }
    }
    found = std::move(kept);
}

bool over(const Vec3& p, const Vec3& pad) {
    return glm::length(Vec2(p - pad)) <= kOverPad_m;
}

/// The stands that belong to taking off and landing are those over the pads before the first that is elsewhere, and
/// after the last.
void tell_aloft(const RecordedShow& show, std::vector<Stand>& found) {
    const auto somebody_away = [&](const Stand& stand) {
        for (std::size_t d = 0; d < show.drones.size(); ++d) {
            const RecordedDrone& drone = show.drones[d];
            if (!over(stand.places_m[d], first_position(drone)) && !over(stand.places_m[d], last_position(drone)))
                return true;
        }
        return false;
    };
    const auto first = std::ranges::find_if(found, somebody_away);
    if (first == found.end()) {  // a show straight above the pads: all but the ground
        for (Stand& stand : found) {
            for (std::size_t d = 0; d < show.drones.size(); ++d)
                stand.aloft |= stand.places_m[d].z - first_position(show.drones[d]).z > 1.0;
        }
        return;
    }
    const auto last = std::find_if(found.rbegin(), found.rend(), somebody_away).base();
    std::for_each(first, last, [](Stand& stand) { stand.aloft = true; });
}

}  // namespace

double standing_tolerance_m(const Rounding& rounding) {
    const double fit_m = rounding.has_acceleration ? 0.0 : rounding.fit_m;  // curves stand exactly, lines may slant
    return 2.0 * (fit_m + std::sqrt(3.0) * rounding.position_m) + 0.001;
}

Result<std::vector<Stand>> stands(const RecordedShow& show, const Run& run) {
    const double tolerance_m = standing_tolerance_m(show.rounding);
    double longest_s = show.duration_s;
    for (const RecordedDrone& drone : show.drones) longest_s = std::max(longest_s, end_s(drone));
    const Millis end_ms = std::max<Millis>(1, static_cast<Millis>(std::ceil(longest_s * 1000.0)));
    const Millis shortest_ms = std::max(kShortestStand_ms, static_cast<Millis>(tolerance_m / kCreep_mps * 1000.0));
    const auto cells = still_cells(show, end_ms, tolerance_m, run);
    if (!cells) return cells.error();
    std::vector<Stand> found;
    for (std::size_t c = 0; c < cells->count(); ++c) {
        if (!cells->still(c)) continue;
        const Millis cell_ms = static_cast<Millis>(c) * kCell_ms;
        if (!found.empty() && cell_ms < found.back().to_ms) continue;
        Stand stand = widened(show, *cells, c, end_ms, tolerance_m);
        if (!found.empty()) stand.from_ms = std::max(stand.from_ms, found.back().to_ms);
        if (run.stopped()) return stopped_error();
        if (stand.to_ms - stand.from_ms < shortest_ms) continue;
        const Points middle_m = places_at(show, seconds_from_ms((stand.from_ms + stand.to_ms) / 2));
        found.push_back(std::move(stand));
        if (everybody_at(show, middle_m, seconds_from_ms(found.back().from_ms), tolerance_m) &&
            everybody_at(show, middle_m, seconds_from_ms(found.back().to_ms), tolerance_m))
            found.back().places_m = middle_m;
    }
    leave_out_creeping(found);
    tell_aloft(show, found);
    return found;
}

}  // namespace aerogram::exporter
