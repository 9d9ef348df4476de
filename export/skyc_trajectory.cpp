#include "export/skyc_trajectory.hpp"

#include <sstream>

#include "export/decimal.hpp"
#include "export/skybrush_frame.hpp"

namespace aerogram::exporter {
namespace {

/// The text of one trajectory, point by point.
class TrajectoryText {
  public:
    TrajectoryText(const Vec3& start_m) {
        text_ = R"({"version":1,"points":[[0,)";
        point(start_m);
        text_ += ",[]]";
    }

    void add(const FittedPiece& piece) {
        text_ += ",[";
        append_seconds(piece.start_ms + piece.duration_ms);
        text_ += ',';
        point(piece.controls_m[3]);
        text_ += ",[";
        if (!piece.stands) {
            point(piece.controls_m[1]);
            text_ += ',';
            point(piece.controls_m[2]);
        }
        text_ += "]]";
    }

    std::string finished(Millis landing_ms) && {
        text_ += R"(],"takeoffTime":0,"landingTime":)";
        append_seconds(landing_ms);
        text_ += "}\n";
        return std::move(text_);
    }

  private:
    void append_seconds(Millis time_ms) { append_units(text_, time_ms, 3); }

    void point(const Vec3& show_m) {
        const Vec3 p = to_skybrush(show_m);
        text_ += '[';
        append_fixed(text_, p.x, 3);
        text_ += ',';
        append_fixed(text_, p.y, 3);
        text_ += ',';
        append_fixed(text_, p.z, 3);
        text_ += ']';
    }

    std::string text_;
};

std::string misfit_text(std::size_t drone, const planner::Act& act, const FitError& error, const FitError& bound) {
    std::ostringstream text;
    text.precision(3);
    text << "drone " << drone + 1 << " in act \"" << act.name << "\": pieces of " << kShortestPieceMs
         << " ms miss the plan by " << error.position_m << " m, " << error.speed_mps << " m/s, "
         << error.acceleration_mps2 << " m/s²; within " << bound.position_m << " m, " << bound.speed_mps << " m/s, "
         << bound.acceleration_mps2 << " m/s² would do: a longer duration or a gentler profile helps";
    return text.str();
}

std::vector<ActFitter> fitters_of(const planner::FlightPlan& plan) {
    std::vector<ActFitter> fitters;
    for (const planner::Act& act : plan.acts) fitters.emplace_back(act, plan.limits);
    return fitters;
}

}  // namespace

std::string skyc_misfit(const planner::FlightPlan& plan) {
    const FitError bound = fit_bound(plan.limits);
    if (bound.position_m <= 0.0) return "export_margin_m leaves no room for millimetres; 0.01 would do";
    const std::vector<ActFitter> fitters = fitters_of(plan);
    for (std::size_t i = 0; i < plan.drones(); ++i) {
        for (std::size_t a = 0; a < fitters.size(); ++a) {
            const FitError error = fitters[a].fit(DroneId(i)).error;
            if (!error.within(bound)) return misfit_text(i, plan.acts[a], error, bound);
        }
    }
    return {};
}

Result<std::vector<std::string>> skyc_trajectories(const planner::FlightPlan& plan, std::size_t first, std::size_t end,
                                                   const Run& run) {
    const std::vector<ActFitter> fitters = fitters_of(plan);
    const FitError bound = fit_bound(plan.limits);
    std::vector<std::string> texts(end - first), misfits(end - first);
    parallel_for(texts.size(), run, "skyc", [&](std::size_t k) {
        const std::size_t i = first + k;
        const Vec3 start_m = planner::sample(plan, DroneId(i), 0.0).motion.position_m;
        TrajectoryText text(start_m);
        for (std::size_t a = 0; a < fitters.size(); ++a) {
            const Fitted fitted = fitters[a].fit(DroneId(i));
            if (misfits[k].empty() && !fitted.error.within(bound))
                misfits[k] = misfit_text(i, plan.acts[a], fitted.error, bound);
            for (const FittedPiece& piece : fitted.pieces) text.add(piece);
        }
        texts[k] = std::move(text).finished(plan.duration_ms());
    });
    if (run.stopped()) return stopped_error();
    for (const std::string& misfit : misfits)
        if (!misfit.empty()) return Error{ErrorCode::infeasible, "skyc: " + misfit};
    return texts;
}

}  // namespace aerogram::exporter
