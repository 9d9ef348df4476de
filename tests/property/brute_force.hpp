#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "geo/airspace.hpp"
#include "geo/show_frame.hpp"
#include "geo/units.hpp"
#include "planner/motion/flight_plan.hpp"

/// What a plan really does, by sampling alone, however large the fleet. Nothing here knows how a certificate is made.
namespace aerogram::property {

/// The closest two of some points nearer than `within_m`.
struct ClosePair {
    double distance_m = std::numeric_limits<double>::infinity();
    std::size_t first = 0, second = 0;
};

/// Sorted cells of edge within_m: each point looks at those of its own and the neighbouring cells, in five runs.
inline ClosePair close_pair(const Points& points_m, const std::vector<std::uint32_t>& of, double downwash,
                            double within_m) {
    struct Place {
        std::int64_t cell;
        std::uint32_t who;
        Vec3 at;
    };
    constexpr std::int64_t kRow = 1 << 20, kLayer = kRow * kRow, kMiddle = 1 << 19;
    std::vector<Place> places;
    places.reserve(of.size());
    for (const std::uint32_t i : of) {
        const Vec3 p{points_m[i].x, points_m[i].y, points_m[i].z / downwash};
        const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / within_m)) + kMiddle; };
        places.push_back({cell(p.z) * kLayer + cell(p.y) * kRow + cell(p.x), i, p});
    }
    std::sort(places.begin(), places.end(),
              [](const Place& a, const Place& b) { return a.cell != b.cell ? a.cell < b.cell : a.who < b.who; });
    ClosePair best;
    const auto compare = [&](const Place& a, const Place& b) {
        const double distance_m = glm::distance(a.at, b.at);
        if (distance_m < best.distance_m && distance_m < within_m) best = {distance_m, a.who, b.who};
    };
    constexpr std::int64_t kRuns[] = {0, kRow, kLayer - kRow, kLayer, kLayer + kRow};
    for (const std::int64_t run : kRuns) {
        std::size_t from = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::int64_t low = places[i].cell + run - 1, high = places[i].cell + run + 1;
            while (from < places.size() && places[from].cell < low) ++from;
            for (std::size_t j = run == 0 ? i + 1 : from; j < places.size() && places[j].cell <= high; ++j)
                compare(places[i], places[j]);
        }
    }
    return best;
}

/// Where and when sampling found the most of something above what was claimed.
struct Shortfall {
    double worst_m = -std::numeric_limits<double>::infinity();  ///< claimed separation minus found; > 0 is a lie
    std::vector<std::string> lies;                              ///< claims and limits that sampling contradicts
};

/// Samples acts against their certificates and the limits.
class BruteForce {
  public:
    /// @param evaluations  positions computed an act, about.
    BruteForce(const planner::FlightPlan& plan, double evaluations)
        : plan_(plan),
          frame_(plan.origin),
          instants_(
              static_cast<std::size_t>(std::clamp(evaluations / static_cast<double>(plan.drones()), 40.0, 2000.0))) {}

    Shortfall check() {
        for (std::size_t a = 0; a < plan_.acts.size(); ++a) check_act(plan_.acts[a], plan_.certificate.acts[a]);
        const double total_s = seconds_from_ms(plan_.duration_ms());
        if (total_s > plan_.endurance_s) lie("the battery", total_s, plan_.endurance_s);
        for (std::size_t d = 0; d < plan_.drones(); ++d) {
            for (const double t_s : {0.0, total_s})
                if (glm::distance(sample(plan_, DroneId(d), t_s).motion.position_m, plan_.pads_m[d]) > 1e-9)
                    lie("the own pad, drone", static_cast<double>(d + 1), t_s);
        }
        return found_;
    }

  private:
    void lie(const std::string& what, double found, double claimed) {
        if (found_.lies.size() >= 20) return;
        std::ostringstream text;
        text.precision(10);
        text << what << ": found " << found << ", claimed " << claimed;
        found_.lies.push_back(text.str());
    }

