#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geo/color.hpp"
#include "geo/vec3.hpp"
#include "planner/formation/svg_ink.hpp"

namespace aerogram::planner {

/// The colours of a drawing by place, painted once on a raster of about a million cells.
class InkColors {
  public:
    explicit InkColors(const Ink& ink);

    /// The topmost colour within `reach` of a place, or the nearest one.
    [[nodiscard]] Rgb at(const Vec2& place, double reach) const;

  private:
    [[nodiscard]] std::uint32_t layer(std::ptrdiff_t column, std::ptrdiff_t row) const;
    void paint(const Region& area, std::uint32_t layer);

    std::vector<Rgb> light_;          ///< one a layer
    std::vector<std::uint32_t> top_;  ///< one a cell: the layer + 1; 0: none
    std::ptrdiff_t across_ = 0, up_ = 0;
    Vec2 low_{};
    double cell_ = 1.0;
};

}  // namespace aerogram::planner
