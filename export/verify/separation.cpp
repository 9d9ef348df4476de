// Smallest separation of a recorded show: time is cut into slabs until drones move little in each, close pairs of boxes
// come from a grid, and each pair's difference polynomials are bounded by their control points' hull, halved while
// inconclusive.
#include <algorithm>
#include <cmath>
#include <limits>

#include "export/verify/close_pairs.hpp"
#include "export/verify/judge.hpp"
#include "export/verify/slab.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kLongestSlab_s = 16.0;
constexpr double kMostParts = 1e5;
constexpr double kShortestSlab_s = 0.02;
constexpr double kStretchesADrone = 6.0;
constexpr double kRoundoff_m = 1e-9;  ///< of all arithmetic here, for coordinates within 1e5 m
constexpr int kHalvings = 60;

struct Best {
    double lower_m = 0.0;  ///< starts at the distance beyond which nothing is of interest
    double resolved_m = 0.0;
    double attained_m = std::numeric_limits<double>::infinity();
    std::uint32_t first = 0, second = 0;
    double time_s = 0.0;

    void attain(double distance_m, double t_s, std::uint32_t i, std::uint32_t j) {
        if (distance_m < attained_m) {
            attained_m = distance_m;
            time_s = t_s;
            first = i;
            second = j;
        }
    }
};

struct Pair {
    std::uint32_t first = 0, second = 0;
};

/// Bounds the distance of a difference curve from the origin on [begin_s, end_s].
void bound_difference(const Bezier& difference, double begin_s, double end_s, Pair pair, int halvings, Best& best) {
    const Vec3 a = difference.front(), chord = difference.back() - a;
    const double chord2 = glm::dot(chord, chord);
    const double share = chord2 > 0.0 ? std::clamp(-glm::dot(a, chord) / chord2, 0.0, 1.0) : 0.0;
    const Vec3 nearest = a + share * chord;
    const double length = glm::length(nearest);
    double lower = 0.0;
    if (length > 0.0) {
        lower = std::numeric_limits<double>::infinity();
        for (const Vec3& p : difference.controls()) lower = std::min(lower, glm::dot(nearest, p) / length);
        lower = std::max(lower, 0.0);
    }
    if (lower >= best.lower_m) return;
    best.attain(glm::length(a), begin_s, pair.first, pair.second);
    best.attain(glm::length(difference.back()), end_s, pair.first, pair.second);
    if (share > 0.0 && share < 1.0) {
        best.attain(glm::length(value(difference, share)), begin_s + share * (end_s - begin_s), pair.first,
                    pair.second);
    }
    if (halvings == 0 || lower >= best.attained_m - best.resolved_m) {
        best.lower_m = lower;
        return;
    }
    const auto [left, right] = split(difference, 0.5);
    const double middle_s = 0.5 * (begin_s + end_s);
    bound_difference(left, begin_s, middle_s, pair, halvings - 1, best);
    bound_difference(right, middle_s, end_s, pair, halvings - 1, best);
}

Bezier stretch_curve(const Slab& slab, const Stretch& stretch, double begin_s, double end_s) {
    Bezier curve;
    curve.degree = stretch.degree;
    std::copy_n(slab.controls_m.begin() + stretch.first_control, stretch.degree + 1, curve.control.begin());
    if (begin_s == stretch.begin_s && end_s == stretch.end_s) return curve;
    const double duration_s = stretch.end_s - stretch.begin_s;
    return restricted(curve, (begin_s - stretch.begin_s) / duration_s, (end_s - stretch.begin_s) / duration_s);
}

void bound_pair(const Slab& slab, Pair pair, Best& best) {
    const auto first = slab.of(pair.first), second = slab.of(pair.second);
    for (std::size_t i = 0, j = 0; i < first.size() && j < second.size();) {
        const Stretch &a = first[i], &b = second[j];
        const double begin_s = std::max(a.begin_s, b.begin_s), end_s = std::min(a.end_s, b.end_s);
        if (!(a.on_ground && b.on_ground) && end_s > begin_s) {
            const std::size_t degree = std::max(a.degree, b.degree);
            Bezier difference = elevated(stretch_curve(slab, a, begin_s, end_s), degree);
            const Bezier other = elevated(stretch_curve(slab, b, begin_s, end_s), degree);
            for (std::size_t c = 0; c <= degree; ++c) difference.control[c] -= other.control[c];
            bound_difference(difference, begin_s, end_s, pair, kHalvings, best);
        }
        if (a.end_s <= b.end_s) ++i;
        if (b.end_s <= a.end_s) ++j;
    }
}

