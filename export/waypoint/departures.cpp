#include "export/waypoint/departures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kMayDrift_m = 0.01;
constexpr std::int64_t kLongest_s = 12 * 3600;
constexpr UtcSeconds kDay_s = 86'400, kLastUtc_s = 253'402'300'799;  ///< the end of 9999

Error refused(std::string why) {
    return {ErrorCode::invalid_input, std::move(why)};
}

template <class... Values>
std::string format(const char* pattern, Values... values) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), pattern, values...);
    return text.data();
}

/// A leg that ends at `stop`.
struct Leg {
    std::size_t drone = 0, stop = 0;
    double needs_s = 0.0, slack_s = std::numeric_limits<double>::infinity();
};

Leg slowest(const LegModel& model, const Stops& stops, std::size_t stop) {
    Leg worst{0, stop, 0.0, 0.0};
    for (std::size_t i = 0; i < stops.places_m.size(); ++i) {
        const double needs_s = leg_needs_s(model, stops.places_m[i][stop] - stops.places_m[i][stop - 1]);
        if (needs_s > worst.needs_s) worst = {i, stop, needs_s, 0.0};
    }
    return worst;
}

std::string too_slow(const OutgoingFacts& facts, const Stops& stops, const Departures& d, const Leg& leg,
                     std::size_t others) {
    const std::size_t k = leg.stop;
    const double there_s = static_cast<double>(d.leave_s[k] - d.leave_s[k - 1]), slack_s = facts.exporting.slack_s;
    std::string why = facts.drones[leg.drone].name + " would come late to \"" + stops.names[k] + "\": " +
                      format("from \"%s\" it needs %.1f s and %.1f s of slack, %.0f s are there (%lld s to %lld s); ",
                             stops.names[k - 1].c_str(), leg.needs_s, slack_s, there_s,
                             static_cast<long long>(d.leave_s[k - 1]), static_cast<long long>(d.leave_s[k]));
    if (stops.from_ms[k] == stops.to_ms[k]) why += "the plan passes it, a waypoint mission stops there; ";
    why += format("leave it %.0f s later (hold_s or at_s), or allow faster legs or less slack ([export])",
                  std::ceil(leg.needs_s + slack_s - there_s));
    if (others > 0) why += "; keyframes that come late beside it: " + std::to_string(others);
    return why;
}

/// The smallest distance of two pads in plan view where it is below least_m; a sweep along x.
std::optional<double> pads_closer_than(double least_m, const OutgoingFacts& facts) {
    std::vector<Vec2> pads;
    for (const OutgoingDrone& drone : facts.drones) pads.emplace_back(drone.home_m);
    std::ranges::sort(pads, {}, [](const Vec2& p) { return std::pair(p.x, p.y); });
    std::optional<double> closest_m;
    for (std::size_t i = 0; i < pads.size(); ++i)
        for (std::size_t j = i + 1; j < pads.size() && pads[j].x - pads[i].x < least_m; ++j)
            if (const double apart_m = glm::length(pads[j] - pads[i]); apart_m < closest_m.value_or(least_m))
                closest_m = apart_m;
    return closest_m;
}

std::string unsound(const OutgoingFacts& facts, const Stops& stops) {
    const auto& start = facts.exporting.start_utc_s;
    if (!start) return "timing = absolute needs start_utc or --start-utc";
    if (*start < kDay_s || *start > kLastUtc_s - kDay_s) return "start_utc must be a day inside of 1970 to 9999";
    if (facts.duration_ms > kLongest_s * 1000) return "longer than twelve hours: times of day would not tell when";
    if (const auto apart_m = pads_closer_than(facts.limits.min_separation_m - kMayDrift_m, facts))
        return format(
            "pads are %.2f m apart: the plan staggers its take-offs, missions that wait for times climb at once",
            *apart_m);
    for (std::size_t k = 0; k < stops.count(); ++k) {
        if (stops.drifts_m[k] > kMayDrift_m)
            return "\"" + stops.names[k] + "\" moves while it is shown; vehicles that wait for a time stand";
    }
    return {};
}

}  // namespace

