#pragma once
#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>

#include "geo/contract.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

/// Where every drone is at share t in [0, 1] of a transition: at 0 the source keyframe, at 1 the target, both to 1e-9
/// m. What every transition method returns, so that methods can be composed by group and blended. Made of any callable
/// (double t, std::span<Vec3> out); methods that are faster for many instants at once give a second one. Holds what it
/// needs; may be called from one thread at a time.
class Interpolation {
  public:
    using At = std::function<void(double, std::span<Vec3>)>;
    using Sample = std::function<void(std::span<const double>, std::span<Vec3>)>;

    template <class Callable>
    requires std::invocable<const Callable&, double, std::span<Vec3>> Interpolation(Callable at)
        : at_(std::move(at)) {}  // NOLINT(google-explicit-constructor)
    Interpolation(At at, Sample sample) : at_(std::move(at)), sample_(std::move(sample)) {}

    /// @param out  one place a drone.
    void operator()(double t, std::span<Vec3> out) const { at_(t, out); }
    /// The same for many instants. @param out  one row of places an instant, rows one after another.
    void sample(std::span<const double> shares, std::span<Vec3> out) const {
        if (shares.empty()) return;
        if (sample_) return sample_(shares, out);
        AEROGRAM_REQUIRE(out.size() % shares.size() == 0, out.size(), shares.size());
        const std::size_t n = out.size() / shares.size();
        for (std::size_t s = 0; s < shares.size(); ++s) at_(shares[s], out.subspan(s * n, n));
    }

  private:
    At at_;
    Sample sample_;
};

}  // namespace aerogram::planner
