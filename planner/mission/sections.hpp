#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/mission/mission.hpp"
#include "planner/mission/table_reader.hpp"

/// The parts of a mission file, each read by one function from its table into the mission. Problems go to the reader's
/// Problems; later functions rely on what earlier ones filled in and skip checks against values that were themselves
/// wrong. In the order of reading.
namespace aerogram::planner {

void read_show(TableReader& root, Mission& mission);
void read_limits(TableReader& root, Mission& mission);
/// After show and limits. A fleet that cannot be counted leaves mission.fleet.drones at 0.
void read_fleet(TableReader& root, Mission& mission);
void read_airspace(TableReader& root, Mission& mission);
void read_lights(TableReader& root, Mission& mission);
void read_groups(TableReader& root, Mission& mission);
void read_cues(TableReader& root, Mission& mission);
void read_adjacency(TableReader& root, Mission& mission);
void read_keyframes(TableReader& root, Mission& mission);
/// [carrier]; after limits and fleet. Planes without one are a problem.
void read_carrier(TableReader& root, Mission& mission);
/// [[light]]; after groups and keyframes.
void read_light_effects(TableReader& root, Mission& mission);

/// [export] and [report].
void read_export(TableReader& root, Mission& mission);
void read_report(TableReader& root, Mission& mission);

/// [keyframe.arrive]. @param in  the keyframe.
Arrive read_arrive(TableReader& in, const Mission& mission);

/// [keyframe] motion.
HoldMotion read_motion(TableReader& in);

/// `animation = { frames = 8, duration_s = 12 }` beside an svg or a mesh.
struct Animation {
    std::string clip;
    std::size_t frames = 2, repeat = 1;
    std::optional<double> duration_s;  ///< of one pass; absent: as fast as the limits allow
};
/// The keyframes that a keyframe with an animation stands for: the first is reached as the mission says, the others by
/// one flow in which every drone keeps its slot.
[[nodiscard]] std::vector<Keyframe> frames_of(const Keyframe& keyframe, const Animation& animation);

/// The source, size, place, colour, share and group of a keyframe without parts or of one part.
struct PartWish {
    Part part;
    std::optional<std::size_t> drones;
    std::optional<double> share;
    std::optional<Animation> animation;
};
PartWish read_part(TableReader& in, const Mission& mission, bool is_part);
/// `color = "#rgb"`, "#rrggbb" or a table with a gradient, a palette or an image.
std::optional<Paint> read_paint(TableReader& in, std::string_view key);
/// A list of at least so many hex colours.
std::optional<std::vector<Rgb>> read_colors(TableReader& in, std::string_view key, std::size_t least);
/// Three numbers, not all 0.
std::optional<Vec3> read_direction(TableReader& in, std::string_view key);
/// `polyline = [[x, z], ...]` or `bezier = [...]`, one of the two. @param closed  the line comes back to its start.
std::optional<DrawnLine> read_drawn_line(TableReader& in, bool closed);
/// `along = { arc_deg = 120 }` or a drawn line.
std::optional<DrawnLine> read_along(TableReader& text);
/// The keys that say what a formation looks like: they belong to the keyframe or to its parts, never to both.
[[nodiscard]] std::span<const std::string_view> source_keys();

/// Whole drones for each part: counts as given, shares by largest remainder, the others share the rest equally.
/// Parts that all say how many may leave drones over: those are spare.
/// Properties: (1) sums to at most the fleet, to all of it when a part does not say how many (2) every part has >= 1
/// (3) a share's count is within 1 of share * fleet. Errors: invalid_input when the parts ask for more drones than the
/// fleet has.
struct CountWish {
    std::optional<std::size_t> drones;
    std::optional<double> share;
};
Result<std::vector<std::size_t>> resolve_counts(std::span<const CountWish> parts, std::size_t fleet);

/// Drones of a list such as "1-5,8" (numbers from 1), ascending.
/// Errors: invalid_input saying what is wrong: not a list, out of 1..fleet, named twice. @param fleet  0: any number
/// will do.
Result<std::vector<DroneId>> parse_drone_list(std::string_view list, std::size_t fleet);

}  // namespace aerogram::planner
