#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/light/effects.hpp"
#include "planner/light/light_places.hpp"
#include "planner/light/light_time.hpp"
#include "planner/picture/picture_light.hpp"

namespace aerogram::planner {

/// Reads the pictures of a light, each kept with at most so many cells. Errors: as read_picture, at the light's line.
Result<std::vector<PictureLight>> read_pictures(const Mission& mission, std::size_t index, std::size_t most_cells);

/// An instant at which a beam is looked at: index into the beam's times. What changes by steps (whose turn it is, which
/// picture, who is inside a volume) is as it was at `state`: `now` itself, or the time before it for the end of a
/// piece.
struct Instant {
    std::size_t now = 0, state = 0;
};

/// One light of a mission over one show.
class Beam {
  public:
    /// @param times_ms  ascending; when the light is looked at: all within time.lit, its end included.
    Beam(const Mission& mission, std::size_t index, const LightStage& stage, const LightTime& time,
         std::span<const Millis> times_ms, std::vector<PictureLight> pictures, const Run& run);

    [[nodiscard]] bool is_for(DroneId drone) const { return places_.is_for(drone); }
    /// Whether it must be told where the plan has the drones.
    [[nodiscard]] bool asks_for_places() const { return in_show_ && by_place_; }
    /// The colours beneath with the light over them.
    /// @param track_m  one drone's places at the times, show frame; read where asks_for_places().
    [[nodiscard]] Rgb over(const Rgb& beneath, DroneId drone, const Instant& at, std::span<const Vec3> track_m) const;

  private:
    [[nodiscard]] Vec3 place_m(DroneId drone, std::size_t when, std::span<const Vec3> track_m) const;
    [[nodiscard]] Glow glow(DroneId drone, const Instant& at, std::span<const Vec3> track_m) const;
    [[nodiscard]] Glow image_glow(const Vec3& place_m, const Instant& at) const;
    [[nodiscard]] bool shines_at(const Vec3& place_m) const;

    const Light& light_;
    LightTime time_;
    std::vector<Millis> times_ms_;
    LightPlaces places_;
    std::vector<PictureLight> pictures_;
    std::uint64_t seed_;
    bool in_show_, by_place_;  ///< without keyframe; what it does depends on where the drone is
};

}  // namespace aerogram::planner