    void check_act(const planner::Act& act, const planner::ActCertificate& claim) {
        const std::size_t n = plan_.drones();
        const bool still = std::holds_alternative<planner::Hold>(act.motion);
        const std::size_t instants = still ? 1 : instants_;
        const double total_s = seconds_from_ms(act.duration_ms), step_s = total_s / static_cast<double>(instants);
        const std::vector<std::uint32_t> judged = who_is_judged(act);
        // A hair more than claimed, so that what keeps the claim shows too.
        const double within_m = claim.separation.lower_bound_m * 1.02 + 0.01;
        Points now(n);
        ClosePair closest;
        double when_s = 0.0;
        for (std::size_t k = 0; k <= instants; ++k) {
            const double t_s = std::min(total_s, static_cast<double>(k) * step_s);
            positions(act, t_s, now);
            if (claim.separation.closest) {
                const ClosePair pair = close_pair(now, judged, plan_.limits.downwash, within_m);
                if (pair.distance_m < closest.distance_m) {
                    closest = pair;
                    when_s = t_s;
                }
            }
            check_air(act, claim, now);
            if (!still && k > 0 && k < instants) check_motion(act, claim, now, t_s);
            if (k % 8 == 0) check_altitudes(act, now, judged);
        }
        if (closest.first == closest.second) return;
        const double least_m = followed(act, closest, when_s, step_s);
        found_.worst_m = std::max(found_.worst_m, claim.separation.lower_bound_m - least_m);
        if (claim.separation.lower_bound_m > least_m + 1e-8)
            lie(act.name + ": separation", least_m, claim.separation.lower_bound_m);
        if (claim.certified() && least_m < claim.required_separation_m - planner::kSeparationTolerance_m)
            lie(act.name + ": required separation", least_m, claim.required_separation_m);
    }

    /// Everybody, but for those that stand on their pads all through a take-off or landing.
    std::vector<std::uint32_t> who_is_judged(const planner::Act& act) const {
        const bool pads = act.role == planner::ActRole::takeoff || act.role == planner::ActRole::landing;
        const double total_s = seconds_from_ms(act.duration_ms);
        std::vector<std::uint32_t> judged;
        for (std::uint32_t d = 0; d < plan_.drones(); ++d) {
            bool stands = pads;
            for (int k = 0; stands && k <= 4; ++k) {
                const Vec3 at = planner::kinematics(act, DroneId(d), 0.25 * k * total_s).position_m;
                stands = glm::distance(at, plan_.pads_m[d]) <= 1e-6;
            }
            if (!stands) judged.push_back(d);
        }
        return judged;
    }

    /// The pair's own minimum around its sample, by golden section.
    double followed(const planner::Act& act, const ClosePair& pair, double t_s, double step_s) const {
        const SeparationMetric metric{plan_.limits.downwash};
        const auto at = [&](double s) {
            return metric.distance(planner::kinematics(act, DroneId(pair.first), s).position_m,
                                   planner::kinematics(act, DroneId(pair.second), s).position_m);
        };
        double low_s = t_s - step_s, high_s = t_s + step_s;
        for (int k = 0; k < 60; ++k) {
            const double third_s = (high_s - low_s) / 3.0;
            if (at(low_s + third_s) < at(high_s - third_s)) {
                high_s -= third_s;
            } else {
                low_s += third_s;
            }
        }
        return std::min(pair.distance_m, at(0.5 * (low_s + high_s)));
    }

