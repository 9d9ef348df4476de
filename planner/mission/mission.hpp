#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "geo/airspace.hpp"
#include "geo/color.hpp"
#include "geo/ids.hpp"
#include "geo/limits.hpp"
#include "geo/show_frame.hpp"
#include "geo/tracks.hpp"

/// A mission as its designer wrote it: checked, defaults filled in, names resolved; nothing planned yet.
/// Everything here mirrors MISSION.md; `line` members point back into the file for error messages.
namespace aerogram::planner {

enum class TextStyle { stroke, outline, fill };
enum class TextAlign { left, center, right };
struct TextSource {
    std::string text;                                ///< UTF-8, may hold '\n'
    std::string font = "stroke";                     ///< "stroke", or the name of an installed family or font
    std::optional<std::filesystem::path> font_file;  ///< instead of an installed one; resolved like a csv
    TextStyle style = TextStyle::stroke;             ///< stroke with the font "stroke", one of the others without
    TextAlign align = TextAlign::center;
    std::optional<double> outline_share;  ///< fill: share of the drones on the outline; absent: one spacing everywhere
};
struct CsvSource {
    std::filesystem::path file;  ///< resolved against the mission's folder
};
enum class ShapeKind { line, grid, circle, sphere, helix, disc, ring, square };
struct ShapeSource {
    ShapeKind kind = ShapeKind::line;
    std::optional<std::uint32_t> rows, columns;  ///< grid
    double turns = 3.0;                          ///< helix
    double inner = 0.5;                          ///< ring: its hole's width as a share of its own
    std::optional<double> outline_share;         ///< disc, ring, square: as for filled text
};
enum class ImageDensity { even, luminance };
struct ImageSource {
    std::filesystem::path file;                 ///< PNG or JPEG; resolved like a csv
    ImageDensity density = ImageDensity::even;  ///< even: alike wherever something is to be seen
    double threshold = 0.05;                    ///< luminance times alpha, below which there is nothing to be seen
    std::optional<std::uint32_t> palette;       ///< at most this many colours
};
using Source = std::variant<TextSource, CsvSource, ShapeSource, ImageSource>;

/// Size along the formation's own axes before rotation; absent components follow the aspect, all absent: the smallest
/// size that holds the formation spacing. Flat sources use width (x) and height (z).
struct Size {
    std::optional<double> width_m, depth_m, height_m;  ///< x, y, z
};

/// One source with its place, colour and share of the fleet. A keyframe without [[keyframe.part]] has exactly one.
struct Part {
    Source source;
    Size size;
    Vec3 center_m{};
    Vec3 rotate_rad{};         ///< about x, y, z in that order, counter-clockwise seen from the axis' tip
    std::optional<Rgb> color;  ///< absent: the source's own, else white
    std::size_t drones = 0;    ///< resolved; what the parts of a keyframe leave over is spare
    std::string group;         ///< the group whose drones fly here; empty: anyone
    int line = 0;
};

/// `automatic` tries straight, rigid and spectral, certifies each and keeps the best by the mission's objective.
enum class Method { straight, spectral, rigid, flow, automatic };
/// What `automatic` prefers: the shortest flight, neighbours that stay together, or the least jerk.
enum class Objective { shortest, together, smooth };
enum class Assign { shortest, bottleneck, keep, groups };
enum class ProfileKind { minimum_jerk, trapezoid, s_curve };
enum class SeparationMethod { projection, social_force, none };
enum class Align { pca, kabsch, none };
enum class Reorder { greedy, max_min, optimal, none };
struct SpectralOptions {
    Align align = Align::kabsch;
    Reorder reorder = Reorder::optimal;
    bool inflate = false;
};
enum class FlowOf { positions, spectral };
struct FlowOptions {
    double tension = 0.5;           ///< Catmull-Rom's tau, [0, 1]; paper 000, equation 5
    bool corner = false;            ///< the path is not smooth at the keyframe arrived at
    FlowOf of = FlowOf::positions;  ///< what is interpolated: positions, or bases and coefficients (cumulative form)
};

/// How one group moves inside its parent: its members around its barycentre (paper 000, section 4.4).
struct GroupMove {
    std::size_t group = 0;  ///< index into Mission::groups
    Method method = Method::straight;
    double blend = 1.0;  ///< 1: as the group's method says; 0: as the parent's method would move its drones; between
    SpectralOptions spectral;
};

/// How the fleet comes to a keyframe.
struct Arrive {
    Method method = Method::straight;
    Assign assign = Assign::shortest;
    std::map<DroneId, SlotId> pins;
    std::set<std::pair<DroneId, SlotId>> forbid;  ///< pairs that may not be matched
    std::optional<double> duration_s;
    double stagger_s = 0.0;                  ///< the last drones start this much later than the first
    std::optional<double> min_separation_m;  ///< more than the mission's minimum, asked for on this way alone
    std::vector<GroupMove> groups;           ///< groups that move as bodies here; their order is the file's
    ProfileKind profile = ProfileKind::minimum_jerk;
    SeparationMethod separation = SeparationMethod::projection;
    SpectralOptions spectral;
    FlowOptions flow;
    int line = 0;
};

/// How a formation moves while it is shown; at rest at both ends of the hold.
struct HoldMotion {
    double spin_rad = 0.0;  ///< about the vertical through the formation's barycentre, counter-clockwise from above
    Vec3 drift_m{};         ///< displacement over the hold

