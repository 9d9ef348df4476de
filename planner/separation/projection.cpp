#include "planner/separation/projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/contract.hpp"
#include "planner/separation/fleet_state.hpp"
#include "planner/separation/waist.hpp"

namespace aerogram::planner {
namespace {

constexpr double kAim = 1.01;              ///< aiming at the requirement itself never quite gets there (DESIGN.md 8)
constexpr double kGain = 2.0;              ///< 1 takes twice the rounds, 3 overshoots
constexpr double kNoise_m = 0.05;          ///< smooth, seeded: breaks head-on symmetry
constexpr double kSlack = 0.25;            ///< of the required separation: drones that moved farther are asked again
constexpr double kLimitsHeld = 1.005;      ///< of a limit
constexpr double kInBand_m = 0.05;         ///< closer than this to the band, rows are just put into it
constexpr double kClear_m = 1e-3;          ///< airspace is held to this
constexpr std::size_t kFewDrones = 2'000;  ///< fewer get the work of so many: it is soon done
constexpr std::size_t kMostStuck = 4;      ///< stuck pairs a drone that are reported
constexpr int kWindow = 60;                ///< rounds whose best is compared with that of the rounds before
constexpr double kProgress = 0.98;         ///< of the shortfall, from window to window
constexpr double kNearer_m = 1e-3;         ///< the closest pair moved apart by this, from window to window
constexpr int kForLimits = 60;             ///< rounds that limits get after everything else holds
constexpr int kMostForLimits = 150;        ///< rounds that limits get at all
constexpr double kTailAim = 1.03;          ///< what the aim grows to, of the requirement, when the end is slow
constexpr double kTailGrowth = 1.0005;     ///< a round
constexpr double kMoveWork = 300.0;        ///< what moving or listing one drone costs, in chords looked at

/// When to give up: a whole window of rounds in which neither the shortfall fell nor the closest pair moved apart, or
/// as much work done as is reasonable.
class Patience {
  public:
    explicit Patience(double work) : left_(work) {}
    void encourage() { before_ = now_ = std::numeric_limits<double>::infinity(); }
    void spend(std::size_t drones) { left_ -= kMoveWork * static_cast<double>(drones); }
    bool gone(const FleetState::Closeness& now, double others_m, int round) {
        left_ -= static_cast<double>(now.looked_at);
        now_ = std::min(now_, now.shortfall_m + others_m);
        closest_m_ = std::max(closest_m_, now.closest_m);
        if (left_ < 0.0) return true;
        if (round % kWindow != kWindow - 1) return false;
        const bool better = now_ < kProgress * before_ || closest_m_ > closest_before_m_ + kNearer_m;
        before_ = now_;
        closest_before_m_ = closest_m_;
        closest_m_ = 0.0;
        now_ = std::numeric_limits<double>::infinity();
        return !better;
    }

  private:
    double before_ = std::numeric_limits<double>::infinity(), now_ = before_, left_;
    double closest_before_m_ = 0.0, closest_m_ = 0.0;
};

class Projection {
  public:
    Projection(const Lattice& input, const ProjectionTask& task, const Run& run)
        : input_(input), task_(task), run_(run), fleet_(input, task), aim_m_(kAim * task.required_m) {}

