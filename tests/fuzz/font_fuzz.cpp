#include "tests/fuzz/text_targets.hpp"

// Fuzz target: any bytes as a font file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    aerogram::planner::fuzz::try_font({size > 0 ? reinterpret_cast<const char*>(data) : "", size});
    return 0;
}
