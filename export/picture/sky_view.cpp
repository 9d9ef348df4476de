#include "export/picture/sky_view.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "export/picture/formation_facts.hpp"
#include "export/picture/spacing_histogram.hpp"
#include "geo/contract.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kMarkSize = 9.0;     ///< letters of the scales, in units
constexpr double kMarksApart = 42.0;  ///< at least, in units
constexpr double kFarthest = 0.45;    ///< how much of its light the farthest drone shows
constexpr double kDarkest = 0.03;     ///< linear luminance
constexpr double kGrowth = 0.35;      ///< of the longest side, that drones that do not shine may add to any

Box box_of(std::span<const PictureDrone> drones, bool shining) {
    Box box;
    bool first = true;
    for (const PictureDrone& drone : drones) {
        if (shining && (drone.spare || is_dark(drone.color))) continue;
        box.low = first ? drone.at_m : glm::min(box.low, drone.at_m);
        box.high = first ? drone.at_m : glm::max(box.high, drone.at_m);
        first = false;
    }
    return box;
}

double longest(const Vec3& size) {
    return std::max({size.x, size.y, size.z});
}

/// Whole steps in a range: the first and the last multiple of `step`.
struct Marks {
    double step = 1.0;
    long first = 0, last = -1;
    Marks(double low, double high, double scale_px, double unit_px)
        : step(round_step(kMarksApart * unit_px / scale_px)),
          first(static_cast<long>(std::ceil(low / step - 1e-9))),
          last(static_cast<long>(std::floor(high / step + 1e-9))) {}
    [[nodiscard]] std::string text(long mark) const {
        const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
        return fixed(static_cast<double>(mark) * step, decimals);
    }
};

void draw_scales(Canvas& canvas, const Lettering& lettering, const SkyView& view, double u) {
    const Vec2 half_m = 0.5 * view.size_px / view.scale_px, low = view.middle_m - half_m, high = view.middle_m + half_m;
    const Vec2 end = view.corner_px + view.size_px;
    const Marks across(low.x, high.x, view.scale_px, u);
    for (long mark = across.first; mark <= across.last; ++mark) {
        const double x = view.corner_px.x + (static_cast<double>(mark) * across.step - low.x) * view.scale_px;
        canvas.line({x, view.corner_px.y}, {x, end.y}, u, ink::kGrid);
        if (!view.marks_below) continue;
        draw_text(canvas, lettering.label(across.text(mark), kMarkSize * u), {x, end.y + 11.0 * u}, ink::kMuted,
                  Anchor::middle);
    }
    const Marks up(low.y, high.y, view.scale_px, u);
    for (long mark = up.first; mark <= up.last; ++mark) {
        const double y = end.y - (static_cast<double>(mark) * up.step - low.y) * view.scale_px;
        const bool ground = mark == 0 && view.side != Side::top;
        canvas.line({view.corner_px.x, y}, {end.x, y}, u, ground ? ink::kGround : ink::kGrid);
        if (!view.marks_left) continue;
        draw_text(canvas, lettering.label(up.text(mark), kMarkSize * u), {view.corner_px.x - 5.0 * u, y + 3.2 * u},
                  ink::kMuted, Anchor::right);
    }
}

/// @param share  of its light, the rest is the sky.
void draw_drone(Canvas& canvas, const PictureDrone& drone, const Vec2& at, const SkyStyle& style, double share) {
    const double r = style.radius_px, rim = std::clamp(0.22 * r, 0.5 * style.unit_px, 1.2 * style.unit_px);
    if (drone.spare) {
        canvas.ring(at, 0.8 * r, rim, ink::kSpare);
        return;
    }
    const Ink lamp = lamp_ink(drone.color);
    const auto dimmed = [&](double light, double sky) { return sky + share * (light - sky); };
    canvas.disc(at, r, {dimmed(lamp.r, ink::kSky.r), dimmed(lamp.g, ink::kSky.g), dimmed(lamp.b, ink::kSky.b)});
    if (is_dark(drone.color)) canvas.ring(at, r - 0.5 * rim, rim, ink::kRim);
}

}  // namespace

Vec2 seen(Side side, const Vec3& p_m) {
    switch (side) {
        case Side::top:
            return {p_m.x, p_m.y};
        case Side::side:
            return {p_m.y, p_m.z};
        case Side::front:
            break;
    }
    return {p_m.x, p_m.z};
}

double nearness(Side side, const Vec3& p_m) {
    return side == Side::front ? -p_m.y : side == Side::top ? p_m.z : p_m.x;
}

bool Box::holds(const Vec3& p) const {
    return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y && p.z <= high.z;
}

bool is_dark(const Rgb& color) {
    return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b < kDarkest &&
           std::max({color.r, color.g, color.b}) < 0.1;
}

Box framed(std::span<const PictureDrone> drones, double margin_m) {
    AEROGRAM_REQUIRE(!drones.empty());
    const bool any = std::ranges::any_of(drones, [](const PictureDrone& d) { return !d.spare && !is_dark(d.color); });
    const Box all = box_of(drones, false), shining = box_of(drones, any);
    const bool near = longest(all.size() - shining.size()) <= kGrowth * (longest(shining.size()) + 2.0 * margin_m);
    Box box = near ? all : shining;
    const Vec3 margin(std::max(margin_m, 0.04 * longest(box.size())));
    box.low -= margin;
    box.high += margin;
    return box;
}

Vec2 SkyView::on_canvas(const Vec3& p_m) const {
    const Vec2 from_middle = (seen(side, p_m) - middle_m) * scale_px;
    return corner_px + 0.5 * size_px + Vec2(from_middle.x, -from_middle.y);
}

double drone_radius_px(double spacing_m, double scale_px, double unit_px) {
    return std::clamp(0.4 * spacing_m * scale_px, 0.9 * unit_px, 7.0 * unit_px);
}

void draw_view(Canvas& canvas, const Lettering& lettering, const SkyView& view, const SkyStyle& style,
               std::span<const PictureDrone> drones) {
    canvas.rectangle(view.corner_px, view.size_px, ink::kSky);
    draw_scales(canvas, lettering, view, style.unit_px);
    std::vector<std::size_t> order(drones.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return nearness(view.side, drones[i].at_m); });
    canvas.only_inside(view.corner_px, view.size_px);
    const Vec2 reach(2.0 * style.radius_px), low = view.corner_px - reach, high = view.corner_px + view.size_px + reach;
    const double depth = view.nearest - view.farthest;
    for (const std::size_t i : order) {
        const Vec2 at = view.on_canvas(drones[i].at_m);
        if (!(at.x > low.x && at.y > low.y && at.x < high.x && at.y < high.y)) continue;
        const double away = depth > 0.0 ? (view.nearest - nearness(view.side, drones[i].at_m)) / depth : 0.0;
        draw_drone(canvas, drones[i], at, style, 1.0 - (1.0 - kFarthest) * std::clamp(away, 0.0, 1.0));
    }
    canvas.everywhere();
}

void draw_text(Canvas& canvas, const Label& label, const Vec2& at, const Ink& ink, Anchor anchor) {
    const double share = anchor == Anchor::left ? 0.0 : anchor == Anchor::middle ? 0.5 : 1.0;
    canvas.fill(label.outlines, at - Vec2(share * label.width, 0.0), ink);
}

}  // namespace aerogram::exporter
