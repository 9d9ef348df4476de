#pragma once
#include <cstddef>
#include <cstdint>

#include "geo/color.hpp"
#include "geo/ids.hpp"
#include "planner/mission/mission.hpp"

/// What each light effect is at one place and time, in closed form. Nothing here knows formations or plans.
namespace aerogram::planner {

/// An effect's colour, and how far it covers the colours beneath: 0 not at all, 1 entirely.
struct Glow {
    Rgb color;
    double share = 1.0;
};

/// A time within repeated rounds: which one, counted from 0, and how much of it is over.
struct Rounds {
    std::int64_t round = 0;
    double share = 0.0;  ///< [0, 1]; 1 is the instant before the next round
};
/// @param counted_at_s  the time whose round it is; since_s itself, or a little earlier for the end of a round.
[[nodiscard]] Rounds rounds_at(double since_s, double counted_at_s, double period_s);

/// From the colours beneath to the first colour and on to the others, evenly. @param progress  of its time, [0, 1].
[[nodiscard]] Glow fade_glow(const Light& light, double progress);

/// A band that comes in at `low` and goes out at `high`, its middle from low - width/2 to high + width/2 once a round,
/// covering (1 + cos(2 pi d / width)) / 2 at distance d from its middle. Each round takes the next colour.
/// @param way_m  where the drone is between low and high.
[[nodiscard]] Glow sweep_glow(const Light& light, double way_m, double low_m, double high_m, const Rounds& at);

/// As many runs as colours, equally far apart, each `length` places long, go once round all places a period; a place
/// is covered as far as a run covers it. @param place  of `count`. @param rounds  periods since the beginning.
[[nodiscard]] Glow chase_glow(const Light& light, std::size_t place, std::size_t count, double rounds);

/// Covers (1 - cos(2 pi share)) / 2: nothing when a round begins, everything in its middle. Each round takes the next
/// colour.
[[nodiscard]] Glow pulse_glow(const Light& light, const Rounds& at);

/// Each drone is lit for one period in every period / share, when is up to the seed, in one of the colours. So at
/// every time the expected share of drones is lit.
[[nodiscard]] Glow sparkle_glow(const Light& light, std::uint64_t seed, DroneId drone, double since_s);

/// In space: the colours from low to high; with a period they run on by the whole length in one, the last colour going
/// over into the first. In time: everybody alike, in rounds likewise, or from first to last over its time.
/// @param progress  of its time, [0, 1].
[[nodiscard]] Glow gradient_glow(const Light& light, double way_m, double low_m, double high_m, double since_s,
                                 double progress);

/// The colours beneath and an effect's over them; every component stays in [0, 1].
/// @param opacity  [0, 1]: how much of the blended colour is seen, glow.share left aside.
[[nodiscard]] Rgb blended(const Rgb& beneath, const Glow& glow, LightBlend blend, double opacity);

}  // namespace aerogram::planner
