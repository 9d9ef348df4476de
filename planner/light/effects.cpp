#include "planner/light/effects.hpp"

#include <algorithm>
#include <cmath>

#include "geo/random.hpp"
#include "geo/units.hpp"
#include "planner/formation/color_ramp.hpp"

namespace aerogram::planner {
namespace {

const Rgb& color_of_round(const Light& light, std::int64_t round) {
    return light.colors[static_cast<std::size_t>(round) % light.colors.size()];
}

/// How much of [low, low + 1] lies in [begin, begin + length] on a ring of `count`; begin in [0, count).
double covered(double low, double begin, double length, double count) {
    const auto common = [&](double from) {
        return std::max(0.0, std::min(low + 1.0, from + length) - std::max(low, from));
    };
    return std::min(1.0, common(begin) + common(begin - count));
}

}  // namespace

Rounds rounds_at(double since_s, double counted_at_s, double period_s) {
    const double round = std::floor(counted_at_s / period_s);
    return {static_cast<std::int64_t>(round), std::clamp(since_s / period_s - round, 0.0, 1.0)};
}

Glow fade_glow(const Light& light, double progress) {
    const double steps = std::clamp(progress, 0.0, 1.0) * static_cast<double>(light.colors.size());
    if (steps <= 1.0) return {light.colors.front(), steps};
    return {ramp_color(light.colors, (steps - 1.0) / static_cast<double>(light.colors.size() - 1)), 1.0};
}

Glow sweep_glow(const Light& light, double way_m, double low_m, double high_m, const Rounds& at) {
    const double middle_m = low_m - 0.5 * light.width_m + at.share * (high_m - low_m + light.width_m);
    const double off = std::abs(way_m - middle_m) / light.width_m;
    const double share = off < 0.5 ? 0.5 + 0.5 * std::cos(2.0 * kPi * off) : 0.0;
    return {color_of_round(light, at.round), share};
}

Glow chase_glow(const Light& light, std::size_t place, std::size_t count, double rounds) {
    const auto places = static_cast<double>(count), runs = static_cast<double>(light.colors.size());
    const double length = std::min(static_cast<double>(light.length), places);
    Rgb sum;
    double whole = 0.0;
    for (std::size_t run = 0; run < light.colors.size(); ++run) {
        const double turned = rounds + static_cast<double>(run) / runs - length / places;
        const double share =
            covered(static_cast<double>(place), (turned - std::floor(turned)) * places, length, places);
        const Rgb& c = light.colors[run];
        sum = {sum.r + share * c.r, sum.g + share * c.g, sum.b + share * c.b};
        whole += share;
    }
    if (whole <= 0.0) return {light.colors.front(), 0.0};
    return {{sum.r / whole, sum.g / whole, sum.b / whole}, std::min(whole, 1.0)};
}

Glow pulse_glow(const Light& light, const Rounds& at) {
    return {color_of_round(light, at.round), 0.5 - 0.5 * std::cos(2.0 * kPi * at.share)};
}

Glow sparkle_glow(const Light& light, std::uint64_t seed, DroneId drone, double since_s) {
    if (light.share <= 0.0) return {light.colors.front(), 0.0};
    const double cycle_s = light.period_s / std::min(light.share, 1.0);
    Random own(seed + drone.value * 0xD1342543DE82EF95ULL);
    const double time_s = since_s + own.unit() * cycle_s;
    const double cycle = std::floor(time_s / cycle_s);
    Random choice(own.bits() + static_cast<std::uint64_t>(cycle) * 0x2545F4914F6CDD1DULL);
    const double lit_from_s = cycle * cycle_s + choice.unit() * (cycle_s - light.period_s);
    const Rgb& color = light.colors[static_cast<std::size_t>(choice.below(light.colors.size()))];
    const bool lit = light.share >= 1.0 || (lit_from_s <= time_s && time_s < lit_from_s + light.period_s);
    return {color, lit ? 1.0 : 0.0};
}

Glow gradient_glow(const Light& light, double way_m, double low_m, double high_m, double since_s, double progress) {
    const bool runs = light.period_s > 0.0;
    const double rounds = runs ? since_s / light.period_s : 0.0;
    if (light.in_time) return {runs ? ring_color(light.colors, rounds) : ramp_color(light.colors, progress), 1.0};
    const double way = high_m > low_m ? (way_m - low_m) / (high_m - low_m) : 0.0;
    return {runs ? ring_color(light.colors, way - rounds) : ramp_color(light.colors, way), 1.0};
}

Rgb blended(const Rgb& beneath, const Glow& glow, LightBlend blend, double opacity) {
    const double share = std::clamp(opacity * glow.share, 0.0, 1.0);
    if (share <= 0.0) return beneath;
    Rgb over = glow.color;
    if (blend == LightBlend::add) over = {beneath.r + over.r, beneath.g + over.g, beneath.b + over.b};
    if (blend == LightBlend::multiply) over = {beneath.r * over.r, beneath.g * over.g, beneath.b * over.b};
    return share >= 1.0 ? clamped(over) : clamped(mix(beneath, clamped(over), share));
}

}  // namespace aerogram::planner
