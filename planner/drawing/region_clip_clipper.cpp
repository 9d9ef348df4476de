#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>

#include "planner/drawing/region_clip.hpp"

namespace aerogram::planner {
namespace {

namespace cl = ClipperLib;
constexpr double kHalfRange = 1e9;  ///< below Clipper's range for plain 64-bit products
constexpr std::size_t kPairsAtMost = 100'000'000, kMeetingsAtMost = 4'000'000;
constexpr std::size_t kEdgesAtMost = 60'000;  ///< joining what touches is quadratic in Clipper

/// Maps the box of all that goes in to Clipper's integers and back.
class Grid {
  public:
    void include(const Contour& contour) {
        for (const Vec2& p : contour) {
            low_ = glm::min(low_, p);
            high_ = glm::max(high_, p);
        }
    }
    [[nodiscard]] cl::Path rounded(const Contour& contour) const {
        cl::Path path;
        path.reserve(contour.size());
        for (const Vec2& p : contour) {
            const Vec2 q = (p - middle()) * scale();
            path.emplace_back(std::llround(q.x), std::llround(q.y));
        }
        return path;
    }
    [[nodiscard]] Contour back(const cl::Path& path) const {
        Contour contour;
        contour.reserve(path.size());
        for (const cl::IntPoint& p : path) {
            contour.push_back(middle() + Vec2(static_cast<double>(p.X), static_cast<double>(p.Y)) / scale());
        }
        return contour;
    }

  private:
    [[nodiscard]] Vec2 middle() const { return 0.5 * (low_ + high_); }
    [[nodiscard]] double scale() const {
        return kHalfRange / std::max({0.5 * (high_.x - low_.x), 0.5 * (high_.y - low_.y), 1e-300});
    }
    Vec2 low_{1e300}, high_{-1e300};
};

struct Span {
    cl::cInt y0, y1, x0, x1;
};

/// Whether a sweep over these paths is bounded: it walks upwards with all edges that reach the sweep's height.
bool affordable(std::initializer_list<const cl::Paths*> all) {
    std::vector<Span> edges;
    for (const cl::Paths* paths : all) {
        for (const cl::Path& path : *paths) {
            for (std::size_t i = 0; i < path.size(); ++i) {
                const cl::IntPoint &a = path[i], &b = path[(i + 1) % path.size()];
                edges.push_back({std::min(a.Y, b.Y), std::max(a.Y, b.Y), std::min(a.X, b.X), std::max(a.X, b.X)});
            }
        }
    }
    if (edges.size() > kEdgesAtMost) return false;
    std::sort(edges.begin(), edges.end(), [](const Span& a, const Span& b) { return a.y0 < b.y0; });
    std::vector<Span> active;
    std::size_t pairs = 0, meetings = 0;
    for (const Span& edge : edges) {
        std::size_t kept = 0;
        for (const Span& other : active) {
            if (other.y1 < edge.y0) continue;
            active[kept++] = other;
            meetings += other.x0 <= edge.x1 && edge.x0 <= other.x1 ? 1U : 0U;
        }
        pairs += active.size();
        if (pairs > kPairsAtMost || meetings > kMeetingsAtMost) return false;
        active.resize(kept);
        active.push_back(edge);
    }
    return true;
}

cl::Paths rounded(const Region& region, const Grid& grid) {
    cl::Paths paths;
    paths.reserve(region.contours.size());
    for (const Contour& contour : region.contours) {
        if (contour.size() > 2) paths.push_back(grid.rounded(contour));
    }
    return paths;
}

Region back(const cl::Paths& paths, const Grid& grid) {
    Region region;
    for (const cl::Path& path : paths) {
        if (path.size() > 2 && std::abs(cl::Area(path)) > 4e-12 * kHalfRange * kHalfRange) {
            region.contours.push_back(grid.back(path));
        }
    }
    return region;
}

std::optional<Region> combined(const Region& a, const Region& b, cl::ClipType how) {
    Grid grid;
    for (const Contour& contour : a.contours) grid.include(contour);
    for (const Contour& contour : b.contours) grid.include(contour);
    const cl::Paths first = rounded(a, grid), second = rounded(b, grid);
    if (!affordable({&first, &second})) return std::nullopt;
    cl::Clipper clipper(cl::ioStrictlySimple);
    clipper.AddPaths(first, cl::ptSubject, true);
    clipper.AddPaths(second, cl::ptClip, true);
    cl::Paths result;
    if (!clipper.Execute(how, result, cl::pftNonZero, cl::pftNonZero)) return std::nullopt;
    return back(result, grid);
}

/// Clipper throws on coordinates out of its range only, which the grid rules out; still nothing may escape the seam.
template <class Operation>
auto guarded(const Operation& operation) -> decltype(operation()) {
    try {
        return operation();
    } catch (const cl::clipperException&) {
        return std::nullopt;
    }
}

/// Labels boxes that touch, directly or through others, alike; absent when too many lie side by side.
std::optional<std::vector<std::size_t>> clusters(const std::vector<Bounds>& boxes) {
    std::vector<std::size_t> order(boxes.size()), leader(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) order[i] = leader[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return boxes[a].low.y != boxes[b].low.y ? boxes[a].low.y < boxes[b].low.y : a < b;
    });
    const auto find = [&](std::size_t i) {
        while (leader[i] != i) i = leader[i] = leader[leader[i]];
        return i;
    };
    std::vector<std::size_t> active;
    std::size_t pairs = 0;
    for (const std::size_t i : order) {
        std::erase_if(active, [&](std::size_t j) { return boxes[j].high.y < boxes[i].low.y; });
        pairs += active.size();
        if (pairs > 2 * kPairsAtMost) return std::nullopt;
        for (const std::size_t j : active) {
            if (boxes[j].low.x > boxes[i].high.x || boxes[i].low.x > boxes[j].high.x) continue;
            const std::size_t a = find(i), b = find(j);
            leader[std::max(a, b)] = std::min(a, b);
        }
        active.push_back(i);
    }
    for (std::size_t i = 0; i < leader.size(); ++i) leader[i] = find(i);
    return leader;
}

std::optional<Region> united_together(const std::vector<const Region*>& regions) {
    Grid grid;
    for (const Region* region : regions) {
        for (const Contour& contour : region->contours) grid.include(contour);
    }
    cl::Paths all;
    for (const Region* region : regions) {  // each by itself first: contours of two must not cancel
        const cl::Paths paths = rounded(*region, grid);
        if (!affordable({&paths})) return std::nullopt;
        cl::Paths own;
        cl::SimplifyPolygons(paths, own, cl::pftNonZero);
        all.insert(all.end(), own.begin(), own.end());
    }
    if (!affordable({&all})) return std::nullopt;
    cl::Clipper clipper(cl::ioStrictlySimple);
    clipper.AddPaths(all, cl::ptSubject, true);
    cl::Paths result;
    if (!clipper.Execute(cl::ctUnion, result, cl::pftPositive, cl::pftPositive)) return std::nullopt;
    return back(result, grid);
}

}  // namespace

