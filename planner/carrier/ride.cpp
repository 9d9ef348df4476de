#include "planner/carrier/ride.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

#include "geo/contract.hpp"
#include "geo/units.hpp"
#include "planner/carrier/ride_spline.hpp"
#include "planner/motion/plane_rules.hpp"
#include "planner/motion/timing.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kManyDrones = 1000;
constexpr std::size_t kFewestKnots = 7;  ///< of a spline at rest at both ends
constexpr double kWithin = 1e-9;         ///< limits are met up to rounding
constexpr std::size_t kSpill = 8;        ///< knots into which a neighbour's acceleration is felt: by 0.27 each
constexpr Millis kLongest_ms = 600'000;  ///< a flight this long cannot be what disturbs a hold
constexpr double kCalm = 1.05;
constexpr double kLengthen = 1.002, kLeast = 1.005, kMost = 1.5;

/// A limited quantity of an act, and what the carrier by itself takes of it.
struct Quantity {
    const char* limit;
    double value, of_carrier, allowed;
    double power;  ///< how the formations' share falls with the act's duration
    bool least = false;

    [[nodiscard]] bool held() const {
        const double slack = kWithin * std::max(1.0, allowed);
        return least ? value >= allowed - slack : value <= allowed + slack;
    }
    /// How much longer the act should last; absent: the carrier leaves nothing.
    [[nodiscard]] std::optional<double> stretch() const {
        const double room = std::abs(allowed - of_carrier), excess = std::abs(value - of_carrier);
        const bool carrier_holds = least ? of_carrier > allowed : of_carrier < allowed;
        if (!carrier_holds || room <= 1e-6 * allowed) return std::nullopt;
        return std::clamp(kLengthen * std::pow(excess / room, 1.0 / power), kLeast, kMost);
    }
};

std::vector<Quantity> quantities(const Motion& motion, const Motion& carrier, double duration_s, const Limits& l) {
    const Extremes e = extremes(motion, duration_s), c = extremes(carrier, duration_s);
    std::vector<Quantity> all{{"acceleration_mps2", e.acceleration_mps2, c.acceleration_mps2, l.acceleration_mps2, 2.0},
                              {"jerk_mps3", e.jerk_mps3, c.jerk_mps3, l.jerk_mps3, 3.0}};
    if (!l.plane) {
        all.push_back(
            {"speed_horizontal_mps", e.speed_horizontal_mps, c.speed_horizontal_mps, l.speed_horizontal_mps, 1.0});
        all.push_back({"speed_up_mps", e.speed_up_mps, c.speed_up_mps, l.speed_up_mps, 1.0});
        all.push_back({"speed_down_mps", e.speed_down_mps, c.speed_down_mps, l.speed_down_mps, 1.0});
        return all;
    }
    const PlaneExtremes p = plane_extremes(motion, duration_s), q = plane_extremes(carrier, duration_s);
    const auto add = [&](const char* limit, const PlaneWorst& found, const PlaneWorst& own, double allowed,
                         double power, bool least) {
        all.push_back({limit, found.value, own.value, allowed, power, least});
    };
    add("airspeed_min_mps", p.airspeed_min_mps, q.airspeed_min_mps, l.plane->airspeed_min_mps, 1.0, true);
    add("airspeed_max_mps", p.airspeed_max_mps, q.airspeed_max_mps, l.plane->airspeed_max_mps, 1.0, false);
    add("turn_rate_dps", p.turn_rate_dps, q.turn_rate_dps, l.plane->turn_rate_dps, 2.0, false);
    add("climb_mps", p.climb_mps, q.climb_mps, l.plane->climb_mps, 1.0, false);
    add("sink_mps", p.sink_mps, q.sink_mps, l.plane->sink_mps, 1.0, false);
    return all;
}

Error cannot(const Mission& mission, const Act& act, const Quantity& q) {
    std::ostringstream text;
    text << std::setprecision(4) << "carrier: \"" << act.name << "\" cannot be flown on this route: " << q.limit
         << " reaches " << q.value << " between " << seconds_from_ms(act.start_ms) << " s and "
         << seconds_from_ms(act.end_ms()) << " s, limit " << q.allowed << "; of the carrier by itself it is "
         << q.of_carrier;
    return {ErrorCode::infeasible, mission.at(mission.carrier->line, text.str())};
}

/// Ground positions at every tick: rows of knots.
Result<Points> carried_samples(const CarrierMotion& carrier, std::span<const Act> placed, Millis tick_ms,
                               const Run& run) {
    const std::size_t n = drone_count(placed.front().motion);
    Points samples, here(n);
    for (const Act& act : placed) {
        const bool last = &act == &placed.back();
        for (Millis local_ms = 0; local_ms < act.duration_ms + (last ? 1 : 0); local_ms += tick_ms) {
            if (run.stopped()) return stopped_error();
            const double t_s = seconds_from_ms(act.start_ms - placed.front().start_ms + local_ms);
            positions(act, seconds_from_ms(local_ms), here);
            for (const Vec3& p : here) samples.push_back(carrier.carried(p, t_s));
        }
    }
    return samples;
}

Lattice spline_through(std::span<const Vec3> samples, std::size_t drones, Vehicle vehicle) {
    return vehicle == Vehicle::plane ? gliding_lattice_through(samples, drones) : lattice_through(samples, drones);
}

/// The route by itself, as one more drone in the formations' origin.
Lattice carrier_spline(const CarrierMotion& carrier, std::size_t knots, Millis tick_ms, Vehicle vehicle) {
    Points samples;
    for (std::size_t m = 0; m < knots; ++m)
        samples.push_back(carrier.at(seconds_from_ms(static_cast<Millis>(m) * tick_ms)));
    return spline_through(samples, 1, vehicle);
}

