#include "planner/formation/spare_places.hpp"

#include <algorithm>
#include <cmath>

#include "planner/formation/sizing.hpp"

namespace aerogram::planner {
namespace {

constexpr double kClearOfFloor_m = 0.1;  ///< take-off ends this far above the minimum navigation altitude

struct Box {
    Vec3 low{}, high{};
};

Box box_of(const Points& points_m) {
    Box box{points_m.front(), points_m.front()};
    for (const Vec3& p : points_m) {
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
    }
    return box;
}

std::size_t room_for(double length, double step) {
    return static_cast<std::size_t>(std::floor(length / step + 1e-9)) + 1;
}

/// The last pads whose places are clear of the formation and of each other.
Result<Points> above_pads(const Mission& mission, const Points& formation_m, std::size_t count) {
    const SeparationMetric metric{mission.limits.downwash};
    const double spacing_m = mission.limits.formation_spacing_m - kSpacingTolerance_m;
    const auto clear_of = [&](const Points& others, const Vec3& p) {
        return std::all_of(others.begin(), others.end(),
                           [&](const Vec3& q) { return metric.distance(p, q) >= spacing_m; });
    };
    const Points& pads_m = mission.fleet.pads_m;
    const double above_m = mission.limits.min_navigation_altitude_m + kClearOfFloor_m;
    double highest_m = 0.0;
    for (const Vec3& pad : pads_m) highest_m = std::max(highest_m, pad.z + above_m);
    Points low_slots_m;  // all others are too high to matter
    std::copy_if(formation_m.begin(), formation_m.end(), std::back_inserter(low_slots_m),
                 [&](const Vec3& p) { return p.z <= highest_m + spacing_m * mission.limits.downwash; });
    Points out;
    for (auto pad = pads_m.rbegin(); pad != pads_m.rend() && out.size() < count; ++pad) {
        const Vec3 place = *pad + Vec3(0.0, 0.0, above_m);
        if (clear_of(low_slots_m, place) && clear_of(out, place)) out.push_back(place);
    }
    if (out.size() == count) return out;
    return Error{ErrorCode::invalid_input,
                 "only " + std::to_string(out.size()) + " of " + std::to_string(count) +
                     " spare drones have a place above a pad that keeps formation_spacing_m to the formation and to "
                     "each other; raise the formation, or write fleet.spares = { where = \"wings\" }"};
}

/// Columns outwards from the formation's sides, the left side first where the number is odd.
Points in_wings(const Limits& limits, const Points& formation_m, std::size_t count) {
    const Box box = box_of(formation_m);
    const double spacing_m = limits.formation_spacing_m, up_m = spacing_m * limits.downwash;
    const double height_m = box.high.z - box.low.z;
    Points out;
    for (const double side : {-1.0, 1.0}) {
        const std::size_t here = side < 0.0 ? count - count / 2 : count / 2;
        if (here == 0) continue;
        const std::size_t most = room_for(height_m, up_m);
        const std::size_t columns = (here + most - 1) / most;
        const std::size_t rows = (here + columns - 1) / columns;
        const double step_m = rows > 1 ? height_m / static_cast<double>(rows - 1) : 0.0;
        for (std::size_t i = 0; i < here; ++i) {
            const double away_m = spacing_m * static_cast<double>(i / rows + 1);
            out.emplace_back(
                side < 0.0 ? box.low.x - away_m : box.high.x + away_m, 0.5 * (box.low.y + box.high.y),
                rows > 1 ? box.low.z + step_m * static_cast<double>(i % rows) : 0.5 * (box.low.z + box.high.z));
        }
    }
    return out;
}

/// A grid over the formation's box, as wide apart as the number allows, two spacings behind it.
Points in_overflow(const Limits& limits, const Points& formation_m, std::size_t count) {
    const Box box = box_of(formation_m);
    const double spacing_m = limits.formation_spacing_m;
    const Vec2 size(box.high.x - box.low.x, (box.high.z - box.low.z) / limits.downwash);
    const auto room = [&](double step_m) { return room_for(size.x, step_m) * room_for(size.y, step_m); };
    double low_m = spacing_m, high_m = std::max(spacing_m, 2.0 * std::max(size.x, size.y));
    for (int i = 0; i < 60 && room(low_m) >= count; ++i) {
        const double middle_m = 0.5 * (low_m + high_m);
        (room(middle_m) >= count ? low_m : high_m) = middle_m;
    }
    const std::size_t columns = room_for(size.x, low_m), rows = room_for(size.y, low_m);
    const auto place = [](double low, double length, std::size_t i, std::size_t n) {
        return n > 1 ? low + length * static_cast<double>(i) / static_cast<double>(n - 1) : low + 0.5 * length;
    };
    Points out;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t sheet = i / (rows * columns), row = i / columns % rows, column = i % columns;
        out.emplace_back(place(box.low.x, size.x, column, columns),
                         box.high.y + spacing_m * static_cast<double>(sheet + 2),
                         place(box.low.z, box.high.z - box.low.z, row, rows));
    }
    return out;
}

}  // namespace

Result<Points> spare_places(const Mission& mission, const Points& formation_m, std::size_t count) {
    switch (mission.fleet.spares) {
        case Spares::wings:
            return in_wings(mission.limits, formation_m, count);
        case Spares::overflow:
            return in_overflow(mission.limits, formation_m, count);
        case Spares::pads:
            break;
    }
    return above_pads(mission, formation_m, count);
}

std::string describe_spares(Spares where, std::size_t count) {
    const std::string who = count == 1 ? "1 spare drone waits " : std::to_string(count) + " spare drones wait ";
    switch (where) {
        case Spares::wings:
            return who + "in columns beside the formation";
        case Spares::overflow:
            return who + "in a sheet behind the formation";
        case Spares::pads:
            break;
    }
    return who + (count == 1 ? "above its pad" : "above their pads");
}

}  // namespace aerogram::planner
