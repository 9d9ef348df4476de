/// Continuous-time separation of a lattice (certificate.hpp, bound_separation).
///
/// Knot intervals are taken in blocks. Over a block a drone keeps near the chord of its curve, and so near that its
/// largest deviation, less the fleet's common one, is a stray of a few centimetres: the control points of a straight
/// line are its values at k - 1, so the control points of the difference are a hull of it. A SweptTree of the chords
/// gives the pairs that may be close. Each is then bounded by one plane for all control points of the block, by halves
/// of the block, and at last by the Bézier curves of single intervals. What is pruned against is known before the
/// blocks are begun, or comes from the block itself, so threads change nothing.
#include <algorithm>
#include <cmath>

#include "geo/vectorized.hpp"
#include "planner/motion/closest.hpp"
#include "planner/motion/lanes.hpp"
#include "planner/motion/swept_tree.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kBlocksInTask = 4;  ///< which share the order of one tree
constexpr std::size_t kSamples = 4;       ///< instants, beside the start, at which the fleet is measured first
constexpr std::size_t kObserved = 128;    ///< drones that stand for the fleet's common motion

/// Control points of one drone over a block: all x, all y, all z, `rows` each.
using Record = const double*;

/// Least extent of rows [begin, end) of the difference b - a along n; at least four rows.
AEROGRAM_VECTORIZED
double least_along(Record a, Record b, std::size_t rows, std::size_t begin, std::size_t end, const Vec3& n) {
    Lanes least = {1e300, 1e300, 1e300, 1e300};
    for (std::size_t k = begin; k < end; k += 4) {
        const std::size_t at = std::min(k, end - 4);
        Lanes p, q;
        load(a + at, p);
        load(b + at, q);
        Lanes along = n.x * (q - p);
        load(a + rows + at, p);
        load(b + rows + at, q);
        along += n.y * (q - p);
        load(a + 2 * rows + at, p);
        load(b + 2 * rows + at, q);
        along += n.z * (q - p);
        least = along < least ? along : least;
    }
    return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

/// Largest squared deviation of a record's rows from the chord, less the common one.
AEROGRAM_VECTORIZED
double stray_squared(Record a, const double* share, const double* common, std::size_t rows, const Vec3& from,
                     const Vec3& way) {
    Lanes most = {0.0, 0.0, 0.0, 0.0};
    for (std::size_t k = 0; k < rows; k += 4) {
        Lanes s, p, c, squared = {0.0, 0.0, 0.0, 0.0};
        load(share + k, s);
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t at = static_cast<std::size_t>(axis) * rows + k;
            load(a + at, p);
            load(common + at, c);
            p -= from[axis] + s * way[axis] + c;
            squared += p * p;
        }
        most = squared > most ? squared : most;
    }
    return std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
}

/// A lattice in the separation metric, as far as its flyers go.
struct Fleet {
    const Lattice& lattice;
    std::span<const std::uint32_t> flyers;
    SeparationMetric metric;

    [[nodiscard]] std::size_t intervals() const { return lattice.rows() - 3; }
    [[nodiscard]] Vec3 at(std::size_t row, std::size_t flyer) const {
        return metric.scaled(lattice.at(row, flyers[flyer]));
    }
    [[nodiscard]] Points at_knot(std::size_t knot) const {
        Points points(flyers.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i] = knot_value(at(knot, i), at(knot + 1, i), at(knot + 2, i));
        }
        return points;
    }
};

/// One block of knot intervals after another.
class BlockSearch {
  public:
    BlockSearch(const Fleet& fleet, std::size_t length, const Run& run)
        : fleet_(fleet),
          run_(run),
          rows_(length + 3),
          records_(3 * rows_ * fleet.flyers.size()),
          share_(rows_),
          common_(3 * rows_),
          from_(fleet.flyers.size()),
          to_(fleet.flyers.size()),
          strays_(fleet.flyers.size()) {}

    /// Intervals [begin, begin + count). @param closest  what is known; what is found joins it.
    void search(std::size_t begin, std::size_t count, SweptTree& tree, Closest& closest) {
        begin_ = begin;
        count_ = count;
        closest_ = &closest;
        read_records();
        measure_strays();
        tree.place(from_, to_, strays_);
        tree.for_each_close_pair(*this);
        closest.not_below(closest.enough_m());  // of all pairs that were not looked at
    }

