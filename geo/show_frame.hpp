#pragma once
#include <memory>
#include <optional>

#include "geo/result.hpp"
#include "geo/vec3.hpp"

namespace aerogram::geo {

/// A place on WGS84; height above the ellipsoid.
struct Geodetic {
    double latitude_deg = 0.0;   ///< [-90, 90]
    double longitude_deg = 0.0;  ///< [-180, 180]
    double height_m = 0.0;       ///< above the ellipsoid
};

/// Where the show stands: the ground point under show (0, 0, 0) and the direction of +y.
struct ShowOrigin {
    Geodetic ground;
    double heading_deg = 0.0;                  ///< of show +y, clockwise from true north
    std::optional<double> geoid_undulation_m;  ///< ellipsoid minus AMSL at the origin; absent: AMSL is not known
};

/// Show frame <-> WGS84 through the tangent plane at the origin (exact, GeographicLib::LocalCartesian; no flat-earth scaling).
/// Properties: (1) to_show(to_geodetic(p)) = p to 1e-8 m within 100 km (2) the origin maps to (0,0,0)
/// (3) a step along +y at heading 90 goes east.
class ShowFrame {
  public:
    explicit ShowFrame(const ShowOrigin& origin);
    ShowFrame(const ShowFrame&);
    ShowFrame& operator=(const ShowFrame&);
    ~ShowFrame();

    [[nodiscard]] const ShowOrigin& origin() const;
    [[nodiscard]] Geodetic to_geodetic(const Vec3& show_m) const;
    [[nodiscard]] Vec3 to_show(const Geodetic& place) const;
    /// Height of a point above a home point: the difference of their ellipsoidal heights, so the earth's curvature is in.
    [[nodiscard]] double altitude_above(const Vec3& home_m, const Vec3& show_m) const;
    /// Height above mean sea level. Errors: invalid_input when the origin has no geoid undulation.
    [[nodiscard]] Result<double> amsl_m(const Vec3& show_m) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aerogram::geo
