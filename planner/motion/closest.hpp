#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "planner/motion/certificate.hpp"

namespace aerogram::planner {

/// What rounding may have added to a bound: metres, for coordinates up to 100 km.
inline constexpr double kRounding_m = 1e-9;

/// The smallest distance so far, and what nothing examined is below. Distances are resolved to a share of 2e-6, never
/// finer than a micrometre.
class Closest {
  public:
    explicit Closest(double beyond_m) : beyond_m_(beyond_m), lower_m_(beyond_m) {}

    /// Whatever is certainly not below this need not be looked at more closely.
    [[nodiscard]] double enough_m() const {
        const double known_m = std::min(beyond_m_, attained_m_);
        return known_m - std::max(kFinest_m, kResolution * known_m);
    }
    [[nodiscard]] double attained_m() const { return attained_m_; }
    void attained(double distance_m, std::size_t i, std::size_t j, double time_share) {
        if (distance_m >= attained_m_) return;
        attained_m_ = distance_m;
        first_ = i;
        second_ = j;
        time_share_ = time_share;
    }
    void not_below(double bound_m) { lower_m_ = std::min(lower_m_, bound_m); }
    /// Takes over what another search found; of equal distances the one already here stays.
    void merge(const Closest& other) {
        attained(other.attained_m_, other.first_, other.second_, other.time_share_);
        not_below(other.lower_m_);
    }

    /// @param names  drone of each index, or empty where they are the same.
    [[nodiscard]] SeparationBound result(double duration_s, std::span<const std::uint32_t> names) const {
        SeparationBound bound;
        bound.lower_bound_m = std::max(0.0, std::min(lower_m_, attained_m_) - kRounding_m);
        if (std::isfinite(attained_m_)) {
            const auto name = [&](std::size_t i) { return DroneId(names.empty() ? i : names[i]); };
            bound.closest = Encounter{name(first_), name(second_), time_share_ * duration_s, attained_m_};
        }
        return bound;
    }

  private:
    static constexpr double kResolution = 2e-6, kFinest_m = 1e-6;
    double beyond_m_, lower_m_;
    double attained_m_ = std::numeric_limits<double>::infinity();
    std::size_t first_ = 0, second_ = 0;
    double time_share_ = 0.0;
};

/// Share of [a, b] at which the segment is nearest to the origin.
[[nodiscard]] inline double nearest_share(const Vec3& a, const Vec3& b) {
    const Vec3 way = b - a;
    const double squared = glm::dot(way, way);
    return squared > 0.0 ? std::clamp(-glm::dot(a, way) / squared, 0.0, 1.0) : 0.0;
}

/// Bézier control points of a pair's difference, in the separation metric.
using Hull = std::array<Vec3, 4>;
/// One pair along one curve, [begin, end] as shares of the act: its hull lies beyond one plane, or it is halved.
void bound_curve(const Hull& d, std::size_t i, std::size_t j, double begin, double end, Closest& closest);

/// The smallest distance of points standing still, exactly; of equal ones the pair named first.
[[nodiscard]] Closest closest_standing(std::span<const Vec3> points, double beyond_m, double time_share,
                                       const Run& run);

/// bound_separation for a lattice: see lattice_bound.cpp.
/// @param flyers  the drones that count, ascending; at least two.
[[nodiscard]] Result<Closest> bound_lattice(const Lattice& lattice, std::span<const std::uint32_t> flyers,
                                            const SeparationMetric& metric, double beyond_m, const Run& run);

}  // namespace aerogram::planner
