#include "export/skybrush/skyc_trajectory.hpp"

#include "export/bytes/decimal.hpp"
#include "export/skybrush/misfit.hpp"
#include "export/skybrush/skybrush_frame.hpp"

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

}  // namespace

std::string skyc_misfit(const OutgoingShow& show) {
    const FitError bound = fit_bound(show.facts().limits);
    if (bound.position_m <= 0.0) return "export_margin_m leaves no room for millimetres; 0.01 would do";
    for (std::size_t i = 0; i < show.drones(); ++i) {
        const FitError error = show.fitted(i).error;
        if (!error.within(bound)) return misfit_text(show.facts().drones[i].name, error, bound);
    }
    return {};
}

Result<std::vector<std::string>> skyc_trajectories(const OutgoingShow& show, std::size_t first, std::size_t end,
                                                   const Run& run) {
    const FitError bound = fit_bound(show.facts().limits);
    std::vector<std::string> texts(end - first), misfits(end - first);
    parallel_for(texts.size(), run, "skyc", [&](std::size_t k) {
        const Fitted fitted = show.fitted(first + k);
        if (!fitted.error.within(bound))
            misfits[k] = misfit_text(show.facts().drones[first + k].name, fitted.error, bound);
        TrajectoryText text(fitted.pieces.front().controls_m.front());
        for (const FittedPiece& piece : fitted.pieces) text.add(piece);
        texts[k] = std::move(text).finished(show.facts().duration_ms);
    });
    if (run.stopped()) return stopped_error();
    for (const std::string& misfit : misfits)
        if (!misfit.empty()) return Error{ErrorCode::infeasible, "skyc: " + misfit};
    return texts;
}

}  // namespace aerogram::exporter
