#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "planner/sampling/site_grid.hpp"
#include "planner/sketch/sketch_region.hpp"

namespace aerogram::planner {
namespace {

constexpr double kSame = 1e-9;   ///< sketch sizes; places nearer than this are one
constexpr double kProbe = 1e-6;  ///< sketch sizes; how far to the side the area is looked for
constexpr double kParallel = 1e-12;
constexpr std::size_t kCutsAtMost = 20'000;  ///< of a curve; scribbles beyond it are judged by longer pieces

/// A place on a curve where another line meets it.
struct Cut {
    std::size_t edge = 0;
    double along = 0.0;  ///< [0, 1]
    Vec2 at{};
};

/// A piece of a boundary between two cuts, the area on its left.
struct Arc {
    std::vector<Vec2> points;
    bool closed = false;

    /// The longest chord begins at this point; absent where all are of no length.
    [[nodiscard]] std::optional<std::size_t> longest_chord() const {
        std::optional<std::size_t> best;
        double longest = 0.0;
        for (std::size_t i = 0; i + 1 < points.size() + (closed ? 1 : 0); ++i) {
            const double length = glm::distance(points[i], after(i));
            if (length <= longest) continue;
            longest = length;
            best = i;
        }
        return best;
    }
    [[nodiscard]] const Vec2& after(std::size_t i) const { return points[i + 1 < points.size() ? i + 1 : 0]; }
};

class Outliner {
  public:
    explicit Outliner(const SketchRegion& region)
        : region_(region), size_(glm::length(region.bounds().size())), cuts_(region.curves().size()) {}

    std::vector<SketchPath> outlines() {
        const auto& curves = region_.curves();
        for (std::size_t a = 0; a < curves.size(); ++a) {
            for (std::size_t b = a; b < curves.size(); ++b) cut_each_other(a, b);
        }
        for (std::size_t c = 0; c < curves.size(); ++c) add_arcs(c);
        remove_doubles();
        return joined();
    }

  private:
    void cut_each_other(std::size_t a, std::size_t b) {
        const ClosedCurve &one = region_.curves()[a], &other = region_.curves()[b];
        const double apart = kSame * size_;
        if (one.bounds().low.x > other.bounds().high.x + apart || other.bounds().low.x > one.bounds().high.x + apart ||
            one.bounds().low.y > other.bounds().high.y + apart || other.bounds().low.y > one.bounds().high.y + apart)
            return;
        for (std::size_t k = 0; k < one.corners().size(); ++k) {
            const Vec2 &p = one.from(k), &q = one.to(k);
            other.edges_between(std::min(p.y, q.y), std::max(p.y, q.y), [&](std::size_t e) {
                if (a == b && e <= k) return;
                const Vec2 &r = other.from(e), &s = other.to(e);
                if (std::max(r.x, s.x) < std::min(p.x, q.x) - kSame * size_ ||
                    std::min(r.x, s.x) > std::max(p.x, q.x) + kSame * size_)
                    return;
                const std::size_t n = one.corners().size();
                if (a == b && (e == k + 1 || (k == 0 && e + 1 == n))) return;  // neighbours share a corner
                cut_edges(a, k, b, e);
            });
        }
    }

    void cut_edges(std::size_t a, std::size_t k, std::size_t b, std::size_t e) {
        const Vec2 p = region_.curves()[a].from(k), q = region_.curves()[a].to(k);
        const Vec2 r = region_.curves()[b].from(e), s = region_.curves()[b].to(e);
        const Vec2 u = q - p, v = s - r;
        const double across = u.x * v.y - u.y * v.x, lengths = glm::length(u) * glm::length(v);
        if (lengths <= 0.0 || std::max(cuts_[a].size(), cuts_[b].size()) >= kCutsAtMost) return;
        if (std::abs(across) > kParallel * lengths) {
            const double t = ((r.x - p.x) * v.y - (r.y - p.y) * v.x) / across;
            const double w = ((r.x - p.x) * u.y - (r.y - p.y) * u.x) / across;
            const double slack_t = kSame * size_ / glm::length(u), slack_w = kSame * size_ / glm::length(v);
            if (t < -slack_t || t > 1.0 + slack_t || w < -slack_w || w > 1.0 + slack_w) return;
            const Vec2 at = p + std::clamp(t, 0.0, 1.0) * u;
            cuts_[a].push_back({k, std::clamp(t, 0.0, 1.0), at});
            cuts_[b].push_back({e, std::clamp(w, 0.0, 1.0), at});
            return;
        }
        if (std::abs(turn_of(p, q, r)) > kSame * size_ * glm::length(u)) return;
        cut_where(a, k, {r, s});
        cut_where(b, e, {p, q});
    }

