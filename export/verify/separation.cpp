// Smallest separation of a recorded show: time is cut into slabs in which drones move little, close pairs of boxes come
// from a grid, and each pair's difference polynomials are bounded by their control points' hull, halved while
// inconclusive. Parts of a few slabs are searched apart from each other, whatever the threads.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "export/verify/close_pairs.hpp"
#include "export/verify/judge.hpp"
#include "export/verify/slab.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kTravelShare = 0.4;  ///< of the distance looked at: what drones fly in a slab
constexpr std::size_t kSlabsAPart = 8;
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

void bound_pair(const Timelines& shows, const Slab& slab, Pair pair, Best& best) {
    const auto first = slab.of(pair.first), second = slab.of(pair.second);
    for (std::size_t i = 0, j = 0; i < first.size() && j < second.size();) {
        const Stretch &a = first[i], &b = second[j];
        const double begin_s = std::max(a.begin_s, b.begin_s), end_s = std::min(a.end_s, b.end_s);
        if (end_s > begin_s && !shows.excuse(pair.first, a.stance, pair.second, b.stance)) {
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

/// True when the difference's control points all lie beyond a plane at that distance, seen along the mean of its ends:
/// what most pairs need.
bool clearly_beyond(std::span<const Vec3> a, std::span<const Vec3> b, double distance_m) {
    const Vec3 along = (a.front() - b.front()) + (a.back() - b.back());
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < a.size(); ++c) least = std::min(least, glm::dot(along, a[c] - b[c]));
    return least > 0.0 && least * least >= distance_m * distance_m * glm::dot(along, along);
}

Stance stance_at(const Timelines& shows, std::size_t drone, double t_s) {
    for (const Stay& stay : shows.stays[drone]) {
        if (t_s >= stay.begin_s && t_s <= stay.end_s) return stay.stance;
    }
    return Stance::flying;
}

/// The distance that two drones have at an instant of [begin_s, end_s], unless they are excused or too far apart to be
/// of interest: what every part of the search may start from.
Best start_of(const RecordedShow& show, const Timelines& shows, double begin_s, double end_s, double beyond_m,
              const SeparationSearch& search) {
    Best best{.lower_m = beyond_m, .resolved_m = search.resolved_m};
    if (!search.likely_closest) return best;
    const auto [i, j, t_s] = *search.likely_closest;
    if (i == j || std::max(i, j) >= show.drones.size() || !(t_s >= begin_s && t_s <= end_s)) return best;
    if (shows.excuse(i, stance_at(shows, i, t_s), j, stance_at(shows, j, t_s))) return best;
    Vec3 apart = position_at(show.drones[i], t_s) - position_at(show.drones[j], t_s);
    apart.z /= shows.downwash;
    if (glm::length(apart) >= beyond_m) return best;
    best.attain(glm::length(apart), t_s, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
    best.lower_m = best.attained_m;
    return best;
}

/// The workspace of one part of the show, and what was found there.
struct Search {
    const Timelines& shows;
    const Run& run;
    Best best;
    std::vector<Slab> slabs;
    CloseBoxes close;

    /// False once two drones meet as nearly as is resolved: then the bound is 0 and nothing worse can be found.
    bool goes_on() {
        if (best.attained_m > best.resolved_m) return true;
        best.lower_m = 0.0;
        return false;
    }

    bool look_at(const Slab& slab, Pair pair) {
        if (shows.excuse(pair.first, slab.stance[pair.first], pair.second, slab.stance[pair.second])) return true;
        const auto a = slab.of(pair.first), b = slab.of(pair.second);
        if (a.size() == 1 && b.size() == 1 && a[0].degree == b[0].degree) {
            const std::span<const Vec3> controls(slab.controls_m);
            const std::size_t count = std::size_t{a[0].degree} + 1;
            if (clearly_beyond(controls.subspan(a[0].first_control, count), controls.subspan(b[0].first_control, count),
                               best.lower_m))
                return true;
        } else if (slab.boxes[pair.first].gap(slab.boxes[pair.second]) >= best.lower_m) {
            return true;
        }
        bound_pair(shows, slab, pair, best);
        return goes_on();
    }

    void search(std::span<const double> times_s) {
        cut(shows, times_s, slabs);
        for (const Slab& slab : slabs) {
            if (run.stopped() || !goes_on()) return;
            close.find(slab.boxes, best.lower_m, [&](std::uint32_t i, std::uint32_t j) {
                return look_at(slab, {i, j});
            });
        }
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
    const Timelines shows = timelines(show, downwash, run);
    const double begin_s = std::max(shows.begin_s, search.begin_s), finish_s = std::min(shows.end_s, search.end_s);
    if (!(finish_s > begin_s)) return result;
    const std::vector<double> times_s = slab_times(shows, begin_s, finish_s, kTravelShare * beyond_m);
    const std::size_t slabs = times_s.size() - 1, parts = (slabs + kSlabsAPart - 1) / kSlabsAPart;
    const Best start = start_of(show, shows, begin_s, finish_s, beyond_m, search);
    std::vector<Best> found(parts);
    parallel_for(parts, run, "verifying separation", [&](std::size_t part) {
        const std::size_t first = part * kSlabsAPart, last = std::min(slabs, first + kSlabsAPart);
        Search part_search{shows, run, start, {}, {}};
        part_search.search(std::span(times_s).subspan(first, last - first + 1));
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
