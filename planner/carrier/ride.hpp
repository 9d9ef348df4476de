#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/carrier/carrier_path.hpp"
#include "planner/mission/mission.hpp"
#include "planner/motion/act.hpp"

/// Shows that ride along a route (MISSION.md, [carrier]).
///
/// The show is planned as if its carrier stood at the start of the route (placed_at_start), in whole ticks; then `ride`
/// moves the acts along. Copters: the carrier starts from rest with the first formation's hold and comes to rest with
/// the last one's end. Planes: the show begins and ends in flight. Wind is not modelled.
namespace aerogram::planner {

/// Acts of a ride last whole ticks: the knot step of their common spline, milliseconds. 100; 200 beyond 1,000 drones.
[[nodiscard]] Millis ride_tick_ms(std::size_t drones);
/// Rounded up to whole ticks.
[[nodiscard]] Millis whole_ticks(Millis duration_ms, Millis tick_ms);

/// The mission as it is planned before the ride: every keyframe at the start of the route (turned towards it when the
/// carrier turns), times in whole ticks (holds, durations and at_s rounded up), a little more separation for the refit
/// of the ride where the spacing leaves room, spare drones on wings (they cannot wait above pads), and for planes the
/// speeds that their acts may be planned with.
/// @param mission  with a carrier.
/// Errors: as CarrierPath::through.
Result<Mission> placed_at_start(const Mission& mission);

/// Where the carrier is at each instant of a ride of a given length.
class CarrierMotion {
  public:
    /// @param mission  as read. @param duration_s  of the ride.
    /// Errors: infeasible when the route is too short, naming its length and the ride's; as CarrierPath::through.
    static Result<CarrierMotion> of(const Mission& mission, double duration_s);

    [[nodiscard]] Vec3 at(double t_s) const;            ///< show frame; t_s from the ride's beginning
    [[nodiscard]] double turned_rad(double t_s) const;  ///< of the formations since the start; 0 unless they turn
    /// A place planned at the route's start as it is at t_s.
    [[nodiscard]] Vec3 carried(const Vec3& placed_m, double t_s) const;

  private:
    CarrierMotion(CarrierPath path, const Carrier& carrier) : path_(std::move(path)), turns_(carrier.turn) {}
    [[nodiscard]] double way_m(double t_s) const;

    CarrierPath path_;
    bool turns_ = false;
    double speed_mps_ = 0.0, ramp_s_ = 0.0, duration_s_ = 0.0;  ///< from rest to speed in ramp_s, likewise at the end
};

/// An act that is too fast on the moving carrier.
struct TooFast {
    std::size_t act = 0;     ///< into the acts given
    Millis duration_ms = 0;  ///< to try next; a whole number of ticks, longer than before
    std::string limit;       ///< "airspeed_max_mps", "acceleration_mps2", ...
};
struct Ride {
    std::vector<Act> acts;  ///< as given, in the ground frame: lattices of one spline, rows shared where acts meet
    std::vector<TooFast> too_fast;  ///< empty: every act holds all speed, acceleration and plane limits
    CarrierMotion carrier;
};

/// Moves acts along the route. One uniform cubic B-spline interpolates the ground positions c(t) + R(t) p(t) at every
/// tick over the whole ride; acts are slices of its rows, so position, velocity and acceleration are continuous where
/// they meet. Copters start and end at rest; planes with the acceleration 0.
///
/// Use: plan the legs of placed_at_start(mission), build the timeline, ride; while some are too_fast, lengthen those
/// and build the timeline again.
///
/// @param mission  as read.
/// @param placed  the acts of the ride in order, without gaps, planned at the route's start; whole ticks long.
/// Properties: (1) at each tick every drone is at its carried place to 1e-9 m (2) names, roles, starts and durations
/// are kept (3) acts meet with one velocity and acceleration (4) a still formation on a straight route flies at the
/// carrier's velocity exactly.
/// Errors: infeasible when a hold breaks a limit (with how much the carrier itself takes of it) or no duration can hold
/// it; as CarrierMotion::of; stopped.
Result<Ride> ride(const Mission& mission, std::span<const Act> placed, const Run& run);

}  // namespace aerogram::planner
