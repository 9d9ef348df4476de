#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "export/verify/claims.hpp"
#include "export/verify/judge.hpp"
#include "export/verify/rules_plane.hpp"
#include "export/verify_agreement.hpp"

namespace aerogram::exporter {
namespace {

/// An act is certified when its bound, which is found by halving, is this near to what it requires: numbers written by
/// a planner that stops there are no lie.
constexpr double kCertified_m = 1e-5;

/// To a micrometre, for two numbers that may differ by as little.
std::string exact(double value_m) {
    std::array<char, 400> text{};
    std::snprintf(text.data(), text.size(), "%.6f", value_m);
    return text.data();
}

std::string shown(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

Rules rules_of(const Manifest& manifest, const RecordedShow& trajectories) {
    Rules rules;
    rules.limits = manifest.limits;
    rules.airspace = manifest.airspace;
    rules.frame.emplace(manifest.origin);
    rules.rounding = trajectories.rounding;
    return rules;
}

Claims claims_of(const CertifiedAct& act) {
    Claims claims;
    claims.begin_s = act.start_s;
    claims.end_s = act.start_s + act.duration_s;
    claims.speed_horizontal_mps = act.speed_horizontal_mps;
    claims.speed_up_mps = act.speed_up_mps;
    claims.speed_down_mps = act.speed_down_mps;
    claims.acceleration_mps2 = act.acceleration_mps2;
    claims.jerk_mps3 = act.jerk_mps3;
    claims.altitude_min_m = act.altitude_min_m;
    claims.altitude_max_m = act.altitude_max_m;
    claims.geofence_margin_m = act.geofence_margin_m;
    claims.audience_margin_m = act.audience_margin_m;
    claims.obstacle_margin_m = act.obstacle_margin_m;
    if (act.plane) claims.plane = {act.plane->airspeed_min_mps, act.plane->airspeed_max_mps, act.plane->turn_rate_dps};
    return claims;
}

/// Whether the pair that is named as the closest is as far apart as is said, at the time that is said; or empty.
std::string wrong_encounter(const CertifiedAct& act, const RecordedShow& trajectories, const Rules& rules) {
    if (!act.closest_m) return {};
    if (!act.pair || !act.time_s) return "names no pair and time for its closest_m";
    const auto [first, second] = *act.pair;
    const std::string pair = "drones " + std::to_string(first) + " and " + std::to_string(second);
    const std::size_t fleet = trajectories.drones.size();
    const double t = *act.time_s;
    if (first == second || std::min(first, second) < 1 || std::max(first, second) > fleet)
        return "names " + pair + " as the closest of " + std::to_string(fleet);
    if (t < act.start_s - kNumeric || t > act.start_s + act.duration_s + kNumeric)
        return "names a closest pair at " + shown(t) + " s, which is not its time";
    const double apart_m = SeparationMetric{rules.limits.downwash}.distance(
        position_at(trajectories.drones[first - 1], t), position_at(trajectories.drones[second - 1], t));
    if (std::abs(apart_m - *act.closest_m) <= 2.0 * rules.space_m() + kNumeric) return {};
    return "says that " + pair + " are " + shown(*act.closest_m) + " m apart at " + shown(t) + " s; they are " +
           shown(apart_m);
}

Result<Problems> problems_of_act(const CertifiedAct& act, const RecordedShow& trajectories, const Rules& rules,
                                 const Run& run) {
    Problems problems;
    if (act.required_separation_m < planned_separation_m(rules.limits) - kNumeric) {  // more may be asked of an act
        problems.push_back("requires a separation of " + shown(act.required_separation_m) + " m; the limits require " +
                           shown(planned_separation_m(rules.limits)));
    }
    if (act.certified && act.min_separation_m &&
        *act.min_separation_m < act.required_separation_m - kCertified_m - kNumeric) {
        problems.push_back("is certified with a separation of " + exact(*act.min_separation_m) + " m; it requires " +
                           exact(act.required_separation_m));
    }
    if (act.plane.has_value() != rules.limits.plane.has_value())
        problems.push_back("does not say what planes do, or says it of copters");
    if (std::string wrong = wrong_encounter(act, trajectories, rules); !wrong.empty()) problems.push_back(wrong);
    const Claims claims = claims_of(act);
    std::vector<BrokenClaim> all_broken = broken_claims(trajectories, rules, claims, run);
    std::ranges::copy(broken_plane_claims(trajectories, rules, claims, run), std::back_inserter(all_broken));
    for (const BrokenClaim& broken : all_broken) {
        problems.push_back("claims " + broken.what + " = " + shown(broken.claimed) + "; drone " +
                           std::to_string(broken.drone + 1) + " has " + shown(broken.found) + " at " +
                           shown(broken.time_s) + " s");
    }
    if (run.stopped()) return stopped_error();
    if (!act.min_separation_m) return problems;
    const double claim_m = *act.min_separation_m;
    const double beyond_m = std::max(rules.limits.min_separation_m, 1.01 * claim_m + kNumeric);
    const auto found = verify_separation(trajectories, rules.limits.downwash, beyond_m, run,
                                         {.begin_s = act.start_s, .end_s = act.start_s + act.duration_s});
    if (!found) return found.error();
    if (claim_m > found->attained_m + kNumeric) {
        problems.push_back("claims a separation of " + shown(claim_m) + " m; drones " +
                           std::to_string(found->first + 1) + " and " + std::to_string(found->second + 1) +
                           " come to " + shown(found->attained_m) + " m at " + shown(found->time_s) + " s");
    }
    return problems;
}

/// The smallest separation that an act claims.
std::optional<double> least_separation(const CertificateRecord& certificate) {
    std::optional<double> least_m;
    for (const CertifiedAct& act : certificate.acts) {
        if (act.min_separation_m) least_m = std::min(least_m.value_or(*act.min_separation_m), *act.min_separation_m);
    }
    return least_m;
}

}  // namespace

Result<Problems> disagreement_with_certificate(const CertificateRecord& certificate, const Manifest& manifest,
                                               const RecordedShow& trajectories, const Run& run) {
    if (const Status sound = well_formed(trajectories); !sound) return sound.error();
    Problems problems;
    const auto require = [&](bool same, const std::string& what) {
        if (!same) problems.push_back(what + " differs from the manifest");
    };
    require(certificate.show_name == manifest.show_name, "the show's name");
    require(certificate.show_hash == manifest.show_hash, "the show hash");
    require(certificate.certified == manifest.certified, "the certified mark");
    if (certificate.min_separation_m != least_separation(certificate))
        problems.push_back("its min_separation_m is not that of its acts");
    const Rules rules = rules_of(manifest, trajectories);
    double clock_s = 0.0;
    for (const CertifiedAct& act : certificate.acts) {
        const std::string name = "act \"" + act.name + "\"";
        if (std::abs(act.start_s - clock_s) > kNumeric)
            problems.push_back(name + " does not start where the one before ends");
        clock_s = act.start_s + act.duration_s;
        if (certificate.certified && !act.certified)
            problems.push_back(name + " is not certified, the certificate says it is");
        const auto wrong = problems_of_act(act, trajectories, rules, run);
        if (!wrong) return wrong.error();
        for (const std::string& what : *wrong) problems.push_back((name + " ").append(what));
    }
    if (std::abs(clock_s - manifest.duration_s) > kNumeric)
        problems.push_back("the acts do not last as long as the show");
    return problems;
}

}  // namespace aerogram::exporter
