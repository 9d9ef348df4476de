#include "export/verify/slab.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aerogram::exporter {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kRoundoff_m = 1e-6;  ///< of the distance of two pads
constexpr std::size_t kDronesATask = 64;

/// One drone on its way through time: hands over each polynomial on its own stretch, in order.
class Walker {
  public:
    Walker(const RecordedDrone& drone, std::span<const Stay> stays, double begin_s)
        : drone_(drone),
          starts_s_(drone.pieces.front().start_s),
          ends_s_(exporter::end_s(drone)),
          piece_(piece_at(drone, begin_s)),
          stay_(std::ranges::partition_point(stays, [&](const Stay& s) { return s.end_s <= begin_s; })),
          no_stay_(stays.end()) {}

    /// @param begin_s  where the call before ended. @param visit  (from_s, to_s, controls, stance)
    template <class Visit>
    void walk(double begin_s, double end_s, const Visit& visit) {
        for (double t = begin_s; t < end_s;) {
            double until = std::min(end_s, next_piece_s());
            if (t < starts_s_) {
                until = std::min(until, starts_s_);
            } else if (t < ends_s_) {
                until = std::min(until, ends_s_);
            }
            while (stay_ != no_stay_ && stay_->end_s <= t) ++stay_;
            const bool staying = stay_ != no_stay_ && stay_->begin_s <= t;
            if (stay_ != no_stay_) until = std::min(until, staying ? stay_->end_s : stay_->begin_s);
            hand_over(t, until, staying ? stay_->stance : Stance::flying, visit);
            t = until;
            while (next_piece_s() <= t) ++piece_;
        }
    }

  private:
    [[nodiscard]] double next_piece_s() const {
        return piece_ + 1 < drone_.pieces.size() ? drone_.pieces[piece_ + 1].start_s : kForever;
    }
    template <class Visit>
    void hand_over(double t, double until, Stance stance, const Visit& visit) const {
        const auto point = [&](const Vec3& p) { visit(t, until, std::span(&p, 1), stance); };
        if (t < starts_s_) return point(first_position(drone_));
        if (t >= ends_s_) return point(last_position(drone_));
        const Piece& piece = drone_.pieces[piece_];
        const double from = (t - piece.start_s) / piece.duration_s, to = (until - piece.start_s) / piece.duration_s;
        if (piece.degree == 0 || (from == 0.0 && std::abs(to - 1.0) < 1e-12)) {
            visit(t, until, std::span(&drone_.controls_m[piece.first_control], std::size_t{piece.degree} + 1), stance);
        } else {
            const Bezier part = restricted(curve_of(drone_, piece), from, to);
            visit(t, until, part.controls(), stance);
        }
    }

    const RecordedDrone& drone_;
    double starts_s_, ends_s_;
    std::size_t piece_;
    std::span<const Stay>::iterator stay_, no_stay_;
};

void clear(Slab& slab) {
    slab.boxes.clear();
    slab.first_stretch.clear();
    slab.stretches.clear();
    slab.controls_m.clear();
    slab.stance.clear();
}

}  // namespace

double Box::gap(const Box& other) const {
    const Vec3 apart = glm::max(glm::max(low_m - other.high_m, other.low_m - high_m), Vec3(0.0));
    return glm::length(apart);
}

Timelines timelines(const RecordedShow& show, double downwash, const Run& run) {
    AEROGRAM_REQUIRE(!show.drones.empty());
    const std::size_t n = show.drones.size();
    const double beside_m = kStraightAbove_m + std::sqrt(2.0) * show.rounding.position_m + show.rounding.fit_m;
    const double rounding_m = 2.0 * std::sqrt(2.0) * show.rounding.position_m + kRoundoff_m;
    Timelines all{show.drones,
                  std::vector<std::vector<Stay>>(n),
                  std::vector<Places>(n),
                  kClosestPads_m - rounding_m,
                  downwash,
                  kForever,
                  -kForever};
    parallel_for((n + kDronesATask - 1) / kDronesATask, Run{run.stop, {}, run.threads}, "", [&](std::size_t task) {
        for (std::size_t d = task * kDronesATask; d < std::min(n, (task + 1) * kDronesATask); ++d) {
            all.stays[d] = stays(show.drones[d], beside_m);
            all.places[d] = places_of(show.drones[d]);
        }
    });
    for (const RecordedDrone& drone : show.drones) {
        all.begin_s = std::min(all.begin_s, drone.pieces.front().start_s);
        all.end_s = std::max(all.end_s, exporter::end_s(drone));
    }
    return all;
}

void cut(const Timelines& shows, std::span<const double> times_s, std::vector<Slab>& slabs) {
    const std::size_t count = times_s.size() - 1;
    slabs.resize(count);
    for (Slab& slab : slabs) clear(slab);
    for (std::size_t d = 0; d < shows.drones.size(); ++d) {
        Walker walker(shows.drones[d], shows.stays[d], times_s.front());
        for (std::size_t k = 0; k < count; ++k) {
            Slab& slab = slabs[k];
            Box box{Vec3(kForever), Vec3(-kForever)};
            Stance least = Stance::on_pad;
            slab.first_stretch.push_back(static_cast<std::uint32_t>(slab.stretches.size()));
            walker.walk(times_s[k], times_s[k + 1],
                        [&](double from_s, double to_s, std::span<const Vec3> controls, Stance stance) {
                            slab.stretches.push_back({from_s, to_s, static_cast<std::uint32_t>(slab.controls_m.size()),
                                                      static_cast<std::uint8_t>(controls.size() - 1), stance});
                            for (Vec3 p : controls) {
                                p.z /= shows.downwash;
                                box.low_m = glm::min(box.low_m, p);
                                box.high_m = glm::max(box.high_m, p);
                                slab.controls_m.push_back(p);
                            }
                            least = std::min(least, stance);
                        });
            slab.boxes.push_back(box);
            slab.stance.push_back(least);
        }
    }
    for (Slab& slab : slabs) slab.first_stretch.push_back(static_cast<std::uint32_t>(slab.stretches.size()));
}

}  // namespace aerogram::exporter
