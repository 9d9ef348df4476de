#include "export/picture/formation_picture.hpp"

#include <algorithm>
#include <cmath>

#include "export/picture/page.hpp"
#include "export/picture/spacing_histogram.hpp"
#include "geo/contract.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kNarrowestView = 56.0, kGap = 14.0;
constexpr double kHighestViews = 470.0;
constexpr double kWords = 372.0;      ///< width of the words below
constexpr double kWordNames = 106.0;  ///< of these the names
constexpr double kHistogram = 72.0;   ///< height of the bars
constexpr std::size_t kBins = 40;
constexpr std::size_t kMostLines = 4;  ///< of one text

/// The largest scale at which the views side by side and above each other have room.
double fitting_scale(const Vec3& size_m, double width, double height) {
    const auto fits = [&](double scale) {
        const auto side = [&](double metres) { return std::max(scale * metres, kNarrowestView); };
        return side(size_m.x) + side(size_m.y) <= width && side(size_m.z) + side(size_m.y) <= height;
    };
    double low = 0.0, high = std::max(width, height) / std::max({size_m.x, size_m.y, size_m.z});
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (fits(middle) ? low : high) = middle;
    }
    return low;
}

/// Texts that are too long for their line go on in the next, at most kMostLines in all; the last is cut where it is
/// drawn.
std::vector<FactLine> wrapped(const Lettering& lettering, const std::vector<FactLine>& lines, double u) {
    std::vector<FactLine> out;
    for (const FactLine& line : lines) {
        if (line.name == "mission" || line.name == "keyframe") continue;  // the title
        FactLine now{line.name, ""};
        std::size_t begun = 1;
        for (std::size_t at = 0; at < line.text.size();) {
            const std::size_t end = std::min(line.text.find(' ', at), line.text.size());
            const std::string word = line.text.substr(at, end - at);
            const std::string longer = now.text.empty() ? word : now.text + ' ' + word;
            const bool fits = lettering.label(longer, kTextSize * u).width <= (kWords - kWordNames) * u;
            if (!fits && !now.text.empty() && begun < kMostLines) {
                out.push_back(now);
                now = {"", word};
                ++begun;
            } else {
                now.text = longer;
            }
            at = end + 1;
        }
        out.push_back(now);
    }
    return out;
}

void draw_words(Canvas& canvas, const Lettering& lettering, const std::vector<FactLine>& lines, double u,
                double top_px) {
    double y = top_px + kTextSize * u;
    for (const FactLine& line : lines) {
        draw_text(canvas, lettering.label(line.name, kTextSize * u, (kWordNames - 6.0) * u), {kMargin * u, y},
                  ink::kMuted);
        draw_text(canvas, lettering.label(line.text, kTextSize * u, (kWords - kWordNames) * u),
                  {(kMargin + kWordNames) * u, y}, ink::kText);
        y += kLine * u;
    }
}

void draw_histogram(Canvas& canvas, const Lettering& lettering, const FormationFacts& facts, double u, double top_px) {
    const double left = (kMargin + kWords + 18.0) * u, right = (kPageWidth - kMargin) * u, width = right - left;
    const double top = top_px + (kCaptionSize + 10.0) * u, bottom = top + kHistogram * u;
    const auto text = [&](const std::string& words, const Vec2& at, const Ink& ink, Anchor anchor) {
        draw_text(canvas, lettering.label(words, kCaptionSize * u, width), at, ink, anchor);
    };
    text("drones by distance to their nearest, m", {left, top_px + kCaptionSize * u}, ink::kMuted, Anchor::left);
    canvas.rectangle({left, top}, {width, bottom - top}, ink::kSky);
    const SpacingHistogram histogram = spacing_histogram(facts.nearest_m, facts.asked_spacing_m, kBins);
    const auto most = static_cast<double>(std::max<std::size_t>(1, *std::ranges::max_element(histogram.bins)));
    const double bin_width = width / static_cast<double>(kBins);
    for (std::size_t b = 0; b < kBins; ++b) {
        if (histogram.bins[b] == 0) continue;
        const double height = std::max(static_cast<double>(histogram.bins[b]) / most * (kHistogram - 15.0), 1.0) * u;
        canvas.rectangle({left + static_cast<double>(b) * bin_width, bottom - height}, {bin_width - 0.5 * u, height},
                         ink::kBar);
    }
    const double step_m = round_step(histogram.end_m / 6.0);
    const int decimals = step_m < 1.0 ? static_cast<int>(std::ceil(-std::log10(step_m) - 1e-9)) : 0;
    for (double mark_m = 0.0; mark_m <= histogram.end_m * (1.0 + 1e-9); mark_m += step_m) {
        const double x = left + mark_m / histogram.end_m * width;
        canvas.line({x, bottom}, {x, bottom + 3.0 * u}, u, ink::kMuted);
        const bool last = mark_m + step_m > histogram.end_m;
        draw_text(canvas,
                  lettering.label(fixed(mark_m, decimals) + (last && histogram.beyond ? " and more" : ""), 9.0 * u),
                  {x, bottom + 13.0 * u}, ink::kMuted, Anchor::middle);
    }
    const double asked_x = left + facts.asked_spacing_m / histogram.end_m * width;
    canvas.line({asked_x, top}, {asked_x, bottom}, 1.5 * u, ink::kMarked);
    const bool room_right = asked_x < left + 0.6 * width;
    text(fixed(facts.asked_spacing_m, 2) + " asked", {asked_x + (room_right ? 4.0 : -4.0) * u, top + 10.0 * u},
         ink::kMarked, room_right ? Anchor::left : Anchor::right);
}

}  // namespace

