#include <cstddef>
#include <cstdint>

#include "tests/fuzz/svg_targets.hpp"

// Fuzz target: any bytes are a sound drawing or are refused with a line; nothing else may happen.
// Build with -fsanitize=fuzzer,address,undefined; the corpus is tests/fuzz/corpus/svg, replayed by a unit test.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    aerogram::planner::fuzz::try_svg({size > 0 ? reinterpret_cast<const char*>(data) : "", size});
    return 0;
}
