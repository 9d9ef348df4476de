#pragma once
#include <memory>
#include <string>

#include "geo/color.hpp"
#include "geo/result.hpp"
#include "geo/vec3.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::exporter {

/// A colour of the screen: sRGB, each in [0, 1], and how much it covers of what is below.
struct Ink {
    double r = 0.0, g = 0.0, b = 0.0, opacity = 1.0;
};
/// How a screen shows a lamp of this linear light.
[[nodiscard]] Ink lamp_ink(const Rgb& linear, double opacity = 1.0);

inline constexpr int kLargestCanvas_px = 8192;

/// A picture being drawn. Pixels from the top left corner, x right, y down; lengths in pixels, edges smoothed.
/// Property: (1) the same calls give the same bytes; no font and no setting of the system takes part.
class Canvas {
  public:
    /// @param width, height  in [1, kLargestCanvas_px].
    Canvas(int width, int height, const Ink& ground);
    Canvas(Canvas&&) noexcept;
    Canvas& operator=(Canvas&&) noexcept;
    ~Canvas();

    void rectangle(const Vec2& corner, const Vec2& size, const Ink& ink);
    void line(const Vec2& from, const Vec2& to, double width, const Ink& ink);
    void disc(const Vec2& middle, double radius, const Ink& ink);
    /// @param radius  of the middle of the line.
    void ring(const Vec2& middle, double radius, double width, const Ink& ink);
    /// The inside of a region whose coordinates are pixels from `at`.
    void fill(const planner::Region& region, const Vec2& at, const Ink& ink);
    /// Until the next `everywhere` only what is inside is drawn on.
    void only_inside(const Vec2& corner, const Vec2& size);
    void everywhere();

    /// The picture as a PNG file, 8-bit RGB. Errors: io when memory does not suffice.
    [[nodiscard]] Result<std::string> png() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aerogram::exporter
