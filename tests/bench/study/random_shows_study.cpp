// Random shows of 10 to 20,000 drones, each planned by a child process under a limit of CPU time: certified ones are
// sampled by brute force, refusals must name who, when and what, and sampling must find just that.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <stop_token>
#include <thread>

#include "planner/mission/mission_reader.hpp"
#include "planner/plan.hpp"
#include "tests/bench/study/study.hpp"
#include "tests/property/brute_force.hpp"
#include "tests/property/random_shows.hpp"
#include "tests/property/refusals.hpp"

namespace aerogram::study {
namespace {

using property::RandomShow;

enum class Outcome { certified, refused, line, late, hung, crashed, lied, unfounded };
constexpr std::array kOutcomes{"certified", "refused", "mission line", "out of time",
                               "hung",      "crashed", "claims more",  "refusal not confirmed"};

/// What a child tells; plain bytes, through a pipe.
struct Report {
    Outcome outcome = Outcome::crashed;
    bool unchecked = false;  ///< a refusal whose uncertified plan took too long to make again
    double plan_cpu_s = 0.0, worst_m = -1e9;
    std::array<char, 400> why{};

    void say(const std::string& text) {
        std::strncpy(why.data(), text.c_str(), why.size() - 1);
        for (char& c : why)
            if (c == '\n') c = '|';
    }
};

/// CPU seconds that planning may take: twice as many for the second 10,000 drones on one way as for none.
double limit_s(const RandomShow& show, double scale_s) {
    const auto ways = static_cast<double>(show.keyframes + 1);
    return scale_s * (1.0 + static_cast<double>(show.drones) * ways / 10'000.0);
}

/// Asks to stop once the process has used that much CPU time.
class Watch {
  public:
    Watch(std::stop_source& stop, double cpu_limit_s)
        : thread_([&stop, cpu_limit_s](const std::stop_token& done) {
              while (!done.stop_requested()) {
                  std::this_thread::sleep_for(std::chrono::milliseconds(10));
                  if (cpu_s() > cpu_limit_s) stop.request_stop();
              }
          }) {}

  private:
    std::jthread thread_;
};

Result<planner::FlightPlan> planned(const planner::Mission& mission, bool best_effort, double seconds) {
    std::stop_source stop;
    const Watch watch(stop, cpu_s() + seconds);
    return planner::plan(mission, {best_effort}, Run{stop.get_token(), {}, 2});
}

/// The kernel ends a process that has not stopped long after it was asked to.
void end_after(double cpu_limit_s) {
    rlimit limit{};
    getrlimit(RLIMIT_CPU, &limit);
    limit.rlim_cur = static_cast<rlim_t>(std::ceil(cpu_limit_s));
    setrlimit(RLIMIT_CPU, &limit);
}

void judge_refusal(Report& report, const planner::Mission& mission, const Error& error, double seconds) {
    report.say(error.message);
    if (error.code == ErrorCode::invalid_input) {
        report.outcome = property::names_a_mission_line(error.message) ? Outcome::line : Outcome::unfounded;
        return;
    }
    report.outcome = Outcome::refused;
    const auto uncertified = planned(mission, true, 2.0 * seconds);
    if (!uncertified) {
        report.unchecked = uncertified.error().code == ErrorCode::stopped;
        if (!report.unchecked) report.outcome = Outcome::unfounded;
        return;
    }
    const property::RefusalCheck check(*uncertified, error.message);
    if (check.problems().empty()) return;
    report.outcome = Outcome::unfounded;
    report.say(check.problems().front());
}

Report fly(const RandomShow& show, double seconds) {
    Report report;
    const double start_s = cpu_s();
    const auto mission = planner::parse_mission(show.text, "show.toml");
    if (!mission) {
        report.outcome = property::names_a_mission_line(mission.error().message) ? Outcome::line : Outcome::unfounded;
        report.say(mission.error().message);
        return report;
    }
    end_after(start_s + 1.5 * seconds + 5.0);
    const auto plan = planned(*mission, false, seconds);
    report.plan_cpu_s = cpu_s() - start_s;
    end_after(1e6);
    if (!plan && plan.error().code == ErrorCode::stopped) {
        report.outcome = Outcome::late;
    } else if (!plan) {
        judge_refusal(report, *mission, plan.error(), seconds);
    } else {
        const property::Shortfall found = property::BruteForce(*plan, 1e6).check();
        report.worst_m = found.worst_m;
        report.outcome = found.lies.empty() && plan->certificate.certified() ? Outcome::certified : Outcome::lied;
        if (!found.lies.empty()) report.say(found.lies.front());
    }
    return report;
}

Report fly_in_child(const RandomShow& show, double seconds, double& child_cpu_s) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no child process");
    if (child == 0) {
        close(ends[0]);
        const Report report = fly(show, seconds);
        const bool told = write(ends[1], &report, sizeof report) == static_cast<ssize_t>(sizeof report);
        _exit(told ? 0 : 1);
    }
    close(ends[1]);
    Report report;
    const bool heard = read(ends[0], &report, sizeof report) == static_cast<ssize_t>(sizeof report);
    close(ends[0]);
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    const auto seconds_of = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    child_cpu_s = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    if (heard) return report;
    const bool hung = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
    report.outcome = hung ? Outcome::hung : Outcome::crashed;
    report.say(WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status)) : "exit");
    return report;
}

