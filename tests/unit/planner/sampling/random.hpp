#pragma once
#include <cstdint>
#include <cstdlib>
#include <string>

#include "geo/random.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner::testing {

/// Seeded numbers for property tests.
class Random : public aerogram::Random {
  public:
    using aerogram::Random::Random;
    Vec3 point(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
};

/// How many random cases a property test tries; AEROGRAM_TEST_N sets it.
inline std::size_t cases(std::size_t usual) {
    const char* asked = std::getenv("AEROGRAM_TEST_N");
    return asked != nullptr ? std::stoul(asked) : usual;
}

}  // namespace aerogram::planner::testing
