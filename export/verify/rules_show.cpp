#include <algorithm>
#include <cstdio>

#include "export/verify/rules.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kProblemsShown = 5;

bool in_unit(const Rgb& color) {
    return std::ranges::all_of(std::array{color.r, color.g, color.b}, [](double c) { return c >= 0.0 && c <= 1.0; });
}

/// Where keys go back in time.
template <class Keys>
std::string disorder(const Keys& keys, std::string_view what) {
    const auto late =
        std::ranges::adjacent_find(keys, [](const auto& a, const auto& b) { return b.time_ms < a.time_ms; });
    if (late == keys.end()) return {};
    return std::string(what) + " go back in time after " + std::to_string(late->time_ms) + " ms";
}

std::string flaw(const Tracks& tracks) {
    for (const std::string& text : {disorder(tracks.lights, "light keys"), disorder(tracks.yaw, "yaw keys"),
                                    disorder(tracks.events, "payload events")}) {
        if (!text.empty()) return text;
    }
    const auto odd = std::ranges::find_if(tracks.lights, [](const LightKey& key) { return !in_unit(key.color); });
    if (odd == tracks.lights.end()) return {};
    return "the light at " + std::to_string(odd->time_ms) + " ms is not within 0..1";
}

}  // namespace

std::vector<Finding> at_most(std::string rule, double limit, double allowance, const FleetWorst& negative) {
    if (!negative.worst.seen()) return {};
    const double worst = -negative.worst.bound;
    return {{std::move(rule),
             limit,
             worst == 0.0 ? 0.0 : worst,
             allowance,
             {negative.drone + 1},
             negative.worst.time_s,
             worst <= limit + allowance + kNumeric}};
}

std::vector<Finding> at_least(std::string rule, double limit, double allowance, const FleetWorst& smallest) {
    if (!smallest.worst.seen()) return {};
    const double worst = smallest.worst.bound;
    return {{std::move(rule),
             limit,
             worst,
             allowance,
             {smallest.drone + 1},
             smallest.worst.time_s,
             worst >= limit - allowance - kNumeric}};
}

std::vector<Finding> ground_findings(const RecordedShow& show, const Rules& rules) {
    FleetWorst pads;
    double longest_s = show.duration_s;
    for (std::size_t d = 0; d < show.drones.size(); ++d) {
        const RecordedDrone& drone = show.drones[d];
        Worst worst;
        if (drone.home_m) worst.meet(-glm::length(first_position(drone) - *drone.home_m), drone.pieces.front().start_s);
        if (drone.land_m) worst.meet(-glm::length(last_position(drone) - *drone.land_m), end_s(drone));
        if (worst.bound < pads.worst.bound) pads = {worst, d};
        longest_s = std::max(longest_s, end_s(drone));
    }
    std::vector<Finding> found;  // the show of planes begins and ends in flight
    if (!rules.limits.plane) found = at_most("pads", 0.0, 2.0 * rules.space_m(), pads);
    if (rules.endurance_s && show.timed) {
        found.push_back({"endurance",
                         *rules.endurance_s,
                         longest_s,
                         rules.rounding.time_s,
                         {},
                         {},
                         longest_s <= *rules.endurance_s + rules.rounding.time_s + kNumeric});
    }
    return found;
}

std::vector<std::string> track_problems(const RecordedShow& show) {
    std::vector<std::string> problems;
    std::size_t more = 0;
    const auto add = [&](std::size_t drone, const std::string& text) {
        if (text.empty()) return;
        if (problems.size() < kProblemsShown) {
            problems.push_back("drone " + std::to_string(drone + 1) + ": " + text);
        } else {
            ++more;
        }
    };
    for (std::size_t d = 0; d < show.drones.size(); ++d) {
        add(d, flaw(show.drones[d].tracks));
        if (!show.timed) continue;
        const double late_s = end_s(show.drones[d]) - show.duration_s;
        if (late_s > 2.0 * show.rounding.time_s + kNumeric) {
            add(d, "flies for " + std::to_string(late_s) + " s after the show's stated end");
        }
    }
    if (more > 0) problems.push_back("and " + std::to_string(more) + " more like these");
    return problems;
}

}  // namespace aerogram::exporter