    [[nodiscard]] bool moves() const { return spin_rad != 0.0 || drift_m != Vec3{}; }
};

struct Keyframe {
    std::string name;         ///< unique
    std::vector<Part> parts;  ///< >= 1
    Vec3 center_m{};          ///< with parts: applied on top of each part's own place; else (0,0,0) and in the part
    Vec3 rotate_rad{};
    std::optional<double> at_s;  ///< the formation stands at this show time
    double hold_s = 3.0;         ///< 0 only where the next arrival is a flow
    HoldMotion motion;
    Arrive arrive;
    int line = 0;
};

/// Asks for groups to be found: this many, by spectral clustering of the first keyframe's adjacency graph.
struct Cluster {
    std::size_t count = 0;
};

/// A named set of drones. Groups may hold groups; two that share drones without one holding the other are legal, but
/// may not move, nor be matched as wholes, on the same way.
struct Group {
    std::string name;
    std::vector<DroneId> drones;      ///< ascending; those of the groups inside included
    std::vector<std::size_t> inside;  ///< groups directly inside: indices into Mission::groups
    std::optional<Cluster> cluster;   ///< groups named NAME-1, NAME-2, ... are made inside by the planner
    double weight = 10.0;             ///< multiplies adjacency weights inside the group
    int line = 0;
};

/// One end of an adjacency edit: a drone or a whole group (index into Mission::groups).
struct AdjacencyEnd {
    std::variant<DroneId, std::size_t> who;
};
struct AdjacencyEdit {
    AdjacencyEnd first, second;
    double weight = 1.0;  ///< multiplies; 0 cuts; connects with 1/d times this where no edge was
    int line = 0;
};

enum class Vehicle { copter, plane };
/// Where drones go that a keyframe does not need, dark: above their pads, in columns beside the formation, or spread
/// behind it.
enum class Spares { pads, wings, overflow };

struct Fleet {
    std::size_t drones = 0;
    Vehicle vehicle = Vehicle::copter;
    Spares spares = Spares::pads;
    Points pads_m;        ///< exactly `drones` places on the ground, show frame; drone i stands on pad i
    Points spare_pads_m;  ///< the mission's pads beyond those, in its order
    double endurance_s = 900.0;
    int line = 0;
};

/// A route that the whole show rides along at constant speed: formations are placed relative to a point that moves
/// along it.
struct Carrier {
    Points waypoints_m;      ///< >= 2, show frame, neighbours apart seen from above
    double speed_mps = 0.0;  ///< over the ground
    bool turn = false;       ///< formations turn with the route: their +y is the direction of flight
    int line = 0;
};

struct Mission {
    std::filesystem::path file;
    std::string name;
    std::uint64_t seed = 1;
    Objective objective = Objective::shortest;
    geo::ShowOrigin origin;
    std::optional<std::filesystem::path> audio;
    Fleet fleet;
    Limits limits;
    geo::Airspace airspace;                ///< already in the show frame
    std::vector<double> obstacle_weights;  ///< one an obstacle: as a vertex of spectral transitions; 0: is none
    std::vector<Keyframe> keyframes;       ///< >= 1
    std::vector<Group> groups;
    std::vector<Cue> cues;        ///< in time order
    double light_rate_hz = 25.0;  ///< [lights] rate_hz, [1, 50]
    std::vector<AdjacencyEdit> adjacency;
    std::optional<Carrier> carrier;

    /// "file:line: what" for messages of later stages, e.g. at(k.line, "keyframe[2].size_m = 3: needs >= 7.5").
    [[nodiscard]] std::string at(int line, const std::string& what) const;
};

/// "keyframe[3]" as messages and people count: from 1.
[[nodiscard]] std::string keyframe_key(std::size_t index);

}  // namespace aerogram::planner
