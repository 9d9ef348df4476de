#include "planner/sketch/sketch_region.hpp"

namespace aerogram::planner {

SketchRegion::SketchRegion(const std::vector<SketchStroke>& strokes) {
    Region all;
    for (const SketchStroke& stroke : strokes) {
        if (stroke.points.empty()) continue;
        all.contours.push_back(stroke.points);
        if (!stroke.closed || stroke.points.size() < 3) continue;
        curves_.emplace_back(stroke.points);
        exclusive_.push_back(stroke.exclusive);
    }
    if (!all.contours.empty()) bounds_ = bounds_of(all);
    const std::size_t n = curves_.size();
    island_.assign(n * n, false);
    for (std::size_t hole = 0; hole < n; ++hole) {
        if (!exclusive_[hole]) continue;
        bool in_something = false;
        for (std::size_t i = 0; i < n && !in_something; ++i)
            in_something = !exclusive_[i] && curves_[i].holds(curves_[hole]);
        for (std::size_t i = 0; i < n && in_something; ++i)
            island_[i * n + hole] = !exclusive_[i] && curves_[hole].holds(curves_[i]);
    }
}

bool SketchRegion::contains(const Vec2& p) const {
    const std::size_t n = curves_.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (exclusive_[i] || !curves_[i].contains(p)) continue;
        bool taken = false;
        for (std::size_t e = 0; e < n && !taken; ++e)
            taken = exclusive_[e] && !is_island(i, e) && curves_[e].contains(p);
        if (!taken) return true;
    }
    return false;
}

std::vector<SketchPath> paths_of(const SketchRegion& region, const std::vector<SketchStroke>& strokes) {
    std::vector<SketchPath> paths = outlines_of(region);
    for (const SketchStroke& stroke : strokes) {
        if (!stroke.closed && !stroke.points.empty()) paths.push_back({stroke.points, false});
    }
    return paths;
}

double length_of(const SketchPath& path) {
    double length = 0.0;
    for (std::size_t i = 1; i < path.points.size(); ++i) length += glm::distance(path.points[i - 1], path.points[i]);
    if (path.closed && !path.points.empty()) length += glm::distance(path.points.back(), path.points.front());
    return length;
}

}  // namespace aerogram::planner
