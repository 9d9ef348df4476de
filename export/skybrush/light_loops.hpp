#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace aerogram::exporter {

inline constexpr std::size_t kLightLoopDepth = 4;  ///< the deepest that readers follow
inline constexpr std::size_t kLongestLoopBody =
    128;  ///< steps that may repeat together; longer periods are not looked for

/// A light program's steps, each as its bytes, joined and with repeats written as loops (0C n .. 0D) where that is
/// shorter.
/// Properties: (1) played, it gives the same steps in the same order (2) it is never longer than the steps joined
/// (3) loops are at most kLightLoopDepth deep, of 2 to 255 rounds.
/// Cost: O(n · kLongestLoopBody) a level. A level is the shortest way to write its steps as loops of plain bodies that
/// take all the rounds they can; bodies are then shortened in the same way, and the loops taken for steps of a next
/// level.
[[nodiscard]] std::vector<std::uint8_t> looped(std::span<const std::string> steps);

}  // namespace aerogram::exporter
