#pragma once
#include <cstddef>
#include <vector>

namespace aerogram::exporter {

/// How many distances fall into each of equally wide bins from 0 to `end_m`; what is beyond is in the last.
struct SpacingHistogram {
    double end_m = 1.0;
    std::vector<std::size_t> bins;
    bool beyond = false;  ///< something is
};

/// Reaches from 0 to a little beyond the largest distance, or to three times the median where a few stand far off, and
/// always beyond `asked_m`.
/// Property: (1) the bins sum up to the number of distances. @param distances_m  finite, >= 0. @param asked_m  > 0.
[[nodiscard]] SpacingHistogram spacing_histogram(std::vector<double> distances_m, double asked_m, std::size_t bins);

/// A step of 1, 2 or 5 times a power of ten that is at least `least` (> 0): for the marks of an axis.
[[nodiscard]] double round_step(double least);

}  // namespace aerogram::exporter
