#include "tests/fuzz/points_targets.hpp"

// Fuzz target: any bytes as a formation csv.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    aerogram::planner::fuzz::try_points({size > 0 ? reinterpret_cast<const char*>(data) : "", size});
    return 0;
}
