#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "export/verify/ground.hpp"

/// A slab of show time, cut for the search of close pairs: what every drone does in it, in the coordinates of the
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
    std::vector<std::vector<Interval>> grounded;  ///< one list a drone
    double downwash = 1.0;
    double begin_s = 0.0, end_s = 0.0;  ///< first start and last end of all pieces
};
/// @param drones  well-formed, at least one; must outlive the result.
[[nodiscard]] Timelines timelines(std::span<const RecordedDrone> drones, double downwash);

/// One polynomial of one drone inside a slab: controls_m[first_control .. first_control + degree].
struct Stretch {
    double begin_s = 0.0, end_s = 0.0;
    std::uint32_t first_control = 0;
    std::uint8_t degree = 0;
    bool on_ground = false;
};

struct Slab {
    double begin_s = 0.0, end_s = 0.0;
    std::vector<Box> boxes;                    ///< one a drone: it stays inside throughout the slab
    std::vector<std::uint32_t> first_stretch;  ///< one a drone, and the total
    std::vector<Stretch> stretches;            ///< of each drone in time order, without gaps
    std::vector<Vec3> controls_m;
    std::vector<char> grounded;  ///< one a drone: 1 when on the ground throughout

    [[nodiscard]] std::span<const Stretch> of(std::size_t drone) const {
        return std::span(stretches).subspan(first_stretch[drone], first_stretch[drone + 1] - first_stretch[drone]);
    }
};

/// How much moves in a slab: decides whether it is cut further.
struct SlabSize {
    double mean_extent_m = 0.0;  ///< over drones, of the longest side of the box
    std::size_t stretches = 0;
};
/// Fills `boxes`, reusing its memory.
[[nodiscard]] SlabSize measure(const Timelines& shows, double begin_s, double end_s, std::vector<Box>& boxes);
/// Fills `slab`, reusing its memory.
void cut(const Timelines& shows, double begin_s, double end_s, Slab& slab);

}  // namespace aerogram::exporter
