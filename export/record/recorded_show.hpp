#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "export/record/bezier.hpp"
#include "geo/airspace.hpp"
#include "geo/limits.hpp"
#include "geo/result.hpp"
#include "geo/show_frame.hpp"
#include "geo/tracks.hpp"
#include "geo/vec3.hpp"

/// What every reader returns: a show as a file tells it, with that file's rounding and interpolation rule and nothing
/// of the planner's. `verify`, `inspect`, `convert`, the viewer and the simulator consume it.
namespace aerogram::exporter {

/// One Bézier polynomial in time. Its control points are controls_m[first_control .. first_control + degree].
struct Piece {
    double start_s = 0.0, duration_s = 0.0;
    std::uint32_t first_control = 0;
    std::uint8_t degree = 1;  ///< 0 (stands) .. 7
};

/// A place to fly to, without a time.
struct Waypoint {
    geo::Geodetic place;  ///< height_m holds the ellipsoidal height only where the format knows it
    double altitude_above_home_m = 0.0;
    double hold_s = 0.0;
    enum class Kind { takeoff, fly_to, land } kind = Kind::fly_to;
    std::optional<double> until_s{};    ///< waits here until this show time
    std::optional<double> speed_mps{};  ///< of the leg to here, where the file sets one
};

struct RecordedDrone {
    std::string name;                    ///< the stable identifier, "drone-001"
    std::optional<Vec3> home_m, land_m;  ///< show frame; as stated, never guessed from the trajectory
    std::vector<Piece> pieces;           ///< in time order, without gaps; first and last positions hold outside
    std::vector<Vec3> controls_m;        ///< show frame
    std::optional<geo::Geodetic> home;   ///< untimed formats: where the drone's altitudes count from
    std::vector<Waypoint> waypoints;     ///< untimed formats; else empty
    Tracks tracks;
    std::optional<double> home_amsl_m;  ///< untimed formats that tell only this height of home; its height_m is 0
};

/// A format's stated rounding, against which verify judges (FORMATS pages).
struct Rounding {
    double position_m = 0.0;  ///< each stored coordinate is within this of the exact one (half the last digit)
    double fit_m = 0.0;       ///< the curve is within this of the exact one, rounding not included
    bool has_speed = true;    ///< the interpolation rule gives speeds that mean something
    double speed_allowance_mps = 0.0;
    bool has_acceleration = true;
    double acceleration_allowance_mps2 = 0.0;
    double time_s = 0.0;  ///< each stored time is within this of the exact one
};

/// A fence as a file tells it on the globe, where it has no frame to put an Airspace into. Heights mean nothing.
struct GeodeticFence {
    using Outline = std::vector<geo::Geodetic>;
    std::vector<Outline> inside;   ///< nobody may leave these
    std::vector<Outline> outside;  ///< nobody may enter these
};

struct RecordedShow {
    std::string format;  ///< registry name, "skyc"
    std::string title;
    std::optional<std::string> show_hash;  ///< 64 lower-case hex digits, where the file holds one
    std::optional<bool> certified;         ///< what the file claims
    std::optional<geo::ShowOrigin> origin;
    std::optional<Limits> limits;
    std::optional<geo::Airspace> airspace;
    std::optional<GeodeticFence> fence;  ///< untimed formats: judged where no airspace is known
    std::optional<double> endurance_s;
    bool timed = true;   ///< false: waypoints only, no separation can be claimed
    std::string timing;  ///< where it differs from file to file of a format ("absolute"); empty: the format's
    Rounding rounding;
    std::vector<RecordedDrone> drones;
    std::vector<Cue> cues;
    double duration_s = 0.0;
};

/// Checks what every consumer relies on: each drone of a timed show has pieces; piece degrees <= 7 with their control
/// points present, finite and within 1e8 m; durations > 0; each piece starts where the one before ends, to 1
/// microsecond. Errors: invalid_input naming drone and piece.
[[nodiscard]] Status well_formed(const RecordedShow& show);

/// Gives each drone whose file states no home, or no landing place, its pad for that.
/// @param pads_m  show frame; with another number of pads than drones nothing changes.
void state_missing_places(RecordedShow& show, std::span<const Vec3> pads_m);

/// The curve of a drone from start_s of a piece to start_s of the next (to the end of the last) is that piece's
/// polynomial in u = (t - start_s) / duration_s; before and after all pieces the first and last points hold.
[[nodiscard]] Bezier curve_of(const RecordedDrone& drone, const Piece& piece);
/// The index of the piece that runs at t_s (clamped); where two meet, the later. @param drone  at least one piece.
[[nodiscard]] std::size_t piece_at(const RecordedDrone& drone, double t_s);
/// Position at t_s, seconds (clamped to the drone's pieces). @param drone  at least one piece.
[[nodiscard]] Vec3 position_at(const RecordedDrone& drone, double t_s);
/// Velocity at t_s, m/s; zero outside the drone's pieces. @param drone  at least one piece.
[[nodiscard]] Vec3 velocity_at(const RecordedDrone& drone, double t_s);
[[nodiscard]] Vec3 first_position(const RecordedDrone& drone);
[[nodiscard]] Vec3 last_position(const RecordedDrone& drone);
/// When the drone's last piece ends, seconds.
[[nodiscard]] double end_s(const RecordedDrone& drone);

}  // namespace aerogram::exporter
