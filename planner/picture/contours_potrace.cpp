#include <potracelib.h>

#include <algorithm>
#include <memory>

#include "geo/contract.hpp"
#include "planner/picture/contours.hpp"
#include "planner/sampling/bezier_line.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kMostPixelsTraced = 4'000'000;
constexpr double kTolerance = 0.05;  ///< pixels that a chord may stray from its curve

struct Free {
    void operator()(potrace_param_t* p) const { potrace_param_free(p); }
    void operator()(potrace_state_t* p) const { potrace_state_free(p); }
};

/// The library's bitmap: rows from the bottom, in words whose highest bit is the leftmost pixel.
std::vector<potrace_word> packed(const Bitmap& bitmap, std::size_t words_a_row) {
    constexpr std::size_t kBits = 8 * sizeof(potrace_word);
    std::vector<potrace_word> words(words_a_row * bitmap.height, 0);
    for (std::size_t p = 0; p < bitmap.set.size(); ++p) {
        if (bitmap.set[p] == 0) continue;
        const std::size_t column = p % bitmap.width, row = bitmap.height - 1 - p / bitmap.width;
        words[row * words_a_row + column / kBits] |= potrace_word{1} << (kBits - 1 - column % kBits);
    }
    return words;
}

Vec2 place(const potrace_dpoint_t& p) {
    return {p.x, p.y};
}

/// A closed row of curves and corners as chords.
Contour chords(const potrace_curve_t& curve) {
    Contour out;
    const auto n = static_cast<std::size_t>(curve.n);
    Vec2 from = place(curve.c[n - 1][2]);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 to = place(curve.c[i][2]);
        if (curve.tag[i] == POTRACE_CORNER) {
            out.push_back(place(curve.c[i][1]));
            out.push_back(to);
        } else {
            const Vec2 control[] = {from, place(curve.c[i][0]), place(curve.c[i][1]), to};
            const std::vector<Vec2> line = flattened(control, false, kTolerance);
            out.insert(out.end(), line.begin() + 1, line.end());
        }
        from = to;
    }
    out.erase(std::unique(out.begin(), out.end()), out.end());
    while (out.size() > 1 && out.front() == out.back()) out.pop_back();
    return out;
}

Result<Region> traced(const potrace_bitmap_t& bits, std::size_t speck) {
    const std::unique_ptr<potrace_param_t, Free> how(potrace_param_default());
    if (!how) return Error{ErrorCode::io, "not enough memory to trace it"};
    how->turdsize = static_cast<int>(speck);
    const std::unique_ptr<potrace_state_t, Free> state(potrace_trace(how.get(), &bits));
    if (!state || state->status != POTRACE_STATUS_OK) return Error{ErrorCode::io, "not enough memory to trace it"};
    Region region;
    for (const potrace_path_t* path = state->plist; path != nullptr; path = path->next) {
        if (path->curve.n > 0) region.contours.push_back(chords(path->curve));
    }
    std::erase_if(region.contours, [](const Contour& contour) { return contour.size() < 3; });
    return region;
}

}  // namespace

Result<Region> contours_of(const Bitmap& bitmap, std::size_t speck) {
    AEROGRAM_REQUIRE(bitmap.set.size() == bitmap.width * bitmap.height && bitmap.set.size() <= kMostPixelsTraced,
                     bitmap.width, bitmap.height);
    AEROGRAM_REQUIRE(std::count(bitmap.set.begin(), bitmap.set.end(), 1) > 0);
    constexpr std::size_t kBits = 8 * sizeof(potrace_word);
    const std::size_t words_a_row = (bitmap.width + kBits - 1) / kBits;
    std::vector<potrace_word> words = packed(bitmap, words_a_row);
    const potrace_bitmap_t bits{static_cast<int>(bitmap.width), static_cast<int>(bitmap.height),
                                static_cast<int>(words_a_row), words.data()};
    auto region = traced(bits, std::min<std::size_t>(speck, kMostPixelsTraced));
    if (region && region->contours.empty()) region = traced(bits, 0);
    return region;
}

}  // namespace aerogram::planner
