#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "export/outgoing/outgoing_show.hpp"
#include "export/outgoing/volumes.hpp"
#include "geo/show_frame.hpp"

/// Places and areas of a show as map formats write them: degrees with nine decimals, metres with three.
namespace aerogram::exporter {

/// Show time 0 of a show without a start: 2000-01-01T00:00:00Z.
inline constexpr UtcSeconds kMapEpoch_s = 946'684'800;
[[nodiscard]] UtcSeconds map_start(const OutgoingFacts& facts);

/// In front of the title of a show that is not certified.
inline constexpr std::string_view kMapUncertified = "UNCERTIFIED: ";

/// Writes places. Longitudes go on beyond ±180° rather than jump within a show.
class MapPlaces {
  public:
    /// @param below_m  taken off ellipsoidal heights: the geoid undulation for heights above sea level, or 0.
    MapPlaces(const geo::ShowOrigin& origin, double below_m) : frame_(origin), below_m_(below_m) {}

    /// "139.745400000,35.658600000,20.000" with the separator in the place of commas.
    void append(std::string& out, const Vec3& show_m, char separator) const;
    /// The corners of a ring at one height, closed if asked for, with `between` after each but the last.
    [[nodiscard]] std::string ring(const geo::Polygon& outline_m, double z_m, std::string_view between,
                                   bool closed) const;
    [[nodiscard]] const geo::ShowFrame& frame() const { return frame_; }
    /// The height that is written for a place.
    [[nodiscard]] double height_m(const Vec3& show_m) const { return frame_.to_geodetic(show_m).height_m - below_m_; }

  private:
    geo::ShowFrame frame_;
    double below_m_;
};

/// An area to draw: upright from base_m to top_m, or flat on the ground.
struct MapArea {
    std::string kind;  ///< "flight", "contingency", "ground-risk", "geofence", "audience", "obstacle"
    std::string name;
    geo::Polygon outline_m;         ///< counter-clockwise
    double base_m = 0.0;            ///< show frame
    double top_m = 0.0;             ///< equal to base_m: flat
    std::string_view fill, stroke;  ///< sRGB and opacity, "rrggbbaa"
};

/// The three volumes, the fence up to the ceiling, audience areas, obstacles (round ones as 48 tangents).
[[nodiscard]] std::vector<MapArea> map_areas(const OutgoingFacts& facts, const FlightVolumes& volumes);

/// A number in the fewest digits that read back as it.
void append_exact(std::string& out, double value);

}  // namespace aerogram::exporter
