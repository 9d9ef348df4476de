#include "planner/sampling/area_shapes.hpp"

#include <cmath>

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

}  // namespace aerogram::planner
