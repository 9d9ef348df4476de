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
#include "planner/mission/export_wishes.hpp"

/// A mission as its designer wrote it: checked, defaults filled in, names resolved; nothing planned yet.
/// Everything here mirrors MISSION.md; `line` members point back into the file for error messages.
namespace aerogram::planner {

/// A line as designers draw it in the x-z plane: x right, z up.
struct DrawnLine {
    std::vector<Vec2> points;
    bool bezier = false;  ///< control points of cubic curves joined end to end: 3n + 1 of them, a closed line 3n
    bool closed = false;
};

/// How an area is shown: its outline, its inside, or both faces and the walls between them once it is extruded.
enum class AreaStyle { outline, fill, solid };
/// Where a solid's drones are: on its skin, in all of it, or on its edges.
enum class SolidStyle { surface, volume, edges };

enum class TextStyle { stroke, outline, fill, solid };
enum class TextAlign { left, center, right };
struct TextSource {
    std::string text;                                ///< UTF-8, may hold '\n'
    std::string font = "stroke";                     ///< "stroke", or the name of an installed family or font
    std::optional<std::filesystem::path> font_file;  ///< instead of an installed one; resolved like a csv
    TextStyle style = TextStyle::stroke;             ///< stroke with the font "stroke", one of the others without
    TextAlign align = TextAlign::center;
    std::optional<DrawnLine> along;  ///< baseline of a one-line text, which is as large as makes it as long as the line
    std::optional<double> outline_share;  ///< fill: share of the drones on the outline; absent: one spacing everywhere
};
struct CsvSource {
    std::filesystem::path file;  ///< resolved against the mission's folder
};
enum class ShapeKind {
    line,
    circle,
    spiral,  // lines
    disc,
    ring,
    square,
    polygon,
    star,
    heart,  // areas
    grid,   // points
    wave,
    sphere,
    dome,
    helix,
    cube,
    torus,
    cylinder,
    cone  // solids; a wave is a sheet, a helix a line
};
struct ShapeSource {
    ShapeKind kind = ShapeKind::line;
    std::optional<std::uint32_t> rows, columns;  ///< grid
    double turns = 3.0;                          ///< helix, spiral
    double inner = 0.5;       ///< ring, star: the inner width as a share of the outer; torus: the tube's, of the whole
    std::uint32_t sides = 5;  ///< polygon: corners; star: tips
    double waves = 2.0;       ///< wave: crests across its width
    AreaStyle area_style = AreaStyle::fill;        ///< areas
    SolidStyle solid_style = SolidStyle::surface;  ///< sphere, dome, cube, torus, cylinder, cone
    std::optional<double> outline_share;           ///< filled areas: as for filled text
};
enum class ImageDensity { even, luminance };
struct ImageSource {
    std::filesystem::path file;                 ///< PNG or JPEG; resolved like a csv
    bool contour = false;                       ///< the lines around what is to be seen instead of all of it
    ImageDensity density = ImageDensity::even;  ///< even: alike wherever something is to be seen
    double threshold = 0.05;                    ///< luminance times alpha, below which there is nothing to be seen
    std::optional<std::uint32_t> palette;       ///< at most this many colours
};
/// One picture of an animation in a file. All frames are drawn at the scale of the box that holds them all.
struct AnimationFrame {
    std::size_t index = 0, count = 1;  ///< the index-th of `count` that are equally far apart, first and last included
    std::string clip;                  ///< glTF: the animation's name; empty: the first
};
enum class SvgStyle { drawn, outline, fill, solid };
struct SvgSource {
    std::vector<std::filesystem::path> files;  ///< one, or all frames of an animation in order
    SvgStyle style = SvgStyle::drawn;          ///< drawn: strokes as lines, fills as areas, as the file says
    std::optional<std::uint32_t> palette;
    std::optional<double> outline_share;  ///< filled shapes
    std::optional<AnimationFrame> frame;
};
enum class UpAxis { y, z };
struct MeshSource {
    std::filesystem::path file;  ///< OBJ, STL, PLY or glTF
    SolidStyle style = SolidStyle::surface;
    bool open_to_surface = false;  ///< a volume that is not closed is sampled on its surface instead of refused
    std::optional<UpAxis> up;      ///< absent: y for glTF and OBJ, z for STL and PLY
    std::optional<AnimationFrame> frame;
};
/// Paper 002: shapes by their boundaries, in metres around the keyframe's centre.
struct SketchLine {
    DrawnLine line;        ///< metres
    bool exclude = false;  ///< a hole (closed lines); open lines are stood upon and enclose nothing
};
struct SketchSource {
    std::vector<SketchLine> lines;
    std::optional<double> sampling_unit_m;       ///< absent: paper 002, section 3.6
    std::map<SlotId, double> relaxation_weight;  ///< 1 for slots not named; paper 002, algorithm 1
    std::uint32_t relaxation_rounds = 60;
};
using Source = std::variant<TextSource, CsvSource, ShapeSource, ImageSource, SvgSource, MeshSource, SketchSource>;

/// How densely areas, skins and volumes are filled: relative to 1 everywhere.
struct BrushStroke {
    Vec2 center_m{};  ///< x, z from the middle of the part
    double radius_m = 1.0;
    double density = 2.0;  ///< in the middle; falls to 1 at the radius
};
struct DensityMap {
    std::optional<std::filesystem::path> image;  ///< luminance over the part's box seen from the front; black: nobody
    std::vector<BrushStroke> brush;

