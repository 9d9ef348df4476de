#include "planner/separation/ladder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <tuple>

#include "geo/contract.hpp"
#include "planner/separation/swaps.hpp"

namespace aerogram::planner {
namespace {

constexpr double kWide = 1.0 / 10.0;         ///< W of the wide filter, a row
constexpr double kStretches[] = {1.5, 2.0};  ///< times the step
constexpr int kSwapTries = 3;

class Ladder {
  public:
    Ladder(const LadderTask& task, const Run& run) : task_(task), run_(run) {}

    Result<Separation> climb() {
        auto raw = task_.raw(task_.rows);
        if (!raw) return raw.error();
        std::vector<Step> steps{[this, &raw] { return project(*raw, task_.projection, "projection"); }};
        if (task_.projection.motion && task_.may_stretch) {
            for (const double stretch : kStretches) {
                steps.push_back([this, &raw, stretch] { return longer(*raw, stretch); });
            }
        }
        steps.push_back([this] { return finer({}); });
        for (int round = 0; task_.swapped && round < kSwapTries; ++round) {
            steps.push_back([this] { return swap(); });
        }
        steps.push_back([this] { return straight(); });
        for (const Step& step : steps) {
            auto done = step();
            if (!done) return done.error();
            if (*done) break;
        }
        best_.rounds = rounds_;
        if (!best_.separated) rungs_.push_back("not separated: " + closest_text());
        best_.rungs = rungs_;
        return best_;
    }

  private:
    using Step = std::function<Result<bool>()>;  ///< true: nothing more is needed

    /// Projects and keeps the outcome when it is better than what was found so far.
    Result<bool> project(const Lattice& lattice, const ProjectionTask& task, const std::string& rung,
                         std::vector<std::uint32_t> target_of = {}) {
        auto projected = project_separation(lattice, task, run_);
        if (!projected) return projected.error();
        rounds_ += projected->rounds;
        if (projected->rounds > 0) rungs_.push_back(rung + ", " + std::to_string(projected->rounds) + " rounds");
        if (projected->rounds == 0 && !projected->separated) rungs_.push_back(rung + ": too crowded to begin");
        stuck_ = std::move(projected->stuck);
        stuck_targets_ = target_of;
        const bool enough = projected->separated && projected->airspace_held &&
                            (projected->limits_held || (task_.may_stretch && task_.projection.motion));
        const auto rank = [](const auto& s) {
            return std::tuple(s.separated, s.airspace_held, s.limits_held, s.lower_bound_m);
        };
        if (first_ || rank(*projected) > rank(best_)) {
            best_.separated = projected->separated;
            best_.airspace_held = projected->airspace_held;
            best_.limits_held = projected->limits_held;
            best_.lower_bound_m = projected->lower_bound_m;
            best_.closest = projected->closest;
            best_.target_of = std::move(target_of);
            best_.motion = std::move(projected->lattice);
        }
        first_ = false;
        return enough;
    }

    Result<bool> longer(const Lattice& raw, double stretch) {
        ProjectionTask task = task_.projection;
        task.motion->step_s *= stretch;
        task.most_work *= 0.25;  // if looser limits help, they help soon
        std::ostringstream rung;
        rung << "projection in " << stretch << " times the time";
        return project(raw, task, rung.str());
    }

    /// Finer rows and a wide filter.
    Result<bool> finer(const std::vector<std::uint32_t>& target_of) {
        const std::size_t rows = task_.fine_rows > 0 ? task_.fine_rows : task_.rows;
        auto raw = target_of.empty() ? task_.raw(rows) : task_.swapped(rows, target_of);
        if (!raw) return raw.error();
        ProjectionTask task = task_.projection;
        task.samples_per_interval = std::max<std::size_t>(task.samples_per_interval, 2);
        task.smoothing_knots = kWide * static_cast<double>(rows);
        if (!target_of.empty()) task.most_work *= 0.5;
        if (task.motion) task.motion->step_s *= static_cast<double>(task_.rows - 3) / static_cast<double>(rows - 3);
        if (task.motion && task_.may_stretch) task.motion->step_s *= kStretches[1];
        std::string rung =
            task_.fine_rows > 0 ? "projection, finer lattice and wide filter" : "projection, wide filter";
        if (!target_of.empty()) rung += ", targets swapped";
        return project(*raw, task, rung, target_of);
    }

    /// Drones that are stuck with each other change targets where their ways cross.
    Result<bool> swap() {
        if (stuck_.empty()) return false;
        auto raw = task_.raw(task_.rows);
        if (!raw) return raw.error();
        std::vector<std::uint32_t> target_of = stuck_targets_;
        if (target_of.empty()) {
            target_of.resize(raw->drones);
            std::iota(target_of.begin(), target_of.end(), 0U);
        }
        const Points from_m = start_positions(*raw), to_m = end_positions(*raw);
        const std::size_t swaps = swap_stuck(from_m, to_m, stuck_, task_.projection.metric, target_of);
        if (swaps == 0) {
            stuck_.clear();
            return false;
        }
        rungs_.push_back(std::to_string(swaps) + " swaps of targets among stuck drones");
        return finer(target_of);
    }

    Result<bool> straight() {
        if (!task_.straight || best_.separated) return false;
        const double required_m = task_.projection.required_m;
        auto bound = bound_separation(*task_.straight, 1.0, task_.projection.metric, 2.0 * required_m, run_);
        if (!bound) return bound.error();
        if (!keeps(*bound, required_m) && bound->lower_bound_m <= best_.lower_bound_m) return false;
        std::ostringstream rung;
        rung << "straight lines on the optimal assignment (spacing / sqrt 2 is theirs: " << bound->lower_bound_m
             << " m)";
        rungs_.push_back(rung.str());
        best_ = Separation{};
        best_.motion = *task_.straight;
        best_.separated = keeps(*bound, required_m);
        best_.lower_bound_m = bound->lower_bound_m;
        best_.closest = bound->closest;
        return best_.separated;
    }

    [[nodiscard]] std::string closest_text() const {
        std::ostringstream text;
        if (!best_.closest) return "too many drones in too little room";
        text << "drones " << best_.closest->first.number() << " and " << best_.closest->second.number() << " come to "
             << best_.closest->distance_m << " m at " << 100.0 * best_.closest->time_s << " % of the act";
        return text.str();
    }

    const LadderTask& task_;
    const Run& run_;
    Separation best_;
    bool first_ = true;
    int rounds_ = 0;
    std::vector<std::string> rungs_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> stuck_;  ///< of the last projection
    std::vector<std::uint32_t> stuck_targets_;                    ///< as they were in that projection
};

}  // namespace

Result<Separation> separate(const LadderTask& task, const Run& run) {
    AEROGRAM_REQUIRE(task.raw, task.rows);
    return Ladder(task, run).climb();
}

}  // namespace aerogram::planner
