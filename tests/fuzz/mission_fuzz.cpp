#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "planner/mission/mission_reader.hpp"

// Fuzz target: any bytes are a mission or are refused with at least one "file:line: " message; nothing else may happen.
// Build with -fsanitize=fuzzer,address,undefined; the corpus is tests/fuzz/corpus/mission, replayed by a unit test.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(size > 0 ? reinterpret_cast<const char*>(data) : "", size);
    const auto mission = aerogram::planner::parse_mission(text, "no-such-folder/m.toml");
    if (mission) {
        const bool sound = mission->fleet.drones > 0 && mission->fleet.pads_m.size() == mission->fleet.drones &&
                           !mission->keyframes.empty();
        if (!sound) std::abort();
        return 0;
    }
    if (!mission.error().message.starts_with("no-such-folder/m.toml:")) std::abort();
    return 0;
}