    [[nodiscard]] double limit_m() const {
        return run_.stopped() ? -std::numeric_limits<double>::infinity() : closest_->enough_m();
    }
    void visit(std::uint32_t i, std::uint32_t j) {
        const Vec3 start = from_[j] - from_[i];
        closest_->attained(glm::length(start), i, j, time_share(0));
        examine(i, j, 0, count_, start, to_[j] - to_[i]);
    }

  private:
    [[nodiscard]] Record record(std::size_t i) const { return records_.data() + 3 * rows_ * i; }
    [[nodiscard]] Vec3 point(std::size_t i, std::size_t k) const {
        const Record r = record(i) + k;
        return {r[0], r[rows_], r[2 * rows_]};
    }
    [[nodiscard]] double time_share(std::size_t knot) const {
        return static_cast<double>(begin_ + knot) / static_cast<double>(fleet_.intervals());
    }

    /// A block that is shorter than its records repeats its last row, which leaves every hull as it is.
    void read_records() {
        constexpr std::size_t kAtOnce = 32;
        const std::size_t n = fleet_.flyers.size();
        for (std::size_t first = 0; first < n; first += kAtOnce) {
            for (std::size_t k = 0; k < rows_; ++k) {
                const std::size_t row = begin_ + std::min(k, count_ + 2);
                for (std::size_t i = first; i < std::min(n, first + kAtOnce); ++i) {
                    const Vec3 p = fleet_.at(row, i);
                    double* r = records_.data() + 3 * rows_ * i + k;
                    r[0] = p.x;
                    r[rows_] = p.y;
                    r[2 * rows_] = p.z;
                }
            }
        }
        for (std::size_t k = 0; k < rows_; ++k) {
            share_[k] = (static_cast<double>(std::min(k, count_ + 2)) - 1.0) / static_cast<double>(count_);
        }
    }

    void measure_strays() {
        const std::size_t n = from_.size();
        for (std::size_t i = 0; i < n; ++i) {
            from_[i] = knot_value(point(i, 0), point(i, 1), point(i, 2));
            to_[i] = knot_value(point(i, count_), point(i, count_ + 1), point(i, count_ + 2));
        }
        std::fill(common_.begin(), common_.end(), 0.0);
        const std::size_t every = (n + kObserved - 1) / kObserved;
        const double weight = 1.0 / static_cast<double>((n + every - 1) / every);
        for (std::size_t i = 0; i < n; i += every) {
            for (std::size_t k = 0; k < rows_; ++k) {
                const Vec3 off = point(i, k) - (from_[i] + share_[k] * (to_[i] - from_[i]));
                for (int axis = 0; axis < 3; ++axis) {
                    common_[static_cast<std::size_t>(axis) * rows_ + k] += weight * off[axis];
                }
            }
        }
        for (std::size_t i = 0; i < n; ++i) {
            strays_[i] =
                std::sqrt(stray_squared(record(i), share_.data(), common_.data(), rows_, from_[i], to_[i] - from_[i]));
        }
    }

    /// One pair on knots [a, b] of the block, where its difference is `start` and `end`; the start is known already.
    void examine(std::size_t i, std::size_t j, std::size_t a, std::size_t b, const Vec3& start, const Vec3& end) {
        closest_->attained(glm::length(end), i, j, time_share(b));
        const Vec3 nearest = start + nearest_share(start, end) * (end - start);
        const double length = glm::length(nearest);
        if (length > 0.0) {
            const double bound = least_along(record(i), record(j), rows_, a, b + 3, nearest / length);
            if (bound >= closest_->enough_m()) return;
        }
        if (b - a == 1) return examine_interval(i, j, a);
        const std::size_t middle = (a + b) / 2;
        const Vec3 half = difference_at_knot(i, j, middle);
        examine(i, j, a, middle, start, half);
        examine(i, j, middle, b, half, end);
    }
    [[nodiscard]] Vec3 difference(std::size_t i, std::size_t j, std::size_t k) const {
        return point(j, k) - point(i, k);
    }
    [[nodiscard]] Vec3 difference_at_knot(std::size_t i, std::size_t j, std::size_t knot) const {
        return knot_value(difference(i, j, knot), difference(i, j, knot + 1), difference(i, j, knot + 2));
    }
    void examine_interval(std::size_t i, std::size_t j, std::size_t a) {
        const Vec3 p0 = difference(i, j, a), p1 = difference(i, j, a + 1), p2 = difference(i, j, a + 2),
                   p3 = difference(i, j, a + 3);
        const Hull hull = {knot_value(p0, p1, p2), (2.0 * p1 + p2) / 3.0, (p1 + 2.0 * p2) / 3.0,
                           knot_value(p1, p2, p3)};
        bound_curve(hull, i, j, time_share(a), time_share(a + 1), *closest_);
    }

