#include "planner/formation/formation.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <limits>
#include <numeric>
#include <sstream>

#include "geo/random.hpp"
#include "planner/formation/figure.hpp"
#include "planner/formation/paint.hpp"
#include "planner/formation/sizing.hpp"
#include "planner/formation/spare_places.hpp"
#include "planner/sampling/closest_pair.hpp"

namespace aerogram::planner {
namespace {

constexpr double kAltitudeTolerance_m = 1e-9;

/// About x, then y, then z, counter-clockwise seen from the axis' tip.
glm::dmat3 rotation(const Vec3& rotate_rad) {
    const Vec3 c(std::cos(rotate_rad.x), std::cos(rotate_rad.y), std::cos(rotate_rad.z));
    const Vec3 s(std::sin(rotate_rad.x), std::sin(rotate_rad.y), std::sin(rotate_rad.z));
    const glm::dmat3 about_x(1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x);  // by columns
    const glm::dmat3 about_y(c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y);
    const glm::dmat3 about_z(c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1);
    return about_z * about_y * about_x;
}

/// One part on its way: the figure, its points, and how they come to stand.
struct PlacedPart {
    PartRef ref;
    Figure figure;
    SizedFigure drawn;
    SpacingOf spacing_of;
    std::size_t first_slot = 0;
};

/// `value` with two decimals, rounded down so that it does not look like the limit it fails.
std::string floored(double value) {
    std::ostringstream text;
    text.setf(std::ios::fixed);
    text.precision(2);
    text << std::floor(value * 100.0 + 1e-6) / 100.0;
    return text.str();
}

std::string shortest(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

Points divided(Points points, const Vec3& scale) {
    for (Vec3& p : points) p /= scale;
    return points;
}

/// An area with a depth: its mission may say it as depth_m.
bool is_extruded(const Source& source) {
    const auto* text = std::get_if<TextSource>(&source);
    const auto* svg = std::get_if<SvgSource>(&source);
    const auto* shape = std::get_if<ShapeSource>(&source);
    return (text && text->style == TextStyle::solid) || (svg && svg->style == SvgStyle::solid) ||
           (shape && shape->area_style == AreaStyle::solid) || std::holds_alternative<SketchSource>(source);
}

class Builder {
  public:
    Builder(const Mission& mission, std::size_t index, const Run& run)
        : mission_(mission),
          keyframe_(mission.keyframes[index]),
          key_(keyframe_key(mission, index)),
          run_(run),
          metric_{mission.limits.downwash},
          turn_(rotation(keyframe_.rotate_rad)) {}

    Result<Formation> build() {
        parts_.reserve(keyframe_.parts.size());
        for (std::size_t p = 0; p < keyframe_.parts.size(); ++p) {
            if (const Status added = add_part(p); !added) return added.error();
            if (run_.stopped()) return stopped_error();
        }
        if (const Status added = add_spares(); !added) return added.error();
        check_spacing();
        check_altitudes();
        if (!problems_.empty()) return Error{ErrorCode::invalid_input, problems_};
        return std::move(out_);
    }

  private:
    Status add_part(std::size_t p) {
        const Part& part = keyframe_.parts[p];
        const bool alone = keyframe_.parts.size() == 1;
        PartRef ref{mission_, part, alone ? key_ : key_ + ".part[" + std::to_string(p + 1) + "]"};
        if (part.drones == 0) return ref.error(".drones = 0: must be > 0");
        auto figure = figure_of(ref, run_);
        if (!figure) return figure.error();

        const glm::dmat3 part_turn = rotation(part.rotate_rad);
        const SpacingOf spacing_of = [this, part_turn](const Points& points) {
            if (points.size() < 2) return std::numeric_limits<double>::infinity();
            Points turned;
            turned.reserve(points.size());
            for (const Vec3& q : points) turned.push_back(turn_ * (part_turn * q));
            return closest_pair(turned, metric_).distance_m;
        };
        SizedFigure drawn = sized(*figure, part.size, mission_.limits.formation_spacing_m, spacing_of);
        const std::size_t count = drawn.points_m.size();
        AEROGRAM_REQUIRE(count <= part.drones && count > 0, count, part.drones);
        if (figure->colors_at) figure->colors = figure->colors_at(divided(drawn.points_m, drawn.scale));
        const std::size_t first = out_.points_m.size();
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 in_keyframe = part_turn * drawn.points_m[i] + part.center_m;
            out_.points_m.push_back(turn_ * in_keyframe + keyframe_.center_m);
            out_.colors.push_back(figure->colors.empty() ? Rgb{1.0, 1.0, 1.0} : figure->colors[i]);
            out_.part.push_back(static_cast<std::uint32_t>(p));
            out_.spare.push_back(false);
        }
        if (const Status colored = paint(ref, p, first); !colored) return colored.error();
        out_.coverage_m.push_back(figure->coverage ? std::optional(figure->coverage(drawn.scale, drawn.points_m))
                                                   : std::nullopt);
        if (!figure->note.empty()) note(alone ? figure->note : "part " + std::to_string(p + 1) + ' ' + figure->note);
        parts_.push_back({std::move(ref), std::move(*figure), std::move(drawn), spacing_of, first});
        return Done{};
    }

    /// A part's own paint over its colours. Frames of an animation are dealt the same palette.
    Status paint(const PartRef& ref, std::size_t p, std::size_t first) {
        if (!ref.part.color) return Done{};
        const Points points_m(out_.points_m.begin() + static_cast<std::ptrdiff_t>(first), out_.points_m.end());
        Random seed(mission_.seed + (std::uint64_t{keyframe_.number} << 32U) + p);
        auto colors = painted(*ref.part.color, points_m, audience_seat(mission_), seed.bits());
        if (!colors) {
            const auto& file = std::get<ProjectedPicture>(*ref.part.color).image;
            const std::string key = ".color.image = \"" + file.generic_string() + "\": ";
            return Error{colors.error().code, ref.error(key + colors.error().message).message};
        }
        std::ranges::copy(*colors, out_.colors.begin() + static_cast<std::ptrdiff_t>(first));
        return Done{};
    }

    Status add_spares() {
        const std::size_t count = mission_.fleet.drones - out_.points_m.size();
        if (count == 0) return Done{};
        const auto places_m = spare_places(mission_, out_.points_m, count);
        if (!places_m)
            return Error{places_m.error().code, mission_.at(keyframe_.line, key_ + ": " + places_m.error().message)};
        for (const Vec3& place_m : *places_m) {
            out_.points_m.push_back(place_m);
            out_.colors.emplace_back();
            out_.part.push_back(static_cast<std::uint32_t>(keyframe_.parts.size()));
            out_.spare.push_back(true);
        }
        note(describe_spares(mission_.fleet.spares, count));
        return Done{};
    }

    void note(const std::string& what) { out_.note += (out_.note.empty() ? "" : "; ") + what; }

    void check_spacing() {
        if (out_.points_m.size() < 2) return;
        const ClosestPair pair = closest_pair(out_.points_m, metric_);
        out_.smallest_spacing_m = pair.distance_m;
        const double wanted_m = mission_.limits.formation_spacing_m;
        if (pair.distance_m >= wanted_m - kSpacingTolerance_m) return;
        // Spare places keep the spacing unless the parts do not.
        AEROGRAM_REQUIRE(!out_.spare[pair.second], pair.first, pair.second, pair.distance_m);
        const PlacedPart& part = parts_[out_.part[pair.first]];
        const bool same_part = out_.part[pair.first] == out_.part[pair.second];
        const std::string slots = "(slots " + std::to_string(SlotId(pair.first).number()) + " and " +
                                  std::to_string(SlotId(pair.second).number()) + ")";
        const std::string too_close = ": smallest spacing " + floored(pair.distance_m) + " m " + slots +
                                      " is below formation_spacing_m = " + shortest(wanted_m);
        if (!same_part) {
            const PlacedPart& other = parts_[out_.part[pair.second]];
            problem(other.ref, ".center_m" + too_close + "; move it away from " + part.ref.key);
        } else if (part.spacing_of(part.drawn.points_m) <= 0.0) {
            problem(part.ref, too_close + "; no size_m can part points in the same place");
        } else {
            const bool extruded = part.figure.extent.y > 0.0 && is_extruded(part.ref.part.source);
            problem(part.ref, ".size_m" + too_close + "; needs size_m >= " +
                                  needed_size(at_any_size(part), part.drawn, wanted_m, part.spacing_of) +
                                  (extruded ? " instead of a depth_m" : ""));
        }
    }

    /// A part's figure for other sizes than its own: brush strokes are in metres, and an extruded area's points depend
    /// on its proportions, so it is drawn anew.
    Figure at_any_size(const PlacedPart& placed) const {
        Figure out = placed.figure;
        if (placed.ref.part.density.brush.empty() && !is_extruded(placed.ref.part.source)) return out;
        out.points = [this, &placed](const Vec3& scale) {
            const Vec3 size_m = placed.figure.extent * scale;
            const auto side = [&](int axis) { return size_m[axis] > 0.0 ? std::optional(size_m[axis]) : std::nullopt; };
            Part part = placed.ref.part;
            part.size = {side(0), side(1), side(2)};
            const auto figure = figure_of({mission_, part, placed.ref.key}, run_);
            return figure ? figure->points(scale) : placed.figure.points(scale);
        };
        return out;
    }

    /// One message a part and bound: its lowest slot above the lowest altitude, its highest below the ceiling.
    void check_altitudes() {
        const double low_m = mission_.limits.min_navigation_altitude_m, high_m = mission_.limits.ceiling_m;
        for (const PlacedPart& part : parts_) {
            const auto begin = out_.points_m.begin() + static_cast<std::ptrdiff_t>(part.first_slot);
            const auto end = begin + static_cast<std::ptrdiff_t>(part.drawn.points_m.size());
            const auto [low, high] =
                std::minmax_element(begin, end, [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
            const auto slot_at = [&](Points::iterator place) {
                return ".center_m: slot " +
                       std::to_string(SlotId(static_cast<std::size_t>(place - out_.points_m.begin())).number()) +
                       " stands at z = " + floored(place->z) + " m, ";
            };
            if (high->z - low->z > high_m - low_m + kAltitudeTolerance_m) {
                problem(part.ref, ".size_m: stands " + shortest(std::ceil((high->z - low->z) * 10.0 - 1e-9) / 10.0) +
                                      " m high; at most " + shortest(high_m - low_m) +
                                      " m fit between min_navigation_altitude_m = " + shortest(low_m) +
                                      " and ceiling_m = " + shortest(high_m));
                continue;
            }
            if (low->z < low_m - kAltitudeTolerance_m) {
                problem(part.ref, slot_at(low) + "below min_navigation_altitude_m = " + shortest(low_m) +
                                      "; raise it by " + shortest(std::ceil((low_m - low->z) * 10.0 - 1e-9) / 10.0) +
                                      " m");
            }
            if (high->z > high_m + kAltitudeTolerance_m) {
                problem(part.ref, slot_at(high) + "above ceiling_m = " + shortest(high_m) + "; lower it by " +
                                      shortest(std::ceil((high->z - high_m) * 10.0 - 1e-9) / 10.0) + " m");
            }
        }
    }

    void problem(const PartRef& ref, const std::string& what) {
        if (!problems_.empty()) problems_ += '\n';
        problems_ += ref.error(what).message;
    }

    const Mission& mission_;
    const Keyframe& keyframe_;
    std::string key_;
    const Run& run_;
    SeparationMetric metric_;
    glm::dmat3 turn_;
    std::vector<PlacedPart> parts_;
    Formation out_;
    std::string problems_;
};

}  // namespace

Result<Formation> build_formation(const Mission& mission, std::size_t index, const Run& run) {
    AEROGRAM_REQUIRE(index < mission.keyframes.size(), index, mission.keyframes.size());
    const auto& parts = mission.keyframes[index].parts;
    const auto drones = std::accumulate(parts.begin(), parts.end(), std::size_t{0},
                                        [](std::size_t sum, const Part& part) { return sum + part.drones; });
    AEROGRAM_REQUIRE(drones <= mission.fleet.drones, drones, mission.fleet.drones);
    return Builder(mission, index, run).build();
}

}  // namespace aerogram::planner
