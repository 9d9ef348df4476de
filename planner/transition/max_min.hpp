#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "planner/transition/hungarian.hpp"

namespace aerogram::planner {

/// A perfect matching of rows to columns that uses scores of at least `least` alone; nothing when there is none.
/// @param scores  n x n, row-major. Augmenting paths, breadth first.
[[nodiscard]] inline std::optional<std::vector<std::size_t>> matching_above(std::span<const std::int64_t> scores,
                                                                            std::size_t n, std::int64_t least) {
    std::vector<std::size_t> column_of(n, n), row_of(n, n), came_from(n), queue;
    std::vector<char> reached(n);
    for (std::size_t start = 0; start < n; ++start) {
        reached.assign(n, 0);
        queue.assign(1, start);
        std::size_t free_column = n;
        for (std::size_t q = 0; q < queue.size() && free_column == n; ++q) {
            const std::size_t row = queue[q];
            for (std::size_t j = 0; j < n && free_column == n; ++j) {
                if (reached[j] || scores[row * n + j] < least) continue;
                reached[j] = 1;
                came_from[j] = row;
                if (row_of[j] == n) {
                    free_column = j;
                } else {
                    queue.push_back(row_of[j]);
                }
            }
        }
        if (free_column == n) return std::nullopt;
        for (std::size_t j = free_column, next = n; j != n; j = next) {
            next = column_of[came_from[j]];
            row_of[j] = came_from[j];
            column_of[came_from[j]] = j;
        }
    }
    return column_of;
}

/// The matching of rows to columns whose smallest score is largest and, of those, whose sum is largest:
/// result[row] = column. Exact. @param scores  as for best_matching, 0 <= score <= 2^30, n <= 4096.
[[nodiscard]] inline std::vector<std::size_t> max_min_matching(std::span<const std::int64_t> scores, std::size_t n) {
    AEROGRAM_REQUIRE(scores.size() == n * n && n <= 4096, scores.size(), n);
    std::vector<std::int64_t> levels(scores.begin(), scores.end());
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    std::size_t possible = 0;  // levels[0] always is
    for (std::size_t beyond = levels.size(); beyond - possible > 1 && !levels.empty();) {
        const std::size_t middle = possible + (beyond - possible) / 2;
        (matching_above(scores, n, levels[middle]) ? possible : beyond) = middle;
    }
    constexpr std::int64_t kNever = -(std::int64_t{1} << 43);  // less than any 4096 scores make up for
    std::vector<std::int64_t> allowed(scores.begin(), scores.end());
    for (std::int64_t& s : allowed) {
        if (s < levels[possible]) s = kNever;
    }
    return best_matching(allowed, n);
}

}  // namespace aerogram::planner