Stops stops_of(const OutgoingShow& show) {
    const OutgoingFacts& facts = show.facts();
    Stops stops;
    const auto add = [&](const std::string& name, Millis from_ms, Millis to_ms) {
        stops.names.push_back(name);
        stops.from_ms.push_back(from_ms);
        stops.to_ms.push_back(to_ms);
    };
    add("take-off", facts.takeoff_end_ms, facts.takeoff_end_ms);
    for (const OutgoingKeyframe& k : facts.keyframes) add(k.name, k.stands_from_ms, k.stands_to_ms);
    add("return", facts.landing_begin_ms, facts.landing_begin_ms);
    stops.drifts_m.assign(stops.count(), 0.0);
    const Vec3 low{0.0, 0.0, facts.limits.min_navigation_altitude_m};
    for (std::size_t i = 0; i < show.drones(); ++i) {
        const Flight flight = show.flight(i);
        FlightCursor cursor(flight);
        const Vec3 pad = facts.drones[i].home_m;
        Points places;
        places.push_back(facts.takeoff_end_ms > 0 ? cursor.position_at(seconds_from_ms(facts.takeoff_end_ms))
                                                  : pad + low);
        for (std::size_t k = 0; k < facts.keyframes.size(); ++k) {
            places.push_back(facts.keyframes[k].places_m[i]);
            const Vec3 left = cursor.position_at(seconds_from_ms(stops.to_ms[k + 1]));
            stops.drifts_m[k + 1] = std::max(stops.drifts_m[k + 1], glm::length(left - places.back()));
        }
        const bool sinks = facts.landing_begin_ms < facts.duration_ms;
        places.push_back(sinks ? cursor.position_at(seconds_from_ms(facts.landing_begin_ms))
                               : facts.drones[i].land_m + low);
        stops.places_m.push_back(std::move(places));
    }
    return stops;
}

Result<Departures> departures(const OutgoingFacts& facts, const Stops& stops) {
    if (std::string why = unsound(facts, stops); !why.empty()) return refused(std::move(why));
    const LegModel model = leg_model(facts.exporting, facts.limits);
    const double slack_s = facts.exporting.slack_s;
    Departures result;
    result.start_utc_s = *facts.exporting.start_utc_s;
    for (const Millis to_ms : stops.to_ms) result.leave_s.push_back((to_ms + 500) / 1000);

    Leg worst;
    std::size_t late = 0;
    const std::size_t last = stops.count() - 1;
    for (std::size_t k = 1; k < last; ++k) {
        Leg leg = slowest(model, stops, k);
        leg.slack_s = static_cast<double>(result.leave_s[k] - result.leave_s[k - 1]) - leg.needs_s;
        if (leg.slack_s < slack_s) ++late;
        if (leg.slack_s < worst.slack_s) worst = leg;
    }
    if (late > 0) return refused(too_slow(facts, stops, result, worst, late - 1));

    const double home_s = slowest(model, stops, last).needs_s + slack_s;
    result.leave_s[last] =
        std::max(result.leave_s[last], result.leave_s[last - 1] + static_cast<std::int64_t>(std::ceil(home_s)));
    const double later_s = static_cast<double>(result.leave_s[last]) - seconds_from_ms(facts.landing_begin_ms);
    if (const double ends_s = seconds_from_ms(facts.duration_ms) + std::max(0.0, later_s); ends_s > facts.endurance_s)
        return refused(
            format("the way home needs %.1f s, so that the show ends at %.1f s, beyond the endurance of %.1f s", home_s,
                   ends_s, facts.endurance_s));

    double climb_s = 0.0;
    for (std::size_t i = 0; i < stops.places_m.size(); ++i)
        climb_s = std::max(climb_s, takeoff_needs_s(model, stops.places_m[i][0].z - facts.drones[i].home_m.z));
    result.last_start_utc_s =
        result.start_utc_s + result.leave_s[0] - static_cast<std::int64_t>(std::ceil(climb_s + slack_s));
    result.first_start_utc_s = result.last_start_utc_s - kStartWindow_s;
    return result;
}

}  // namespace aerogram::exporter
