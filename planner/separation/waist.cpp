#include "planner/separation/waist.hpp"

#include <algorithm>
#include <cmath>

#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

/// Shares of a ball's volume that the drones' balls fill: denser than any packing, where blowing up begins, and its
/// aim.
constexpr double kImpossible = 0.74, kTight = 0.3, kRoomy = 0.1;

constexpr std::size_t kFewest = 10;  ///< the projection sorts out fewer by itself

/// Radius of the ball that n drones fill so far.
double radius_m(std::size_t n, double spacing_m, double filling) {
    return 0.5 * spacing_m * std::cbrt(static_cast<double>(n) / filling);
}

double rms_radius_m(const Lattice& lattice, std::size_t row, const SeparationMetric& metric) {
    Vec3 mean{};
    for (std::size_t i = 0; i < lattice.drones; ++i) mean += lattice.at(row, i);
    mean /= static_cast<double>(lattice.drones);
    double squared = 0.0;
    for (std::size_t i = 0; i < lattice.drones; ++i) {
        const Vec3 d = metric.scaled(lattice.at(row, i) - mean);
        squared += glm::dot(d, d);
    }
    return std::sqrt(squared / static_cast<double>(lattice.drones));
}

Vec3 in_unit_ball(Random& random) {
    Vec3 p{};
    do {
        p = {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
    } while (glm::dot(p, p) > 1.0);
    return p;
}

}  // namespace

std::optional<Lattice> spread_waist(const Lattice& input, double spacing_m, const SeparationMetric& metric,
                                    std::uint64_t seed) {
    const std::size_t n = input.drones, rows = input.rows();
    const double of_ball = std::sqrt(0.6);  // root mean square of a full ball of radius 1
    const double impossible_m = of_ball * (radius_m(n, spacing_m, kImpossible) - 0.5 * spacing_m);
    const double tight_m = of_ball * radius_m(n, spacing_m, kTight);
    std::vector<double> share(rows, 0.0);
    bool narrow = false;
    for (std::size_t k = 3; k + 3 < rows; ++k) {
        const double now_m = rms_radius_m(input, k, metric), ratio = now_m / tight_m;
        share[k] = std::pow(std::max(0.0, 1.0 - ratio * ratio), 2);
        narrow = narrow || now_m < impossible_m;
    }
    if (n < kFewest || !narrow) return std::nullopt;
    Lattice spread = input;
    Random random(seed);
    for (std::size_t i = 0; i < n; ++i) {
        Vec3 place = radius_m(n, spacing_m, kRoomy) * in_unit_ball(random);
        place.z *= metric.downwash;
        for (std::size_t k = 3; k + 3 < rows; ++k) spread.at(k, i) += share[k] * place;
    }
    return spread;
}

}  // namespace aerogram::planner
