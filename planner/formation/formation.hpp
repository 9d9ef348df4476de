#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geo/color.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "geo/vec3.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// One keyframe's places ("slots"). points_m, colors and part have one entry a slot; slot i is SlotId(i).
struct Formation {
    Points points_m;                  ///< show frame
    std::vector<Rgb> colors;          ///< linear
    std::vector<std::uint32_t> part;  ///< index into Keyframe::parts; their number for spare slots
    std::vector<bool> spare;          ///< the drone waits here, dark: the parts do not need it
    double smallest_spacing_m = 0.0;  ///< in the separation metric; 0 for a single slot; spare slots count
    /// One a part: how far a place of the area, surface or volume that it shows is from its nearest drone, on average
    /// (paper 003, equation 4, divided by the number of places); absent: it shows lines or points.
    std::vector<std::optional<double>> coverage_m;
    std::string note;  ///< what people should know, for reports; may be empty
};

/// The formation of mission.keyframes[index]: exactly fleet.drones slots, in a stable order, placed in the show frame:
/// those of the parts one after another, then the spare ones (spare_places.hpp), when parts take fewer drones than the
/// fleet has or a csv has fewer points than drones. A csv with more points is thinned (thinning.hpp).
/// Properties: (1) N exact (2) smallest spacing >= limits.formation_spacing_m (3) ends and corners of strokes are
/// occupied whenever N allows (4) same mission, same bytes. Errors: invalid_input at the part's line when the source is
/// unusable, when the spacing does not fit ("needs size_m >= ..."), or when a slot is below the minimum navigation
/// altitude or above the ceiling.
Result<Formation> build_formation(const Mission& mission, std::size_t index, const Run& run);

}  // namespace aerogram::planner