    const Fleet& fleet_;
    const Run& run_;
    std::size_t rows_, begin_ = 0, count_ = 0;
    std::vector<double> records_;
    std::vector<double> share_;   ///< of the chord, where a straight line has its control point k
    std::vector<double> common_;  ///< deviation of the observed drones on average, like a record
    Points from_, to_;
    std::vector<double> strays_;
    Closest* closest_ = nullptr;
};

/// Some instants of the act, measured exactly: a first upper bound.
Closest measure(const Fleet& fleet, double beyond_m, const Run& run) {
    const std::size_t samples = std::min(kSamples, fleet.intervals());
    std::vector<Closest> found(samples + 1, Closest(beyond_m));
    parallel_for(samples + 1, run, "", [&](std::size_t s) {
        const std::size_t knot = s * fleet.intervals() / samples;
        const double share = static_cast<double>(knot) / static_cast<double>(fleet.intervals());
        found[s] = closest_standing(fleet.at_knot(knot), beyond_m, share, run);
    });
    Closest closest(beyond_m);
    for (const Closest& one : found) closest.merge(one);
    return closest;
}

/// Knot intervals in a block: as many as keep the strays a small share of the distances in question. The deviation of L
/// intervals from their chord is about |Δ²P| L² / 8.
std::size_t block_length(const Fleet& fleet, const Closest& known) {
    constexpr double kStrayShare = 0.3;
    const std::size_t rows = fleet.lattice.rows(), n = fleet.flyers.size();
    const std::size_t every = (n + kObserved - 1) / kObserved, every_row = (rows + 63) / 64;
    double bend_m = 0.0, count = 0.0;
    for (std::size_t k = 1; k + 1 < rows; k += every_row) {
        Vec3 common{};
        std::vector<Vec3> bends;
        for (std::size_t i = 0; i < n; i += every) {
            bends.push_back(fleet.at(k + 1, i) - 2.0 * fleet.at(k, i) + fleet.at(k - 1, i));
            common += bends.back();
        }
        common /= static_cast<double>(bends.size());
        for (const Vec3& bend : bends) bend_m += glm::length(bend - common);
        count += static_cast<double>(bends.size());
    }
    const double wanted_squared = 8.0 * kStrayShare * std::max(0.0, known.enough_m()) / (bend_m / count + 1e-12);
    std::size_t length = 1;
    for (const std::size_t more : {5UL, 13UL, 29UL, 61UL}) {  // rows are then a power of two
        if (static_cast<double>(more * more) <= wanted_squared && more < 2 * fleet.intervals()) length = more;
    }
    return length;
}

}  // namespace

Result<Closest> bound_lattice(const Lattice& lattice, std::span<const std::uint32_t> flyers,
                              const SeparationMetric& metric, double beyond_m, const Run& run) {
    const Fleet fleet{lattice, flyers, metric};
    Closest closest = measure(fleet, beyond_m, run);
    if (run.stopped()) return stopped_error();
    const std::size_t intervals = fleet.intervals(), length = block_length(fleet, closest);
    const std::size_t task_length = length * kBlocksInTask, tasks = (intervals + task_length - 1) / task_length;
    std::vector<Closest> found(tasks, closest);
    parallel_for(tasks, run, "", [&](std::size_t task) {
        const std::size_t begin = task * task_length, end = std::min(intervals, begin + task_length);
        SweptTree tree(fleet.at_knot(begin), fleet.at_knot(end));
        BlockSearch search(fleet, length, run);
        for (std::size_t at = begin; at < end && !run.stopped(); at += length) {
            search.search(at, std::min(length, end - at), tree, found[task]);
        }
    });
    if (run.stopped()) return stopped_error();
    for (const Closest& one : found) closest.merge(one);
    return closest;
}

}  // namespace aerogram::planner
