#include "export/picture/page.hpp"

#include <algorithm>

namespace aerogram::exporter {

void draw_title(Canvas& canvas, const Lettering& lettering, double unit_px, const std::string& title,
                const std::string& of) {
    const double room = (kPageWidth - 2.0 * kMargin) * unit_px, baseline = 22.0 * unit_px;
    const Label name = lettering.label(title, kTitleSize * unit_px, 0.62 * room);
    draw_text(canvas, name, {kMargin * unit_px, baseline}, ink::kText);
    const Label whole = lettering.label(of, kTextSize * unit_px, room - name.width - kMargin * unit_px);
    draw_text(canvas, whole, {(kPageWidth - kMargin) * unit_px, baseline}, ink::kMuted, Anchor::right);
}

void draw_caption(Canvas& canvas, const Lettering& lettering, const SkyView& view, double unit_px,
                  const std::string& text) {
    draw_text(canvas, lettering.label(text, kCaptionSize * unit_px, view.size_px.x),
              view.corner_px - Vec2(0.0, 5.0 * unit_px), ink::kMuted);
}

std::string outside_text(const Box& frame, std::span<const PictureDrone> drones) {
    const auto outside = std::ranges::count_if(drones, [&](const PictureDrone& d) { return !frame.holds(d.at_m); });
    if (outside == 0) return "";
    return std::to_string(outside) + (outside == 1 ? " dark drone is" : " dark drones are") + " outside of the picture";
}

}  // namespace aerogram::exporter
