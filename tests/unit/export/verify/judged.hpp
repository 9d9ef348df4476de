#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "export/verify/judge.hpp"

/// Shows judged, and what was found, in few words.
namespace aerogram::exporter::testing {

inline Judgement judged(const RecordedShow& show, const JudgeAgainst& against = {}) {
    return judge(show, against, aerogram::Run{}).value();
}
inline const Finding& finding(const Judgement& judgement, const std::string& rule) {
    for (const Finding& each : judgement.findings) {
        if (each.rule == rule) return each;
    }
    throw std::runtime_error("no finding for " + rule);
}
inline std::vector<std::string> broken(const Judgement& judgement) {
    std::vector<std::string> names;
    for (const Finding& each : judgement.findings) {
        if (!each.held) names.push_back(each.rule);
    }
    return names;
}
inline JudgeAgainst limits(const Limits& limits) {
    return {.limits = limits, .airspace = {}, .origin = {}, .endurance_s = {}, .claimed_separation_m = {}};
}
inline JudgeAgainst airspace(const geo::Airspace& airspace) {
    return {.limits = {}, .airspace = airspace, .origin = {}, .endurance_s = {}, .claimed_separation_m = {}};
}

}  // namespace aerogram::exporter::testing
