#include "planner/light/light_places.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

constexpr std::uint32_t kNoPlace = std::numeric_limits<std::uint32_t>::max();

bool is_spare(const PlannedKeyframe& keyframe, DroneId drone) {
    return !keyframe.spare.empty() && keyframe.spare[keyframe.slot_of[drone.value].value];
}

/// The barycentre of those who are shown; of everybody where nobody is.
Vec3 barycentre(const PlannedKeyframe& keyframe) {
    Vec3 sum{};
    double shown = 0.0;
    for (std::size_t slot = 0; slot < keyframe.formation_m.size(); ++slot) {
        if (!keyframe.spare.empty() && keyframe.spare[slot]) continue;
        sum += keyframe.formation_m[slot];
        shown += 1.0;
    }
    return shown > 0.0 ? sum / shown : keyframe.formation_m.front();
}

bool spans_something(const Light& light) {
    return light.effect == LightEffect::sweep || light.effect == LightEffect::image ||
           (light.effect == LightEffect::gradient && !light.in_time);
}

/// Places that span a volume: a box's corners, or a ball's ends along the axes and along `direction`.
Points ends_of(const LightVolume& volume, const Vec3& direction) {
    Points out;
    if (volume.size_m) {
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 sign((corner & 1) ? 0.5 : -0.5, (corner & 2) ? 0.5 : -0.5, (corner & 4) ? 0.5 : -0.5);
            out.push_back(volume.center_m + sign * *volume.size_m);
        }
        return out;
    }
    for (const Vec3& way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, direction}) {
        out.push_back(volume.center_m + volume.radius_m.value_or(0.0) * way);
        out.push_back(volume.center_m - volume.radius_m.value_or(0.0) * way);
    }
    return out;
}

Vec3 unit(const Vec3& v, const Vec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : otherwise;
}

Extent mixed(const Extent& a, const Extent& b, double share) {
    return {glm::mix(a.middle_m, b.middle_m, share), a.low_m + share * (b.low_m - a.low_m),
            a.high_m + share * (b.high_m - a.high_m)};
}

}  // namespace

LightPlaces::LightPlaces(const Mission& mission, std::size_t light, const LightStage& stage,
                         std::span<const Millis> times_ms, const Run& run)
    : light_(mission.lights[light]), stage_(stage), range_(keyframes_of(mission, light_).value()) {
    const std::size_t drones = stage.keyframes.front().slot_of.size();
    if (light_.group) {
        member_.assign(drones, false);
        for (const DroneId drone : stage.groups[*light_.group].drones) member_[drone.value] = true;
    }
    count_ = light_.group ? stage.groups[*light_.group].drones.size() : drones;
    const Vec3 direction = light_.direction.value_or(Vec3{1, 0, 0});
    axis_ = unit(direction, {1, 0, 0});
    right_ = unit({direction.x, direction.y, 0.0}, {1, 0, 0});
    for (const Millis time_ms : times_ms) passages_.push_back(passage_at(stage, range_, time_ms));
    for (std::size_t k = range_.first; k <= range_.last; ++k) {
        barycentres_m_.push_back(barycentre(stage.keyframes[k]));
        if (light_.effect == LightEffect::chase) order_keyframe(mission, k);
    }
    if (!spans_something(light_)) return;
    const auto members_at = [&](std::size_t keyframe, auto&& place_m) {
        Points shown_m;
        for (std::size_t d = 0; d < drones; ++d) {
            if (is_for(DroneId(d)) && shown(DroneId(d), keyframe)) shown_m.push_back(place_m(DroneId(d)));
        }
        return shown_m;
    };
    if (!light_.keyframe.empty()) {
        for (std::size_t k = range_.first; k <= range_.last; ++k)
            extents_.push_back(extent_of(members_at(k, [&](DroneId d) { return local_m(d, k); })));
        return;
    }
    if (light_.volume && light_.effect != LightEffect::image) {  // stands in the show: drones pass through it
        extents_.assign(times_ms.size(), extent_of(ends_of(*light_.volume, axis_)));
        return;
    }
    extents_.resize(times_ms.size());
    parallel_for(times_ms.size(), run, {}, [&](std::size_t i) {
        const auto after = std::ranges::find_if(stage_.acts, [&](const Act& a) { return a.start_ms > times_ms[i]; });
        const Act& act = *(after - (after == stage_.acts.begin() ? 0 : 1));
        Points here_m(drones), shown_m;
        positions(act, seconds_from_ms(times_ms[i] - act.start_ms), here_m);
        for (std::size_t d = 0; d < drones; ++d) {
            if (is_for(DroneId(d)) && presence(DroneId(d), passages_[i]) > 0.0) shown_m.push_back(here_m[d]);
        }
        extents_[i] = extent_of(shown_m);
    });
}

