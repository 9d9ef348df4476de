#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "export/verify/ground.hpp"
#include "geo/run.hpp"

/// Slabs of show time, cut for the search of close pairs: what every drone does in each, in the coordinates of the
/// separation metric (z divided by the downwash).
namespace aerogram::exporter {

struct Box {
    Vec3 low_m{}, high_m{};
    /// Distance between two boxes; 0 when they touch.
    [[nodiscard]] double gap(const Box& other) const;
};

/// What all slabs of one show share.
struct Timelines {
    std::span<const RecordedDrone> drones;
    std::vector<std::vector<Stay>> stays;    ///< one list a drone
    std::vector<Places> places;              ///< one a drone
    double closest_pads_m = kClosestPads_m;  ///< less what rounding may take from it
    double downwash = 1.0;
    double begin_s = 0.0, end_s = 0.0;  ///< first start and last end of all pieces

    /// Whether two drones that stand so are excused from each other.
    [[nodiscard]] bool excuse(std::size_t i, Stance a, std::size_t j, Stance b) const {
        return excused(a, b) && !too_close(places[i], places[j], closest_pads_m);
    }
};
/// @param show  well-formed, at least one drone; must outlive the result.
[[nodiscard]] Timelines timelines(const RecordedShow& show, double downwash, const Run& run);

/// One polynomial of one drone inside a slab: controls_m[first_control .. first_control + degree].
struct Stretch {
    double begin_s = 0.0, end_s = 0.0;
    std::uint32_t first_control = 0;
    std::uint8_t degree = 0;
    Stance stance = Stance::flying;
};

struct Slab {
    std::vector<Box> boxes;                    ///< one a drone: it stays inside throughout the slab
    std::vector<std::uint32_t> first_stretch;  ///< one a drone, and the total
    std::vector<Stretch> stretches;            ///< of each drone in time order, without gaps
    std::vector<Vec3> controls_m;
    std::vector<Stance> stance;  ///< one a drone: the least bound to its pad that it is in the slab

    [[nodiscard]] std::span<const Stretch> of(std::size_t drone) const {
        return std::span(stretches).subspan(first_stretch[drone], first_stretch[drone + 1] - first_stretch[drone]);
    }
};

/// Times at which to cut [begin_s, end_s], both included: in a slab between two neighbours the drones fly about
/// `travel_m` or less in the mean and have few stretches; cuts are where the drone with most pieces has its own, if
/// that suffices. What is chosen here sets the cost of the search, nothing else.
[[nodiscard]] std::vector<double> slab_times(const Timelines& shows, double begin_s, double end_s, double travel_m);
/// Fills slabs[k] with what happens between times_s[k] and times_s[k + 1], reusing memory.
void cut(const Timelines& shows, std::span<const double> times_s, std::vector<Slab>& slabs);

}  // namespace aerogram::exporter
