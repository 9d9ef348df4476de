#include "export/verify/judge.hpp"

#include <algorithm>

#include "export/verify/rules.hpp"
#include "export/verify/rules_plane.hpp"
#include "export/verify/waypoint_legs.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kMostExcused = 0.75;  ///< of the least speed limit, and of the acceleration limit
constexpr double kSag_m = 0.02;        ///< a level leg of 1 km is a straight line, that much lower in its middle

std::string where_limits_come_from(const RecordedShow& show, const JudgeAgainst& against) {
    if (show.limits) return "the file";
    return against.limits ? against.limits_from : "preset standard";
}

Rules rules_for(const RecordedShow& show, const JudgeAgainst& against) {
    Rules rules;
    rules.limits = show.limits ? *show.limits : against.limits.value_or(Limits{});
    rules.airspace = show.airspace ? *show.airspace : against.airspace.value_or(geo::Airspace{});
    if (const auto& origin = show.origin ? show.origin : against.origin) rules.frame.emplace(*origin);
    rules.endurance_s = show.endurance_s ? show.endurance_s : against.endurance_s;
    rules.rounding = show.rounding;
    // A file's rounding excuses a part of a limit, never all of it: one tiny piece must not hide what others do.
    const Limits& l = rules.limits;
    const double slowest_mps = std::min({l.speed_horizontal_mps, l.speed_up_mps, l.speed_down_mps});
    rules.rounding.speed_allowance_mps = std::min(rules.rounding.speed_allowance_mps, kMostExcused * slowest_mps);
    rules.rounding.acceleration_allowance_mps2 =
        std::min(rules.rounding.acceleration_allowance_mps2, kMostExcused * l.acceleration_mps2);
    return rules;
}

void append(std::vector<Finding>& all, std::vector<Finding> more) {
    for (Finding& finding : more) all.push_back(std::move(finding));
}

Status judge_separation(const RecordedShow& show, const Rules& rules, const JudgeAgainst& against, const Run& run,
                        Judgement& judgement) {
    const double limit = rules.limits.min_separation_m;
    const double beyond = std::max(2.0 * limit, 1.01 * against.claimed_separation_m.value_or(0.0));
    SeparationSearch search;
    search.likely_closest = against.likely_closest;
    auto found = verify_separation(show, rules.limits.downwash, beyond, run, search);
    if (found && found->lower_bound_m < limit && found->attained_m >= limit) {  // too close to the limit to tell
        search.resolved_m = 0.5 * kNumeric;
        found = verify_separation(show, rules.limits.downwash, beyond, run, search);
    }
    if (!found) return found.error();
    judgement.min_separation_m = found->lower_bound_m;
    judgement.closest_m = found->attained_m;
    Finding finding{"separation", limit, found->lower_bound_m, 0.0, {}, {}, found->lower_bound_m >= limit - kNumeric};
    if (found->attained_m <= beyond) {
        finding.drones = {std::min(found->first, found->second) + 1, std::max(found->first, found->second) + 1};
        finding.time_s = found->time_s;
    }
    if (show.drones.size() > 1) judgement.findings.push_back(std::move(finding));
    return Done{};
}

/// Places only: times and speeds mean nothing but the moments that a fleet waits for.
Result<Judgement> judge_waypoints(const RecordedShow& show, Rules rules, const Run& run, Judgement judgement) {
    auto legs = legs_as_pieces(show, rules);
    if (!legs) return legs.error();
    rules.rounding.fit_m += kSag_m;
    append(judgement.findings, altitude_findings(*legs, rules, run));
    append(judgement.findings, airspace_findings(*legs, rules, run));
    append(judgement.findings, ground_findings(*legs, rules));
    for (Finding& finding : judgement.findings) finding.time_s.reset();
    auto standing = standing_findings(show, *legs, rules, run);
    if (!standing) return standing.error();
    append(judgement.findings, std::move(*standing));
    judgement.problems = track_problems(*legs);
    judgement.separation_claimed = false;
    if (run.stopped()) return stopped_error();
    return judgement;
}

}  // namespace

bool Judgement::held() const {
    return problems.empty() && std::ranges::all_of(findings, &Finding::held);
}

std::optional<LikelyClosest> closest_of(const Judgement& judgement) {
    const auto found = std::ranges::find(judgement.findings, "separation", &Finding::rule);
    if (found == judgement.findings.end() || found->drones.size() != 2 || !found->time_s) return std::nullopt;
    return LikelyClosest{found->drones[0] - 1, found->drones[1] - 1, *found->time_s};
}

Result<Judgement> judge(const RecordedShow& show, const JudgeAgainst& against, const Run& run) {
    if (show.drones.empty()) return Error{ErrorCode::invalid_input, "the show has no drones"};
    Judgement judgement;
    judgement.format = show.format;
    judgement.timing = show.timing;
    judgement.limits_from = where_limits_come_from(show, against);
    const Rules rules = rules_for(show, against);
    if (!show.timed) return judge_waypoints(show, rules, run, std::move(judgement));
    if (const Status sound = well_formed(show); !sound) return sound.error();
    if (const Status done = judge_separation(show, rules, against, run, judgement); !done) return done.error();
    append(judgement.findings, motion_findings(show, rules, run));
    append(judgement.findings, plane_findings(show, rules, run));
    append(judgement.findings, altitude_findings(show, rules, run));
    append(judgement.findings, airspace_findings(show, rules, run));
    append(judgement.findings, ground_findings(show, rules));
    judgement.problems = track_problems(show);
    if (run.stopped()) return stopped_error();
    return judgement;
}

}  // namespace aerogram::exporter
