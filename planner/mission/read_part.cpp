#include <algorithm>
#include <array>

#include "geo/units.hpp"
#include "planner/mission/read_source.hpp"

namespace aerogram::planner {
namespace {

constexpr std::array<std::string_view, 28> kSourceKeys{
    "text",   "svg",       "image",   "mesh",          "csv",     "shape", "sketch",          "font",       "style",
    "align",  "along",     "rows",    "columns",       "turns",   "inner", "sides",           "waves",      "density",
    "brush",  "threshold", "palette", "outline_share", "if_open", "up",    "sampling_unit_m", "relaxation", "size_m",
    "depth_m"};

Size read_sides(TableReader& in, Form form) {
    Size size;
    const TomlValue* value = in.find("size_m");
    if (!value) return size;
    if (std::holds_alternative<TomlTable>(value->data)) {
        TableReader table = *in.table("size_m");
        size.width_m = table.number("width", more_than(0.0, 10000.0));
        size.height_m = table.number("height", more_than(0.0, 10000.0));
        size.depth_m = table.number("depth", more_than(0.0, 10000.0));
        if (form == Form::flat && size.depth_m) table.bad("depth", "a flat source has width and height only");
        if (table.entries().empty()) in.bad("size_m", "must have width, height or depth");
        table.finish();
        return size;
    }
    const auto v =
        form == Form::flat
            ? in.numbers("size_m", 1, 2, "[width], [width, height] or { height = 16 }, each > 0 and <= 10000",
                         more_than(0.0, 10000.0))
            : in.numbers("size_m", 1, 3,
                         "[width], [x, y, z] or { width = .., depth = .., height = .. }, each > 0 and <= 10000",
                         more_than(0.0, 10000.0));
    if (!v) return size;
    if (form == Form::solid && v->size() == 2) {
        in.bad("size_m", "a solid source has three: must be [x, y, z], [width] or a table");
        return size;
    }
    size.width_m = (*v)[0];
    if (v->size() == 3) size.depth_m = (*v)[1];
    if (v->size() > 1) size.height_m = v->back();
    return size;
}

Size read_size(TableReader& in, Form form) {
    Size size = read_sides(in, form);
    const auto depth_m = in.number("depth_m", more_than(0.0, 10000.0));
    if (form == Form::unknown) return size;
    if (form != Form::extruded) {
        if (in.has("depth_m"))
            in.bad("depth_m", form == Form::flat
                                  ? "needs style = \"solid\", which text, svg, sketches and area shapes have"
                                  : "a solid source has its depth in size_m = [x, y, z]");
        return size;
    }
    if (size.depth_m && depth_m) in.bad("depth_m", "stands beside a size_m with a depth; must be one of the two");
    if (depth_m) size.depth_m = depth_m;
    if (!size.depth_m && !in.has("depth_m") && !in.has("size_m")) {
        in.need("depth_m", "style = \"solid\" needs how deep it is: write depth_m = 3");
    } else if (!size.depth_m && !in.has("depth_m")) {
        in.need("depth_m", "style = \"solid\" needs how deep it is: write depth_m = 3, or size_m = [x, y, z]");
    }
    if (!size.width_m && !size.height_m && !in.has("sketch"))
        in.need("size_m", "style = \"solid\" needs a width or a height: write size_m = [24]");
    return size;
}

// `density = "map.png"`, `brush = [{ center_m = [x, z], radius_m = 3, density = 2 }]`.
DensityMap read_density(TableReader& in, const Sourced& sourced, const Size& size) {
    DensityMap out;
    const auto* image = std::get_if<ImageSource>(&sourced.source);
    const TomlValue* written = in.find("density");
    const auto* word = written ? std::get_if<std::string>(&written->data) : nullptr;
    const bool of_image = image && word && (*word == "even" || *word == "luminance");
    if (written && !of_image && (sourced.dense || sourced.form == Form::unknown))
        out.image = in.file("density", std::string(image ? "\"even\", \"luminance\" or " : "") + "a PNG or JPEG file");
    for (TableReader& stroke : in.tables("brush")) {
        BrushStroke brush;
        stroke.need("center_m", "write center_m = [x, z], from the part's middle");
        stroke.need("radius_m", "write radius_m = 3");
        brush.center_m = stroke.vec2("center_m").value_or(Vec2{});
        brush.radius_m = stroke.number("radius_m", more_than(0.0, 10000.0)).value_or(1.0);
        brush.density = stroke.number("density", at_least(0.0, 1000.0)).value_or(brush.density);
        stroke.finish();
        out.brush.push_back(brush);
    }
    if (sourced.form == Form::unknown || sourced.dense) {
        const bool sketch = std::holds_alternative<SketchSource>(sourced.source);
        if (sourced.dense && !out.brush.empty() && !sketch && !size.width_m && !size.height_m)
            in.bad("brush", "needs a size_m: its places are metres from the part's middle");
        return out;
    }
    for (const std::string_view key : {"density", "brush"}) {
        if (in.has(key) && !of_image) in.bad(key, "this source has no inside to be filled by a density");
    }
    return out;
}

}  // namespace

std::span<const std::string_view> source_keys() {
    return kSourceKeys;
}

PartWish read_part(TableReader& in, const Mission& mission, bool is_part) {
    PartWish wish;
    Part& part = wish.part;
    part.line = in.line();
    Sourced sourced = read_source(in, is_part);
    part.source = sourced.source;
    part.size = read_size(in, sourced.form);
    part.density = read_density(in, sourced, part.size);
    wish.animation = std::move(sourced.animation);
    if (wish.animation && !part.size.width_m && !part.size.height_m && !part.size.depth_m)
        in.need("size_m", "an animation needs a size that holds for all frames: write size_m = [24]");
    part.center_m = in.vec3("center_m").value_or(Vec3{});
    const Vec3 rotate_deg = in.vec3("rotate_deg").value_or(Vec3{});
    part.rotate_rad = {radians(rotate_deg.x), radians(rotate_deg.y), radians(rotate_deg.z)};
    part.color = read_paint(in, "color");
    if (!is_part) return wish;
    const auto drones = in.integer("drones", 1, 100000);
    if (drones) wish.drones = static_cast<std::size_t>(*drones);
    wish.share = in.number("share", {0.0, 1.0, true});
    if (in.has("drones") && in.has("share")) in.bad("share", "stands beside drones; must be one of the two");
    part.group = in.text("group").value_or("");
    constexpr std::string_view kOfKeyframe[] = {"name", "at_s", "hold_s", "motion", "arrive"};
    in.misplaced(kOfKeyframe, "belongs to the keyframe; must stand before its [[keyframe.part]]s");
    in.finish();
    if (part.group.empty()) return wish;
    const auto group = std::find_if(mission.groups.begin(), mission.groups.end(),
                                    [&](const Group& g) { return g.name == part.group; });
    if (group == mission.groups.end()) {
        std::vector<std::string_view> names;
        for (const Group& g : mission.groups) names.push_back(g.name);
        in.bad("group", names.empty() ? "there is no [[group]] in this mission"
                                      : "must be a group of this mission: " + one_of(names));
        part.group.clear();
    } else if (!wish.drones && !wish.share && !group->drones.empty()) {
        wish.drones = group->drones.size();
    }
    return wish;
}

}  // namespace aerogram::planner
