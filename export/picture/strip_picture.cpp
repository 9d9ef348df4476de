#include "export/picture/strip_picture.hpp"

#include <algorithm>
#include <cmath>

#include "export/picture/formation_picture.hpp"
#include "export/picture/nearest_distances.hpp"
#include "export/picture/page.hpp"
#include "geo/contract.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kHighestPage = 900.0, kGap = 10.0, kSmallestMargin_m = 1.0;

/// How frames stand in rows.
struct Rows {
    std::size_t columns = 1;
    Vec2 size{};  ///< of one view, in units
    double scale = 0.0;
};

/// The columns that make the views largest; of equal ones the fewest.
Rows best_rows(std::size_t frames, const Vec2& size_m) {
    Rows best;
    for (std::size_t columns = 1; columns <= frames; ++columns) {
        const auto across = static_cast<double>(columns), down = std::ceil(static_cast<double>(frames) / across);
        const Vec2 room((kPageWidth - 2.0 * kMargin - kMarksLeft - (across - 1.0) * kGap) / across,
                        (kHighestPage - kHeading - kMarksBelow) / down - kCaption - kGap);
        if (room.x <= 0.0 || room.y <= 0.0) continue;
        const double scale = std::min(room.x / size_m.x, room.y / size_m.y);
        if (scale > best.scale * (1.0 + 1e-9)) best = {columns, {room.x, scale * size_m.y}, scale};
    }
    return best;
}

/// How far drones that shine typically are from their nearest: the median over all frames, metres.
double typical_spacing_m(const std::vector<StripFrame>& frames) {
    std::vector<double> nearest_m;
    for (const StripFrame& frame : frames) {
        Points shining_m;
        for (const PictureDrone& drone : frame.drones) {
            if (!drone.spare && !is_dark(drone.color)) shining_m.push_back(drone.at_m);
        }
        const auto distances_m = nearest_distances(shining_m, {});
        nearest_m.insert(nearest_m.end(), distances_m.begin(), distances_m.end());
    }
    if (nearest_m.empty()) return kSmallestMargin_m;
    const auto middle = nearest_m.begin() + static_cast<std::ptrdiff_t>(nearest_m.size() / 2);
    std::nth_element(nearest_m.begin(), middle, nearest_m.end());
    return *middle;
}

}  // namespace

Result<std::string> strip_picture(const std::string& title, const std::string& of,
                                  const std::vector<StripFrame>& frames, int width_px) {
    AEROGRAM_REQUIRE(!frames.empty() && frames.size() <= kMostStripFrames, frames.size());
    AEROGRAM_REQUIRE(width_px >= kNarrowestPicture_px && width_px <= kWidestPicture_px, width_px);
    const auto lettering = Lettering::load();
    if (!lettering) return lettering.error();
    std::vector<PictureDrone> all;
    for (const StripFrame& frame : frames) all.insert(all.end(), frame.drones.begin(), frame.drones.end());
    const double spacing_m = typical_spacing_m(frames), u = width_px / kPageWidth;
    const Box box = framed(all, std::max(spacing_m, kSmallestMargin_m));
    const Rows rows = best_rows(frames.size(), seen(Side::front, box.size()));
    const SkyStyle style{u, drone_radius_px(spacing_m, rows.scale * u, u)};

    const std::size_t count = (frames.size() + rows.columns - 1) / rows.columns;
    const double pitch = rows.size.y + kCaption + kGap;
    const double height = kHeading + static_cast<double>(count) * pitch + kMarksBelow + kMargin;
    Canvas canvas(width_px, static_cast<int>(std::ceil(height * u)), ink::kPage);
    draw_title(canvas, *lettering, u, title, of);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const std::size_t column = f % rows.columns, row = f / rows.columns;
        SkyView view{Side::front,    {},
                     rows.size * u,  seen(Side::front, box.middle()),
                     rows.scale * u, f + rows.columns >= frames.size(),
                     column == 0};
        view.corner_px = Vec2(kMargin + kMarksLeft + static_cast<double>(column) * (rows.size.x + kGap),
                              kHeading + kCaption + static_cast<double>(row) * pitch) *
                         u;
        draw_view(canvas, *lettering, view, style, frames[f].drones);
        const std::string outside = outside_text(box, frames[f].drones);
        draw_caption(canvas, *lettering, view, u, frames[f].caption + (outside.empty() ? "" : "   " + outside));
    }
    return canvas.png();
}

}  // namespace aerogram::exporter
