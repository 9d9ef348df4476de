#pragma once
#include <cstdint>
#include <cstdlib>
#include <string>

#include "geo/vec3.hpp"

namespace aerogram::planner::testing {

/// Seeded numbers for property tests (splitmix64).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t v = state_ += 0x9E3779B97F4A7C15U;
        v = (v ^ (v >> 30U)) * 0xBF58476D1CE4E5B9U;
        v = (v ^ (v >> 27U)) * 0x94D049BB133111EBU;
        return v ^ (v >> 31U);
    }
    /// In [0, 1).
    double share() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }
    double between(double low, double high) { return low + (high - low) * share(); }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }
    Vec3 point(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }

  private:
    std::uint64_t state_;
};

/// How many random cases a property test tries; AEROGRAM_TEST_N sets it.
inline std::size_t cases(std::size_t usual) {
    const char* asked = std::getenv("AEROGRAM_TEST_N");
    return asked != nullptr ? std::stoul(asked) : usual;
}

}  // namespace aerogram::planner::testing
