#include "planner/separation/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geo/contract.hpp"
#include "geo/random.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/neighbours.hpp"
#include "planner/separation/smoother.hpp"

namespace aerogram::planner {
namespace {

constexpr double kAim = 1.01;      ///< aiming at the requirement itself never quite gets there (DESIGN.md 8)
constexpr double kGain = 2.0;      ///< 1 takes twice the rounds, 3 overshoots
constexpr double kNoise_m = 0.05;  ///< smooth, seeded: breaks head-on symmetry
constexpr double kSkin_m = 1.0;    ///< pair lists serve until a drone has moved half of this

struct Pair {
    std::uint32_t i = 0, j = 0;
};

/// A pair's closest approach on the chord between two sample rows.
struct Approach {
    double distance_m = 0.0, share = 0.0;
    Vec3 direction{};  ///< from i to j, in the metric's space; not unit
};

Approach approach(const Vec3& before, const Vec3& after) {
    const Vec3 way = after - before;
    const double squared = glm::dot(way, way);
    const double w = squared > 0.0 ? std::clamp(-glm::dot(before, way) / squared, 0.0, 1.0) : 0.0;
    const Vec3 nearest = before + w * way;
    return {glm::length(nearest), w, nearest};
}

class Projector {
  public:
    Projector(const Lattice& input, const ProjectionTask& task)
        : task_(task), n_(input.drones), rows_(input.rows()), lattice_(input), aim_m_(kAim * task.required_m) {
        const std::size_t samples = task.samples_per_interval * (rows_ - 3) + 1;
        samples_.resize(samples * n_);
        corrections_.resize(rows_ * n_);
        pairs_.resize(samples - 1);
        std::vector<bool> fixed(rows_, false);
        for (std::size_t k = 0; k < 3; ++k) fixed[k] = fixed[rows_ - 1 - k] = true;
        banded_ = std::vector<bool>(rows_);
        for (std::size_t k = 0; k < rows_; ++k) banded_[k] = !fixed[k];
        for (const std::size_t knot : task.held_knots) {
            AEROGRAM_REQUIRE(knot >= 3 && knot + 6 <= rows_, knot, rows_);
            for (std::size_t k = knot; k < knot + 3; ++k) banded_[k] = false;
        }
        const double width = task.smoothing_knots > 0.0 ? task.smoothing_knots : static_cast<double>(rows_) / 17.0;
        smoother_.emplace(fixed, std::pow(width, 4), task.held_knots);
        fixed_ = std::move(fixed);
    }

    Result<Projected> run(const Run& run) {
        evaluate();
        break_symmetry();
        for (int round = 0; round < task_.max_rounds; ++round) {
            if (run.stopped()) return stopped_error();
            evaluate();
            const double closest_m = collect();
            if (closest_m >= task_.required_m && in_band()) {
                auto bound = bound_separation(lattice_, 1.0, task_.metric, 2.0 * task_.required_m, run);
                if (!bound) return bound.error();
                if (keeps(*bound, task_.required_m)) return Projected{lattice_, round, bound->lower_bound_m, true};
                aim_m_ += 0.5 * (task_.required_m - bound->lower_bound_m) + 1e-4;
            }
            push_into_band();
            smoother_->apply(corrections_);
            for (std::size_t p = 0; p < corrections_.size(); ++p) lattice_.points_m[p] += kGain * corrections_[p];
            keep_in_band();
        }
        auto bound = bound_separation(lattice_, 1.0, task_.metric, 2.0 * task_.required_m, run);
        if (!bound) return bound.error();
        return Projected{lattice_, task_.max_rounds, bound->lower_bound_m,
                         keeps(*bound, task_.required_m) && in_band()};
    }

    /// Whether all rows that may move are within the band.
    bool in_band() const {
        for (std::size_t k = 0; k < rows_; ++k) {
            if (!banded_[k]) continue;
            for (std::size_t i = 0; i < n_; ++i) {
                const double z = lattice_.at(k, i).z;
                if (z < task_.floor_z_m || z > task_.ceiling_z_m) return false;
            }
        }
        return true;
    }

