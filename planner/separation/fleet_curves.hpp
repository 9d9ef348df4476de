#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/motion/act.hpp"

namespace aerogram::planner {

/// The control rows of a fleet, each drone's together: three rows of doubles (x, y, z) of `stride` places, padded with
/// zeros. What the projection does to one drone stays in the processor's nearest memory.
struct ControlCurves {
    std::size_t drones = 0, rows = 0, stride = 0;
    std::vector<double> values;

    [[nodiscard]] double* axis(std::size_t drone, std::size_t a) { return values.data() + (3 * drone + a) * stride; }
    [[nodiscard]] const double* axis(std::size_t drone, std::size_t a) const {
        return values.data() + (3 * drone + a) * stride;
    }
    [[nodiscard]] Vec3 at(std::size_t row, std::size_t drone) const {
        return {axis(drone, 0)[row], axis(drone, 1)[row], axis(drone, 2)[row]};
    }
};

/// Drones in an order in which neighbours halfway lie together (Morton curve): result[place] is the lattice's drone.
[[nodiscard]] std::vector<std::uint32_t> neighbourly_order(const Lattice& lattice);
/// @param order  place of the curves -> drone of the lattice.
[[nodiscard]] ControlCurves curves_of(const Lattice& lattice, const std::vector<std::uint32_t>& order);
[[nodiscard]] Lattice lattice_of(const ControlCurves& curves, const std::vector<std::uint32_t>& order);

/// Where curves are looked at: `per` instants a knot interval. Values are kept by phase: place m of phase q is the
/// instant q / per after knot m, so that all loops run over neighbouring places.
/// Chord (m, q) leads from there to the next instant.
class Sampling {
  public:
    Sampling(std::size_t rows, std::size_t per_interval);

    [[nodiscard]] std::size_t intervals() const { return rows_ - 3; }
    [[nodiscard]] std::size_t per_interval() const { return per_; }
    [[nodiscard]] std::size_t stride() const { return stride_; }
    /// Places of one coordinate of one drone.
    [[nodiscard]] std::size_t axis_stride() const { return per_ * stride_; }
    [[nodiscard]] std::size_t drone_stride() const { return 3 * axis_stride(); }
    [[nodiscard]] std::size_t before(std::size_t phase) const { return phase * stride_; }
    [[nodiscard]] std::size_t after(std::size_t phase) const { return phase + 1 < per_ ? (phase + 1) * stride_ : 1; }

    /// Curve values of one coordinate, times scale. @param rows  padded by at least one place.
    void evaluate(const double* rows, double scale, double* samples) const;
    /// Adds the transpose of evaluate (without its scale) times share to the rows, and clears the samples.
    void spread_back(double* samples, double share, double* rows) const;

  private:
    std::size_t rows_, per_, stride_;
    std::vector<std::array<double, 4>> weight_;  ///< by phase
};

/// Samples of a fleet in the separation metric (z divided by the downwash), laid out as Sampling says.
struct SampledCurves {
    std::size_t drone_stride = 0;
    std::vector<double> values;

    [[nodiscard]] double* of(std::size_t drone) { return values.data() + drone * drone_stride; }
    [[nodiscard]] const double* of(std::size_t drone) const { return values.data() + drone * drone_stride; }
};

/// Closest approach of two drones on consecutive chords: squared distance, and the share of the chord where it is.
/// Reads and writes up to three places more.
/// @param i, j  one drone's samples each.  @param before, after  places of the first chord's ends.
void closest_approaches(const double* i, const double* j, std::size_t axis_stride, std::size_t before,
                        std::size_t after, std::size_t count, double* squared, double* share);
/// Squared lengths of the steps from one set of samples to another, place by place of the first coordinate.
void squared_steps(const double* before, const double* after, std::size_t axis_stride, std::size_t count,
                   double* squared);
/// The smallest of count >= 1 values.
[[nodiscard]] double smallest(const double* values, std::size_t count);

}  // namespace aerogram::planner
