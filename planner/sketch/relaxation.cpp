#include "planner/sketch/relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"
#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

constexpr double kReach = 2.5;   ///< spacings; who is farther away is no neighbour
constexpr double kStill = 1e-6;  ///< spacings
constexpr double kStep = 0.25;   ///< spacings, at most, a round

class Relaxer {
  public:
    Relaxer(std::vector<Vec2> points, std::size_t fixed, const GaussianRelaxation& how)
        : points_(std::move(points)), fixed_(fixed), how_(how), spacing_(points_.size(), how.spacing) {}

    std::vector<Vec2> run() {
        for (std::size_t round = 0; round < how_.rounds && fixed_ < points_.size(); ++round) {
            double widest = how_.spacing;
            if (how_.spacing_at) {
                widest = 0.0;
                for (std::size_t i = 0; i < points_.size(); ++i) {
                    spacing_[i] = how_.spacing_at(points_[i]);
                    widest = std::max(widest, spacing_[i]);
                }
            }
            const SiteGrid grid(points_, kReach * widest);
            next_ = points_;
            bool moved = false;
            for (std::size_t i = fixed_; i < points_.size(); ++i) moved = move(i, grid) || moved;
            points_.swap(next_);
            if (!moved) break;
        }
        return std::move(points_);
    }

  private:
    [[nodiscard]] double weight(std::size_t i) const { return how_.weights.empty() ? 1.0 : how_.weights[i]; }

    /// Whether it is by more than next to nothing.
    bool move(std::size_t i, const SiteGrid& grid) {
        const Vec2 here = points_[i];
        Vec2 v{};
        double neighbours = 0.0;
        grid.near(here, 1, [&](std::size_t j, const Vec2& there) {
            const Vec2 d = here - there;
            const double spacing = 0.5 * (spacing_[i] + spacing_[j]);
            const double squared = glm::dot(d, d) / (spacing * spacing);
            if (j == i || squared > kReach * kReach) return;
            v += weight(j) * std::exp(-how_.beta * squared) * d;
            neighbours += 1.0;
        });
        if (neighbours == 0.0) return false;
        Vec2 step = (how_.speed * weight(i) / neighbours) * v;
        const double length = glm::length(step), longest = kStep * spacing_[i];
        if (length > longest) step *= longest / length;
        for (int tries = 0; tries < 3; ++tries, step *= 0.5) {
            if (how_.inside && !how_.inside(here + step)) continue;
            next_[i] = here + step;
            return glm::length(step) > kStill * spacing_[i];
        }
        return false;
    }

    std::vector<Vec2> points_, next_;
    std::size_t fixed_;
    const GaussianRelaxation& how_;
    std::vector<double> spacing_;  ///< by point, this round
};

}  // namespace

std::vector<Vec2> relaxed(std::vector<Vec2> points, std::size_t fixed, const GaussianRelaxation& how) {
    AEROGRAM_REQUIRE(fixed <= points.size() && how.beta > 0.0 && how.spacing > 0.0, fixed, how.beta, how.spacing);
    AEROGRAM_REQUIRE(how.weights.empty() || how.weights.size() == points.size(), how.weights.size());
    return Relaxer(std::move(points), fixed, how).run();
}

}  // namespace aerogram::planner