    Result<Projected> project() {
        bool listed = fleet_.list_pairs(kTailAim * task_.required_m, kSlack * task_.required_m, run_);
        Patience patience(task_.most_work * static_cast<double>(std::max(input_.drones, kFewDrones)));
        for (int round = 0;; ++round) {
            if (run_.stopped()) return stopped_error();
            if (!listed) return given_up(round);
            const auto close = fleet_.push_pairs(aim_m_, task_.required_m, run_);
            const double lacking_m = fleet_.push_airspace(run_);
            held_.limits_held = fleet_.motion_ratio() <= kLimitsHeld;
            held_.airspace_held = lacking_m <= kClear_m;
            const bool clear = close.closest_m >= task_.required_m && held_.airspace_held &&
                               fleet_.band_excess_m() <= (round == 0 ? 0.0 : kInBand_m);
            if (clear) limits_until_ = std::min(limits_until_, round + kForLimits);
            const bool limits_wanted = round < limits_until_;
            if (clear && (held_.limits_held || !limits_wanted)) {
                auto projected = judged(round);
                if (!projected || projected->separated) return projected;
                aim_m_ += 0.5 * (task_.required_m - projected->lower_bound_m) + 1e-4;
                patience.encourage();
            }
            if (round >= task_.max_rounds || patience.gone(close, lacking_m + fleet_.band_excess_m(), round)) {
                return given_up(round);
            }
            report(close);
            if (round >= kWindow && close.closest_m > 0.95 * task_.required_m) {
                aim_m_ = std::max(aim_m_, std::min(kTailGrowth * aim_m_, kTailAim * task_.required_m));
            }
            if (round == 0 && close.closest_m < task_.required_m) {
                fleet_.nudge_close(task_.seed, kNoise_m, run_);
            } else {
                patience.spend(fleet_.advance(kGain, limits_wanted, run_));
            }
            listed = fleet_.refresh_pairs(run_);
            patience.spend(fleet_.listed());
        }
    }

  private:
    /// The motion as it is, with its bound.
    Result<Projected> judged(int round) {
        Projected projected = held_;
        projected.lattice = round == 0 ? input_ : fleet_.lattice_in_band();
        projected.rounds = round;
        auto bound = bound_separation(projected.lattice, 1.0, task_.metric, 2.0 * task_.required_m, run_);
        if (!bound) return bound.error();
        projected.lower_bound_m = bound->lower_bound_m;
        projected.closest = bound->closest;
        projected.separated = keeps(*bound, task_.required_m);
        return projected;
    }

    Result<Projected> given_up(int round) {
        if (run_.stopped()) return stopped_error();
        if (fleet_.crowded()) {
            Projected projected = held_;
            projected.lattice = fleet_.lattice_in_band();
            projected.rounds = round;
            projected.closest = fleet_.encounter(fleet_.push_pairs(aim_m_, task_.required_m, run_));
            projected.stuck = fleet_.close();
            projected.stuck.resize(std::min(projected.stuck.size(), kMostStuck * input_.drones));
            return projected;
        }
        auto projected = judged(std::max(round, 1));
        if (!projected) return projected.error();
        projected->rounds = round;
        projected->stuck = fleet_.close();
        projected->stuck.resize(std::min(projected->stuck.size(), kMostStuck * input_.drones));
        return projected;
    }

    void report(const FleetState::Closeness& close) {
        first_shortfall_m_ = std::max(first_shortfall_m_, close.shortfall_m);
        run_.report("separate", first_shortfall_m_ > 0.0 ? 1.0 - close.shortfall_m / first_shortfall_m_ : 1.0);
    }

    const Lattice& input_;
    const ProjectionTask& task_;
    const Run& run_;
    FleetState fleet_;
    double aim_m_, first_shortfall_m_ = 0.0;
    int limits_until_ = kMostForLimits;  ///< round until when limits are pushed: then separation alone counts
    Projected held_;                     ///< which constraints hold at present
};

}  // namespace

Result<Projected> project_separation(const Lattice& input, const ProjectionTask& task, const Run& run) {
    AEROGRAM_REQUIRE(input.drones > 0 && input.rows() >= 9 && task.required_m > 0.0 && task.samples_per_interval >= 1,
                     input.drones, input.rows(), task.required_m, task.samples_per_interval);
    const auto spread =
        task.held_knots.empty() ? spread_waist(input, task.required_m, task.metric, task.seed) : std::nullopt;
    return Projection(spread ? *spread : input, task, run).project();
}

}  // namespace aerogram::planner
