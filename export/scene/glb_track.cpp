#include "export/scene/glb_track.hpp"

#include "export/bytes/little_endian.hpp"
#include "export/scene/gltf_frame.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

void append(std::string& out, const Vec3& show) {
    const Vec3 p = to_gltf(show);
    for (const double x : {p.x, p.y, p.z}) put(out, static_cast<float>(x + 0.0));  // never -0
}

Vec3 speed(const Vec3& from_m, const Vec3& to_m, const FittedPiece& piece) {
    return 3.0 / seconds_from_ms(piece.duration_ms) * (to_m - from_m);
}

}  // namespace

GlbTrack glb_track(const Fitted& fitted) {
    GlbTrack track;
    track.values.reserve((fitted.pieces.size() + 1) * kGlbKeyBytes);
    Vec3 arriving{};
    for (const FittedPiece& piece : fitted.pieces) {
        const auto& c = piece.controls_m;
        track.times_ms.push_back(piece.start_ms);
        append(track.values, arriving);
        append(track.values, c[0]);
        append(track.values, speed(c[0], c[1], piece));
        arriving = speed(c[2], c[3], piece);
    }
    const FittedPiece& last = fitted.pieces.back();
    track.times_ms.push_back(last.start_ms + last.duration_ms);
    append(track.values, arriving);
    append(track.values, last.controls_m[3]);
    append(track.values, Vec3{});
    return track;
}

void append_glb_lights(std::string& out, const std::vector<LightKey>& keys) {
    for (const LightKey& key : keys) {
        const Rgb8 color = quantised(key.color);
        put(out, static_cast<std::uint32_t>(key.time_ms));
        for (const std::uint8_t channel : {color.r, color.g, color.b}) put(out, channel);
        put(out, static_cast<std::uint8_t>(key.fade ? 1 : 0));
    }
}

}  // namespace aerogram::exporter
