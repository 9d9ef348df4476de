#include <fribidi.h>

#include <algorithm>

#include "geo/contract.hpp"
#include "planner/text/directions.hpp"

namespace aerogram::planner {

std::vector<DirectedRun> runs_as_seen(std::u32string_view line) {
    const std::size_t n = line.size();
    if (n == 0) return {};
    const auto length = static_cast<FriBidiStrIndex>(n);
    const std::vector<FriBidiChar> text(line.begin(), line.end());
    std::vector<FriBidiCharType> types(n);
    std::vector<FriBidiBracketType> brackets(n);
    std::vector<FriBidiLevel> levels(n);
    fribidi_get_bidi_types(text.data(), length, types.data());
    fribidi_get_bracket_types(text.data(), length, types.data(), brackets.data());
    FriBidiParType base = FRIBIDI_PAR_ON;
    const FriBidiLevel highest =
        fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), length, &base, levels.data());
    AEROGRAM_REQUIRE(highest > 0, n);      // it is 0 only when there is no memory
    std::vector<FriBidiStrIndex> seen(n);  // seen[v]: the character at place v from the left
    for (std::size_t i = 0; i < n; ++i) seen[i] = static_cast<FriBidiStrIndex>(i);
    const FriBidiLevel reordered =
        fribidi_reorder_line(0, types.data(), length, 0, base, levels.data(), nullptr, seen.data());
    AEROGRAM_REQUIRE(reordered > 0, n);

    std::vector<DirectedRun> runs;
    for (const FriBidiStrIndex index : seen) {
        const auto i = static_cast<std::size_t>(index);
        const bool right_to_left = FRIBIDI_LEVEL_IS_RTL(levels[i]) != 0;
        if (!runs.empty() && runs.back().right_to_left == right_to_left) {
            DirectedRun& run = runs.back();
            if (right_to_left ? i + 1 == run.begin : i == run.end) {
                (right_to_left ? run.begin : run.end) = right_to_left ? i : i + 1;
                continue;
            }
        }
        runs.push_back({i, i + 1, right_to_left});
    }
    return runs;
}

}  // namespace aerogram::planner
