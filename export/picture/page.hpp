#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "export/picture/canvas.hpp"
#include "export/picture/lettering.hpp"
#include "export/picture/sky_view.hpp"

/// What pictures of formations and of shows have in common. Lengths are in units: the page's width / 640.
namespace aerogram::exporter {

inline constexpr double kPageWidth = 640.0;
inline constexpr double kMargin = 12.0;
inline constexpr double kHeading = 34.0;     ///< the title's line, with what is above and below it
inline constexpr double kCaption = 16.0;     ///< a caption above a view
inline constexpr double kMarksLeft = 34.0;   ///< numbers left of a view
inline constexpr double kMarksBelow = 16.0;  ///< numbers below a view
inline constexpr double kTextSize = 11.0, kTitleSize = 14.0, kCaptionSize = 10.0, kLine = 15.0;

/// The page's title: what it shows, and in another colour what that belongs to; both are cut where they are too long.
void draw_title(Canvas& canvas, const Lettering& lettering, double unit_px, const std::string& title,
                const std::string& of);

/// A caption above a view, cut to its width.
void draw_caption(Canvas& canvas, const Lettering& lettering, const SkyView& view, double unit_px,
                  const std::string& text);

/// "3 of 12 drones that do not shine are outside"; empty when all are inside.
[[nodiscard]] std::string outside_text(const Box& frame, std::span<const PictureDrone> drones);

}  // namespace aerogram::exporter
