#include "planner/hold_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/motion/profile.hpp"

namespace aerogram::planner {
namespace {

/// Knots a full turn: a cubic spline through the points of a circle so far apart is within 1e-5 of its radius.
constexpr double kKnotsPerTurn = 64.0;
constexpr std::size_t kLeastKnots = 33, kMostKnots = 2001;

bool stays(const std::vector<bool>& still, std::size_t i) {
    return !still.empty() && still[i];
}

Vec3 barycentre(const Points& points_m, const std::vector<bool>& still) {
    Vec3 sum{};
    double moving = 0.0;
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        if (stays(still, i)) continue;
        sum += points_m[i];
        moving += 1.0;
    }
    return moving > 0.0 ? sum / moving : sum;
}

/// A wave swells over this share of the hold and ebbs over as much.
constexpr double kSwell = 0.25;

/// How much of a wave is there at share u of the hold's time: 0 at both ends, 1 between.
double swell(double u) {
    const auto smooth = [](double v) { return profile_value(ProfileKind::minimum_jerk, std::clamp(v, 0.0, 1.0)); };
    return smooth(u / kSwell) * smooth((1.0 - u) / kSwell);
}

Vec3 wave_at(const Wave& wave, const Vec3& p, double u) {
    const double crests = glm::dot(p, glm::normalize(wave.direction)) / wave.length_m;
    return swell(u) * std::sin(2.0 * std::numbers::pi * (wave.cycles * u - crests)) * wave.amplitude_m;
}

/// The formation at share u of the hold's time.
void moved(const Points& formation_m, const Vec3& middle_m, const HoldMotion& motion, const std::vector<bool>& still,
           double u, Vec3* out) {
    const double s = profile_value(ProfileKind::minimum_jerk, u);
    const double c = std::cos(s * motion.spin_rad), d = std::sin(s * motion.spin_rad);
    const double size = 1.0 + s * (motion.scale - 1.0);
    for (std::size_t i = 0; i < formation_m.size(); ++i) {
        if (stays(still, i)) {
            out[i] = formation_m[i];
            continue;
        }
        const Vec3 arm = size * (formation_m[i] - middle_m);
        out[i] = middle_m + Vec3{c * arm.x - d * arm.y, d * arm.x + c * arm.y, arm.z} + s * motion.drift_m;
        if (motion.wave && u > 0.0 && u < 1.0) out[i] += wave_at(*motion.wave, formation_m[i], u);
    }
}

}  // namespace

Points after_hold(const Points& formation_m, const HoldMotion& motion, const std::vector<bool>& still) {
    Points out = formation_m;
    if (motion.displaces()) moved(formation_m, barycentre(formation_m, still), motion, still, 1.0, out.data());
    return out;
}

Lattice hold_lattice(const Points& formation_m, const HoldMotion& motion, const std::vector<bool>& still) {
    // The minimum-jerk clock runs at up to 15/8 of its mean speed: that many more knots.
    // A wave's swell and ebb are a quarter of the hold each: as bent as a turn.
    const double waves = motion.wave ? motion.wave->cycles + 1.0 : 0.0;
    const double turns = std::abs(motion.spin_rad) / (2.0 * std::numbers::pi) + waves;
    const auto knots = std::clamp(static_cast<std::size_t>(std::ceil(15.0 / 8.0 * kKnotsPerTurn * turns)) + 1,
                                  kLeastKnots, kMostKnots);
    const Vec3 middle_m = barycentre(formation_m, still);
    Points samples_m(knots * formation_m.size());
    for (std::size_t k = 0; k < knots; ++k) {
        const double u = static_cast<double>(k) / static_cast<double>(knots - 1);
        moved(formation_m, middle_m, motion, still, u, samples_m.data() + k * formation_m.size());
    }
    const Points end_m = after_hold(formation_m, motion, still);
    std::copy(formation_m.begin(), formation_m.end(), samples_m.begin());
    std::copy(end_m.begin(), end_m.end(), samples_m.end() - static_cast<std::ptrdiff_t>(end_m.size()));
    return lattice_through(samples_m, formation_m.size());
}

}  // namespace aerogram::planner
