#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sampling/stroke.hpp"

namespace aerogram::planner {

/// p -> x * p.x + y * p.y + at.
struct Affine {
    Vec2 x{1.0, 0.0}, y{0.0, 1.0}, at{};

    [[nodiscard]] Vec2 operator()(const Vec2& p) const { return x * p.x + y * p.y + at; }
    /// First `inner`, then this one.
    [[nodiscard]] Affine after(const Affine& inner) const {
        return {x * inner.x.x + y * inner.x.y, x * inner.y.x + y * inner.y.y, (*this)(inner.at)};
    }
    [[nodiscard]] double determinant() const { return x.x * y.y - x.y * y.x; }
};

enum class StepKind : std::uint8_t { move, line, curve, close };
/// One step of a pen. A curve is a cubic Bézier with the control points `first` and `second`.
struct PathStep {
    StepKind kind = StepKind::move;
    Vec2 first{}, second{}, to{};
};
using Path = std::vector<PathStep>;

/// Draws a path as SVG defines its commands, all places absolute.
class PathPen {
  public:
    void move(const Vec2& to);
    void line(const Vec2& to);
    void cubic(const Vec2& first, const Vec2& second, const Vec2& to);
    /// A cubic whose first control point mirrors the one before.
    void smooth_cubic(const Vec2& second, const Vec2& to);
    void quadratic(const Vec2& control, const Vec2& to);
    void smooth_quadratic(const Vec2& to);
    /// An elliptical arc as cubics of at most 90 degrees: 3e-4 of the radius off at most.
    /// Radii that are too small are scaled up; one of 0 gives a line (SVG 1.1, appendix F.6).
    void arc(const Vec2& radii, double turn_rad, bool large, bool sweep, const Vec2& to);
    void close();

    [[nodiscard]] const Vec2& here() const { return here_; }
    [[nodiscard]] const Path& path() const { return path_; }
    [[nodiscard]] Path take() { return std::move(path_); }

  private:
    enum class Last : std::uint8_t { other, cubic, quadratic };
    void begin();

    Path path_;
    Vec2 here_{}, start_{}, control_{};
    Last last_ = Last::other;
    bool open_ = false;
};

/// Every place of a path moved.
[[nodiscard]] Path transformed(const Path& path, const Affine& by);

/// Subpaths as chords; a closed one does not repeat its first point.
struct Chords {
    std::vector<Stroke> lines;
    std::vector<bool> closed;
};
/// @param tolerance  > 0: how far a chord may stray from its curve; chords of a curve also turn by 15 degrees at most.
/// Repeated points are one; subpaths of a single point are left out. A curve becomes 200 chords at most.
[[nodiscard]] Chords chords_of(const Path& path, double tolerance);

}  // namespace aerogram::planner