    /// Edges that lie on one another cut each other where they end.
    void cut_where(std::size_t curve, std::size_t edge, std::initializer_list<Vec2> places) {
        const Vec2 p = region_.curves()[curve].from(edge), u = region_.curves()[curve].to(edge) - p;
        for (const Vec2& place : places) {
            const double t = glm::dot(place - p, u) / glm::dot(u, u);
            if (t >= 0.0 && t <= 1.0) cuts_[curve].push_back({edge, t, place});
        }
    }

    void add_arcs(std::size_t c) {
        const Contour& corners = region_.curves()[c].corners();
        std::vector<Cut>& cuts = cuts_[c];
        std::sort(cuts.begin(), cuts.end(),
                  [](const Cut& a, const Cut& b) { return a.edge != b.edge ? a.edge < b.edge : a.along < b.along; });
        if (cuts.empty()) return add_arc({corners, true});
        for (std::size_t i = 0; i < cuts.size(); ++i) {
            const Cut &from = cuts[i], &to = cuts[(i + 1) % cuts.size()];
            Arc arc{{from.at}, false};
            std::size_t steps = (to.edge + corners.size() - from.edge) % corners.size();
            if (steps == 0 && i + 1 == cuts.size()) steps = corners.size();  // once round
            for (std::size_t s = 1; s <= steps; ++s) {
                const Vec2& corner = corners[(from.edge + s) % corners.size()];
                if (glm::distance(corner, arc.points.back()) > kSame * size_) arc.points.push_back(corner);
            }
            if (glm::distance(to.at, arc.points.back()) > kSame * size_) {
                arc.points.push_back(to.at);
            } else if (arc.points.size() > 1) {
                arc.points.back() = to.at;
            }
            if (arc.points.size() > 1) add_arc(std::move(arc));
        }
    }

    void add_arc(Arc arc) {
        const auto chord = arc.longest_chord();
        if (!chord) return;
        const Vec2 a = arc.points[*chord], b = arc.after(*chord);
        const Vec2 aside = (kProbe * size_ / glm::distance(a, b)) * Vec2(a.y - b.y, b.x - a.x);
        const bool left = region_.contains(0.5 * (a + b) + aside), right = region_.contains(0.5 * (a + b) - aside);
        if (left == right) return;
        if (right) std::reverse(arc.points.begin(), arc.points.end());
        arcs_.push_back(std::move(arc));
    }

    /// Of boundaries drawn over each other, one stays.
    void remove_doubles() {
        if (arcs_.empty()) return;
        std::vector<Vec2> middles;
        for (const Arc& arc : arcs_) {
            const std::size_t chord = *arc.longest_chord();
            middles.push_back(0.5 * (arc.points[chord] + arc.after(chord)));
        };
        const SiteGrid grid(middles, 2.0 * kProbe * size_);
        std::vector<Arc> kept;
        for (std::size_t i = 0; i < arcs_.size(); ++i) {
            bool doubled = false;
            grid.near(middles[i], 1, [&](std::size_t j, const Vec2& at) {
                doubled = doubled || (j < i && glm::distance(at, middles[i]) < kProbe * size_);
            });
            if (!doubled) kept.push_back(arcs_[i]);
        }
        arcs_ = std::move(kept);
    }

    /// Arcs end to end. One whose end finds no other becomes an open path (rounding only).
    std::vector<SketchPath> joined() const {
        std::vector<SketchPath> out;
        std::vector<Vec2> starts;
        for (const Arc& arc : arcs_) starts.push_back(arc.points.front());
        const double same = 4.0 * kSame * size_;
        const SiteGrid grid(starts, 2.0 * same);
        std::vector<bool> used(arcs_.size(), false);
        const auto next_of = [&](const Vec2& end) {
            std::optional<std::size_t> best;
            grid.near(end, 1, [&](std::size_t i, const Vec2& at) {
                if (!used[i] && glm::distance(at, end) <= same && (!best || i < *best)) best = i;
            });
            return best;
        };
        for (std::size_t first = 0; first < arcs_.size(); ++first) {
            if (used[first]) continue;
            used[first] = true;
            SketchPath path{arcs_[first].points, arcs_[first].closed};
            while (!path.closed) {
                if (glm::distance(path.points.back(), path.points.front()) <= same) {
                    path.points.pop_back();
                    path.closed = true;
                    break;
                }
                const auto next = next_of(path.points.back());
                if (!next) break;
                used[*next] = true;
                const auto& more = arcs_[*next].points;
                path.points.insert(path.points.end(), more.begin() + 1, more.end());
            }
            out.push_back(std::move(path));
        }
        return out;
    }

    const SketchRegion& region_;
    double size_;
    std::vector<std::vector<Cut>> cuts_;  ///< by curve
    std::vector<Arc> arcs_;
};

}  // namespace

std::vector<SketchPath> outlines_of(const SketchRegion& region) {
    return Outliner(region).outlines();
}

}  // namespace aerogram::planner
