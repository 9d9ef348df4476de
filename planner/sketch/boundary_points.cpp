#include "planner/sketch/boundary_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

constexpr double kCornerCosine = 0.8660254;  ///< of 30 degrees
constexpr double kApart = 0.7;               ///< units
constexpr std::size_t kTriesAtMost = 32, kThinnedOneByOne = 200;
constexpr double kPointsAtMost = 2e5;

/// A corner of a path: where it is along it, and the cosine of its turn.
struct Corner {
    std::size_t path = 0;
    double along = 0.0, cosine = 1.0;
};

/// A path between two corners, or all of a closed one without.
struct Piece {
    std::size_t path = 0;
    double from = 0.0, length = 0.0;
    bool from_corner = true;  ///< its first point is a corner or an end
    bool with_end = false;    ///< the last piece of an open path has its end too
    bool alone = false;       ///< an open path for which there is one point only: its middle
};

/// The paths by length.
class Tracks {
  public:
    explicit Tracks(const std::vector<SketchPath>& paths) : paths_(paths) {
        for (const SketchPath& path : paths) {
            std::vector<double> along{0.0};
            const std::size_t n = path.points.size();
            for (std::size_t i = 1; i < n + (path.closed ? 1 : 0); ++i)
                along.push_back(along.back() + glm::distance(path.points[i - 1], path.points[i % n]));
            along_.push_back(std::move(along));
        }
    }
    [[nodiscard]] double length(std::size_t path) const { return along_[path].back(); }
    [[nodiscard]] double total() const {
        return std::accumulate(along_.begin(), along_.end(), 0.0,
                               [](double sum, const auto& a) { return sum + a.back(); });
    }
    [[nodiscard]] Vec2 at(std::size_t path, double distance) const {
        const std::vector<double>& along = along_[path];
        const auto& points = paths_[path].points;
        if (length(path) <= 0.0) return points.front();
        if (paths_[path].closed) distance -= length(path) * std::floor(distance / length(path));
        const auto after = std::upper_bound(along.begin() + 1, along.end() - 1, distance);
        const auto i = static_cast<std::size_t>(after - along.begin()) - 1;
        const Vec2 from = points[i], to = points[(i + 1) % points.size()];
        const double step = along[i + 1] - along[i];
        return step > 0.0 ? from + (to - from) * std::clamp((distance - along[i]) / step, 0.0, 1.0) : from;
    }
    /// The corners of all paths, sharpest first.
    [[nodiscard]] std::vector<Corner> corners() const {
        std::vector<Corner> out;
        for (std::size_t p = 0; p < paths_.size(); ++p) {
            const auto& points = paths_[p].points;
            const std::size_t n = points.size();
            for (std::size_t i = paths_[p].closed ? 0 : 1; i + (paths_[p].closed ? 0 : 1) < n; ++i) {
                const Vec2 in = points[i] - points[(i + n - 1) % n], on = points[(i + 1) % n] - points[i];
                const double lengths = glm::length(in) * glm::length(on);
                if (lengths <= 0.0) continue;
                const double cosine = glm::dot(in, on) / lengths;
                if (cosine < kCornerCosine) out.push_back({p, along_[p][i], cosine});
            }
        }
        std::stable_sort(out.begin(), out.end(), [](const Corner& a, const Corner& b) { return a.cosine < b.cosine; });
        return out;
    }

  private:
    const std::vector<SketchPath>& paths_;
    std::vector<std::vector<double>> along_;
};

/// Which paths and corners keep points where there are at most `count`.
std::vector<Piece> pieces_of(const std::vector<SketchPath>& paths, const Tracks& tracks, std::size_t count) {
    std::vector<Corner> corners = tracks.corners();
    std::vector<std::size_t> order(paths.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t p) { return tracks.length(p) <= 0.0; });
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return tracks.length(a) > tracks.length(b); });
    std::vector<std::size_t> needed(paths.size(), 0);
    std::size_t sum = 0;
    for (const std::size_t p : order) {
        if (sum == count) break;
        needed[p] = 1;
        ++sum;
    }
    for (const std::size_t p : order) {
        if (sum >= count) break;
        if (needed[p] == 0 || paths[p].closed) continue;
        needed[p] = 2;
        ++sum;
    }
    std::vector<std::vector<double>> kept(paths.size());
    for (const Corner& corner : corners) {
        if (sum >= count) break;
        if (needed[corner.path] == 0 || (!paths[corner.path].closed && needed[corner.path] == 1)) continue;
        if (!paths[corner.path].closed || !kept[corner.path].empty()) ++sum;  // a loop's one point moves to its corner
        kept[corner.path].push_back(corner.along);
    }
    std::vector<Piece> out;
    for (std::size_t p = 0; p < paths.size(); ++p) {
        if (needed[p] == 0) continue;
        const double length = tracks.length(p);
        if (!paths[p].closed && needed[p] == 1) {
            out.push_back({p, 0.5 * length, 0.0, true, false, true});
            continue;
        }
        std::vector<double>& at = kept[p];
        std::sort(at.begin(), at.end());
        const bool smooth = paths[p].closed && at.empty();
        if (smooth || !paths[p].closed) at.insert(at.begin(), 0.0);
        for (std::size_t k = 0; k < at.size(); ++k) {
            const bool last = k + 1 == at.size();
            const double end = !last ? at[k + 1] : paths[p].closed ? at.front() + length : length;
            out.push_back({p, at[k], end - at[k], !smooth, last && !paths[p].closed, false});
        }
    }
    return out;
}

