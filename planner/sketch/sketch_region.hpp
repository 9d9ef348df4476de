#pragma once
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sampling/region.hpp"
#include "planner/sketch/closed_curve.hpp"

namespace aerogram::planner {

/// One drawn line, curves already broken into short chords. Any unit; x right, y up in the sketch's plane.
struct SketchStroke {
    std::vector<Vec2> points;
    bool closed = true;
    bool exclusive = false;  ///< a closed line that takes its inside away; nothing for open ones
};

/// A line that drones stand on.
struct SketchPath {
    std::vector<Vec2> points;
    bool closed = true;
};

/// The area of a sketch: what inclusive boundaries enclose and exclusive ones do not take away (paper 002, section
/// 3.1), whatever the order of the strokes. An inclusive boundary wholly inside a hole (an exclusive one that is itself
/// wholly inside an inclusive one) is an island: the hole does not take it away. Any depth. Open strokes enclose
/// nothing. Curves that cross themselves enclose what they wind round.
class SketchRegion {
  public:
    /// @param strokes  finite points; those with fewer than two different points (closed: three) enclose nothing.
    explicit SketchRegion(const std::vector<SketchStroke>& strokes);

    [[nodiscard]] bool contains(const Vec2& p) const;
    [[nodiscard]] const std::vector<ClosedCurve>& curves() const { return curves_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }  ///< of all strokes, open ones included

  private:
    [[nodiscard]] bool is_island(std::size_t inclusive, std::size_t exclusive) const {
        return island_[inclusive * curves_.size() + exclusive];
    }

    std::vector<ClosedCurve> curves_;
    std::vector<bool> exclusive_;
    std::vector<bool> island_;  ///< by inclusive, exclusive: the one is an island in the other's hole
    Bounds bounds_;
};

/// The lines around a sketch's area, their inside on the left: parts of the boundaries that have the area on one side
/// only, joined where boundaries cross. Where inclusive boundaries overlap they are one, and what an exclusive one cuts
/// off has no line.
/// Accuracy: boundaries nearer to each other than 1e-6 of the sketch's size count as one; crossings of a curve beyond
/// 20,000 are not looked for. Cost: O(edges + crossings) where edges are short.
[[nodiscard]] std::vector<SketchPath> outlines_of(const SketchRegion& region);

/// What drones stand on: the outlines, then the open strokes.
[[nodiscard]] std::vector<SketchPath> paths_of(const SketchRegion& region, const std::vector<SketchStroke>& strokes);

[[nodiscard]] double length_of(const SketchPath& path);

}  // namespace aerogram::planner
