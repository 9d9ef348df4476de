#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

#include "export/report/pair_grid.hpp"
#include "export/report/parts.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kShown = 20, kKept = 60;
constexpr std::size_t kStepsATask = 64;
constexpr double kAgain = 1.1;  ///< two minima of a pair are two approaches if it is that much farther between
constexpr double kEqual_m = 1e-4;
constexpr std::size_t kMostDroneInstants = 4'000'000;  ///< at which alignments are looked for

/// A pair near each other from one of the report's times to another.
struct Approach {
    std::uint32_t first = 0, second = 0;
    double distance_m = 0.0, time_s = 0.0;
    std::size_t last_step = 0;
};

bool nearer(const Approach& a, const Approach& b) {
    return std::tie(a.distance_m, a.time_s, a.first, a.second) < std::tie(b.distance_m, b.time_s, b.first, b.second);
}

/// The closest approaches found so far, at most kKept.
class Closest {
  public:
    explicit Closest(double reach_m) : reach_m_(reach_m) {}

    [[nodiscard]] double reach_m() const { return reach_m_; }
    void note(const Approach& next) {
        if (!(next.distance_m < reach_m_)) return;
        for (Approach& a : all_) {
            if (a.first != next.first || a.second != next.second || a.last_step + 1 < next.last_step) continue;
            a.last_step = next.last_step;
            if (next.distance_m < a.distance_m - kEqual_m) a.distance_m = next.distance_m, a.time_s = next.time_s;
            return;
        }
        all_.push_back(next);
        if (all_.size() <= kKept) return;
        all_.erase(std::ranges::max_element(all_, nearer));
        reach_m_ = std::ranges::max_element(all_, nearer)->distance_m - kEqual_m;
    }
    [[nodiscard]] const std::vector<Approach>& all() const { return all_; }

  private:
    double reach_m_;
    std::vector<Approach> all_;
};

/// The smallest of a function near a time where it is small, to about a microsecond.
double time_of_least(const std::function<double(double)>& of, double near_s, double from_s, double to_s) {
    constexpr int kLooks = 64;
    double best_s = near_s, best = of(near_s);
    for (int k = 0; k <= kLooks; ++k) {
        const double t_s = from_s + (to_s - from_s) * k / kLooks;
        if (const double there = of(t_s); there < best - 1e-12) best = there, best_s = t_s;
    }
    double low_s = std::max(from_s, best_s - (to_s - from_s) / kLooks);
    double high_s = std::min(to_s, best_s + (to_s - from_s) / kLooks);
    while (high_s - low_s > 1e-7) {
        const double left_s = low_s + (high_s - low_s) / 3.0, right_s = high_s - (high_s - low_s) / 3.0;
        if (of(left_s) <= of(right_s)) {
            high_s = right_s;
        } else {
            low_s = left_s;
        }
    }
    const double found_s = 0.5 * (low_s + high_s);
    return of(found_s) < best ? found_s : best_s;
}

/// Two exact flights at once.
class Pair {
  public:
    Pair(const OutgoingShow& show, const Approach& a)
        : metric_{show.facts().limits.downwash},
          first_(show.flight(a.first)),
          second_(show.flight(a.second)),
          first_at_(first_),
          second_at_(second_) {}
    Pair(const Pair&) = delete;
    Pair& operator=(const Pair&) = delete;

    [[nodiscard]] double distance(double t_s) {
        return metric_.distance(first_at_.position_at(t_s), second_at_.position_at(t_s));
    }
    [[nodiscard]] Vec3 first(double t_s) { return first_at_.position_at(t_s); }
    [[nodiscard]] Vec3 second(double t_s) { return second_at_.position_at(t_s); }

  private:
    SeparationMetric metric_;
    Flight first_, second_;
    FlightCursor first_at_, second_at_;
};

/// One above the other: how far beside and below it may be, show frame.
struct Column {
    double radius_m = std::numeric_limits<double>::infinity(), height_m = std::numeric_limits<double>::infinity();
};

/// On the exact flights, while the pair counts.
ReportEncounter refined(const OutgoingShow& show, const Survey& all, const Approach& a, double step_s,
                        const Column& column, bool upper_first) {
    Pair pair(show, a);
    const auto distance = [&](double t_s) {
        const Vec3 d = pair.second(t_s) - pair.first(t_s);
        const bool counts = std::hypot(d.x, d.y) <= column.radius_m && std::abs(d.z) <= column.height_m &&
                            !all.excuses(a.first, a.second, t_s);
        return counts ? pair.distance(t_s) : std::numeric_limits<double>::infinity();
    };
    const double t_s = time_of_least(distance, a.time_s, std::max(0.0, a.time_s - step_s),
                                     std::min(all.duration_s, a.time_s + step_s));
    const Vec3 p = pair.first(t_s), q = pair.second(t_s);
    const bool swap = upper_first && q.z > p.z;
    const auto& drones = show.facts().drones;
    return {drones[swap ? a.second : a.first].number,
            drones[swap ? a.first : a.second].number,
            t_s,
            pair.distance(t_s),
            std::hypot(p.x - q.x, p.y - q.y),
            std::abs(p.z - q.z),
            0.5 * (p + q)};
}