double doubled_area(const Contour& contour) {
    double sum = 0.0;
    for (std::size_t i = 0; i < contour.size(); ++i) {
        const Vec2 a = contour[i] - contour[0], b = contour[(i + 1) % contour.size()] - contour[0];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

std::optional<Region> simplified(const Region& region, FillRule rule) {
    return guarded([&]() -> std::optional<Region> {
        Grid grid;
        for (const Contour& contour : region.contours) grid.include(contour);
        const cl::Paths paths = rounded(region, grid);
        if (!affordable({&paths})) return std::nullopt;
        cl::Clipper clipper(cl::ioStrictlySimple);
        clipper.AddPaths(paths, cl::ptSubject, true);
        const cl::PolyFillType type = rule == FillRule::evenodd ? cl::pftEvenOdd : cl::pftNonZero;
        cl::Paths result;
        if (!clipper.Execute(cl::ctUnion, result, type, type)) return std::nullopt;
        return back(result, grid);
    });
}

std::optional<Region> united(std::span<const Region> regions) {
    std::vector<const Region*> some;
    std::vector<Bounds> boxes;
    for (const Region& region : regions) {
        if (std::all_of(region.contours.begin(), region.contours.end(), [](const Contour& c) { return c.empty(); }))
            continue;
        some.push_back(&region);
        boxes.push_back(bounds_of(region));
    }
    const auto cluster = clusters(boxes);
    if (!cluster) return std::nullopt;
    std::vector<std::vector<const Region*>> groups(some.size());
    for (std::size_t i = 0; i < some.size(); ++i) groups[(*cluster)[i]].push_back(some[i]);
    Region out;
    for (const auto& group : groups) {
        if (group.empty()) continue;
        const auto one = guarded([&] { return united_together(group); });
        if (!one) return std::nullopt;
        out.contours.insert(out.contours.end(), one->contours.begin(), one->contours.end());
    }
    return out;
}

std::optional<Region> subtracted(const Region& from, const Region& what) {
    return guarded([&] { return combined(from, what, cl::ctDifference); });
}

std::optional<Region> intersected(const Region& a, const Region& b) {
    return guarded([&] { return combined(a, b, cl::ctIntersection); });
}

std::optional<Chords> clipped(const Chords& lines, const Region& region, Side side) {
    return guarded([&]() -> std::optional<Chords> {
        Grid grid;
        for (const Contour& contour : region.contours) grid.include(contour);
        for (const Stroke& line : lines.lines) grid.include(line);
        cl::Paths open;
        for (std::size_t i = 0; i < lines.lines.size(); ++i) {
            open.push_back(grid.rounded(lines.lines[i]));
            if (lines.closed[i]) open.back().push_back(open.back().front());
        }
        const cl::Paths window = rounded(region, grid);
        if (!affordable({&open, &window})) return std::nullopt;
        cl::Clipper clipper;
        clipper.AddPaths(open, cl::ptSubject, false);
        clipper.AddPaths(window, cl::ptClip, true);
        cl::PolyTree result;
        const cl::ClipType how = side == Side::inside ? cl::ctIntersection : cl::ctDifference;
        if (!clipper.Execute(how, result, cl::pftNonZero, cl::pftNonZero)) return std::nullopt;
        cl::Paths parts;
        cl::OpenPathsFromPolyTree(result, parts);
        Chords out;
        for (const cl::Path& part : parts) {
            if (part.size() < 2) continue;
            out.lines.push_back(grid.back(part));
            out.closed.push_back(false);
        }
        return out;
    });
}

}  // namespace aerogram::planner
