#include "planner/transition/rigid_turns.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

#include "geo/units.hpp"
#include "planner/transition/alignment.hpp"
#include "planner/transition/columns.hpp"

namespace aerogram::planner {
namespace {

constexpr int kMostSweeps = 24;       ///< of following the neighbours; what is open spreads one neighbour a sweep
constexpr double kSettled = 1e-16;    ///< squared change of a rotation's axes in a sweep that changes nothing any more
constexpr double kFollow = 0.1;       ///< how much neighbours' rotations count beside the own ring
constexpr double kHome = 1e-10;       ///< how much no rotation counts: decides what no neighbour decides
constexpr double kHomeAxis = 1e-12;   ///< and turning about the thinnest axis, where even that leaves a tie
constexpr double kFlatValue = 1e-12;  ///< share of the largest singular value that is rounding error

void add(Mat3& sum, const Mat3& m, double factor) {
    for (std::size_t c = 0; c < 3; ++c) sum.columns[c] += factor * m.columns[c];
}

double squared_difference(const Mat3& a, const Mat3& b) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        const Vec3 d = a.columns[c] - b.columns[c];
        sum += glm::dot(d, d);
    }
    return sum;
}

Mat3 right_handed(const Vec3& first, const Vec3& second) {
    const Vec3 a = glm::normalize(first), b = glm::normalize(second - glm::dot(second, a) * a);
    return Mat3{{a, b, glm::cross(a, b)}};
}

/// The rotation R with the largest trace of Rᵀ m.
Mat3 nearest_rotation(const Mat3& m) {
    const Svd3 svd = singular_values(m);
    if (!(svd.values[1] > kFlatValue * svd.values[0])) return {};
    const Mat3 u = right_handed(svd.u.columns[0], svd.u.columns[1]);
    const Mat3 v = right_handed(svd.v.columns[0], svd.v.columns[1]);
    Mat3 out = zero3();
    for (std::size_t c = 0; c < 3; ++c) out.add_outer(u.columns[c], v.columns[c]);
    return out;
}

double ring_weight(const RingGraph& graph, std::uint32_t i) {
    double sum = 0.0;
    for (std::uint32_t k = graph.starts[i]; k < graph.starts[i + 1]; ++k) sum += graph.weights[k];
    return sum > 0.0 ? sum : 1.0;
}

/// Σ w d_T d_Sᵀ / Σ w of every ring, d the unit directions to the neighbours: near and far ones count alike.
std::vector<Mat3> correlations(const RingGraph& graph, std::span<const Vec3> source_m, std::span<const Vec3> target_m) {
    std::vector<Mat3> out(graph.n, zero3());
    for (std::uint32_t i = 0; i < graph.n; ++i) {
        const double all = ring_weight(graph, i);
        for (std::uint32_t k = graph.starts[i]; k < graph.starts[i + 1]; ++k) {
            const std::uint32_t j = graph.neighbours[k];
            const Vec3 s = source_m[j] - source_m[i], t = target_m[j] - target_m[i];
            const double lengths = glm::length(s) * glm::length(t);
            if (lengths > 0.0) out[i].add_outer((graph.weights[k] / (all * lengths)) * t, s);
        }
    }
    return out;
}

/// What decides where nothing else does: no turn, or one about the thinnest axis.
Mat3 stillness(std::span<const Vec3> source_m) {
    const Vec3 thin = thinnest_axis(centred(source_m, barycentre(source_m)));
    Mat3 out = zero3();
    add(out, Mat3{}, kHome);
    out.add_outer(kHomeAxis * thin, thin);
    return out;
}

/// The rotation of each component as one body.
std::vector<Mat3> component_rotations(const RingGraph& graph, std::span<const Vec3> source_m,
                                      std::span<const Vec3> target_m, const Mat3& still) {
    const std::size_t count = graph.first_of.size();
    Points from_m(count, Vec3{}), to_m(count, Vec3{});
    std::vector<double> members(count, 0.0), lengths(count, 0.0);
    for (std::size_t i = 0; i < graph.n; ++i) {
        from_m[graph.component[i]] += source_m[i];
        to_m[graph.component[i]] += target_m[i];
        members[graph.component[i]] += 1.0;
    }
    std::vector<Mat3> out(count, zero3());
    for (std::size_t i = 0; i < graph.n; ++i) {
        const std::uint32_t c = graph.component[i];
        const Vec3 s = source_m[i] - from_m[c] / members[c], t = target_m[i] - to_m[c] / members[c];
        out[c].add_outer(t, s);
        lengths[c] += glm::length(s) * glm::length(t);
    }
    for (std::size_t c = 0; c < count; ++c) {
        Mat3 wish = still;
        if (lengths[c] > 0.0) add(wish, out[c], 1.0 / lengths[c]);
        out[c] = nearest_rotation(wish);
    }
    return out;
}

