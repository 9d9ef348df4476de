#include <iomanip>
#include <iostream>
#include <sstream>

#include "export/verify_show.hpp"
#include "ground/app/answers.hpp"
#include "ground/app/commands.hpp"
#include "ground/app/exit_status.hpp"
#include "ground/app/words.hpp"

namespace aerogram::ground {
namespace {

using exporter::Finding;
using exporter::Judgement;

constexpr double kShownAllowance = 5e-4;  // below it prints as 0.000

/// The unit that a rule is judged in.
std::string unit_of(const std::string& rule) {
    if (rule == "velocity_jump" || rule.starts_with("speed") || rule.starts_with("airspeed") || rule == "climb" ||
        rule == "sink")
        return " m/s";
    if (rule == "acceleration") return " m/s²";
    if (rule == "endurance" || rule == "leaving_times") return " s";
    if (rule == "turn_rate_dps") return " deg/s";
    return " m";
}

std::string finding_line(const Finding& finding) {
    const std::string unit = unit_of(finding.rule);
    std::ostringstream line;
    line << "    " << (finding.held ? "ok      " : "BROKEN  ") << std::left << std::setw(26) << finding.rule
         << " worst " << decimals(finding.worst, 3) << unit << ", limit " << decimals(finding.limit, 3) << unit;
    if (finding.allowance >= kShownAllowance)
        line << " + " << decimals(finding.allowance, 3) << unit << " for the format's rounding";
    if (!finding.drones.empty()) line << ", " << drones_in_words(finding.drones);
    if (finding.time_s) line << " at " << decimals(*finding.time_s, 2) << " s";
    return line.str() + "\n";
}

std::string judgement_text(const Judgement& judgement, bool only_broken = false) {
    std::string text = "  " + judgement.format + ": " + (judgement.held() ? "holds" : "BROKEN") + " (limits from " +
                       judgement.limits_from + ")\n";
    if (!judgement.separation_claimed) text += "    no separation is claimed for waypoints\n";
    for (const Finding& finding : judgement.findings) {
        if (!finding.held || !only_broken) text += finding_line(finding);
    }
    for (const std::string& problem : judgement.problems) text += "    BROKEN  " + problem + "\n";
    return text;
}

/// A format that holds, beside others of the same show.
std::string one_line(const Judgement& judgement) {
    const std::string kept =
        judgement.separation_claimed
            ? "separation >= " + decimals(judgement.min_separation_m, 3) + " m"
            : (judgement.timing.empty() ? "untimed" : judgement.timing.substr(0, judgement.timing.find(':'))) +
                  " waypoints, no separation is claimed";
    return "  " + judgement.format + ": holds, " + kept + "\n";
}

}  // namespace

int run_verify(const VerifyCommand& command, const Session& session) {
    std::vector<std::pair<std::filesystem::path, exporter::Verified>> all;
    bool held = true;
    for (const auto& path : command.paths) {
        auto verified = exporter::verify_path(path, session.run);
        if (!verified) return report_error(verified.error(), session);
        held = held && verified->held();
        all.emplace_back(path, std::move(*verified));
    }
    session.console.clear_line();
    if (session.json) {
        std::cout << verify_answer(all);
    } else if (!session.quiet) {
        for (const auto& [path, verified] : all) {
            std::cout << path.string() << ": " << (verified.held() ? "verified\n" : "NOT VERIFIED\n");
            for (const std::string& problem : verified.problems) std::cout << "  BROKEN  " << problem << "\n";
            for (const Judgement& judgement : verified.shows) {
                const bool brief = judgement.held() && &judgement != &verified.shows.front();
                std::cout << (brief ? one_line(judgement) : judgement_text(judgement));
            }
        }
    } else {
        for (const auto& [path, verified] : all) {
            for (const std::string& problem : verified.problems) session.console.error(problem);
            for (const Judgement& judgement : verified.shows) {
                if (!judgement.held()) session.console.error(path.string() + "\n" + judgement_text(judgement, true));
            }
        }
    }
    return held ? kDone : kCannotBeFlown;
}

}  // namespace aerogram::ground
