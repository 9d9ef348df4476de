#include "planner/light/beam.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

bool depends_on_place(const Light& light) {
    return light.volume || light.effect == LightEffect::sweep || light.effect == LightEffect::image ||
           (light.effect == LightEffect::gradient && !light.in_time);
}

}  // namespace

Result<std::vector<PictureLight>> read_pictures(const Mission& mission, std::size_t index, std::size_t most_cells) {
    const Light& light = mission.lights[index];
    const std::string key = "light[" + std::to_string(index + 1) + "]";
    if (light.images.empty())
        return Error{ErrorCode::invalid_input, mission.at(light.line, key + ": an image effect needs an image")};
    std::vector<PictureLight> out;
    for (const std::filesystem::path& file : light.images) {
        const auto picture = read_picture(file);
        if (!picture) {
            const std::string what = key + ".image = \"" + file.generic_string() + "\": " + picture.error().message;
            return Error{picture.error().code, mission.at(light.line, what)};
        }
        out.emplace_back(*picture, most_cells);
    }
    return out;
}

Beam::Beam(const Mission& mission, std::size_t index, const LightStage& stage, const LightTime& time,
           std::span<const Millis> times_ms, std::vector<PictureLight> pictures, const Run& run)
    : light_(mission.lights[index]),
      time_(time),
      times_ms_(times_ms.begin(), times_ms.end()),
      places_(mission, index, stage, times_ms, run),
      pictures_(std::move(pictures)),
      seed_(Random(mission.seed + (index + 1) * 0xA0761D6478BD642FULL).bits()),
      in_show_(light_.keyframe.empty()),
      by_place_(depends_on_place(light_)) {
}

Vec3 Beam::place_m(DroneId drone, std::size_t when, std::span<const Vec3> track_m) const {
    return in_show_ ? track_m[when] : places_.slot_m(drone, places_.passage(when));
}

bool Beam::shines_at(const Vec3& place_m) const {
    if (!light_.volume) return true;
    const Vec3 off = glm::abs(place_m - light_.volume->center_m);
    if (light_.volume->radius_m) return glm::length(off) <= *light_.volume->radius_m;
    if (!light_.volume->size_m) return true;
    const Vec3 half = 0.5 * *light_.volume->size_m;
    return off.x <= half.x && off.y <= half.y && off.z <= half.z;
}

Glow Beam::image_glow(const Vec3& place_m, const Instant& at) const {
    const auto count = static_cast<double>(pictures_.size());
    const auto which = static_cast<std::size_t>(time_.progress(times_ms_[at.state]) * count);
    const PictureLight& picture = pictures_[std::min(which, pictures_.size() - 1)];
    const Extent extent = places_.extent(at.now);
    const PictureFit fit = fit_size(picture, light_.image_size_m, {extent.low_m, extent.high_m},
                                    std::max<std::size_t>(1, places_.count()));
    const bool stands = in_show_ && light_.volume;  // a plane in the show stands in its volume's middle
    const Vec2 middle = places_.on_plane_m(stands ? light_.volume->center_m : extent.middle_m);
    const Vec2 off = places_.on_plane_m(place_m) - middle;
    const SeenLight seen = picture.around(0.5 * picture.size() + fit.cells_per_m * off, fit.reach);
    if (seen.alpha <= 0.0) return {{}, 0.0};
    return {{seen.color.r / seen.alpha, seen.color.g / seen.alpha, seen.color.b / seen.alpha}, seen.alpha};
}

Glow Beam::glow(DroneId drone, const Instant& at, std::span<const Vec3> track_m) const {
    const double since_s = time_.since_s(times_ms_[at.now]), state_s = time_.since_s(times_ms_[at.state]);
    switch (light_.effect) {
        case LightEffect::fade:
            return fade_glow(light_, time_.progress(times_ms_[at.now]));
        case LightEffect::pulse:
            return pulse_glow(light_, rounds_at(since_s, state_s, light_.period_s));
        case LightEffect::sparkle:
            return sparkle_glow(light_, seed_, drone, state_s);
        case LightEffect::chase: {
            const auto place = places_.chase_place(drone, places_.passage(at.state));
            if (!place) return {{}, 0.0};
            return chase_glow(light_, place->place, place->count, since_s / light_.period_s);
        }
        case LightEffect::image:
            return image_glow(place_m(drone, at.now, track_m), at);
        case LightEffect::sweep:
        case LightEffect::gradient:
            break;
    }
    const Extent extent = places_.extent(at.now);
    const double way_m = light_.in_time ? 0.0 : places_.way_m(place_m(drone, at.now, track_m), extent);
    if (light_.effect == LightEffect::sweep)
        return sweep_glow(light_, way_m, extent.low_m, extent.high_m, rounds_at(since_s, state_s, light_.period_s));
    return gradient_glow(light_, way_m, extent.low_m, extent.high_m, since_s, time_.progress(times_ms_[at.now]));
}

Rgb Beam::over(const Rgb& beneath, DroneId drone, const Instant& at, std::span<const Vec3> track_m) const {
    const double opacity =
        light_.opacity * time_.envelope(light_, times_ms_[at.now]) * places_.presence(drone, places_.passage(at.now));
    if (opacity <= 0.0) return beneath;
    if (light_.volume && !shines_at(place_m(drone, at.state, track_m))) return beneath;
    return blended(beneath, glow(drone, at, track_m), light_.blend, opacity);
}

}  // namespace aerogram::planner