std::vector<Mat3> ring_rotations(const RingGraph& graph, std::span<const Vec3> source_m,
                                 std::span<const Vec3> target_m) {
    std::vector<Mat3> own = correlations(graph, source_m, target_m);
    const Mat3 still = stillness(source_m);
    const std::vector<Mat3> bodies = component_rotations(graph, source_m, target_m, still);
    std::vector<Mat3> now(graph.n), before(graph.n);
    for (std::size_t i = 0; i < graph.n; ++i) {
        add(own[i], still, 1.0);
        now[i] = bodies[graph.component[i]];
    }
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        double change = 0.0;
        std::swap(before, now);
        for (std::uint32_t i = 0; i < graph.n; ++i) {
            Mat3 wish = own[i];
            const double share = kFollow / ring_weight(graph, i);
            for (std::uint32_t k = graph.starts[i]; k < graph.starts[i + 1]; ++k) {
                add(wish, before[graph.neighbours[k]], share * graph.weights[k]);
            }
            now[i] = nearest_rotation(wish);
            change = std::max(change, squared_difference(now[i], before[i]));
        }
        if (change < kSettled) break;
    }
    return now;
}

/// The turn that is the same rotation by the other way round.
Turn other_way(const Turn& turn) {
    return {-turn.axis, 2.0 * kPi - turn.angle_rad};
}
Vec3 rotation_vector(const Turn& turn) {
    return turn.angle_rad * turn.axis;
}
double squared(const Vec3& v) {
    return glm::dot(v, v);
}

/// Chooses the branch of every turn.
class BranchWalk {
  public:
    BranchWalk(const RingGraph& graph, std::vector<Turn> turns, const Turn& fleet)
        : graph_(graph), turns_(std::move(turns)), fleet_(rotation_vector(fleet)), visited_(graph.n, false) {}

    std::vector<Turn> walked() {
        std::vector<std::uint32_t> roots = graph_.first_of;
        for (std::uint32_t i = 0; i < graph_.n; ++i) {
            std::uint32_t& root = roots[graph_.component[i]];
            if (turns_[i].angle_rad < turns_[root].angle_rad) root = i;
        }
        for (const std::uint32_t root : roots) walk_from(root);
        return std::move(turns_);
    }

  private:
    void walk_from(std::uint32_t root) {
        constexpr double kMayGoRound = 2.0 * kPi / 3.0, kTie = 1e-6;
        const Turn round = other_way(turns_[root]);
        if (turns_[root].angle_rad > kMayGoRound &&
            glm::length(rotation_vector(round) + fleet_) + kTie < glm::length(rotation_vector(turns_[root]) + fleet_)) {
            turns_[root] = round;
        }
        visit(root);
        while (!waiting_.empty()) {
            const std::uint32_t i = std::get<1>(waiting_.top());
            waiting_.pop();
            if (visited_[i]) continue;
            const Turn round_i = other_way(turns_[i]);
            if (strangeness(i, round_i) < strangeness(i, turns_[i])) turns_[i] = round_i;
            visit(i);
        }
    }

    void visit(std::uint32_t i) {
        visited_[i] = true;
        for (std::uint32_t k = graph_.starts[i]; k < graph_.starts[i + 1]; ++k) {
            const std::uint32_t j = graph_.neighbours[k];
            if (visited_[j]) continue;
            const Turn &a = turns_[i], &b = turns_[j];
            const double nearest = std::min(squared(rotation_vector(a) - rotation_vector(b)),
                                            squared(rotation_vector(a) - rotation_vector(other_way(b))));
            waiting_.emplace(nearest, j, i);
        }
    }

    /// How far a turn is from those of the neighbours that have theirs.
    double strangeness(std::uint32_t i, const Turn& turn) const {
        double sum = 0.0;
        for (std::uint32_t k = graph_.starts[i]; k < graph_.starts[i + 1]; ++k) {
            const std::uint32_t j = graph_.neighbours[k];
            if (visited_[j]) sum += graph_.weights[k] * squared(rotation_vector(turn) - rotation_vector(turns_[j]));
        }
        return sum;
    }

    using Waiting = std::tuple<double, std::uint32_t, std::uint32_t>;  ///< difference, who, from whom
    const RingGraph& graph_;
    std::vector<Turn> turns_;
    Vec3 fleet_;
    std::vector<bool> visited_;
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_;
};

}  // namespace

std::vector<Turn> ring_turns(const RingGraph& graph, std::span<const Vec3> source_m, std::span<const Vec3> target_m,
                             const Turn& fleet) {
    std::vector<Turn> turns;
    turns.reserve(graph.n);
    for (const Mat3& rotation : ring_rotations(graph, source_m, target_m)) turns.push_back(turn_of(rotation));
    return BranchWalk(graph, std::move(turns), fleet).walked();
}

}  // namespace aerogram::planner
