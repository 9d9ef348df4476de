#include "export/vehicle/septic.hpp"

#include <algorithm>
#include <cmath>

namespace aerogram::exporter {
namespace {

constexpr std::size_t kDegree = kSepticTerms - 1;
static_assert(kDegree == kMaxDegree);

double choose(std::size_t n, std::size_t k) {
    double result = 1.0;
    for (std::size_t i = 0; i < k; ++i) result = result * static_cast<double>(n - i) / static_cast<double>(i + 1);
    return result;
}

}  // namespace

void set_powers(SepticPiece& piece, const Bezier& curve) {
    const double duration_s = static_cast<double>(piece.duration_s);
    double scale = 1.0;  // duration^i
    for (std::size_t i = 0; i <= kDegree; ++i, scale *= duration_s) {
        Vec3 sum{};
        for (std::size_t k = 0; k <= i; ++k)
            sum += ((i - k) % 2 == 0 ? choose(i, k) : -choose(i, k)) * curve.control[k];
        const Vec3 c = to_crazyflie(choose(kDegree, i) / scale * sum);
        for (std::size_t axis = 0; axis < 3; ++axis)
            piece.place[axis][i] = static_cast<float>(c[static_cast<int>(axis)] + 0.0);
    }
}

Bezier curve_of(const SepticPiece& piece) {
    const double duration_s = static_cast<double>(piece.duration_s);
    Bezier curve;
    curve.degree = kDegree;
    for (std::size_t j = 0; j <= kDegree; ++j) {
        Vec3 p{};
        double scale = 1.0;
        for (std::size_t i = 0; i <= j; ++i, scale *= duration_s) {
            const double share = scale * choose(j, i) / choose(kDegree, i);
            p += share * Vec3{static_cast<double>(piece.place[0][i]), static_cast<double>(piece.place[1][i]),
                              static_cast<double>(piece.place[2][i])};
        }
        curve.control[j] = from_crazyflie(p);
    }
    return curve;
}

std::array<double, 3> rounding_of(const SepticPiece& piece) {
    constexpr double kHalfFloat = 1.0 / (1 << 24);
    const double t = static_cast<double>(piece.duration_s);
    std::array<double, 3> worst{};
    for (const Powers& powers : piece.place) {
        std::array<double, 3> sum{};
        for (std::size_t i = 0; i <= kDegree; ++i) {
            const double n = static_cast<double>(i), c = kHalfFloat * std::abs(static_cast<double>(powers[i]));
            sum[0] += c * std::pow(t, n);
            if (i >= 1) sum[1] += n * c * std::pow(t, n - 1.0);
            if (i >= 2) sum[2] += n * (n - 1.0) * c * std::pow(t, n - 2.0);
        }
        for (std::size_t k = 0; k < 3; ++k) worst[k] = std::max(worst[k], sum[k]);
    }
    return worst;
}

}  // namespace aerogram::exporter
