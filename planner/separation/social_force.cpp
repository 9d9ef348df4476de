#include "planner/separation/social_force.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geo/contract.hpp"
#include "geo/random.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/neighbours.hpp"

namespace aerogram::planner {
namespace {

// Helbing and Molnár 1995, in the metres and seconds of pedestrians.
constexpr double kWidth = 0.6;           ///< of a person; here the required separation
constexpr double kWalk = 1.34;           ///< wished speed, m/s; here the fleet's fastest mean speed
constexpr double kMostSpeed = 1.3;       ///< of one's own wished speed
constexpr double kRelaxation = 0.5;      ///< tau, s
constexpr double kPotential = 2.1;       ///< V0, m²/s²
constexpr double kRange = 0.3;           ///< sigma, m
constexpr double kAhead = 0.5;           ///< of the other's relative motion that counts as taken, s (Johansson 2007)
constexpr double kReach = 5.0 * kRange;  ///< beyond, a hundredth of the force is left
constexpr double kFluctuation = 0.05;    ///< m/s²
constexpr double kStep = 0.1;            ///< s, at most
constexpr int kSmoothings = 3;           ///< of (1, 2, 1)/4
constexpr double kBlend = 0.12;          ///< share of the act at its end over which deviations are led back

/// One simulation of the whole act, in pedestrian units and the metric's space.
class Crowd {
  public:
    Crowd(const Lattice& reference, const SocialForceTask& task, double strength)
        : n_(reference.drones), knots_(reference.rows() - 2), strength_(strength), metric_(task.metric) {
        to_units_ = kWidth / task.required_m;
        reference_.resize(knots_ * n_);
        for (std::size_t m = 0; m < knots_; ++m) {
            for (std::size_t i = 0; i < n_; ++i) {
                const Vec3 p = knot_value(reference.at(m, i), reference.at(m + 1, i), reference.at(m + 2, i));
                reference_[m * n_ + i] = to_units_ * metric_.scaled(p);
            }
        }
        double fastest = 0.0;  // mean way in one knot interval
        for (std::size_t m = 0; m + 1 < knots_; ++m) {
            double way = 0.0;
            for (std::size_t i = 0; i < n_; ++i) way += glm::distance(ref(m, i), ref(m + 1, i));
            fastest = std::max(fastest, way / static_cast<double>(n_));
        }
        knot_time_ = std::max(fastest / kWalk, 1e-3);
        Random random(task.seed);
        fluctuation_.resize(n_);
        for (Vec3& f : fluctuation_) {
            f = {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
            f *= kFluctuation;
        }
        at_.assign(reference_.begin(), reference_.begin() + static_cast<std::ptrdiff_t>(n_));
        speed_.assign(n_, Vec3{});
        force_.resize(n_);
        ahead_.resize(n_);
    }

    /// What the forces move each drone at each knot, metres; zero at both ends. Nothing when stopped.
    std::optional<Points> deviations(const Run& run) {
        Points out(knots_ * n_, Vec3{});
        const int steps = std::max(1, static_cast<int>(std::ceil(knot_time_ / kStep)));
        for (std::size_t m = 1; m < knots_; ++m) {
            for (int step = 0; step < steps; ++step) {
                if (run.stopped()) return std::nullopt;
                const double knot = static_cast<double>(m - 1) + static_cast<double>(step) / steps;
                advance(knot, knot_time_ / steps);
            }
            const double left = static_cast<double>(knots_ - 1 - m) / (kBlend * static_cast<double>(knots_ - 1));
            const double u = std::min(1.0, left), keep = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
            for (std::size_t i = 0; i < n_; ++i) {
                const Vec3 moved = (keep / to_units_) * (at_[i] - ref(m, i));
                out[m * n_ + i] = {moved.x, moved.y, moved.z * metric_.downwash};
            }
        }
        return out;
    }

  private:
    const Vec3& ref(std::size_t knot, std::size_t i) const { return reference_[knot * n_ + i]; }

    /// The reference between knots, standing at its end afterwards.
    Vec3 reference_at(double knot, std::size_t i) const {
        const double clamped = std::min(knot, static_cast<double>(knots_ - 1));
        const std::size_t m = std::min(static_cast<std::size_t>(clamped), knots_ - 2);
        const double u = clamped - static_cast<double>(m);
        return (1.0 - u) * ref(m, i) + u * ref(m + 1, i);
    }

    void advance(double knot, double step) {
        drive(knot);
        repel();
        for (std::size_t i = 0; i < n_; ++i) {
            speed_[i] += step * force_[i];
            const double now = glm::length(speed_[i]), most = most_speed(i);
            if (now > most) speed_[i] *= most / now;
            at_[i] += step * speed_[i];
        }
    }

    /// Towards where the reference is one relaxation time later.
    void drive(double knot) {
        for (std::size_t i = 0; i < n_; ++i) {
            ahead_[i] = (reference_at(knot + kRelaxation / knot_time_, i) - at_[i]) / kRelaxation;
            force_[i] = (ahead_[i] - speed_[i]) / kRelaxation + fluctuation_[i];
        }
    }
    double most_speed(std::size_t i) const { return kMostSpeed * std::max(kWalk, glm::length(ahead_[i])); }

    void repel() {
        double fastest = 0.0;
        for (const Vec3& v : speed_) fastest = std::max(fastest, glm::length(v));
        const double reach = kReach + std::min(kAhead * fastest, kReach);
        NeighbourGrid(at_, reach).for_each_pair([&](std::size_t i, std::size_t j) {
            const Vec3 apart = at_[i] - at_[j];
            if (glm::dot(apart, apart) > reach * reach) return;
            const Vec3 force = strength_ * repulsion(apart, kAhead * (speed_[j] - speed_[i]));
            force_[i] += force;
            force_[j] -= force;
        });
    }

    /// -grad of V0 exp(-b / sigma), b the half minor axis of the ellipse with foci 0 and `taken` through `apart`.
    static Vec3 repulsion(const Vec3& apart, const Vec3& taken) {
        const Vec3 later = apart - taken;
        const double near = std::max(glm::length(apart), 1e-6), far = std::max(glm::length(later), 1e-6);
        const double sum = near + far, squared = sum * sum - glm::dot(taken, taken);
        const double b = std::max(0.5 * std::sqrt(std::max(squared, 0.0)), 0.1 * kRange);
        if (b > kReach) return Vec3{};
        return (kPotential / kRange * std::exp(-b / kRange) * sum / (4.0 * b)) * (apart / near + later / far);
    }

    std::size_t n_, knots_;
    double strength_, to_units_ = 1.0, knot_time_ = 1.0;
    SeparationMetric metric_;
    Points reference_, at_, speed_, force_, ahead_, fluctuation_;
};

void smooth(Points& deviations, std::size_t drones) {
    const std::size_t knots = deviations.size() / drones;
    for (int pass = 0; pass < kSmoothings; ++pass) {
        const Points before = deviations;
        for (std::size_t p = drones; p < (knots - 1) * drones; ++p) {
            deviations[p] = 0.25 * (before[p - drones] + 2.0 * before[p] + before[p + drones]);
        }
    }
}

/// The reference with the deviations added; rows that may move are kept in the band as far as they were in it.
Lattice moved(const Lattice& reference, const Points& deviations, const SocialForceTask& task) {
    Lattice out = lattice_through(deviations, reference.drones);
    for (std::size_t p = 0; p < out.points_m.size(); ++p) {
        const Vec3& was = reference.points_m[p];
        Vec3& now = out.points_m[p];
        now += was;
        now.z = std::clamp(now.z, std::min(task.floor_z_m, was.z), std::max(task.ceiling_z_m, was.z));
    }
    return out;
}

bool in_band(const Lattice& lattice, const SocialForceTask& task) {
    const auto begin = lattice.points_m.begin() + static_cast<std::ptrdiff_t>(3 * lattice.drones);
    const auto end = lattice.points_m.end() - static_cast<std::ptrdiff_t>(3 * lattice.drones);
    return std::all_of(begin, end, [&](const Vec3& p) { return p.z >= task.floor_z_m && p.z <= task.ceiling_z_m; });
}

Result<Projected> judged(Lattice lattice, int rounds, const SocialForceTask& task, const Run& run) {
    auto bound = bound_separation(lattice, 1.0, task.metric, 2.0 * task.required_m, run);
    if (!bound) return bound.error();
    Projected out;
    out.rounds = rounds;
    out.lower_bound_m = bound->lower_bound_m;
    out.separated = keeps(*bound, task.required_m) && in_band(lattice, task);
    out.closest = bound->closest;
    out.lattice = std::move(lattice);
    return out;
}

}  // namespace

Result<Projected> ease_by_social_forces(const Lattice& reference, const SocialForceTask& task, const Run& run) {
    AEROGRAM_REQUIRE(reference.drones > 0 && reference.rows() >= 9 && task.required_m > 0.0, reference.drones,
                     reference.rows(), task.required_m);
    auto best = judged(reference, 0, task, run);
    double strength = 1.0;
    for (int round = 1; best.ok() && !best->separated && round <= task.max_rounds; ++round) {
        run.report("social forces", static_cast<double>(round - 1) / task.max_rounds);
        auto deviations = Crowd(reference, task, strength).deviations(run);
        if (!deviations) return stopped_error();
        smooth(*deviations, reference.drones);
        auto next = judged(moved(reference, *deviations, task), round, task, run);
        if (!next) return next.error();
        if (next->separated || next->lower_bound_m > best->lower_bound_m) best = std::move(next);
        best->rounds = round;
        strength *= 2.0;
    }
    return best;
}

}  // namespace aerogram::planner