bool LightPlaces::shown(DroneId drone, std::size_t keyframe) const {
    return !is_spare(stage_.keyframes[keyframe], drone);
}

double LightPlaces::presence(DroneId drone, const Passage& passage) const {
    const double from = shown(drone, passage.from) ? 1.0 : 0.0;
    if (passage.from == passage.to) return from;
    return from + passage.share * ((shown(drone, passage.to) ? 1.0 : 0.0) - from);
}

Vec3 LightPlaces::local_m(DroneId drone, std::size_t k) const {
    const PlannedKeyframe& keyframe = stage_.keyframes[k];
    const Vec3 arm = keyframe.formation_m[keyframe.slot_of[drone.value].value] - barycentres_m_[k - range_.first];
    if (keyframe.turned_rad == 0.0) return arm;
    const double c = std::cos(keyframe.turned_rad), s = std::sin(keyframe.turned_rad);
    return {c * arm.x + s * arm.y, c * arm.y - s * arm.x, arm.z};
}

Vec3 LightPlaces::slot_m(DroneId drone, const Passage& passage) const {
    const Vec3 from_m = local_m(drone, passage.from);
    return passage.from == passage.to ? from_m : glm::mix(from_m, local_m(drone, passage.to), passage.share);
}

double LightPlaces::way_m(const Vec3& place_m, const Extent& extent) const {
    return light_.radial ? glm::distance(place_m, extent.middle_m) : glm::dot(place_m, axis_);
}

Vec2 LightPlaces::on_plane_m(const Vec3& place_m) const {
    return {glm::dot(place_m, right_), place_m.z};
}

Extent LightPlaces::extent_of(const Points& shown_m) const {
    if (shown_m.empty()) return {};
    Vec3 low = shown_m.front(), high = low;
    Vec2 plane_low = on_plane_m(low), plane_high = plane_low;
    for (const Vec3& p : shown_m) {
        low = glm::min(low, p);
        high = glm::max(high, p);
        plane_low = glm::min(plane_low, on_plane_m(p));
        plane_high = glm::max(plane_high, on_plane_m(p));
    }
    Extent out{0.5 * (low + high), 0.0, 0.0};
    if (light_.effect == LightEffect::image) {
        const Vec2 middle = 0.5 * (plane_low + plane_high), size = plane_high - plane_low;
        return {middle.x * right_ + Vec3{0, 0, middle.y}, size.x, size.y};
    }
    if (!light_.radial) out.low_m = out.high_m = way_m(shown_m.front(), out);
    for (const Vec3& p : shown_m) {
        if (!light_.radial) out.low_m = std::min(out.low_m, way_m(p, out));
        out.high_m = std::max(out.high_m, way_m(p, out));
    }
    return out;
}

Extent LightPlaces::extent(std::size_t when) const {
    if (extents_.empty()) return {};
    if (light_.keyframe.empty()) return extents_[when];
    const Passage& passage = passages_[when];
    const Extent& from = extents_[passage.from - range_.first];
    return passage.from == passage.to ? from : mixed(from, extents_[passage.to - range_.first], passage.share);
}

/// Frames of an animation take the order of its first.
void LightPlaces::order_keyframe(const Mission& mission, std::size_t k) {
    const std::string& clip = mission.keyframes[k].clip;
    if (k > range_.first && !clip.empty() && mission.keyframes[k - 1].clip == clip) {
        orders_.push_back(orders_.back());
        return;
    }
    const PlannedKeyframe& keyframe = stage_.keyframes[k];
    struct Ranked {
        double way_m;
        SlotId slot;
        DroneId drone;
        auto operator<=>(const Ranked&) const = default;
    };
    std::vector<Ranked> ranked;
    for (std::size_t d = 0; d < keyframe.slot_of.size(); ++d) {
        if (!is_for(DroneId(d)) || !shown(DroneId(d), k)) continue;
        const double way_m = light_.direction ? glm::dot(local_m(DroneId(d), k), axis_) : 0.0;
        ranked.push_back({way_m, keyframe.slot_of[d], DroneId(d)});
    }
    std::ranges::sort(ranked);
    Order order{std::vector<std::uint32_t>(keyframe.slot_of.size(), kNoPlace), ranked.size()};
    for (std::size_t i = 0; i < ranked.size(); ++i)
        order.place_of[ranked[i].drone.value] = static_cast<std::uint32_t>(i);
    orders_.push_back(std::move(order));
}

std::optional<LightPlaces::Place> LightPlaces::chase_place(DroneId drone, const Passage& passage) const {
    const Order& order = orders_[passage.from - range_.first];
    if (order.place_of[drone.value] == kNoPlace) return std::nullopt;
    return Place{order.place_of[drone.value], order.count};
}

}  // namespace aerogram::planner