Millis lengthened(Millis duration_ms, double stretch, Millis tick_ms) {
    return std::max(duration_ms + tick_ms,
                    whole_ticks(std::llround(stretch * static_cast<double>(duration_ms)), tick_ms));
}

/// The acts of a ride against the limits.
struct Judged {
    const Mission& mission;
    std::span<const Act> placed;
    const Lattice &whole, &own;
    Millis tick_ms;

    [[nodiscard]] std::size_t knot_of(Millis time_ms) const {
        return static_cast<std::size_t>((time_ms - placed.front().start_ms) / tick_ms);
    }
    [[nodiscard]] Act act(std::size_t a) const {
        Act act = placed[a];
        act.timing = Timing::fixed;
        act.motion = part_of(whole, knot_of(act.start_ms), knot_of(act.end_ms()));
        return act;
    }
    /// What an act breaks, `margin` knots at either end left out.
    [[nodiscard]] std::vector<Quantity> broken(std::size_t a, std::size_t margin) const {
        const std::size_t first = knot_of(placed[a].start_ms) + margin, last = knot_of(placed[a].end_ms()) - margin;
        const double duration_s = static_cast<double>(last - first) * seconds_from_ms(tick_ms);
        auto all = quantities(part_of(whole, first, last), part_of(own, first, last), duration_s, mission.limits);
        std::erase_if(all, [](const Quantity& q) { return q.held(); });
        return all;
    }
    /// A spline carries what happens at a knot a little into the acts beside it. A hold that breaks a limit only there
    /// is mended by gentler flights beside it.
    [[nodiscard]] Status calm_neighbours(std::size_t hold, std::vector<TooFast>& too_fast) const {
        const std::vector<Quantity> edges = broken(hold, 0);
        const bool has_middle = knot_of(placed[hold].end_ms()) - knot_of(placed[hold].start_ms) > 2 * kSpill;
        const std::vector<Quantity> inside = has_middle ? broken(hold, kSpill) : edges;
        if (has_middle && !inside.empty()) return cannot(mission, placed[hold], inside.front());
        bool mended = false;
        for (const std::size_t a : {hold - 1, hold + 1}) {  // before the first wraps to beyond the last
            if (a >= placed.size() || placed[a].role == ActRole::hold) continue;
            if (placed[a].duration_ms > kLongest_ms) continue;
            too_fast.push_back({a, lengthened(placed[a].duration_ms, kCalm, tick_ms), edges.front().limit});
            mended = true;
        }
        if (!mended) return cannot(mission, placed[hold], edges.front());
        return Done{};
    }
};

}  // namespace

Millis ride_tick_ms(std::size_t drones) {
    return drones > kManyDrones ? 200 : 100;
}

Millis whole_ticks(Millis duration_ms, Millis tick_ms) {
    return (duration_ms + tick_ms - 1) / tick_ms * tick_ms;
}

Result<Ride> ride(const Mission& mission, std::span<const Act> placed, const Run& run) {
    AEROGRAM_REQUIRE(mission.carrier && !placed.empty(), placed.size());
    const std::size_t n = drone_count(placed.front().motion);
    const Millis tick_ms = ride_tick_ms(n), begin_ms = placed.front().start_ms;
    for (const Act& act : placed) AEROGRAM_REQUIRE(act.duration_ms % tick_ms == 0, act.name, act.duration_ms);
    const auto knots = static_cast<std::size_t>((placed.back().end_ms() - begin_ms) / tick_ms) + 1;
    if (knots < kFewestKnots) {
        return Error{ErrorCode::infeasible, mission.at(mission.carrier->line,
                                                       "carrier: the ride lasts less than a second; hold a keyframe "
                                                       "longer")};
    }
    auto carrier = CarrierMotion::of(mission, seconds_from_ms(placed.back().end_ms() - begin_ms));
    if (!carrier) return carrier.error();
    auto samples = carried_samples(*carrier, placed, tick_ms, run);
    if (!samples) return samples.error();
    const Vehicle vehicle = mission.fleet.vehicle;
    const Lattice whole = spline_through(*samples, n, vehicle), own = carrier_spline(*carrier, knots, tick_ms, vehicle);

    const Judged judged{mission, placed, whole, own, tick_ms};
    Ride out{{}, {}, std::move(*carrier)};
    std::vector<std::size_t> wrong_holds;
    for (std::size_t a = 0; a < placed.size(); ++a) {
        if (run.stopped()) return stopped_error();
        out.acts.push_back(judged.act(a));
        TooFast wish{a, 0, ""};
        for (const Quantity& q : judged.broken(a, 0)) {
            if (placed[a].role == ActRole::hold) {
                if (wrong_holds.empty() || wrong_holds.back() != a) wrong_holds.push_back(a);
                continue;
            }
            const auto stretch = q.stretch();
            if (!stretch) return cannot(mission, placed[a], q);
            const Millis longer_ms = lengthened(placed[a].duration_ms, *stretch, tick_ms);
            if (longer_ms > wish.duration_ms) wish = {a, longer_ms, q.limit};
        }
        if (wish.duration_ms > 0) out.too_fast.push_back(wish);
    }
    if (!out.too_fast.empty()) return out;
    for (const std::size_t a : wrong_holds) {
        if (auto done = judged.calm_neighbours(a, out.too_fast); !done) return done.error();
    }
    return out;
}

}  // namespace aerogram::planner