/// Whether a pair gets clearly farther apart between two of its times.
bool apart_between(const Survey& all, const Approach& a, const Approach& b) {
    const double from_s = std::min(a.time_s, b.time_s), to_s = std::max(a.time_s, b.time_s);
    const double beyond_m = kAgain * std::max(a.distance_m, b.distance_m);
    for (double t_s = from_s; t_s <= to_s; t_s += all.step_s()) {
        if (glm::length(all.place_at(a.first, t_s) - all.place_at(a.second, t_s)) >= beyond_m) return true;
    }
    return false;
}

/// The closest of all parts, one an approach.
std::vector<Approach> merged(const Survey& all, const std::vector<Closest>& parts) {
    std::vector<Approach> sorted, chosen;
    for (const Closest& part : parts) sorted.insert(sorted.end(), part.all().begin(), part.all().end());
    std::ranges::sort(sorted, nearer);
    for (const Approach& a : sorted) {
        if (chosen.size() == kShown) break;
        const bool known = std::ranges::any_of(chosen, [&](const Approach& c) {
            return c.first == a.first && c.second == a.second && !apart_between(all, c, a);
        });
        if (!known) chosen.push_back(a);
    }
    return chosen;
}

std::vector<ReportEncounter> refined(const OutgoingShow& show, const Survey& all, const std::vector<Closest>& parts,
                                     double step_s, const Column& column, bool upper_first) {
    std::vector<ReportEncounter> found;
    for (const Approach& a : merged(all, parts)) found.push_back(refined(show, all, a, step_s, column, upper_first));
    std::ranges::stable_sort(found, [](const ReportEncounter& a, const ReportEncounter& b) {
        return std::tie(a.distance_m, a.time_s, a.first, a.second) <
               std::tie(b.distance_m, b.time_s, b.first, b.second);
    });
    return found;
}

}  // namespace

void report_encounters(const OutgoingShow& show, const Survey& all, const Run& run, Report& report) {
    const std::vector<double>& times_s = report.times_s;
    const double reach_m = 3.0 * std::max(report.limits.min_separation_m, report.limits.formation_spacing_m);
    const std::size_t steps = times_s.size() - 1;
    std::vector<Closest> parts((steps + kStepsATask - 1) / kStepsATask, Closest(reach_m));
    parallel_for(parts.size(), run, "finding encounters", [&](std::size_t part) {
        Closest& closest = parts[part];
        PairGrid grid;
        std::vector<Mover> movers(all.drones.size());
        for (std::size_t k = part * kStepsATask; k < std::min(steps, (part + 1) * kStepsATask); ++k) {
            for (std::uint32_t d = 0; d < movers.size(); ++d)
                movers[d] = {all.place_at(d, times_s[k]), all.place_at(d, times_s[k + 1]), times_s[k], times_s[k + 1],
                             d};
            grid.search(movers, closest.reach_m(), [&](std::size_t i, std::size_t j) {
                const Nearest near = closest_approach(movers[i], movers[j]);
                if (near.distance_m < closest.reach_m() && !all.excuses(i, j, near.u))
                    closest.note({movers[i].drone, movers[j].drone, near.distance_m, near.u, k});
                return closest.reach_m();
            });
        }
    });
    report.encounters = refined(show, all, parts, report.step_s, {}, false);
}

void report_alignments(const OutgoingShow& show, const Survey& all, const Run& run, Report& report) {
    // Half of the smallest separation beside, four times below: docs/report.md.
    const double radius_m = 0.5 * report.limits.min_separation_m, height_m = 4.0 * report.limits.min_separation_m;
    report.alignment_radius_m = radius_m;
    report.alignment_height_m = height_m;
    const Vec3 scale{1.0 / radius_m, 1.0 / radius_m, all.downwash / height_m};
    const std::vector<double>& times_s = report.times_s;
    const std::size_t every = 1 + all.drones.size() * times_s.size() / kMostDroneInstants;
    std::vector<Closest> parts((times_s.size() + kStepsATask - 1) / kStepsATask, Closest(radius_m + height_m));
    parallel_for(parts.size(), run, "finding alignments", [&](std::size_t part) {
        Closest& closest = parts[part];
        PairGrid grid;
        std::vector<Mover> movers(all.drones.size());
        for (std::size_t k = part * kStepsATask; k < std::min(times_s.size(), (part + 1) * kStepsATask); ++k) {
            if (k % every != 0) continue;
            for (std::uint32_t d = 0; d < movers.size(); ++d) {
                const Vec3 at = scale * all.place_at(d, times_s[k]);
                movers[d] = {at, at, times_s[k], times_s[k], d};
            }
            grid.search(movers, std::sqrt(2.0), [&](std::size_t i, std::size_t j) {
                const Vec3 d = movers[j].from - movers[i].from;
                if (d.x * d.x + d.y * d.y <= 1.0 && std::abs(d.z) <= 1.0) {
                    const double distance_m = glm::length(d / scale);
                    if (distance_m < closest.reach_m() && !all.excuses(i, j, times_s[k]))
                        closest.note({movers[i].drone, movers[j].drone, distance_m, times_s[k], k / every});
                }
                return std::sqrt(2.0);
            });
        }
    });
    report.alignments =
        refined(show, all, parts, 0.5 * report.step_s * static_cast<double>(every), {radius_m, height_m}, true);
}

}  // namespace aerogram::exporter
