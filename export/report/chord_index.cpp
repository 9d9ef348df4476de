#include "export/report/chord_index.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

namespace aerogram::exporter {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kSmallestCell_m = 1.2;
constexpr double kDirect = 4.0;          ///< cells: wider questions are asked in steps
constexpr double kMostCrossings = 25e6;  ///< of cells, by all ways: 100 MB
constexpr double kRounding_m = 2e-3;     ///< of floats, a kilometre away
constexpr std::size_t kDronesATask = 64;
constexpr std::size_t kBucketsATask = 1 << 16;

}  // namespace

Vec3 ChordIndex::drifted(std::size_t drone, std::size_t k) const {
    Vec3 p = wide(all_.place(drone, k));
    p.z -= drift_mps_ * time_s(k);
    return p;
}

double ChordIndex::time_s(std::size_t k) const {
    return std::min(static_cast<double>(k) * all_.step_s(), all_.duration_s);
}

ChordIndex::Cell ChordIndex::cell_of(const Vec3& p) const {
    return {static_cast<std::int32_t>(std::floor(p.x / cell_)), static_cast<std::int32_t>(std::floor(p.y / cell_)),
            static_cast<std::int32_t>(std::floor(p.z / cell_))};
}

/// Cells in a row along x are neighbours in memory.
std::size_t ChordIndex::bucket(const Cell& c) const {
    const std::uint64_t mixed = static_cast<std::uint32_t>(c.y) * 0xC2B2AE3D27D4EB4FULL ^
                                static_cast<std::uint32_t>(c.z) * 0x165667B19E3779F9ULL;
    return static_cast<std::size_t>(((mixed * 0x9E3779B97F4A7C15ULL) >> 32) + static_cast<std::uint32_t>(c.x)) & mask_;
}

/// Without drift: whoever stands is one entry however long. With drift: where drones stand on pads, which are left out.
void ChordIndex::find_stands() {
    const std::size_t last = all_.instants - 1;
    for (std::size_t d = 0; d < all_.drones.size(); ++d) {
        first_stand_.push_back(static_cast<std::uint32_t>(stands_.size()));
        for (std::size_t k = 0; k < last; ++k) {
            std::size_t to = k;
            while (to < last && all_.place(d, to + 1) == all_.place(d, k)) ++to;
            if (to == k) continue;
            const bool on_pad = all_.stance(d, 0.5 * (time_s(k) + time_s(to))) == Stance::on_pad;
            if (drift_mps_ == 0.0 || on_pad)
                stands_.push_back(
                    {static_cast<std::uint32_t>(d), static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(to)});
            k = to - 1;
        }
        const bool ends_so = stands_.size() > first_stand_.back() && stands_.back().to == last;
        if (drift_mps_ == 0.0 && !ends_so)
            stands_.push_back(
                {static_cast<std::uint32_t>(d), static_cast<std::uint32_t>(last), static_cast<std::uint32_t>(last)});
    }
    first_stand_.push_back(static_cast<std::uint32_t>(stands_.size()));
}

/// Calls with (entry, from, to) for each chord and stand of a drone.
template <class Visit>
void ChordIndex::for_each_entry(std::size_t d, const Visit& visit) const {
    std::uint32_t next = first_stand_[d];
    const std::uint32_t end = first_stand_[d + 1];
    const std::size_t last = all_.instants - 1;
    for (std::size_t k = 0; k < last; ++k) {
        if (next < end && stands_[next].from == k) {
            if (drift_mps_ == 0.0) visit(next | kStand, drifted(d, k), drifted(d, k));
            k = stands_[next++].to - 1;
            continue;
        }
        visit(static_cast<std::uint32_t>(d * all_.instants + k), drifted(d, k), drifted(d, k + 1));
    }
    if (next < end && drift_mps_ == 0.0) visit(next | kStand, drifted(d, last), drifted(d, last));
}

