#include "planner/transition/rigid.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "geo/contract.hpp"
#include "planner/transition/alignment.hpp"
#include "planner/transition/columns.hpp"
#include "planner/transition/rigid_solver.hpp"
#include "planner/transition/rigid_turns.hpp"

namespace aerogram::planner {
namespace {

/// R^t of a turn.
Mat3 power(const Turn& turn, double t) {
    const double half = std::sin(0.5 * t * turn.angle_rad), cosine = std::cos(0.5 * t * turn.angle_rad);
    const double s = 2.0 * half * cosine, v = 2.0 * half * half;
    const Vec3& a = turn.axis;
    return Mat3{{Vec3{1.0 - v * (a.y * a.y + a.z * a.z), v * a.x * a.y + s * a.z, v * a.x * a.z - s * a.y},
                 Vec3{v * a.x * a.y - s * a.z, 1.0 - v * (a.x * a.x + a.z * a.z), v * a.y * a.z + s * a.x},
                 Vec3{v * a.x * a.z + s * a.y, v * a.y * a.z - s * a.x, 1.0 - v * (a.x * a.x + a.y * a.y)}}};
}

/// The prepared transition. With x = (1-t) S + t T + u, the normal equations of Σ w |x_j - x_i - wish_ij|² are
/// L u = wished - straight divergences; both sides vanish at the ends, so that these are met whatever the solver does.
class RigidTransition {
  public:
    RigidTransition(const SpectralKeyframe& source, const SpectralKeyframe& target)
        : graph_(ring_graph(source.graph, target.graph)),
          from_middle_m_(barycentre(source.positions_m)),
          to_middle_m_(barycentre(target.positions_m)),
          from_m_(centred(source.positions_m, from_middle_m_)),
          to_m_(centred(target.positions_m, to_middle_m_)),
          solver_(graph_) {
        const Turn back = alignment_turn(from_m_, to_m_, Align::kabsch);
        for (Vec3& p : to_m_) p = turned(back, 1.0, p);
        fleet_ = back.inverse();
        turns_ = ring_turns(graph_, from_m_, to_m_, fleet_);
        prepare_edges();
        turned_.resize(graph_.n);
        moved_m_.resize(graph_.n);
    }

    void at(double t, std::span<Vec3> out) {
        AEROGRAM_REQUIRE(out.size() == graph_.n, out.size(), graph_.n);
        for (std::size_t i = 0; i < graph_.n; ++i) turned_[i] = power(turns_[i], t);
        right_hand_side(t);
        solver_.solve(moved_m_);
        rest_components();
        const Mat3 fleet = power(fleet_, t);
        const Vec3 middle_m = (1.0 - t) * from_middle_m_ + t * to_middle_m_;
        for (std::size_t i = 0; i < graph_.n; ++i) {
            out[i] = middle_m + fleet * ((1.0 - t) * from_m_[i] + t * to_m_[i] + moved_m_[i]);
        }
    }

  private:
    /// One end's view of an edge, times its weight: the edge at the source, and at the target in that end's frame.
    struct View {
        Vec3 from{}, to{};
    };

    void prepare_edges() {
        from_sum_.assign(graph_.n, Vec3{});
        to_sum_.assign(graph_.n, Vec3{});
        to_seen_.resize(graph_.n);
        views_.resize(graph_.weights.size());
        for (std::size_t i = 0; i < graph_.n; ++i) {
            for (std::uint32_t k = graph_.starts[i]; k < graph_.starts[i + 1]; ++k) {
                const std::uint32_t j = graph_.neighbours[k];
                const Vec3 from_m = from_m_[j] - from_m_[i], to_m = to_m_[j] - to_m_[i];
                if (goes_with_the_fleet(turns_[i], turns_[j], from_m, to_m)) continue;
                const Vec3 from = graph_.weights[k] * from_m, to = graph_.weights[k] * to_m;
                views_[k] = {from, turned(turns_[j], -1.0, to)};
                from_sum_[i] += from;
                to_sum_[i] += to;
            }
            to_seen_[i] = turned(turns_[i], -1.0, to_sum_[i]);
        }
    }

    /// Between bodies that turn about themselves while they circle each other, an edge turns with neither of them: it
    /// goes straight as seen from the turning fleet where that fits at least twice as well.
    static bool goes_with_the_fleet(const Turn& one, const Turn& other, const Vec3& from_m, const Vec3& to_m) {
        const auto squared = [](const Vec3& v) { return glm::dot(v, v); };
        const double ends = squared(to_m - turned(one, 1.0, from_m)) + squared(to_m - turned(other, 1.0, from_m));
        return 4.0 * squared(to_m - from_m) < ends;
    }

    void right_hand_side(double t) {
        const double s = 1.0 - t;
        for (std::size_t i = 0; i < graph_.n; ++i) {
            const Vec3 straight = s * from_sum_[i] + t * to_sum_[i];
            Vec3 wished = turned_[i] * (s * from_sum_[i] + t * to_seen_[i]);
            for (std::uint32_t k = graph_.starts[i]; k < graph_.starts[i + 1]; ++k) {
                wished += turned_[graph_.neighbours[k]] * (s * views_[k].from + t * views_[k].to);
            }
            moved_m_[i] = straight - 0.5 * wished;
        }
    }

    /// The system leaves each component's place open: its barycentre goes straight, seen from the turning fleet.
    void rest_components() {
        Points mean_m(graph_.first_of.size(), Vec3{});
        std::vector<double> count(graph_.first_of.size(), 0.0);
        for (std::size_t i = 0; i < graph_.n; ++i) {
            mean_m[graph_.component[i]] += moved_m_[i];
            count[graph_.component[i]] += 1.0;
        }
        for (std::size_t i = 0; i < graph_.n; ++i) {
            moved_m_[i] -= mean_m[graph_.component[i]] / count[graph_.component[i]];
        }
    }

    RingGraph graph_;
    Vec3 from_middle_m_, to_middle_m_;
    Points from_m_, to_m_;  ///< about their barycentres, the target turned onto the source
    LaplacianSolver solver_;
    Turn fleet_;
    std::vector<Turn> turns_;
    Points from_sum_, to_sum_, to_seen_;  ///< weighted sums of each individual's turning edges; the last in its frame
    std::vector<View> views_;             ///< by place in graph_.neighbours, as the neighbour sees it
    std::vector<Mat3> turned_;            ///< of the instant asked for
    Points moved_m_;
};

}  // namespace

Result<Interpolation> rigid_transition(const SpectralKeyframe& source, const SpectralKeyframe& target, const Run& run) {
    const std::size_t n = source.positions_m.size();
    AEROGRAM_REQUIRE(n >= 1 && target.positions_m.size() == n && source.graph.n == n, n, target.positions_m.size());
    for (const Points* points : {&source.positions_m, &target.positions_m}) {
        for (const Vec3& p : *points) AEROGRAM_REQUIRE(is_finite(p), p.x, p.y, p.z);
    }
    if (run.stopped()) return stopped_error();
    auto transition = std::make_shared<RigidTransition>(source, target);
    if (run.stopped()) return stopped_error();
    return Interpolation([transition](double t, std::span<Vec3> out) { transition->at(t, out); });
}

}  // namespace aerogram::planner
