#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "geo/limits.hpp"

/// What the writer and the reader of trajectories.bin share: the numbers of docs/formats/trajectories-bin.md, no code.
namespace aerogram::exporter::trajectories {

inline constexpr std::string_view kMagic = "AEROGRAM";
inline constexpr std::uint32_t kVersion = 1;
inline constexpr std::size_t kHeaderBytes = 72;
inline constexpr std::size_t kHashOffset = 32;
inline constexpr std::size_t kHeaderCrcOffset = 68;

/// The limits in the order of the file.
inline std::array<double*, 11> limit_fields(Limits& l) {
    return {&l.min_separation_m,
            &l.formation_spacing_m,
            &l.downwash,
            &l.export_margin_m,
            &l.speed_horizontal_mps,
            &l.speed_up_mps,
            &l.speed_down_mps,
            &l.acceleration_mps2,
            &l.jerk_mps3,
            &l.min_navigation_altitude_m,
            &l.ceiling_m};
}

/// The block at the payload's end, there when the header's flag says that the vehicles are planes.
inline constexpr std::uint32_t kCertifiedFlag = 1, kPlanesFlag = 2;
inline std::array<double*, 5> plane_fields(PlaneLimits& p) {
    return {&p.airspeed_min_mps, &p.airspeed_max_mps, &p.turn_rate_dps, &p.climb_mps, &p.sink_mps};
}

}  // namespace aerogram::exporter::trajectories