/// Calls for each cell's bucket that the line from a to b passes through.
template <class Visit>
void ChordIndex::walk(const Vec3& a, const Vec3& b, const Visit& visit) const {
    Cell at = cell_of(a);
    const Cell to = cell_of(b);
    visit(bucket(at));
    int left = std::abs(to.x - at.x) + std::abs(to.y - at.y) + std::abs(to.z - at.z);
    if (left == 0) return;
    const Vec3 way = b - a;
    const auto ahead = [&](double from, double by, std::int32_t cell) {
        if (by == 0.0) return kForever;
        return ((static_cast<double>(cell) + (by > 0.0 ? 1.0 : 0.0)) * cell_ - from) / by;
    };
    for (; left > 0; --left) {  // steps across the next border; towards the goal whatever rounding says
        const double x = at.x == to.x ? kForever : ahead(a.x, way.x, at.x);
        const double y = at.y == to.y ? kForever : ahead(a.y, way.y, at.y);
        const double z = at.z == to.z ? kForever : ahead(a.z, way.z, at.z);
        if (x <= y && x <= z && at.x != to.x) {
            at.x += to.x > at.x ? 1 : -1;
        } else if (y <= z && at.y != to.y) {
            at.y += to.y > at.y ? 1 : -1;
        } else {
            at.z += to.z > at.z ? 1 : -1;
        }
        visit(bucket(at));
    }
}

void ChordIndex::choose_cells(const Run& run) {
    const std::size_t n = all_.drones.size();
    std::vector<double> length(n);
    parallel_for((n + kDronesATask - 1) / kDronesATask, run, "", [&](std::size_t task) {
        for (std::size_t d = task * kDronesATask; d < std::min(n, (task + 1) * kDronesATask); ++d) {
            for_each_entry(d, [&](std::uint32_t, const Vec3& a, const Vec3& b) {
                const Vec3 way = glm::abs(b - a);
                length[d] += way.x + way.y + way.z;
            });
        }
    });
    double whole = 0.0;
    for (const double l : length) whole += l;
    cell_ = std::max(kSmallestCell_m, whole / kMostCrossings);
    const double entries = static_cast<double>(n * all_.instants) + whole / cell_;
    mask_ = std::clamp<std::size_t>(std::bit_ceil(static_cast<std::size_t>(entries)), 1 << 10, 1 << 25) - 1;
}

ChordIndex::ChordIndex(const Survey& all, double drift_mps, const Run& run) : all_(all), drift_mps_(drift_mps) {
    const std::size_t n = all.drones.size(), tasks = (n + kDronesATask - 1) / kDronesATask;
    find_stands();
    choose_cells(run);
    starts_.assign(mask_ + 3, 0);  // counted two further on, so that filling moves each start to its place
    const auto for_all = [&](const auto& each) {
        parallel_for(tasks, run, "", [&](std::size_t task) {
            for (std::size_t d = task * kDronesATask; d < std::min(n, (task + 1) * kDronesATask); ++d) {
                for_each_entry(d, [&](std::uint32_t entry, const Vec3& a, const Vec3& b) {
                    walk(a, b, [&](std::size_t in) { each(entry, in); });
                });
            }
        });
    };
    for_all([&](std::uint32_t, std::size_t in) {
        std::atomic_ref(starts_[in + 2]).fetch_add(1, std::memory_order_relaxed);
    });
    for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
    entries_.resize(starts_.back());
    for_all([&](std::uint32_t entry, std::size_t in) {
        entries_[std::atomic_ref(starts_[in + 1]).fetch_add(1, std::memory_order_relaxed)] = entry;
    });
    parallel_for((mask_ + kBucketsATask) / kBucketsATask, run, "", [&](std::size_t task) {
        for (std::size_t b = task * kBucketsATask; b < std::min(mask_ + 1, (task + 1) * kBucketsATask); ++b)
            std::sort(entries_.begin() + starts_[b], entries_.begin() + starts_[b + 1]);
    });
}