    void check_air(const planner::Act& act, const planner::ActCertificate& claim, const Points& now) {
        double fence_m = std::numeric_limits<double>::infinity(), crowd_m = fence_m, obstacle_m = fence_m;
        const geo::Airspace& air = plan_.airspace;
        for (const Vec3& p : now) {
            if (!air.geofence_m.empty()) fence_m = std::min(fence_m, geo::signed_distance(air.geofence_m, Vec2(p)));
            for (const auto& polygon : air.audience_m)
                crowd_m = std::min(crowd_m, -geo::signed_distance(polygon, Vec2(p)));
            for (const auto& obstacle : air.obstacles) obstacle_m = std::min(obstacle_m, geo::clearance(obstacle, p));
        }
        const auto compare = [&](const char* what, double found_m, const std::optional<double>& claimed_m) {
            if (claimed_m && found_m < *claimed_m - 1e-9) lie(act.name + ": " + what, found_m, *claimed_m);
            if (claim.certified() && found_m < 0.0) lie(act.name + ": " + what, found_m, 0.0);
        };
        compare("geofence", fence_m, claim.geofence_margin_m);
        compare("audience", crowd_m, claim.audience_margin_m);
        compare("obstacle", obstacle_m, claim.obstacle_margin_m);
    }

    /// Central differences.
    void check_motion(const planner::Act& act, const planner::ActCertificate& claim, const Points& now, double t_s) {
        constexpr double kStep_s = 1e-3, kSlack = 1e-4;
        const double total_s = seconds_from_ms(act.duration_ms);
        if (t_s < kStep_s || t_s > total_s - kStep_s) return;
        before_.resize(now.size());
        after_.resize(now.size());
        positions(act, t_s - kStep_s, before_);
        positions(act, t_s + kStep_s, after_);
        double level = 0.0, up = 0.0, down = 0.0, most = 0.0;
        for (std::size_t d = 0; d < now.size(); ++d) {
            const Vec3 v = (after_[d] - before_[d]) / (2.0 * kStep_s);
            const Vec3 a = (after_[d] - 2.0 * now[d] + before_[d]) / (kStep_s * kStep_s);
            level = std::max(level, glm::length(Vec2(v)));
            up = std::max(up, v.z);
            down = std::max(down, -v.z);
            most = std::max(most, glm::length(a));
        }
        const auto compare = [&](const char* what, double found, double claimed, double limit) {
            if (found > claimed + kSlack) lie(act.name + ": " + what, found, claimed);
            if (claim.certified() && found > limit + 1e-3) lie(act.name + ": limit of " + what, found, limit);
        };
        const planner::Extremes& e = claim.extremes;
        compare("horizontal speed", level, e.speed_horizontal_mps, plan_.limits.speed_horizontal_mps);
        compare("upward speed", up, e.speed_up_mps, plan_.limits.speed_up_mps);
        compare("downward speed", down, e.speed_down_mps, plan_.limits.speed_down_mps);
        compare("acceleration", most, e.acceleration_mps2, plan_.limits.acceleration_mps2);
    }

    /// Who is below the lowest navigation altitude is over the own pad; nobody is above the ceiling.
    void check_altitudes(const planner::Act& act, const Points& now, const std::vector<std::uint32_t>& judged) {
        constexpr double kCurvature_m = 1.1e-3;
        for (const std::uint32_t d : judged) {
            const double altitude_m = frame_.altitude_above(plan_.pads_m[d], now[d]);
            if (altitude_m > plan_.limits.ceiling_m + kCurvature_m)
                lie(act.name + ": ceiling", altitude_m, plan_.limits.ceiling_m);
            if (altitude_m < -1e-6) lie(act.name + ": ground", altitude_m, 0.0);
            const bool low = altitude_m < plan_.limits.min_navigation_altitude_m - kCurvature_m;
            if (low && glm::distance(Vec2(now[d]), Vec2(plan_.pads_m[d])) > 1e-5)
                lie(act.name + ": sideways low flight", altitude_m, plan_.limits.min_navigation_altitude_m);
        }
    }

    const planner::FlightPlan& plan_;
    geo::ShowFrame frame_;
    std::size_t instants_;
    Points before_, after_;
    Shortfall found_;
};

}  // namespace aerogram::property