  private:
    std::size_t sample_rows() const { return samples_.size() / n_; }
    const Vec3& sample(std::size_t row, std::size_t i) const { return samples_[row * n_ + i]; }

    /// Weights of the four rows that carry a sample row, and the first of them.
    struct Carrier {
        std::size_t row = 0;
        std::array<double, 4> weight{};
    };
    Carrier carrier(std::size_t sample_row) const {
        const std::size_t per = task_.samples_per_interval;
        const std::size_t interval = std::min(sample_row / per, rows_ - 4);
        const double u = static_cast<double>(sample_row - interval * per) / static_cast<double>(per), v = 1.0 - u;
        return {interval,
                {v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
                 (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0, u * u * u / 6.0}};
    }

    /// Sample rows of the curve, in the metric's space.
    void evaluate() {
        double moved_squared = 0.0;
        for (std::size_t s = 0; s < sample_rows(); ++s) {
            const Carrier c = carrier(s);
            for (std::size_t i = 0; i < n_; ++i) {
                Vec3 p{};
                for (std::size_t m = 0; m < 4; ++m) p += c.weight[m] * lattice_.at(c.row + m, i);
                samples_[s * n_ + i] = task_.metric.scaled(p);
            }
        }
        if (listed_at_.empty()) return list_pairs();
        for (std::size_t p = 0; p < samples_.size(); ++p) {
            const Vec3 moved = samples_[p] - listed_at_[p];
            moved_squared = std::max(moved_squared, glm::dot(moved, moved));
        }
        if (moved_squared > 0.25 * kSkin_m * kSkin_m) list_pairs();
    }

    /// Pairs whose chords are, or may soon be, closer than the aim.
    void list_pairs() {
        listed_at_ = samples_;
        const double reach = 1.1 * aim_m_ + kSkin_m;
        Points centers(n_);
        for (std::size_t s = 0; s + 1 < sample_rows(); ++s) {
            double longest = 0.0;
            Vec3 drift{};  // the fleet's common motion does not bring anybody closer
            for (std::size_t i = 0; i < n_; ++i) drift += (sample(s + 1, i) - sample(s, i)) / static_cast<double>(n_);
            for (std::size_t i = 0; i < n_; ++i) {
                centers[i] = 0.5 * (sample(s, i) + sample(s + 1, i));
                longest = std::max(longest, glm::length(sample(s + 1, i) - sample(s, i) - drift));
            }
            pairs_[s].clear();
            NeighbourGrid(centers, reach + longest).for_each_pair([&](std::size_t i, std::size_t j) {
                const Approach a = approach(sample(s, j) - sample(s, i), sample(s + 1, j) - sample(s + 1, i));
                if (a.distance_m < reach)
                    pairs_[s].push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
            });
        }
    }

    /// Drones that meet too close get a small sideways bump of their own, so that no two are exactly head-on.
    void break_symmetry() {
        std::vector<bool> meets(n_, false);
        for (std::size_t s = 0; s < pairs_.size(); ++s) {
            for (const Pair& pair : pairs_[s]) {
                const Approach a =
                    approach(sample(s, pair.j) - sample(s, pair.i), sample(s + 1, pair.j) - sample(s + 1, pair.i));
                if (a.distance_m < task_.required_m) meets[pair.i] = meets[pair.j] = true;
            }
        }
        Random random(task_.seed);
        for (std::size_t i = 0; i < n_; ++i) {
            Vec3 sideways{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
            if (!meets[i]) continue;
            sideways *= kNoise_m / std::max(0.1, glm::length(sideways));
            for (std::size_t k = 3; k + 3 < rows_; ++k) {
                const double u = static_cast<double>(k - 2) / static_cast<double>(rows_ - 5);
                corrections_[k * n_ + i] = 16.0 * u * u * (1.0 - u) * (1.0 - u) * sideways;
            }
        }
        smoother_->apply(corrections_);
        for (std::size_t p = 0; p < corrections_.size(); ++p) lattice_.points_m[p] += corrections_[p];
    }

    /// Fills corrections_ with Bᵀ of what would push each too close pair to the aim; returns the smallest chord
    /// distance.
    double collect() {
        std::fill(corrections_.begin(), corrections_.end(), Vec3{});
        double closest_m = std::numeric_limits<double>::infinity();
        for (std::size_t s = 0; s < pairs_.size(); ++s) {
            const Carrier before = carrier(s), after = carrier(s + 1);
            for (const Pair& pair : pairs_[s]) {
                const Approach a =
                    approach(sample(s, pair.j) - sample(s, pair.i), sample(s + 1, pair.j) - sample(s + 1, pair.i));
                closest_m = std::min(closest_m, a.distance_m);
                if (a.distance_m >= aim_m_) continue;
                const Vec3 c = 0.5 * separating_move(a);
                spread(before, pair, (1.0 - a.share) * c);
                spread(after, pair, a.share * c);
            }
        }
        return closest_m;
    }

    /// The shortest displacement of j relative to i that brings the approach to the aim: along the distance's gradient.
    Vec3 separating_move(const Approach& a) const {
        const Vec3 unit = a.distance_m > 1e-9 ? a.direction / a.distance_m : Vec3{0.0, 0.0, 1.0};
        const Vec3 gradient = task_.metric.scaled(unit);
        return gradient * ((aim_m_ - a.distance_m) / glm::dot(gradient, gradient));
    }

    void spread(const Carrier& carrier, const Pair& pair, const Vec3& move) {
        const double share = 1.0 / static_cast<double>(task_.samples_per_interval);
        for (std::size_t m = 0; m < 4; ++m) {
            corrections_[(carrier.row + m) * n_ + pair.i] -= carrier.weight[m] * share * move;
            corrections_[(carrier.row + m) * n_ + pair.j] += carrier.weight[m] * share * move;
        }
    }

    void push_into_band() {
        for (std::size_t p = 0; p < corrections_.size(); ++p) {
            const double z = lattice_.points_m[p].z;
            if (z < task_.floor_z_m) corrections_[p].z += task_.floor_z_m - z;
            if (z > task_.ceiling_z_m) corrections_[p].z += task_.ceiling_z_m - z;
        }
    }

    void keep_in_band() {
        for (std::size_t k = 0; k < rows_; ++k) {
            if (!banded_[k]) continue;
            for (std::size_t i = 0; i < n_; ++i) {
                double& z = lattice_.at(k, i).z;
                z = std::clamp(z, task_.floor_z_m, task_.ceiling_z_m);
            }
        }
    }

    const ProjectionTask& task_;
    std::size_t n_, rows_;
    Lattice lattice_;
    double aim_m_;
    std::vector<bool> fixed_, banded_;  ///< rows that never move; rows that the band binds
    std::optional<SobolevSmoother> smoother_;
    Points samples_, listed_at_, corrections_;
    std::vector<std::vector<Pair>> pairs_;  ///< by chord
};

}  // namespace

Result<Projected> project_separation(const Lattice& input, const ProjectionTask& task, const Run& run) {
    AEROGRAM_REQUIRE(input.drones > 0 && input.rows() >= 9 && task.required_m > 0.0 && task.samples_per_interval >= 1,
                     input.drones, input.rows(), task.required_m, task.samples_per_interval);
    auto bound = bound_separation(input, 1.0, task.metric, 2.0 * task.required_m, run);
    if (!bound) return bound.error();
    Projector projector(input, task);
    if (keeps(*bound, task.required_m) && projector.in_band()) return Projected{input, 0, bound->lower_bound_m, true};
    return projector.run(run);
}

}  // namespace aerogram::planner