    [[nodiscard]] bool even() const { return !image && brush.empty(); }
};

/// Colours by place. Positions are the formation's in the show frame.
struct Gradient {
    std::vector<Rgb> colors;        ///< >= 2, equally far apart, linear light
    Vec3 direction{1.0, 0.0, 0.0};  ///< from the first colour to the last, across the part's box
    bool radial = false;            ///< from the box's middle to its farthest drone instead
};
enum class PaletteBy { slot, random };
struct Palette {
    std::vector<Rgb> colors;  ///< >= 1
    PaletteBy by = PaletteBy::slot;
};
/// A picture seen from the audience's seat, fitted over the part as seen from there.
struct ProjectedPicture {
    std::filesystem::path image;
};
using Paint = std::variant<Rgb, Gradient, Palette, ProjectedPicture>;

/// Size along the formation's own axes before rotation; absent components follow the aspect, all absent: the smallest
/// size that holds the formation spacing. Flat sources use width (x) and height (z); areas of style solid have all
/// three, their depth and at least one of the others given.
struct Size {
    std::optional<double> width_m, depth_m, height_m;  ///< x, y, z
};

/// One source with its place, colour and share of the fleet. A keyframe without [[keyframe.part]] has exactly one.
struct Part {
    Source source;
    Size size;
    DensityMap density;  ///< areas, skins and volumes
    Vec3 center_m{};
    Vec3 rotate_rad{};           ///< about x, y, z in that order, counter-clockwise seen from the axis' tip
    std::optional<Paint> color;  ///< absent: the source's own, else white
    std::size_t drones = 0;      ///< resolved; what the parts of a keyframe leave over is spare
    std::string group;           ///< the group whose drones fly here; empty: anyone
    int line = 0;
};

/// `automatic` tries straight, rigid and spectral, certifies each and keeps the best by the mission's objective.
/// `steered`: paper 002, section 4.2.
enum class Method { straight, spectral, rigid, flow, steered, automatic };
/// What `automatic` prefers: the shortest flight, neighbours that stay together, or the least jerk.
enum class Objective { shortest, together, smooth };
/// keep: drone i takes slot i; slots: every drone keeps its slot's number; formation_coordinates: paper 002,
/// section 3.4.
enum class Assign { shortest, bottleneck, keep, groups, slots, formation_coordinates };
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

/// Two-level control (paper 002, equation 4 and table 1, "single group dynamics").
struct SteerOptions {
    double w1 = 0.4;           ///< towards the places in the formation
    double w2 = 0.2;           ///< away from neighbours and obstacles
    double w3 = 0.3;           ///< along the group's way
    double w4 = 0.1;           ///< of the group away from other groups and obstacles
    bool face_course = false;  ///< the formation turns with its course on the way
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
    SteerOptions steer;
    int line = 0;
};

/// A wave that runs through a formation: it begins flat and ends flat.
struct Wave {
    Vec3 amplitude_m{0.0, 2.0, 0.0};  ///< to and fro along this vector
    Vec3 direction{1.0, 0.0, 0.0};    ///< where the crests run
    double length_m = 20.0;           ///< from crest to crest
    double cycles = 2.0;              ///< crests that pass a drone during the hold
};

/// How a formation moves while it is shown; at rest at both ends of the hold.
struct HoldMotion {
    double spin_rad = 0.0;  ///< about the vertical through the formation's barycentre, counter-clockwise from above
    Vec3 drift_m{};         ///< displacement over the hold
    double scale = 1.0;     ///< how many times as large it is at the end, about the barycentre
    std::optional<Wave> wave = std::nullopt;

