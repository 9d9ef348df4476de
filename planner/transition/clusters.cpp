#include <algorithm>
#include <limits>
#include <utility>

#include "geo/contract.hpp"
#include "geo/random.hpp"
#include "planner/transition/hierarchy.hpp"
#include "planner/transition/low_modes.hpp"

namespace aerogram::planner {
namespace {

constexpr int kStarts = 8, kMostRounds = 200;

using Labels = std::vector<std::size_t>;

/// One point a drone: its row of the modes.
struct Rows {
    std::size_t count = 0, width = 0;
    std::vector<double> values;
    [[nodiscard]] const double* row(std::size_t i) const { return values.data() + i * width; }
};

double squared_distance(const double* a, const double* b, std::size_t width) {
    double sum = 0.0;
    for (std::size_t c = 0; c < width; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
    return sum;
}

/// k-means++ (Arthur and Vassilvitskii 2007): each next centre with a chance in proportion to its squared distance from
/// those before.
std::vector<double> first_centres(const Rows& rows, std::size_t count, Random& random) {
    std::vector<double> centres, far(rows.count, std::numeric_limits<double>::infinity());
    std::size_t chosen = random.below(rows.count);
    for (std::size_t k = 0; k < count; ++k) {
        centres.insert(centres.end(), rows.row(chosen), rows.row(chosen) + rows.width);
        double sum = 0.0;
        for (std::size_t i = 0; i < rows.count; ++i) {
            far[i] = std::min(far[i], squared_distance(rows.row(i), rows.row(chosen), rows.width));
            sum += far[i];
        }
        double left = random.unit() * sum;
        chosen = 0;
        while (chosen + 1 < rows.count && left >= far[chosen]) left -= far[chosen++];
    }
    return centres;
}

/// The nearest centre of each row; the lowest of equals. @returns the sum of squared distances.
double assign_nearest(const Rows& rows, std::size_t count, const std::vector<double>& centres, Labels& labels,
                      std::vector<double>& distances) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rows.count; ++i) {
        distances[i] = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < count; ++k) {
            const double d = squared_distance(rows.row(i), centres.data() + k * rows.width, rows.width);
            if (d < distances[i]) {
                distances[i] = d;
                labels[i] = k;
            }
        }
        sum += distances[i];
    }
    return sum;
}

/// An empty cluster takes the row that is farthest from its own centre, out of a cluster that has others.
void fill_empty(std::size_t count, Labels& labels, std::vector<double>& distances) {
    std::vector<std::size_t> sizes(count, 0);
    for (const std::size_t k : labels) ++sizes[k];
    for (std::size_t k = 0; k < count; ++k) {
        if (sizes[k] != 0) continue;
        std::size_t farthest = labels.size();
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (sizes[labels[i]] > 1 && (farthest == labels.size() || distances[i] > distances[farthest])) farthest = i;
        }
        --sizes[labels[farthest]];
        labels[farthest] = k;
        distances[farthest] = 0.0;
        sizes[k] = 1;
    }
}

std::vector<double> means(const Rows& rows, const Labels& labels, std::size_t count) {
    std::vector<double> centres(count * rows.width, 0.0), sizes(count, 0.0);
    for (std::size_t i = 0; i < rows.count; ++i) {
        sizes[labels[i]] += 1.0;
        for (std::size_t c = 0; c < rows.width; ++c) centres[labels[i] * rows.width + c] += rows.row(i)[c];
    }
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t c = 0; c < rows.width; ++c) centres[k * rows.width + c] /= sizes[k];
    }
    return centres;
}

/// Lloyd's rounds from one start. @returns the sum of squared distances to the clusters' means.
double k_means(const Rows& rows, std::size_t count, Random& random, Labels& labels) {
    std::vector<double> centres = first_centres(rows, count, random), distances(rows.count);
    Labels before;
    double sum = 0.0;
    for (int round = 0; round < kMostRounds; ++round) {
        sum = assign_nearest(rows, count, centres, labels, distances);
        fill_empty(count, labels, distances);
        if (labels == before) break;
        before = labels;
        centres = means(rows, labels, count);
    }
    return sum;
}

}  // namespace

Result<std::vector<std::vector<DroneId>>> spectral_clusters(const SpectralKeyframe& keyframe, std::size_t count,
                                                            std::uint64_t seed, const Run& run) {
    const std::size_t n = keyframe.positions_m.size();
    AEROGRAM_REQUIRE(count >= 1 && count <= n && keyframe.graph.n >= n, count, n, keyframe.graph.n);
    const auto basis = low_eigenbasis(keyframe.graph, count - 1, run);
    if (!basis) return basis.error();
    Rows rows{n, basis->modes.columns, std::vector<double>(n * basis->modes.columns)};
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < rows.width; ++c) rows.values[i * rows.width + c] = basis->modes(i, c);
    }
    Random random(seed);
    Labels best, labels(n, 0);
    double best_sum = std::numeric_limits<double>::infinity();
    for (int start = 0; start < kStarts; ++start) {
        if (run.stopped()) return stopped_error();
        const double sum = k_means(rows, count, random, labels);
        if (sum < best_sum) {
            best_sum = sum;
            best = labels;
        }
    }
    std::vector<std::vector<DroneId>> clusters(count);
    for (std::size_t i = 0; i < n; ++i) clusters[best[i]].push_back(DroneId(i));
    std::ranges::sort(clusters);  // members ascend, so that is by the first
    return clusters;
}

}  // namespace aerogram::planner
