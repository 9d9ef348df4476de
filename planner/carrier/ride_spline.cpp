#include "planner/carrier/ride_spline.hpp"

#include "geo/contract.hpp"

namespace aerogram::planner {

Lattice gliding_lattice_through(std::span<const Vec3> samples_m, std::size_t drones) {
    AEROGRAM_REQUIRE(drones > 0 && samples_m.size() % drones == 0, drones, samples_m.size());
    const std::size_t knots = samples_m.size() / drones;
    AEROGRAM_REQUIRE(knots >= 3, knots);
    Lattice lattice{drones, Points((knots + 2) * drones)};
    // No acceleration at the ends: their second control points are the samples. Between, P[k-1] + 4 P[k] + P[k+1] = 6
    // times the sample at knot k-1, eliminated downwards (Thomas).
    for (std::size_t i = 0; i < drones; ++i) {
        lattice.at(1, i) = samples_m[i];
        lattice.at(knots, i) = samples_m[(knots - 1) * drones + i];
    }
    std::vector<double> upper(knots, 0.0);
    for (std::size_t k = 2; k < knots; ++k) {
        upper[k] = 1.0 / (4.0 - upper[k - 1]);
        for (std::size_t i = 0; i < drones; ++i) {
            Vec3 right = 6.0 * samples_m[(k - 1) * drones + i] - lattice.at(k - 1, i);
            if (k + 1 == knots) right -= lattice.at(knots, i);
            lattice.at(k, i) = right * upper[k];
        }
    }
    for (std::size_t k = knots - 1; k-- > 2;) {
        for (std::size_t i = 0; i < drones; ++i) lattice.at(k, i) -= upper[k] * lattice.at(k + 1, i);
    }
    for (std::size_t i = 0; i < drones; ++i) {
        lattice.at(0, i) = 2.0 * lattice.at(1, i) - lattice.at(2, i);
        lattice.at(knots + 1, i) = 2.0 * lattice.at(knots, i) - lattice.at(knots - 1, i);
    }
    return lattice;
}

Lattice part_of(const Lattice& lattice, std::size_t first_knot, std::size_t last_knot) {
    AEROGRAM_REQUIRE(first_knot < last_knot && last_knot + 3 <= lattice.rows(), first_knot, last_knot, lattice.rows());
    const auto begin = lattice.points_m.begin();
    const auto place = [&](std::size_t row) { return begin + static_cast<std::ptrdiff_t>(row * lattice.drones); };
    return {lattice.drones, Points(place(first_knot), place(last_knot + 3))};
}

}  // namespace aerogram::planner