/// One entry against the way of the drone that left.
void ChordIndex::meet(std::uint32_t entry, const Mover& way, Stance stance, Found& found) const {
    Mover other;
    if ((entry & kStand) != 0) {
        const Stand& stand = stands_[entry & ~kStand];
        other.drone = stand.drone;
        other.begin_s = time_s(stand.from);
        other.end_s = stand.to + 1 == all_.instants ? kForever : time_s(stand.to);
        if (other.drone == way.drone || other.end_s < way.begin_s || other.begin_s > way.end_s) return;
        other.from = other.to = wide(all_.place(stand.drone, stand.from));
    } else {
        other.drone = entry / static_cast<std::uint32_t>(all_.instants);
        const std::size_t k = entry % all_.instants;
        other.begin_s = time_s(k);
        other.end_s = time_s(k + 1);
        if (other.drone == way.drone || other.end_s < way.begin_s || other.begin_s > way.end_s) return;
        other.from = wide(all_.place(other.drone, k));
        other.to = wide(all_.place(other.drone, k + 1));
    }
    const double from_s = std::max(way.begin_s, other.begin_s);
    double to_s = std::min(way.end_s, other.end_s);
    if (to_s == kForever) to_s = from_s;  // both stand
    const Nearest near = nearest_on_line(other.at(from_s) - way.at(from_s), other.at(to_s) - way.at(to_s));
    if (!(near.distance_m < found.distance)) return;
    const double t_s = from_s + near.u * (to_s - from_s);
    if (all_.excuses(way.drone, stance, other.drone, all_.stance(other.drone, t_s))) return;
    found.note(near.distance_m, way.drone, other.drone, t_s);
}

/// Looks wider and wider until nobody closer can be left. low, high: the way's box, drifted.
void ChordIndex::look_around(const Mover& way, const Vec3& low, const Vec3& high, Stance stance, Found& found) const {
    for (double reach = kDirect * cell_;; reach *= 2.0) {
        const bool last = found.distance <= reach;
        const Vec3 wider(std::min(reach, found.distance) + kRounding_m);
        const Vec3 cells = (high - low + 2.0 * wider) / cell_ + 2.0;
        if (cells.x * cells.y * cells.z > 0.25 * static_cast<double>(std::min(entries_.size(), mask_))) {
            for (const std::uint32_t entry : entries_) meet(entry, way, stance, found);
            return;
        }
        const Cell from = cell_of(low - wider), to = cell_of(high + wider);
        for (std::int32_t z = from.z; z <= to.z; ++z) {
            for (std::int32_t y = from.y; y <= to.y; ++y) {
                const std::size_t begin = bucket({from.x, y, z}), cells_x = static_cast<std::size_t>(to.x - from.x) + 1;
                const std::size_t end = std::min(begin + cells_x, mask_ + 1);
                for (std::size_t i = starts_[begin]; i < starts_[end]; ++i) meet(entries_[i], way, stance, found);
                const std::size_t over = begin + cells_x - end;  // the row goes on at the table's beginning
                for (std::size_t i = 0; i < starts_[over]; ++i) meet(entries_[i], way, stance, found);
            }
        }
        if (last || found.distance <= reach) return;
    }
}

void ChordIndex::ask(const Question& q, Found& found) const {
    Mover way{q.at, q.at, q.begin_s, q.end_s, static_cast<std::uint32_t>(q.drone)};
    if (drift_mps_ != 0.0) {
        way.end_s = std::min(way.end_s, all_.duration_s);
        if (way.end_s < way.begin_s) return;
        way.to.z += drift_mps_ * (way.end_s - way.begin_s);
    }
    Vec3 at = q.at;
    at.z -= drift_mps_ * q.begin_s;
    look_around(way, at, at, q.stance, found);
}

void ChordIndex::ask(const Mover& mover, Stance stance, Found& found) const {
    look_around(mover, glm::min(mover.from, mover.to), glm::max(mover.from, mover.to), stance, found);
}

}  // namespace aerogram::exporter
