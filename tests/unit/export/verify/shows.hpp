#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "geo/random.hpp"

/// Small shows for the tests of verify.
namespace aerogram::exporter::testing {

class Random : public aerogram::Random {
  public:
    using aerogram::Random::Random;
    double in(double low, double high) { return between(low, high); }
    Vec3 in_box(const Vec3& low, const Vec3& high) { return {in(low.x, high.x), in(low.y, high.y), in(low.z, high.z)}; }
};

/// Adds a piece that starts where the drone's pieces end (at 0 for the first).
inline void add_piece(RecordedDrone& drone, double duration_s, std::vector<Vec3> controls_m) {
    const double start_s = drone.pieces.empty() ? 0.0 : drone.pieces.back().start_s + drone.pieces.back().duration_s;
    drone.pieces.push_back({start_s, duration_s, static_cast<std::uint32_t>(drone.controls_m.size()),
                            static_cast<std::uint8_t>(controls_m.size() - 1)});
    drone.controls_m.insert(drone.controls_m.end(), controls_m.begin(), controls_m.end());
}

/// Straight lines through points, one every step_s.
inline RecordedDrone polyline(double step_s, const std::vector<Vec3>& points_m) {
    RecordedDrone drone;
    for (std::size_t i = 1; i < points_m.size(); ++i) add_piece(drone, step_s, {points_m[i - 1], points_m[i]});
    return drone;
}

/// From a to b, at rest at both ends and C² (the quintic minimum-jerk profile).
inline void add_smooth(RecordedDrone& drone, double duration_s, const Vec3& a, const Vec3& b) {
    add_piece(drone, duration_s, {a, a, a, b, b, b});
}

inline RecordedShow show_of(std::vector<RecordedDrone> drones) {
    RecordedShow show;
    show.format = "test";
    show.drones = std::move(drones);
    for (const RecordedDrone& drone : show.drones) show.duration_s = std::max(show.duration_s, end_s(drone));
    return show;
}

}  // namespace aerogram::exporter::testing
