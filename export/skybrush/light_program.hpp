#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geo/result.hpp"
#include "geo/tracks.hpp"

/// The Skybrush light program: what .skyc and .skyb carry for one lamp. Ticks of 20 ms, durations as LEB128, 8-bit
/// linear RGB, dark at the start. Instructions read and written (FORMATS.md 1): 00 end, 02 sleep, 04-07 set and hold
/// (RGB, gray, black, white), 08-0B fade to the same, 0C n .. 0D loop. Others are refused.
namespace aerogram::exporter {

inline constexpr Millis kLightTickMs = 20;

/// The program of one lamp. It ends with a set (black for one tick, `06 01 00`) at the show's end or at the last key,
/// whichever is later, never on a fade.
/// @param keys  in time order; times are rounded to ticks.
/// Properties: (1) decoding gives the same light at every instant before the end, within 1/255 a component (2) loops
/// are at most four deep, of 2 to 255 rounds, and written where they make the program shorter (light_loops.hpp);
/// sleeps are not written (3) a step that goes on with the colour before it is one step with it (4) at most 14 bytes a
/// key and 9 more. Cost: linear in the keys: 10,000 drones of 500 keys take a second or two.
[[nodiscard]] std::vector<std::uint8_t> light_program(std::span<const LightKey> keys, Millis duration_ms);

/// What a program may make a reader do.
struct LightProgramLimits {
    Millis until_ms = 86'400'000;  ///< decoding stops here: a loop without an end is legal
    std::size_t instructions = 200'000;
    std::size_t loop_depth = 4;
};
/// The light keys of a program.
/// Errors: invalid_input, naming the byte, for an unknown instruction, a truncated one, no end, loops too deep or not
/// matched, durations beyond 32 bits, too many instructions.
Result<std::vector<LightKey>> decoded_light_program(std::span<const std::uint8_t> program,
                                                    const LightProgramLimits& limits = {});

}  // namespace aerogram::exporter
