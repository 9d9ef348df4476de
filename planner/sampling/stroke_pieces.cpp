#include "planner/sampling/stroke_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace aerogram::planner {
namespace {

constexpr double kSamePlace = 1e-6;  ///< share of `snap` below which two computed points are one

struct Segment {
    Vec2 a{}, b{};
};

double cross(const Vec2& u, const Vec2& v) {
    return u.x * v.y - u.y * v.x;
}

/// Share in [0, 1] along the segment of its point nearest to p.
double nearest_share(const Segment& s, const Vec2& p) {
    const Vec2 along = s.b - s.a;
    const double squared = glm::dot(along, along);
    return squared > 0.0 ? std::clamp(glm::dot(p - s.a, along) / squared, 0.0, 1.0) : 0.0;
}

Vec2 at_share(const Segment& s, double share) {
    return s.a + (s.b - s.a) * share;
}

/// The point of a stroke nearest to p.
Vec2 nearest_point(const Stroke& stroke, const Vec2& p) {
    Vec2 best = stroke.front();
    for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
        const Segment s{stroke[i], stroke[i + 1]};
        const Vec2 candidate = at_share(s, nearest_share(s, p));
        if (glm::distance(candidate, p) < glm::distance(best, p)) best = candidate;
    }
    return best;
}

void snap_ends(std::vector<Stroke>& strokes, double snap) {
    for (std::size_t i = 0; i < strokes.size(); ++i) {
        for (Vec2* end : {&strokes[i].front(), &strokes[i].back()}) {
            Vec2 target = *end;
            double nearest = snap;
            for (std::size_t j = 0; j < strokes.size(); ++j) {
                if (j == i) continue;
                const Vec2 candidate = nearest_point(strokes[j], *end);
                if (glm::distance(candidate, *end) >= nearest) continue;
                nearest = glm::distance(candidate, *end);
                target = candidate;
            }
            *end = target;
        }
    }
}

/// Adds to `cuts` the shares of `s` where `other` meets it.
void add_cuts(const Segment& s, const Segment& other, double tolerance, std::vector<double>& cuts) {
    for (const Vec2& end : {other.a, other.b}) {
        const double share = nearest_share(s, end);
        if (glm::distance(at_share(s, share), end) <= tolerance) cuts.push_back(share);
    }
    const Vec2 u = s.b - s.a, v = other.b - other.a;
    const double area = cross(u, v);
    if (std::abs(area) <= 1e-12 * glm::length(u) * glm::length(v)) return;  // parallel: their ends tell all
    const double share = cross(other.a - s.a, v) / area, other_share = cross(other.a - s.a, u) / area;
    if (share > 0.0 && share < 1.0 && other_share > 0.0 && other_share < 1.0) cuts.push_back(share);
}

std::size_t vertex_at(std::vector<Vec2>& vertices, const Vec2& p, double tolerance) {
    const auto found =
        std::find_if(vertices.begin(), vertices.end(), [&](const Vec2& v) { return glm::distance(v, p) <= tolerance; });
    if (found != vertices.end()) return static_cast<std::size_t>(found - vertices.begin());
    vertices.push_back(p);
    return vertices.size() - 1;
}

}  // namespace

StrokePieces cut_strokes(std::vector<Stroke> strokes, double snap) {
    snap_ends(strokes, snap);
    const double tolerance = kSamePlace * snap;
    std::vector<Segment> segments;
    for (const Stroke& stroke : strokes) {
        for (std::size_t i = 0; i + 1 < stroke.size(); ++i) segments.push_back({stroke[i], stroke[i + 1]});
    }
    StrokePieces out;
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        std::vector<double> cuts{0.0, 1.0};
        for (std::size_t j = 0; j < segments.size(); ++j) {
            if (j != i) add_cuts(segments[i], segments[j], tolerance, cuts);
        }
        std::sort(cuts.begin(), cuts.end());
        std::size_t last = vertex_at(out.vertices, segments[i].a, tolerance);
        for (const double cut : cuts) {
            const std::size_t next = vertex_at(out.vertices, at_share(segments[i], cut), tolerance);
            if (next == last) continue;
            if (seen.insert(std::minmax(last, next)).second) out.pieces.push_back({last, next});
            last = next;
        }
    }
    return out;
}

std::vector<Stroke> without_thickening(std::span<const Stroke> strokes, double distance) {
    std::vector<Stroke> kept;
    for (const Stroke& stroke : strokes) {
        const auto thickens = [&](const Stroke& earlier) {
            const auto is_near = [&](const Vec2& p) { return glm::distance(nearest_point(earlier, p), p) <= distance; };
            for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
                const Segment s{stroke[i], stroke[i + 1]};
                const double steps = std::ceil(glm::distance(s.a, s.b) / (0.5 * distance));
                for (double k = 0.0; k <= steps; k += 1.0) {
                    if (!is_near(at_share(s, steps > 0.0 ? k / steps : 0.0))) return false;
                }
            }
            return is_near(stroke.front());
        };
        if (std::none_of(kept.begin(), kept.end(), thickens)) kept.push_back(stroke);
    }
    return kept;
}

}  // namespace aerogram::planner
