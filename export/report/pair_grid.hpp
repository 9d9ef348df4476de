#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geo/vec3.hpp"

namespace aerogram::exporter {

/// Somebody who flies straight from one place to another between two times; equal places: stands.
struct Mover {
    Vec3 from{}, to{};
    double begin_s = 0.0, end_s = 0.0;
    std::uint32_t drone = 0;

    [[nodiscard]] Vec3 at(double t_s) const {
        return end_s > begin_s ? from + (t_s - begin_s) / (end_s - begin_s) * (to - from) : from;
    }
};

/// The smallest length of a + u (b - a), u in [0, 1], and where.
struct Nearest {
    double distance_m = 0.0, u = 0.0;
};
[[nodiscard]] Nearest nearest_on_line(const Vec3& a, const Vec3& b);
/// The closest approach of two movers while both move; infinite where their times do not overlap. u: show time.
[[nodiscard]] Nearest closest_approach(const Mover& a, const Mover& b);

/// Pairs that come near each other, by a uniform grid; memory is reused.
class PairGrid {
  public:
    /// Looks at a pair, the lower index first, and returns from now on within what distance pairs are wanted.
    using Visit = std::function<double(std::size_t first, std::size_t second)>;

    /// Visits each pair of movers that may come within reach of each other, once, in a fixed order. @param reach_m
    /// finite, >= 0. Cost: O(n + pairs within reach and two ways of the movers).
    void search(std::span<const Mover> movers, double reach_m, const Visit& visit);

  private:
    struct Entry {
        float x = 0.0F, y = 0.0F, z = 0.0F, radius = 0.0F;
        std::int32_t cx = 0, cy = 0, cz = 0;
        std::uint32_t mover = 0;
    };
    [[nodiscard]] std::size_t bucket(std::int32_t x, std::int32_t y, std::int32_t z) const;
    void enter(std::span<const Mover> movers, double reach_m);

    std::vector<Entry> entries_, unordered_;
    std::vector<std::uint32_t> starts_;
    std::size_t mask_ = 0;
};

}  // namespace aerogram::exporter
