#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "geo/show_frame.hpp"

/// Tracks as readers of map files collect them, before it is known when the show begins.
namespace aerogram::exporter {

struct MapTrack {
    RecordedDrone drone;              ///< without pieces
    std::vector<std::int64_t> at_us;  ///< since 1970 or since any other moment that all tracks share; rising
    std::vector<Vec3> places_m;       ///< show frame
};

/// Where the places of a file are put in the show frame.
class MapGround {
  public:
    /// As our own files state it. @param below_m  what heights are lower by than the ellipsoid's.
    void state(const geo::ShowOrigin& origin, double below_m);
    /// Longitude and latitude in degrees, height in metres; without a stated origin the first place of all becomes it.
    [[nodiscard]] Vec3 to_show(const Vec3& place);
    [[nodiscard]] const std::optional<geo::ShowFrame>& frame() const { return frame_; }

  private:
    std::optional<geo::ShowFrame> frame_;
    double below_m_ = 0.0;
};

/// Turns tracks into drones. @param start_us  show time 0; absent: the earliest time of any track. Times from the start
/// on a grid of microseconds; drones without a name become "drone-001" by their places.
/// Errors: invalid_input, beginning with `file`, when there are none or times span more than ten days.
Status take_tracks(RecordedShow& show, std::vector<MapTrack> tracks, std::optional<std::int64_t> start_us,
                   const std::string& file);

/// The show facts of own files. @param text  facts_json(). Errors: invalid_input.
Status take_facts(RecordedShow& show, const std::string& file, std::string_view text);

/// Three numbers with spaces between, or absent. @param limit  none may be beyond.
[[nodiscard]] std::optional<Vec3> parse_place(std::string_view text, double limit);

}  // namespace aerogram::exporter
