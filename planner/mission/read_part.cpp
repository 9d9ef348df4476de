#include <algorithm>
#include <array>

#include "geo/units.hpp"
#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

constexpr std::array<std::string_view, 7> kSources{"text", "csv", "shape", "svg", "image", "mesh", "sketch"};
constexpr std::array<std::string_view, 20> kSourceKeys{
    "text", "csv",     "shape", "svg",   "image",   "mesh",      "sketch",  "font",          "style",  "align",
    "rows", "columns", "turns", "inner", "density", "threshold", "palette", "outline_share", "size_m", "depth_m"};

// What size_m may look like; unknown where the source itself is wrong, so that one slip is told once.
enum class Form { flat, solid, unknown };
struct Sourced {
    Source source = TextSource{};
    Form form = Form::unknown;
};

bool is_font_file(std::string_view font) {
    const std::string ending = std::filesystem::path(font).extension().string();
    constexpr std::array<std::string_view, 8> kEndings{".ttf", ".otf", ".ttc", ".otc", ".TTF", ".OTF", ".TTC", ".OTC"};
    return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

std::optional<double> read_outline_share(TableReader& in) {
    return in.number("outline_share", {0.0, 1.0});
}

TextSource read_text(TableReader& in) {
    TextSource out;
    out.text = in.text("text").value_or("");
    const bool blank = std::all_of(out.text.begin(), out.text.end(),
                                   [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; });
    if (blank && !out.text.empty()) in.bad("text", "must hold a character that can be seen");
    out.font = in.text("font").value_or(out.font);
    if (is_font_file(out.font)) out.font_file = in.file("font", "a TrueType or OpenType font file");
    using enum TextStyle;
    const bool strokes = out.font == "stroke";
    const auto style =
        in.choice<TextStyle>("style", {{"stroke", stroke}, {"outline", outline}, {"fill", fill}, {"solid", {}}});
    if (style && strokes && *style != stroke) {
        in.bad("style", "needs a font with outlines; write font = \"DejaVu Sans\" or another family or font file");
    } else if (style == stroke && !strokes) {
        in.bad("style", "needs font = \"stroke\"; a font with outlines has \"outline\" and \"fill\"");
    }
    out.style = style.value_or(strokes ? stroke : fill);
    out.align = in.choice<TextAlign>(
                      "align", {{"left", TextAlign::left}, {"center", TextAlign::center}, {"right", TextAlign::right}})
                    .value_or(out.align);
    out.outline_share = read_outline_share(in);
    if (out.outline_share && out.style != fill) in.bad("outline_share", "only style = \"fill\" has an outline_share");
    return out;
}

ImageSource read_image(TableReader& in) {
    ImageSource out;
    out.file = in.file("image", "a PNG or JPEG file").value_or("");
    out.density =
        in.choice<ImageDensity>("density", {{"even", ImageDensity::even}, {"luminance", ImageDensity::luminance}})
            .value_or(out.density);
    out.threshold = in.number("threshold", {0.0, 1.0}).value_or(out.threshold);
    if (const auto colors = in.integer("palette", 1, 256)) out.palette = static_cast<std::uint32_t>(*colors);
    return out;
}

Sourced read_shape(TableReader& in) {
    using enum ShapeKind;
    ShapeSource out;
    const auto kind = in.choice<ShapeKind>("shape", {{"line", line},
                                                     {"grid", grid},
                                                     {"circle", circle},
                                                     {"sphere", sphere},
                                                     {"helix", helix},
                                                     {"disc", disc},
                                                     {"ring", ring},
                                                     {"square", square},
                                                     {"star", {}},
                                                     {"heart", {}},
                                                     {"polygon", {}},
                                                     {"spiral", {}},
                                                     {"cube", {}},
                                                     {"box", {}},
                                                     {"cylinder", {}},
                                                     {"cone", {}},
                                                     {"torus", {}}});
    out.kind = kind.value_or(line);
    const auto count = [&](std::string_view key) -> std::optional<std::uint32_t> {
        const auto n = in.integer(key, 1, 100000);
        if (n && kind && kind != grid) in.bad(key, "only shape = \"grid\" has " + std::string(key));
        return n ? std::optional(static_cast<std::uint32_t>(*n)) : std::nullopt;
    };
    out.rows = count("rows");
    out.columns = count("columns");
    const auto turns = in.number("turns", more_than(0.0, 1000.0));
    if (turns && kind && kind != helix) in.bad("turns", "only shape = \"helix\" has turns");
    out.turns = turns.value_or(out.turns);
    const auto inner = in.number("inner", {0.0, 0.99, true});
    if (inner && kind && kind != ring) in.bad("inner", "only shape = \"ring\" has inner");
    out.inner = inner.value_or(out.inner);
    out.outline_share = read_outline_share(in);
    const bool area = kind == disc || kind == ring || kind == square;
    if (out.outline_share && kind && !area) in.bad("outline_share", "only disc, ring and square have an outline_share");
    if (!kind) return {out, Form::unknown};
    return {out, *kind == sphere || *kind == helix ? Form::solid : Form::flat};
}

// Keys that another source would have.
void refuse_foreign_keys(TableReader& in, std::string_view source) {
    const auto only = [&](std::string_view owner, std::initializer_list<std::string_view> keys) {
        for (const std::string_view key : keys) {
            if (in.has(key) && source != owner)
                in.bad(key, "belongs to " + std::string(owner) + "; this source is " + std::string(source));
        }
    };
    only("text", {"font", "style", "align"});
    only("shape", {"rows", "columns", "turns", "inner"});
    only("image", {"density", "threshold", "palette"});
    if (in.has("outline_share") && source != "text" && source != "shape")
        in.bad("outline_share", "belongs to text and shape; this source is " + std::string(source));
    in.later("depth_m", "sources are strokes, areas and points, without depth");
}

void know_source_keys(TableReader& in) {
    in.know({"font", "style", "align", "rows", "columns", "turns", "inner", "density", "threshold", "palette",
             "outline_share", "depth_m"});
}

Sourced read_source(TableReader& in, bool is_part) {
    std::vector<std::string_view> present;
    for (const std::string_view key : kSources) {
        if (in.has(key)) present.push_back(key);
    }
    const std::string now = "text, image, csv or shape";
    if (present.empty()) {
        know_source_keys(in);
        in.problems().add(in.line(),
                          in.path() + ": no source; write one of " + now + (is_part ? "" : ", or [[keyframe.part]]s"));
        return {};
    }
    if (present.size() > 1) {
        know_source_keys(in);
        in.bad(present[1], "second source beside " + std::string(present[0]) + "; must be exactly one of " + now +
                               (is_part ? "" : " (several: [[keyframe.part]]s)"));
        return {};
    }
    Sourced source;
    if (present[0] == "text") {
        source = {read_text(in), Form::flat};
    } else if (present[0] == "image") {
        source = {read_image(in), Form::flat};
    } else if (present[0] == "csv") {
        const auto file = in.file("csv", "a CSV file with the header Name,x_m,y_m,z_m[,Red,Green,Blue]");
        source = {CsvSource{file.value_or("")}, Form::solid};
    } else if (present[0] == "shape") {
        source = read_shape(in);
    } else if (in.text(present[0])) {
        in.bad(present[0], "source not in this version; must be " + now);
    }
    refuse_foreign_keys(in, present[0]);
    return source;
}

Size read_size(TableReader& in, Form form) {
    const bool flat = form == Form::flat;
    Size size;
    const TomlValue* value = in.find("size_m");
    if (!value) return size;
    if (std::holds_alternative<TomlTable>(value->data)) {
        TableReader table = *in.table("size_m");
        size.width_m = table.number("width", more_than(0.0, 10000.0));
        size.height_m = table.number("height", more_than(0.0, 10000.0));
        size.depth_m = table.number("depth", more_than(0.0, 10000.0));
        if (flat && size.depth_m) table.bad("depth", "a flat source has width and height only");
        if (table.entries().empty()) in.bad("size_m", "must have width, height or depth");
        table.finish();
        return size;
    }
    const auto v =
        flat ? in.numbers("size_m", 1, 2, "[width], [width, height] or { height = 16 }, each > 0 and <= 10000",
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

}  // namespace

std::span<const std::string_view> source_keys() {
    return kSourceKeys;
}

std::optional<Rgb> read_color(TableReader& in) {
    const TomlValue* value = in.find("color");
    if (!value) return std::nullopt;
    if (std::holds_alternative<TomlTable>(value->data)) {
        in.bad("color", "gradients are not in this version; must be \"#rgb\" or \"#rrggbb\"");
        return std::nullopt;
    }
    const auto* text = std::get_if<std::string>(&value->data);
    if (text) {
        if (Result<Rgb> color = rgb_from_hex(*text)) return *color;
    }
    in.bad("color", "must be \"#rgb\" or \"#rrggbb\"");
    return std::nullopt;
}

PartWish read_part(TableReader& in, const Mission& mission, bool is_part) {
    PartWish wish;
    Part& part = wish.part;
    part.line = in.line();
    const Sourced sourced = read_source(in, is_part);
    part.source = sourced.source;
    part.size = read_size(in, sourced.form);
    part.center_m = in.vec3("center_m").value_or(Vec3{});
    const Vec3 rotate_deg = in.vec3("rotate_deg").value_or(Vec3{});
    part.rotate_rad = {radians(rotate_deg.x), radians(rotate_deg.y), radians(rotate_deg.z)};
    part.color = read_color(in);
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
