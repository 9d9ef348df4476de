#include "export/verify/slab.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aerogram::exporter {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

/// Walks one drone through [begin_s, end_s] and hands over each polynomial on its own time.
template <class Visit>
void walk(const RecordedDrone& drone, std::span<const Interval> grounded, double begin_s, double end_s, Visit visit) {
    const double starts_s = drone.pieces.front().start_s, ends_s = exporter::end_s(drone);
    std::size_t k = piece_at(drone, begin_s);
    auto ground = std::ranges::partition_point(grounded, [&](const Interval& g) { return g.end_s <= begin_s; });
    for (double t = begin_s; t < end_s;) {
        const Piece& piece = drone.pieces[k];
        double until = std::min(end_s, k + 1 < drone.pieces.size() ? drone.pieces[k + 1].start_s : kForever);
        if (t < starts_s) {
            until = std::min(until, starts_s);
        } else if (t < ends_s) {
            until = std::min(until, ends_s);
        }
        while (ground != grounded.end() && ground->end_s <= t) ++ground;
        const bool on_ground = ground != grounded.end() && ground->begin_s <= t;
        if (ground != grounded.end()) until = std::min(until, on_ground ? ground->end_s : ground->begin_s);
        if (t < starts_s || t >= ends_s) {
            visit(t, until, Bezier{{t < starts_s ? first_position(drone) : last_position(drone)}, 0}, on_ground);
        } else {
            const double from = (t - piece.start_s) / piece.duration_s;
            const double to = (until - piece.start_s) / piece.duration_s;
            const bool whole = from == 0.0 && std::abs(to - 1.0) < 1e-12;
            visit(t, until, whole ? curve_of(drone, piece) : restricted(curve_of(drone, piece), from, to), on_ground);
        }
        t = until;
        while (k + 1 < drone.pieces.size() && drone.pieces[k + 1].start_s <= t) ++k;
    }
}

void scale(Bezier& curve, double downwash) {
    for (std::size_t i = 0; i <= curve.degree; ++i) curve.control[i].z /= downwash;
}

void include(Box& box, const Bezier& curve) {
    for (const Vec3& p : curve.controls()) {
        box.low_m = glm::min(box.low_m, p);
        box.high_m = glm::max(box.high_m, p);
    }
}

Box nothing() {
    return {Vec3(kForever), Vec3(-kForever)};
}

}  // namespace

double Box::gap(const Box& other) const {
    const Vec3 apart = glm::max(glm::max(low_m - other.high_m, other.low_m - high_m), Vec3(0.0));
    return glm::length(apart);
}

Timelines timelines(std::span<const RecordedDrone> drones, double downwash) {
    AEROGRAM_REQUIRE(!drones.empty());
    Timelines all{drones, {}, downwash, kForever, -kForever};
    all.grounded.reserve(drones.size());
    for (const RecordedDrone& drone : drones) {
        all.grounded.push_back(grounded_intervals(drone));
        all.begin_s = std::min(all.begin_s, drone.pieces.front().start_s);
        all.end_s = std::max(all.end_s, exporter::end_s(drone));
    }
    return all;
}

SlabSize measure(const Timelines& shows, double begin_s, double end_s, std::vector<Box>& boxes) {
    SlabSize size;
    boxes.assign(shows.drones.size(), nothing());
    for (std::size_t d = 0; d < shows.drones.size(); ++d) {
        walk(shows.drones[d], shows.grounded[d], begin_s, end_s, [&](double, double, Bezier curve, bool) {
            scale(curve, shows.downwash);
            include(boxes[d], curve);
            ++size.stretches;
        });
        const Vec3 extent = boxes[d].high_m - boxes[d].low_m;
        size.mean_extent_m += std::max({extent.x, extent.y, extent.z});
    }
    size.mean_extent_m /= static_cast<double>(shows.drones.size());
    return size;
}

void cut(const Timelines& shows, double begin_s, double end_s, Slab& slab) {
    slab.begin_s = begin_s;
    slab.end_s = end_s;
    slab.boxes.assign(shows.drones.size(), nothing());
    slab.grounded.assign(shows.drones.size(), 1);
    slab.first_stretch.clear();
    slab.stretches.clear();
    slab.controls_m.clear();
    for (std::size_t d = 0; d < shows.drones.size(); ++d) {
        slab.first_stretch.push_back(static_cast<std::uint32_t>(slab.stretches.size()));
        walk(shows.drones[d], shows.grounded[d], begin_s, end_s,
             [&](double t0, double t1, Bezier curve, bool on_ground) {
                 scale(curve, shows.downwash);
                 include(slab.boxes[d], curve);
                 slab.stretches.push_back({t0, t1, static_cast<std::uint32_t>(slab.controls_m.size()),
                                           static_cast<std::uint8_t>(curve.degree), on_ground});
                 slab.controls_m.insert(slab.controls_m.end(), curve.controls().begin(), curve.controls().end());
                 if (!on_ground) slab.grounded[d] = 0;
             });
    }
    slab.first_stretch.push_back(static_cast<std::uint32_t>(slab.stretches.size()));
}

}  // namespace aerogram::exporter