    /// Whether it ends otherwise than it began; waves end flat.
    [[nodiscard]] bool displaces() const { return spin_rad != 0.0 || drift_m != Vec3{} || scale != 1.0; }
    [[nodiscard]] bool moves() const { return displaces() || wave; }
};

struct Keyframe {
    std::string name;         ///< unique
    std::size_t number = 1;   ///< of the [[keyframe]] in the file, from 1; all frames of an animation have its number
    std::string clip;         ///< a frame of an animation: the name of the keyframe that the mission writes, else empty
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

/// What a light effect does; parameters that an effect does not use are left alone.
enum class LightEffect { fade, sweep, chase, pulse, sparkle, gradient, image };
enum class LightBlend { replace, add, multiply };
/// Where an effect shines: a box or a ball.
struct LightVolume {
    Vec3 center_m{};  ///< from the keyframe's barycentre; of an effect without keyframe: show frame
    std::optional<Vec3> size_m;
    std::optional<double> radius_m;
};
/// A light effect over a keyframe (moves with its drones) or over a time of the show (stands in the show frame).
struct Light {
    LightEffect effect = LightEffect::fade;
    std::string keyframe;              ///< empty: over show time
    double start_s = 0.0;              ///< after the keyframe stands, or show time; may be negative with a keyframe
    std::optional<double> duration_s;  ///< absent: to the end of the hold (all frames of a clip), or of the show
    std::vector<Rgb> colors = std::vector<Rgb>(1, Rgb{1.0, 1.0, 1.0});  ///< >= 1
    LightBlend blend = LightBlend::replace;
    double opacity = 1.0;  ///< [0, 1]
    double fade_in_s = 0.0, fade_out_s = 0.0;
    std::optional<std::size_t> group;   ///< made for its drones alone, whom it spans: index into Mission::groups
    std::optional<LightVolume> volume;  ///< a mask; without keyframe, sweeps and gradients span it
    std::optional<Vec3>
        direction;          ///< sweep, gradient: where they run (absent: x); chase: along it (absent: by slot number)
    double width_m = 5.0;   ///< sweep: of the band that runs through
    double period_s = 2.0;  ///< sweep, chase, pulse, sparkle: of one round; gradient: likewise, 0: it stands still, or
                            ///< follows its colours once in its time
    std::uint32_t length = 5;                   ///< chase: drones in a run
    double share = 0.2;                         ///< sparkle: of the drones that are lit at a time
    bool radial = false;                        ///< sweep, gradient: from the middle outwards
    bool in_time = false;                       ///< gradient: colours follow one another in time instead of in space
    std::vector<std::filesystem::path> images;  ///< image: one, or a sequence that plays once in the effect's time
    Vec2 image_size_m{};                        ///< image: width and height of the upright plane; 0: the keyframe's box
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
    std::optional<Vec3> seat_m;  ///< where the audience's eyes are; absent: see audience_seat
    Fleet fleet;
    Limits limits;
    geo::Airspace airspace;                ///< already in the show frame
    std::vector<double> obstacle_weights;  ///< one an obstacle: as a vertex of spectral transitions; 0: is none
    std::vector<Keyframe> keyframes;       ///< >= 1
    std::vector<Group> groups;
    std::vector<Cue> cues;        ///< in time order
    double light_rate_hz = 25.0;  ///< [lights] rate_hz, [1, 50]
    std::vector<Light> lights;    ///< later ones over earlier ones
    std::vector<AdjacencyEdit> adjacency;
    std::optional<Carrier> carrier;
    ExportWishes exporting;
    ReportWishes reporting;

    /// "file:line: what" for messages of later stages, e.g. at(k.line, "keyframe[2].size_m = 3: needs >= 7.5").
    [[nodiscard]] std::string at(int line, const std::string& what) const;
};

/// The audience's eyes: [show] seat_m, else 1.7 m above the middle of the audience's polygon, else 1.7 m high and 80 m
/// in front of the origin.
[[nodiscard]] Vec3 audience_seat(const Mission& mission);

/// "keyframe[3]" as messages and people count: from 1. @param index  into mission.keyframes.
[[nodiscard]] std::string keyframe_key(const Mission& mission, std::size_t index);

}  // namespace aerogram::planner
