// All transition methods on the same moves, each as it comes, after the projection and after social forces: the table
// of docs/transitions.md. Measures: DESIGN.md section 12.
#include <fstream>
#include <iomanip>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "planner/assignment/assignment.hpp"
#include "planner/motion/certificate.hpp"
#include "planner/motion/profile.hpp"
#include "planner/separation/projection.hpp"
#include "planner/separation/social_force.hpp"
#include "planner/transition/rigid.hpp"
#include "planner/transition/spectral.hpp"
#include "tests/bench/study/study.hpp"
#include "tests/unit/planner/transition/moving_bodies.hpp"
#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::study {
namespace {

using namespace planner;

constexpr std::size_t kRows = 63;
constexpr double kShare = 0.95;  ///< of the formation's spacing, asked of projection and social forces

struct Measures {
    double path = 0.0, distortion = 0.0, separation = 0.0, jerk = 0.0;
};

/// T to H, everybody to the nearest free place by the optimal matching.
bodies::Move matched_letters(std::size_t n) {
    bodies::Move out;
    out.from_m = planner::testing::letter_t(n);
    Points slots_m = planner::testing::letter_h(n);
    for (Points* points : {&out.from_m, &slots_m}) {
        const double scale = bodies::kSpacing_m / bodies::smallest_distance_m(*points);
        for (Vec3& p : *points) p = scale * p + Vec3{0.0, 0.0, 60.0};
    }
    const Assignment matching = assign_shortest(out.from_m, slots_m, {}, SeparationMetric{}, Run{}).value();
    for (const SlotId slot : matching.slot_of) out.to_m.push_back(slots_m[slot.value]);
    out.body.assign(n, 0);
    return out;
}

Lattice flown(const Interpolation& path, std::size_t n) {
    const std::size_t knots = kRows - 2;
    Points samples_m(knots * n);
    for (std::size_t m = 0; m < knots; ++m) {
        const double u = static_cast<double>(m) / static_cast<double>(knots - 1);
        path(profile_value(ProfileKind::minimum_jerk, u), std::span(samples_m).subspan(m * n, n));
    }
    return lattice_through(samples_m, n);
}

/// ∫|jerk|² T⁵ / L² of the whole fleet, L straight: 720 for straight minimum-jerk flights.
double dimensionless_jerk(const Lattice& lattice, const bodies::Move& move) {
    const auto intervals = static_cast<double>(lattice.rows() - 3);
    double jerk = 0.0, straight = 0.0;
    for (std::size_t i = 0; i < lattice.drones; ++i) {
        for (std::size_t k = 0; k + 3 < lattice.rows(); ++k) {
            const Vec3 third =
                lattice.at(k + 3, i) - 3.0 * lattice.at(k + 2, i) + 3.0 * lattice.at(k + 1, i) - lattice.at(k, i);
            jerk += glm::dot(third, third);
        }
        const Vec3 way = move.to_m[i] - move.from_m[i];
        straight += glm::dot(way, way);
    }
    return jerk * std::pow(intervals, 5) / straight;
}

/// The share of time at which the profile has come this far.
double time_of(double share) {
    double low = 0.0, high = 1.0;
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        (profile_value(ProfileKind::minimum_jerk, middle) < share ? low : high) = middle;
    }
    return share >= 1.0 ? 1.0 : low;
}

Measures measured(const Lattice& lattice, const bodies::Move& move) {
    const Act act{"", ActRole::transit, Timing::free, 0, 60'000, lattice};
    const bodies::Quality quality =
        bodies::quality(move, [&](double share, std::span<Vec3> out) { positions(act, 60.0 * time_of(share), out); });
    const double spacing_m = std::min(bodies::smallest_distance_m(move.from_m), bodies::smallest_distance_m(move.to_m));
    const auto bound = bound_separation(lattice, 60.0, SeparationMetric{}, 2.0 * spacing_m, Run{});
    return {quality.path_ratio, quality.distortion, bound->lower_bound_m / spacing_m,
            dimensionless_jerk(lattice, move)};
}

Lattice separated(const std::string& how, const Lattice& raw, double required_m) {
    if (how == "projection") {
        ProjectionTask task;
        task.required_m = required_m;
        task.samples_per_interval = 2;
        return std::move(project_separation(raw, task, Run{})).value().lattice;
    }
    if (how == "social_force") {
        SocialForceTask task;
        task.required_m = required_m;
        return std::move(ease_by_social_forces(raw, task, Run{})).value().lattice;
    }
    return raw;
}

Interpolation transition(const std::string& method, const bodies::Move& move) {
    if (method == "spectral") {
        auto built = std::make_shared<SpectralTransition>(
            std::move(SpectralTransition::between(bodies::source(move), bodies::target(move), {}, Run{})).value());
        return Interpolation([built](double t, std::span<Vec3> out) { built->at(t, out); });
    }
    if (method == "rigid")
        return std::move(rigid_transition(bodies::source(move), bodies::target(move), Run{})).value();
    return Interpolation([move](double t, std::span<Vec3> out) {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = (1.0 - t) * move.from_m[i] + t * move.to_m[i];
    });
}

/// The bars that rigid has to pass.
void require_bars(const std::string& name, const Measures& rigid) {
    const bool ring = name.starts_with("ring");
    if ((ring || name == "swap") && rigid.distortion > 0.012) throw std::runtime_error(name + ": torn groups");
    if (ring && rigid.separation < 0.95) throw std::runtime_error(name + ": too close");
}

Json methods(const Arguments& arguments) {
    const auto seed = static_cast<std::uint64_t>(arguments.number("seed", 1.0));
    const std::vector<std::pair<std::string, bodies::Move>> moves{
        {"ring-1", bodies::ring_of_bodies(1, 1.0, seed)},
        {"ring-2", bodies::ring_of_bodies(2, 1.0, seed)},
        {"swap", bodies::swapping_bodies(1.0, seed)},
        {"shuffle", bodies::shuffled_places(seed)},
        {"letters", matched_letters(60)},
    };
    std::ostringstream table;
    table << "| move | method | separation | path ratio | edge distortion | separation / spacing | jerk |\n"
          << "|---|---|---|---|---|---|---|\n"
          << std::fixed;
    Json json;
    for (const auto& [name, move] : moves) {
        const double spacing_m =
            std::min(bodies::smallest_distance_m(move.from_m), bodies::smallest_distance_m(move.to_m));
        for (const std::string method : {"straight", "spectral", "rigid"}) {
            const Lattice raw = flown(transition(method, move), move.from_m.size());
            for (const std::string how : {"none", "projection", "social_force"}) {
                const Measures m = measured(separated(how, raw, kShare * spacing_m), move);
                if (method == "rigid" && how == "none") require_bars(name, m);
                table << "| " << name << " | " << method << " | " << how << " | " << std::setprecision(3) << m.path
                      << " | " << std::setprecision(2) << 100.0 * m.distortion << " % | " << m.separation << " | "
                      << std::setprecision(0) << m.jerk << " |\n";
                const std::string key = name + "_" + method + "_" + how;
                json.add(key + "_path", m.path).add(key + "_distortion", m.distortion);
                json.add(key + "_separation", m.separation).add(key + "_jerk", m.jerk);
            }
        }
    }
    const std::string file = arguments.option("markdown", "");
    if (!file.empty() && !(std::ofstream(file) << table.str())) throw std::runtime_error("cannot write " + file);
    return json;
}

const Study kMethods{"methods", "[--seed N] [--markdown FILE]", "--seed 1", methods};

}  // namespace
}  // namespace aerogram::study
