#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

namespace aerogram::planner {

/// Characters of a line that run in one direction.
struct DirectedRun {
    std::size_t begin = 0, end = 0;  ///< code points
    bool right_to_left = false;
};

/// A line cut into runs, in the order in which they are seen from left to right. The line runs as its first letter of a
/// direction does, and nested directions, numbers, brackets and control characters follow Unicode's bidirectional
/// algorithm (annex 9). Each character is in exactly one run. Cost: O(characters).
[[nodiscard]] std::vector<DirectedRun> runs_as_seen(std::u32string_view line);

}  // namespace aerogram::planner