Json random_shows(const Arguments& arguments) {
    const std::size_t first = arguments.count(0), count = arguments.count(1);
    const auto most = static_cast<std::size_t>(arguments.number("most", 20'000));
    const double scale_s = arguments.number("limit-s", 10.0);
    std::array<double, kOutcomes.size()> counts{};
    double tame = 0, tame_certified = 0, unchecked = 0, drones = 0, plan_cpu_s = 0, all_cpu_s = 0, worst_m = -1e9;
    std::string untrue, refused_tame;
    for (std::size_t seed = first; seed < first + count; ++seed) {
        const RandomShow show = property::random_show(seed, most);
        double child_cpu_s = 0.0;
        const Report report = fly_in_child(show, limit_s(show, scale_s), child_cpu_s);
        const auto outcome = static_cast<std::size_t>(report.outcome);
        ++counts[outcome];
        const bool certified = report.outcome == Outcome::certified;
        tame += show.tame;
        tame_certified += show.tame && certified;
        unchecked += report.unchecked;
        drones += static_cast<double>(show.drones);
        plan_cpu_s += report.plan_cpu_s;
        all_cpu_s += child_cpu_s;
        worst_m = std::max(worst_m, report.worst_m);
        if (show.tame && !certified) refused_tame += (refused_tame.empty() ? "" : " ") + std::to_string(seed);
        if (report.outcome >= Outcome::hung) untrue += (untrue.empty() ? "" : " ") + std::to_string(seed);
        std::cerr << "seed " << seed << ": " << show.drones << " drones, " << show.keyframes << " keyframes, "
                  << (show.tame ? "tame" : "wild") << ": " << kOutcomes[outcome] << ", " << report.plan_cpu_s
                  << " s of " << limit_s(show, scale_s) << ' ' << report.why.data() << std::endl;
    }
    if (!untrue.empty()) throw std::runtime_error("hung, crashed or untrue, seeds " + untrue);
    Json out;
    out.add("shows", static_cast<double>(count)).add("drones", drones).add("feasible by construction", tame);
    out.add("of these certified", tame_certified).add("of these not certified, seeds", refused_tame);
    for (std::size_t o = 0; o < counts.size(); ++o) out.add(kOutcomes[o], counts[o]);
    out.add("refusals not planned again", unchecked).add("worst shortfall_m", worst_m);
    return out.add("plan cpu_s", plan_cpu_s).add("all cpu_s", all_cpu_s);
}

/// Prints the mission of a seed.
Json random_show_text(const Arguments& arguments) {
    const auto most = static_cast<std::size_t>(arguments.number("most", 20'000));
    const RandomShow show = property::random_show(arguments.count(0), most);
    std::cerr << show.text;
    return Json{}.add("drones", static_cast<double>(show.drones)).add("feasible by construction", show.tame);
}

const Study kShows{"random-shows", "FIRST_SEED COUNT [--most 20000] [--limit-s 10]", "1 4 --most 40", random_shows};
const Study kShow{"random-show", "SEED [--most 20000]  (the mission goes to stderr)", "", random_show_text};

}  // namespace
}  // namespace aerogram::study