/// Points none of which is nearer to another than a distance; asking takes the same time however many are refused.
class TakenPoints {
  public:
    TakenPoints(const Vec2& origin, double apart) : origin_(origin), apart_(apart) {}

    /// Takes the point unless one that is taken is too near.
    bool take(const Vec2& p) {
        const auto column = static_cast<std::int64_t>(std::floor((p.x - origin_.x) / apart_));
        const auto row = static_cast<std::int64_t>(std::floor((p.y - origin_.y) / apart_));
        for (std::int64_t r = row - 1; r <= row + 1; ++r) {
            for (std::int64_t c = column - 1; c <= column + 1; ++c) {
                const auto found = cells_.find({c, r});
                if (found == cells_.end()) continue;
                for (const Vec2& other : found->second)
                    if (glm::distance(p, other) < apart_) return false;
            }
        }
        cells_[{column, row}].push_back(p);
        return true;
    }

  private:
    Vec2 origin_;
    double apart_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Vec2>> cells_;
};

/// The points of pieces divided into steps, those too near to others left out.
std::vector<Vec2> points_of(const Tracks& tracks, const std::vector<Piece>& pieces,
                            const std::vector<std::size_t>& steps, double apart) {
    std::vector<Vec2> all;
    std::vector<bool> corner;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const Piece& piece = pieces[k];
        for (std::size_t s = 0; s < steps[k] + (piece.with_end ? 1U : 0U); ++s) {
            const double share = static_cast<double>(s) / static_cast<double>(steps[k]);
            all.push_back(tracks.at(piece.path, piece.from + piece.length * share));
            corner.push_back((s == 0 && piece.from_corner) || s == steps[k]);
        }
    }
    if (apart <= 0.0 || all.empty()) return all;
    TakenPoints grid(all.front(), apart);
    std::vector<bool> taken(all.size(), false);
    for (const bool corners : {true, false}) {
        for (std::size_t i = 0; i < all.size(); ++i)
            if (corner[i] == corners) taken[i] = grid.take(all[i]);
    }
    std::vector<Vec2> out;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (taken[i]) out.push_back(all[i]);
    return out;
}

/// Steps a piece so that they make `count` points: the longest steps are divided first.
std::vector<std::size_t> divided(const std::vector<Piece>& pieces, std::size_t count) {
    std::vector<std::size_t> steps(pieces.size(), 1);
    using Entry = std::pair<double, std::size_t>;
    const auto less = [](const Entry& a, const Entry& b) {
        return a.first != b.first ? a.first < b.first : a.second > b.second;
    };
    std::priority_queue<Entry, std::vector<Entry>, decltype(less)> longest(less);
    std::size_t points = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        points += pieces[k].with_end ? std::size_t{2} : std::size_t{1};
        if (!pieces[k].alone) longest.emplace(pieces[k].length, k);
    }
    for (; points < count && !longest.empty(); ++points) {
        const std::size_t k = longest.top().second;
        longest.pop();
        ++steps[k];
        longest.emplace(pieces[k].length / static_cast<double>(steps[k]), k);
    }
    return steps;
}

/// Takes the points away that stand closest to another one before them; of many too many, every so many.
void thin(std::vector<Vec2>& points, std::size_t count) {
    if (points.size() > count + kThinnedOneByOne) {
        std::vector<Vec2> kept;
        for (std::size_t k = 0; k < count; ++k) kept.push_back(points[k * points.size() / count]);
        points = std::move(kept);
    }
    while (points.size() > count) {
        std::size_t worst = 0;
        double closest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double gap = glm::distance(points[i], points[i - 1]);
            if (gap >= closest) continue;
            closest = gap;
            worst = i;
        }
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(worst));
    }
}

}  // namespace

std::vector<Vec2> resampled(const std::vector<SketchPath>& paths, double unit) {
    AEROGRAM_REQUIRE(unit > 0.0, unit);
    const Tracks tracks(paths);
    unit = std::max(unit, tracks.total() / kPointsAtMost);
    const std::vector<Piece> pieces = pieces_of(paths, tracks, std::numeric_limits<std::size_t>::max());
    std::vector<std::size_t> steps;
    for (const Piece& piece : pieces)
        steps.push_back(static_cast<std::size_t>(std::max(1.0, std::round(piece.length / unit))));
    return points_of(tracks, pieces, steps, kApart * unit);
}

std::vector<Vec2> resampled_exactly(const std::vector<SketchPath>& paths, std::size_t count) {
    AEROGRAM_REQUIRE(count >= 1, count);
    const Tracks tracks(paths);
    AEROGRAM_REQUIRE(tracks.total() > 0.0);
    std::vector<Vec2> out;
    std::size_t asked = count;
    for (std::size_t k = 0; k < kTriesAtMost; ++k) {
        const bool last = k + 1 == kTriesAtMost || static_cast<double>(asked) > kPointsAtMost;
        if (last) asked = count;  // then without regard to how near they come
        const std::vector<Piece> pieces = pieces_of(paths, tracks, asked);
        const double apart = last ? 0.0 : kApart * tracks.total() / static_cast<double>(asked);
        out = points_of(tracks, pieces, divided(pieces, asked), apart);
        if (out.size() >= count) break;
        asked += count - out.size();
    }
    thin(out, count);
    return out;
}

}  // namespace aerogram::planner
