#pragma once
#include <span>
#include <string>
#include <vector>

#include "export/picture/canvas.hpp"
#include "export/picture/lettering.hpp"
#include "geo/color.hpp"
#include "geo/vec3.hpp"

/// Drones in the night sky, seen from one of three sides without perspective, with metre scales.
namespace aerogram::exporter {

struct PictureDrone {
    Vec3 at_m{};         ///< show frame
    Rgb color{};         ///< linear
    bool spare = false;  ///< shown as a hollow mark
};

/// front: as the audience looks (x right, z up); top: from above, the audience below (x right, y up); side: from the
/// right, the audience on the left (y right, z up).
enum class Side { front, top, side };
/// Right and up, metres.
[[nodiscard]] Vec2 seen(Side side, const Vec3& p_m);
/// Larger is nearer to who looks, metres.
[[nodiscard]] double nearness(Side side, const Vec3& p_m);

/// A box in the show frame, metres.
struct Box {
    Vec3 low{}, high{};
    [[nodiscard]] Vec3 middle() const { return 0.5 * (low + high); }
    [[nodiscard]] Vec3 size() const { return high - low; }
    [[nodiscard]] bool holds(const Vec3& p) const;
};
/// What a picture shows: all drones that shine, with a margin of at least `margin_m`, and those that do not as far as
/// the box hardly grows by them; everything where none shines.
/// @param drones  at least one.
[[nodiscard]] Box framed(std::span<const PictureDrone> drones, double margin_m);

/// Whether a lamp is so dark that it is drawn with a rim.
[[nodiscard]] bool is_dark(const Rgb& color);

/// A rectangle of the canvas that shows the sky from one side.
struct SkyView {
    Side side = Side::front;
    Vec2 corner_px{}, size_px{};                 ///< upper left
    Vec2 middle_m{};                             ///< of `seen`, in its middle
    double scale_px = 1.0;                       ///< of a metre
    bool marks_below = true, marks_left = true;  ///< numbers beside the axes
    /// From here to there drones grow dimmer, so that a body's front stands out from its back; alike: none does.
    double nearest = 0.0, farthest = 0.0;

    [[nodiscard]] Vec2 on_canvas(const Vec3& p_m) const;
};

/// What all views of a picture share.
struct SkyStyle {
    double unit_px = 1.0;    ///< of all lines and letters: the picture's width / 640
    double radius_px = 3.0;  ///< of a drone
};
/// The radius of drones that stand `spacing_m` apart: discs that do not touch, as far as they can still be seen.
[[nodiscard]] double drone_radius_px(double spacing_m, double scale_px, double unit_px);

/// Draws the view: scales, the ground where it is in sight, and the drones, the nearest last.
void draw_view(Canvas& canvas, const Lettering& lettering, const SkyView& view, const SkyStyle& style,
               std::span<const PictureDrone> drones);

namespace ink {
inline constexpr Ink kPage{0.035, 0.043, 0.075};
inline constexpr Ink kSky{0.012, 0.016, 0.035};
inline constexpr Ink kGrid{0.45, 0.55, 0.80, 0.14};
inline constexpr Ink kGround{0.55, 0.75, 0.50, 0.55};
inline constexpr Ink kText{0.90, 0.92, 0.97};
inline constexpr Ink kMuted{0.58, 0.63, 0.74};
inline constexpr Ink kRim{0.50, 0.56, 0.68};
inline constexpr Ink kSpare{0.62, 0.66, 0.76, 0.8};
inline constexpr Ink kBar{0.36, 0.62, 0.95};
inline constexpr Ink kMarked{1.0, 0.62, 0.25};
}  // namespace ink

enum class Anchor { left, middle, right };
/// A line of text whose baseline's left end, middle or right end is at `at`.
void draw_text(Canvas& canvas, const Label& label, const Vec2& at, const Ink& ink, Anchor anchor = Anchor::left);

}  // namespace aerogram::exporter
