#include "export/picture/spacing_histogram.hpp"

#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"

namespace aerogram::exporter {

SpacingHistogram spacing_histogram(std::vector<double> distances_m, double asked_m, std::size_t bins) {
    AEROGRAM_REQUIRE(asked_m > 0.0 && bins > 0, asked_m, bins);
    SpacingHistogram out;
    out.bins.assign(bins, 0);
    out.end_m = 1.5 * asked_m;
    if (distances_m.empty()) return out;
    std::ranges::sort(distances_m);
    const double median_m = distances_m[distances_m.size() / 2];
    out.end_m = std::max(out.end_m, std::min(1.1 * distances_m.back(), 3.0 * median_m));
    for (const double distance_m : distances_m) {
        const auto bin = static_cast<std::size_t>(
            std::min(distance_m / out.end_m * static_cast<double>(bins), static_cast<double>(bins - 1)));
        ++out.bins[bin];
    }
    out.beyond = distances_m.back() > out.end_m;
    return out;
}

double round_step(double least) {
    AEROGRAM_REQUIRE(least > 0.0, least);
    double step = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * step >= least) return factor * step;
    }
    return 10.0 * step;
}

}  // namespace aerogram::exporter
