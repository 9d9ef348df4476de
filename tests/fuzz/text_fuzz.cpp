#include "tests/fuzz/text_targets.hpp"

// Fuzz target: any bytes as a text, in the stroke font and in a font of outlines, straight and along a curve.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    aerogram::planner::fuzz::try_text({size > 0 ? reinterpret_cast<const char*>(data) : "", size},
                                      AEROGRAM_SOURCE_DIR "/tests/fuzz/corpus/font/own.ttf");
    return 0;
}