ThreeViews three_views(std::span<const PictureDrone> drones, const FormationFacts& facts, int width_px) {
    const double u = width_px / kPageWidth;
    const double spacing_m = facts.closest ? facts.closest->distance_m : facts.asked_spacing_m;
    const Box frame = framed(drones, std::max(spacing_m, facts.asked_spacing_m));
    const Vec3 size_m = frame.size(), middle_m = frame.middle();
    const double room = kPageWidth - 2.0 * kMargin - kMarksLeft - kGap;
    const double scale = fitting_scale(size_m, room, kHighestViews);
    const auto length = [&](double metres) { return std::max(scale * metres, kNarrowestView); };
    const double side_width = length(size_m.y), height = length(size_m.z), depth = length(size_m.y);
    const double left = (kMargin + kMarksLeft) * u, front_width = room - side_width, top = (kHeading + kCaption) * u;

    const Box lit{facts.low_m, facts.high_m};
    ThreeViews views;
    views.frame = frame;
    views.style = {u, drone_radius_px(spacing_m, scale * u, u)};
    views.front = {Side::front, {left, top}, Vec2(front_width, height) * u, seen(Side::front, middle_m), scale * u,
                   false,       true};
    views.side = {Side::side,
                  {left + (front_width + kGap) * u, top},
                  Vec2(side_width, height) * u,
                  seen(Side::side, middle_m),
                  scale * u,
                  true,
                  false};
    views.top = {Side::top,
                 {left, top + (height + kCaption + kGap) * u},
                 Vec2(front_width, depth) * u,
                 seen(Side::top, middle_m),
                 scale * u,
                 true,
                 true};
    for (SkyView* view : {&views.front, &views.side, &views.top}) {
        const double one = nearness(view->side, lit.low), other = nearness(view->side, lit.high);
        view->nearest = std::max(one, other);
        view->farthest = std::min(one, other);
    }
    views.bottom_px = views.top.corner_px.y + (depth + kMarksBelow) * u;
    return views;
}

std::vector<PictureDrone> picture_drones(const planner::Formation& formation) {
    std::vector<PictureDrone> drones;
    for (std::size_t i = 0; i < formation.points_m.size(); ++i)
        drones.push_back({formation.points_m[i], formation.colors[i], formation.spare[i]});
    return drones;
}

Result<std::string> formation_picture(const planner::Formation& formation, const FormationFacts& facts, int width_px) {
    AEROGRAM_REQUIRE(width_px >= kNarrowestPicture_px && width_px <= kWidestPicture_px, width_px);
    const auto lettering = Lettering::load();
    if (!lettering) return lettering.error();
    const std::vector<PictureDrone> drones = picture_drones(formation);
    const double u = width_px / kPageWidth;
    const ThreeViews views = three_views(drones, facts, width_px);

    std::vector<FactLine> lines = fact_lines(facts);
    if (const std::string outside = outside_text(views.frame, drones); !outside.empty()) lines.push_back({"", outside});
    lines = wrapped(*lettering, lines, u);
    const double words_px = views.bottom_px + 14.0 * u;
    const double height = std::max(static_cast<double>(lines.size()) * kLine + 4.0, kHistogram + 40.0) + kMargin;
    Canvas canvas(width_px, static_cast<int>(std::ceil(words_px + height * u)), ink::kPage);
    draw_title(canvas, *lettering, u, facts.keyframe,
               facts.show + ", keyframe " + std::to_string(facts.number) + " of " + std::to_string(facts.keyframes));
    for (const SkyView* view : {&views.front, &views.side, &views.top})
        draw_view(canvas, *lettering, *view, views.style, drones);
    draw_caption(canvas, *lettering, views.front, u, "front, as the audience sees it: x and z in m");
    draw_caption(canvas, *lettering, views.side, u,
                 views.side.size_px.x > 150.0 * u ? "from the right: y and z" : "side: y, z");
    draw_caption(canvas, *lettering, views.top, u, "from above, the audience below: x and y in m");
    draw_words(canvas, *lettering, lines, u, words_px);
    draw_histogram(canvas, *lettering, facts, u, words_px);
    return canvas.png();
}

}  // namespace aerogram::exporter
