#include "tests/fuzz/picture_targets.hpp"

// Fuzz target: any bytes as a picture.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    aerogram::planner::fuzz::try_picture({size > 0 ? reinterpret_cast<const char*>(data) : "", size});
    return 0;
}
