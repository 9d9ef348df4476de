#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geo/run.hpp"
#include "planner/light/light_time.hpp"

namespace aerogram::planner {

/// What an effect spans. Of an image low and high are the width and height of its box.
struct Extent {
    Vec3 middle_m{};  ///< of the drones' box
    double low_m = 0.0, high_m = 0.0;
};

/// Where one light finds the drones that it is made for: the fleet, or its group.
///
/// With a keyframe: the formation's own slots, around its barycentre and along the axes of the mission (a carrier that
/// turns is turned back), from one frame of an animation to the next by straight lines. Without: where the plan has the
/// drones, show frame; sweeps and gradients with a volume stand in that. Spare drones do not count.
class LightPlaces {
  public:
    /// @param times_ms  ascending: when the light is asked for what it spans.
    LightPlaces(const Mission& mission, std::size_t light, const LightStage& stage, std::span<const Millis> times_ms,
                const Run& run);

    /// True for the drones of its group.
    [[nodiscard]] bool is_for(DroneId drone) const { return member_.empty() || member_[drone.value]; }
    /// How many those are.
    [[nodiscard]] std::size_t count() const { return count_; }
    /// How far a drone takes part: 1 in its slot, 0 as a spare, between on the way.
    [[nodiscard]] double presence(DroneId drone, const Passage& passage) const;
    /// @param when  index into times_ms.
    [[nodiscard]] const Passage& passage(std::size_t when) const { return passages_[when]; }
    [[nodiscard]] Extent extent(std::size_t when) const;
    /// Where a drone is, and how far along the light's direction or from the middle. With a keyframe only.
    [[nodiscard]] Vec3 slot_m(DroneId drone, const Passage& passage) const;
    /// Of a drone at place_m: along the direction, or from the middle.
    [[nodiscard]] double way_m(const Vec3& place_m, const Extent& extent) const;
    /// To the right and upwards on an image's plane.
    [[nodiscard]] Vec2 on_plane_m(const Vec3& place_m) const;

    /// A chase's places: which one a drone has in its order, of how many.
    struct Place {
        std::size_t place = 0, count = 0;
    };
    /// Absent for drones that have none.
    [[nodiscard]] std::optional<Place> chase_place(DroneId drone, const Passage& passage) const;

  private:
    [[nodiscard]] bool shown(DroneId drone, std::size_t keyframe) const;
    [[nodiscard]] Vec3 local_m(DroneId drone, std::size_t keyframe) const;
    [[nodiscard]] Extent extent_of(const Points& shown_m) const;
    void order_keyframe(const Mission& mission, std::size_t keyframe);

    const Light& light_;
    LightStage stage_;
    KeyframeRange range_;
    std::vector<bool> member_;  ///< by drone; empty: everybody
    std::size_t count_ = 0;
    std::vector<Vec3> barycentres_m_;  ///< of the keyframes of the range
    Vec3 axis_{}, right_{};
    std::vector<Passage> passages_;
    std::vector<Extent> extents_;  ///< a keyframe of the range, or a time
    struct Order {
        std::vector<std::uint32_t> place_of;  ///< by drone
        std::size_t count = 0;
    };
    std::vector<Order> orders_;  ///< a keyframe of the range; chases
};

}  // namespace aerogram::planner
