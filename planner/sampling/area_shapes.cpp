#include "planner/sampling/area_shapes.hpp"

#include <cmath>
#include <utility>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

constexpr int kChords = 720;  ///< of a circle: within 1e-5 of its radius

/// Counter-clockwise from the right, or clockwise.
Contour circle(double radius, bool clockwise) {
    Contour out;
    for (int i = 0; i < kChords; ++i) {
        const double angle = 2.0 * kPi * i / kChords * (clockwise ? -1.0 : 1.0);
        out.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return out;
}

/// One unit wide, the middle of its box at (0, 0).
Region one_wide(Contour contour) {
    const Bounds box = bounds_of({{contour}});
    for (Vec2& p : contour) p = (p - 0.5 * (box.low + box.high)) / box.size().x;
    return {{std::move(contour)}};
}

/// Counter-clockwise; angle 0 is up.
Vec2 on_circle(double angle) {
    return {-std::sin(angle), std::cos(angle)};
}

}  // namespace

Region disc_region() {
    return {{circle(0.5, false)}};
}

Region ring_region(double inner) {
    AEROGRAM_REQUIRE(inner > 0.0 && inner < 1.0, inner);
    return {{circle(0.5, false), circle(0.5 * inner, true)}};
}

Region square_region() {
    return {{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}}};
}

Region polygon_region(std::size_t sides) {
    AEROGRAM_REQUIRE(sides >= 3, sides);
    const double step = 2.0 * kPi / static_cast<double>(sides);
    Contour contour;
    for (std::size_t i = 0; i < sides; ++i) contour.push_back(on_circle(kPi + step * (static_cast<double>(i) + 0.5)));
    return one_wide(std::move(contour));
}

Region star_region(std::size_t tips, double inner) {
    AEROGRAM_REQUIRE(tips >= 3 && inner > 0.0 && inner < 1.0, tips, inner);
    const double step = kPi / static_cast<double>(tips);
    Contour contour;
    for (std::size_t i = 0; i < 2 * tips; ++i)
        contour.push_back((i % 2 == 0 ? 1.0 : inner) * on_circle(step * static_cast<double>(i)));
    return one_wide(std::move(contour));
}

Region heart_region() {
    Contour contour;
    for (int i = 0; i < kChords; ++i) {
        const double t = -2.0 * kPi * i / kChords, s = std::sin(t);
        contour.emplace_back(16.0 * s * s * s, 13.0 * std::cos(t) - 5.0 * std::cos(2.0 * t) - 2.0 * std::cos(3.0 * t) -
                                                   std::cos(4.0 * t));
    }
    return one_wide(std::move(contour));
}

}  // namespace aerogram::planner
