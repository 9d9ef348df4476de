#include <algorithm>
#include <cmath>
#include <limits>

#include "export/report/pair_grid.hpp"
#include "export/report/parts.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::size_t kBars = 41;                      ///< of the histogram: 0 to 10 m, and beyond
constexpr std::size_t kMostDroneInstants = 3'000'000;  ///< of the histogram
constexpr std::size_t kInstantsATask = 16;

class Instant {
  public:
    explicit Instant(const Survey& all) : all_(all) {}

    void go_to(double t_s) {
        const std::size_t n = all_.drones.size();
        movers_.resize(n);
        stance_.resize(n);
        for (std::size_t d = 0; d < n; ++d) {
            const Vec3 at = all_.place_at(d, t_s);
            movers_[d] = {at, at, t_s, t_s, static_cast<std::uint32_t>(d)};
            stance_[d] = all_.stance(d, t_s);
        }
    }
    [[nodiscard]] double distance(std::size_t i, std::size_t j) const {
        return glm::length(movers_[i].from - movers_[j].from);
    }
    /// Whether the pair counts: one at least is in the air, and they are not excused.
    [[nodiscard]] bool counts(std::size_t i, std::size_t j) const {
        return !all_.excuses(i, stance_[i], j, stance_[j]);
    }
    [[nodiscard]] bool in_air(std::size_t d) const { return stance_[d] != Stance::on_pad; }

    /// Distance of the closest pair that counts; infinite when none does.
    [[nodiscard]] double closest() {
        double reach_m = kInfinite;
        for (std::size_t d = 0; d + 1 < movers_.size(); ++d) {
            if (distance(d, d + 1) < reach_m && counts(d, d + 1)) reach_m = distance(d, d + 1);
        }
        if (reach_m == kInfinite) reach_m = any_pair();
        double closest_m = reach_m;
        if (closest_m == kInfinite) return closest_m;
        grid_.search(movers_, reach_m, [&](std::size_t i, std::size_t j) {
            const double there_m = distance(i, j);
            if (there_m < closest_m && counts(i, j)) closest_m = there_m;
            return closest_m;
        });
        return closest_m;
    }

    /// Adds those in the air to the bar of their nearest that counts. Wider and wider, as long as many have found none
    /// within reach, so that dense fleets do not compare all within the last bar.
    void count(double step_m, std::vector<std::size_t>& bars) {
        const double last_m = step_m * static_cast<double>(bars.size() - 1);
        nearest_.assign(movers_.size(), kInfinite);
        std::vector<std::size_t> open;
        for (double reach_m = 0.25 * last_m; reach_m <= last_m; reach_m *= 2.0) {
            note_within(reach_m);
            open.clear();
            for (std::size_t d = 0; d < movers_.size(); ++d) {
                if (in_air(d) && nearest_[d] == kInfinite) open.push_back(d);
            }
            if (open.size() <= movers_.size() / 20) break;
        }
        for (const std::size_t d : open) {
            for (std::size_t j = 0; j < movers_.size(); ++j) {
                if (j != d && distance(d, j) < nearest_[d] && counts(d, j)) nearest_[d] = distance(d, j);
            }
        }
        for (std::size_t d = 0; d < movers_.size(); ++d) {
            if (in_air(d)) ++bars[static_cast<std::size_t>(std::min(nearest_[d], last_m) / step_m)];
        }
    }

  private:
    void note_within(double reach_m) {
        grid_.search(movers_, reach_m, [&](std::size_t i, std::size_t j) {
            const double there_m = distance(i, j);
            if (there_m <= reach_m && (there_m < nearest_[i] || there_m < nearest_[j]) && counts(i, j)) {
                nearest_[i] = std::min(nearest_[i], there_m);
                nearest_[j] = std::min(nearest_[j], there_m);
            }
            return reach_m;
        });
    }
    /// Some pair that counts, where neighbours in the list do not: early and late, when few are in the air.
    [[nodiscard]] double any_pair() const {
        double closest_m = kInfinite;
        for (std::size_t i = 0; i < movers_.size(); ++i) {
            if (stance_[i] == Stance::on_pad) continue;
            for (std::size_t j = 0; j < movers_.size(); ++j) {
                if (j != i && counts(i, j)) closest_m = std::min(closest_m, distance(i, j));
            }
            if (closest_m < kInfinite) break;
        }
        return closest_m;
    }

    const Survey& all_;
    std::vector<Mover> movers_;
    std::vector<Stance> stance_;
    std::vector<double> nearest_;
    PairGrid grid_;
};

}  // namespace

void report_nearest(const Survey& all, const Run& run, Report& report) {
    const std::size_t instants = report.times_s.size(), n = all.drones.size();
    report.nearest_m.assign(instants, kInfinite);
    const std::size_t every = std::max<std::size_t>(1, n * instants / kMostDroneInstants);
    std::vector<std::vector<std::size_t>> bars((instants + kInstantsATask - 1) / kInstantsATask);
    parallel_for(bars.size(), run, "measuring the nearest", [&](std::size_t task) {
        Instant instant(all);
        bars[task].assign(kBars, 0);
        for (std::size_t k = task * kInstantsATask; k < std::min(instants, (task + 1) * kInstantsATask); ++k) {
            instant.go_to(report.times_s[k]);
            report.nearest_m[k] = n > 1 ? instant.closest() : kInfinite;
            if (k % every == 0) instant.count(report.histogram_step_m, bars[task]);
        }
    });
    report.histogram.assign(kBars, 0);
    for (const auto& part : bars) {
        for (std::size_t b = 0; b < part.size(); ++b) report.histogram[b] += part[b];
    }
}

}  // namespace aerogram::exporter
