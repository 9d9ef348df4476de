#pragma once
#include <cstdint>
#include <cstring>

namespace aerogram::planner {

/// Four numbers handled at once, whatever the processor (GCC and clang vector extension). Only for loops inside
/// functions marked AEROGRAM_VECTORIZED: hand Lanes to other functions by reference.
using Lanes = double __attribute__((vector_size(32)));
/// The answers of a comparison of Lanes: all bits set where it holds.
using LaneBits = std::int64_t __attribute__((vector_size(32)));

/// Four neighbours in memory, at any alignment.
inline void load(const double* from, Lanes& to) {
    std::memcpy(&to, from, sizeof(Lanes));
}

}  // namespace aerogram::planner
