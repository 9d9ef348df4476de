#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geo/contract.hpp"

namespace aerogram::planner {

/// The matching of rows to columns with the largest sum of scores: result[row] = column. Exact.
/// @param scores  n x n, row-major; integers, so that equal scores are equal; |score| < 2^44.
/// Cost: O(n³) by shortest augmenting paths; ties go to the lowest column. Source: Kuhn 1955; Jonker and Volgenant
/// 1987.
[[nodiscard]] inline std::vector<std::size_t> best_matching(std::span<const std::int64_t> scores, std::size_t n) {
    AEROGRAM_REQUIRE(scores.size() == n * n, scores.size(), n);
    constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max() / 4;
    // Place 0 stands for "nobody"; rows and columns count from 1.
    std::vector<std::int64_t> row_price(n + 1, 0), column_price(n + 1, 0), slack(n + 1);
    std::vector<std::size_t> row_of(n + 1, 0), came_from(n + 1, 0);
    std::vector<char> reached(n + 1);
    for (std::size_t row = 1; row <= n; ++row) {
        row_of[0] = row;
        slack.assign(n + 1, kFar);
        reached.assign(n + 1, 0);
        std::size_t column = 0;
        while (row_of[column] != 0) {
            reached[column] = 1;
            const std::size_t i = row_of[column];
            std::size_t nearest = 0;
            for (std::size_t j = 1; j <= n; ++j) {
                if (reached[j]) continue;
                const std::int64_t reduced = -scores[(i - 1) * n + (j - 1)] - row_price[i] - column_price[j];
                if (reduced < slack[j]) {
                    slack[j] = reduced;
                    came_from[j] = column;
                }
                if (nearest == 0 || slack[j] < slack[nearest]) nearest = j;
            }
            const std::int64_t step = slack[nearest];
            for (std::size_t j = 0; j <= n; ++j) {
                if (reached[j]) {
                    row_price[row_of[j]] += step;
                    column_price[j] -= step;
                } else {
                    slack[j] -= step;
                }
            }
            column = nearest;
        }
        while (column != 0) {
            row_of[column] = row_of[came_from[column]];
            column = came_from[column];
        }
    }
    std::vector<std::size_t> column_of(n);
    for (std::size_t j = 1; j <= n; ++j) column_of[row_of[j] - 1] = j - 1;
    return column_of;
}

}  // namespace aerogram::planner