/// The workspace of one thread's part of the show, and what it found.
struct Search {
    const Timelines& shows;
    const Run& run;
    double longest_extent_m;  ///< the boxes' mean above which a slab is halved
    Best best;
    std::vector<Box> boxes;
    Slab slab;
    CloseBoxes close;

    /// False once two drones meet as nearly as is resolved: then the bound is 0 and nothing worse can be found.
    bool goes_on() {
        if (run.stopped()) return false;
        if (best.attained_m > best.resolved_m) return true;
        best.lower_m = 0.0;
        return false;
    }

    void search(double begin_s, double end_s) {
        if (!goes_on()) return;
        const SlabSize size = measure(shows, begin_s, end_s, boxes);
        const bool much = size.mean_extent_m > longest_extent_m ||
                          static_cast<double>(size.stretches) > kStretchesADrone * static_cast<double>(boxes.size());
        if (much && end_s - begin_s > kShortestSlab_s) {
            const double middle_s = 0.5 * (begin_s + end_s);
            search(begin_s, middle_s);
            search(middle_s, end_s);
            return;
        }
        cut(shows, begin_s, end_s, slab);
        close.find(slab.boxes, best.lower_m, size.mean_extent_m, [&](std::uint32_t i, std::uint32_t j) {
            if (slab.grounded[i] != 0 && slab.grounded[j] != 0) return goes_on();
            if (slab.boxes[i].gap(slab.boxes[j]) >= best.lower_m) return goes_on();
            bound_pair(slab, {i, j}, best);
            return goes_on();
        });
    }
};

}  // namespace

Result<VerifiedSeparation> verify_separation(const RecordedShow& show, double downwash, double beyond_m, const Run& run,
                                             const SeparationSearch& search) {
    if (const Status sound = well_formed(show); !sound) return sound.error();
    if (!(downwash >= 1.0) || !(beyond_m > 0.0) || !std::isfinite(beyond_m) || !std::isfinite(downwash)) {
        return Error{ErrorCode::invalid_input, "separation: downwash must be >= 1 and the distance looked at > 0"};
    }
    VerifiedSeparation result{beyond_m, std::numeric_limits<double>::infinity(), 0, 0, 0.0};
    if (show.drones.size() < 2 || !show.timed) return result;
    const Timelines shows = timelines(show.drones, downwash);
    const double begin_s = std::max(shows.begin_s, search.begin_s), finish_s = std::min(shows.end_s, search.end_s);
    if (!(finish_s > begin_s)) return result;
    const double span_s = finish_s - begin_s;
    const auto parts = static_cast<std::size_t>(std::ceil(std::min(span_s / kLongestSlab_s, kMostParts)));
    std::vector<Best> found(parts);
    parallel_for(parts, run, "verifying separation", [&](std::size_t part) {
        const auto at = [&](std::size_t k) {
            return begin_s + span_s * (static_cast<double>(k) / static_cast<double>(parts));
        };
        Search part_search{shows, run, 0.5 * beyond_m, {.lower_m = beyond_m, .resolved_m = search.resolved_m}, {},
                           {},    {}};
        part_search.search(at(part), part + 1 == parts ? finish_s : at(part + 1));
        found[part] = part_search.best;
    });
    if (run.stopped()) return stopped_error();
    for (const Best& best : found) {
        result.lower_bound_m = std::min(result.lower_bound_m, best.lower_m);
        if (best.attained_m < result.attained_m) {
            result.attained_m = best.attained_m;
            result.first = best.first;
            result.second = best.second;
            result.time_s = best.time_s;
        }
    }
    if (result.lower_bound_m < beyond_m) result.lower_bound_m = std::max(0.0, result.lower_bound_m - kRoundoff_m);
    return result;
}

}  // namespace aerogram::exporter
