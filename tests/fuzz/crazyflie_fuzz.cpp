#include <cstddef>
#include <cstdint>

#include "tests/fuzz/format_targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const void* bytes = data;
    aerogram::exporter::fuzz::try_crazyflie({static_cast<const char*>(bytes), size});
    return 0;
}
