#include "planner/mission/read_source.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace aerogram::planner {
namespace {

constexpr std::array<std::string_view, 7> kSources{"text", "svg", "image", "mesh", "csv", "shape", "sketch"};
constexpr std::size_t kMostFrames = 600;
constexpr std::string_view kAnyImage = "a PNG or JPEG file";

bool is_font_file(std::string_view font) {
    const std::string ending = std::filesystem::path(font).extension().string();
    constexpr std::array<std::string_view, 8> kEndings{".ttf", ".otf", ".ttc", ".otc", ".TTF", ".OTF", ".TTC", ".OTC"};
    return std::ranges::find(kEndings, ending) != kEndings.end();
}

Sourced read_text(TableReader& in) {
    using enum TextStyle;
    TextSource out;
    out.text = in.text("text").value_or("");
    const bool blank =
        std::ranges::all_of(out.text, [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; });
    if (blank && !out.text.empty()) in.bad("text", "must hold a character that can be seen");
    out.font = in.text("font").value_or(out.font);
    if (is_font_file(out.font)) out.font_file = in.file("font", "a TrueType or OpenType font file");
    const bool strokes = out.font == "stroke";
    const auto style =
        in.choice<TextStyle>("style", {{"stroke", stroke}, {"outline", outline}, {"fill", fill}, {"solid", solid}});
    if (style && strokes && *style != stroke) {
        in.bad("style", "needs a font with outlines; write font = \"DejaVu Sans\" or another family or font file");
    } else if (style == stroke && !strokes) {
        in.bad("style", "needs font = \"stroke\"; a font with outlines has \"outline\", \"fill\" and \"solid\"");
    }
    out.style = style.value_or(strokes ? stroke : fill);
    out.align = in.choice<TextAlign>(
                      "align", {{"left", TextAlign::left}, {"center", TextAlign::center}, {"right", TextAlign::right}})
                    .value_or(out.align);
    out.along = read_along(in);
    if (in.has("along") && out.text.find('\n') != std::string::npos) in.bad("along", "needs a text of one line");
    out.outline_share = in.number("outline_share", {0.0, 1.0});
    if (out.outline_share && out.style != fill) in.bad("outline_share", "only style = \"fill\" has an outline_share");
    return {out, out.style == solid ? Form::extruded : Form::flat, out.style == fill || out.style == solid};
}

// Frames, their time and how often they are shown. @param clips  the file names its animations.
std::optional<Animation> read_animation(TableReader& source, bool is_part, bool clips) {
    auto in = source.table("animation");
    if (!in) return std::nullopt;
    if (is_part) source.bad("animation", "belongs to a keyframe without parts");
    Animation out;
    in->need("frames", "write how many keyframes show it: frames = 8");
    out.frames = static_cast<std::size_t>(in->integer("frames", 2, 100).value_or(2));
    out.repeat = static_cast<std::size_t>(in->integer("repeat", 1, 600).value_or(1));
    if (out.frames * out.repeat > kMostFrames)
        in->bad("repeat", "frames times repeat must be <= " + std::to_string(kMostFrames) + ": all are flown as one");
    out.duration_s = in->number("duration_s", more_than(0.0, 86400.0));
    out.clip = in->text("clip").value_or("");
    if (!clips && in->has("clip")) in->bad("clip", "only meshes have clips; numbered SVGs are one");
    in->finish();
    return out;
}

// walk-08.svg, walk-09.svg, walk-10.svg, ...: as many as there are frames, from the one that the mission names.
std::vector<std::filesystem::path> numbered_files(TableReader& in, const std::filesystem::path& first,
                                                  std::size_t count) {
    std::vector<std::filesystem::path> out{first};
    const std::string stem = first.stem().string();
    std::size_t digits = 0;
    while (digits < stem.size() && digits < 9 &&
           std::isdigit(static_cast<unsigned char>(stem[stem.size() - 1 - digits])))
        ++digits;
    if (digits == 0) {
        in.bad("svg", "an animation's files are numbered: must end with a number, as in walk-1.svg");
        return out;
    }
    const std::string name = stem.substr(0, stem.size() - digits), number = stem.substr(stem.size() - digits);
    for (std::size_t frame = 1; frame < count; ++frame) {
        std::string next = std::to_string(std::stoul(number) + frame);
        if (number.front() == '0' && next.size() < digits) next.insert(0, digits - next.size(), '0');
        const auto file = first.parent_path() / (name + next + first.extension().string());
        std::error_code failed;
        if (!std::filesystem::is_regular_file(file, failed)) {
            in.bad("animation",
                   "needs " + std::to_string(count) + " numbered files; there is no " + file.generic_string());
            return out;
        }
        out.push_back(file);
    }
    return out;
}

Sourced read_svg(TableReader& in, bool is_part) {
    using enum SvgStyle;
    SvgSource out;
    const auto file = in.file("svg", "an SVG file");
    out.style = in.choice<SvgStyle>("style", {{"drawn", drawn}, {"outline", outline}, {"fill", fill}, {"solid", solid}})
                    .value_or(out.style);
    if (const auto colors = in.integer("palette", 1, 256)) out.palette = static_cast<std::uint32_t>(*colors);
    out.outline_share = in.number("outline_share", {0.0, 1.0});
    if (out.outline_share && out.style != fill) in.bad("outline_share", "only style = \"fill\" has an outline_share");
    auto animation = read_animation(in, is_part, false);
    if (file) {
        out.files = animation ? numbered_files(in, *file, animation->frames) : std::vector{*file};
        if (animation) out.frame = AnimationFrame{0, animation->frames, {}};
    }
    return {out, out.style == solid ? Form::extruded : Form::flat, out.style != outline, std::move(animation)};
}

Sourced read_image(TableReader& in) {
    ImageSource out;
    out.file = in.file("image", kAnyImage).value_or("");
    out.contour = in.choice<bool>("style", {{"fill", false}, {"contour", true}}).value_or(false);
    const auto words = in.find("density");
    const auto* word = words ? std::get_if<std::string>(&words->data) : nullptr;
    if (word && (*word == "even" || *word == "luminance")) {
        out.density = *word == "even" ? ImageDensity::even : ImageDensity::luminance;
        if (out.contour) in.bad("density", "a contour has no inside; leave out density, or style = \"fill\"");
    }
    out.threshold = in.number("threshold", {0.0, 1.0}).value_or(out.threshold);
    if (const auto colors = in.integer("palette", 1, 256)) out.palette = static_cast<std::uint32_t>(*colors);
    return {out, Form::flat, !out.contour};
}

Sourced read_mesh(TableReader& in, bool is_part) {
    MeshSource out;
    out.file = in.file("mesh", "an OBJ, STL, PLY, glTF or GLB file").value_or("");
    out.style = read_solid_style(in).value_or(out.style);
    out.open_to_surface = in.choice<bool>("if_open", {{"error", false}, {"surface", true}}).value_or(false);
    if (in.has("if_open") && out.style != SolidStyle::volume) in.bad("if_open", "only style = \"volume\" has if_open");
    out.up = in.choice<UpAxis>("up", {{"y", UpAxis::y}, {"z", UpAxis::z}});
    auto animation = read_animation(in, is_part, true);
    if (animation) {
        out.frame = AnimationFrame{0, animation->frames, animation->clip};
        if (out.style != SolidStyle::surface) in.bad("animation", "only style = \"surface\" can be animated");
    }
    return {out, Form::solid, out.style != SolidStyle::edges, std::move(animation)};
}

void read_relaxation(TableReader& sketch, SketchSource& out) {
    auto in = sketch.table("relaxation");
    if (!in) return;
    if (const auto rounds = in->integer("rounds", 0, 10000))
        out.relaxation_rounds = static_cast<std::uint32_t>(*rounds);
    if (auto weights = in->table("weights")) {
        for (const TomlEntry& entry : weights->entries()) {
            const bool number = !entry.key.empty() && entry.key.size() < 7 && entry.key.front() != '0' &&
                                std::ranges::all_of(entry.key, [](unsigned char c) { return std::isdigit(c) != 0; });
            const auto weight = weights->number(entry.key, at_least(0.0, 1000.0));
            if (!number) {
                weights->bad(entry.key, "must be a slot's number from 1, as in { 3 = 2.0 }");
            } else if (weight) {
                out.relaxation_weight[SlotId::from_number(std::stoul(entry.key))] = *weight;
            }
        }
    }
    in->finish();
}

Sourced read_sketch(TableReader& in) {
    SketchSource out;
    for (TableReader& table : in.tables("sketch")) {
        const bool open = table.flag("open").value_or(false);
        const bool exclude = table.flag("exclude").value_or(false);
        if (open && exclude) table.bad("exclude", "an open line encloses nothing that could be left out");
        if (auto line = read_drawn_line(table, !open)) out.lines.push_back({std::move(*line), exclude});
        table.finish();
    }
    const auto* listed = std::get_if<TomlArray>(&in.find("sketch")->data);
    if (listed && listed->empty()) in.bad("sketch", "must have at least one line");
    const bool encloses = std::ranges::any_of(out.lines, [](const SketchLine& l) { return !l.exclude; });
    if (listed && !out.lines.empty() && out.lines.size() == listed->size() && !encloses)
        in.bad("sketch", "must have a line without exclude: there is nothing to stand on");
    out.sampling_unit_m = in.number("sampling_unit_m", more_than(0.0, 1000.0));
    read_relaxation(in, out);
    return {out, in.has("depth_m") ? Form::extruded : Form::flat, true};
}

// Keys that other sources have.
void refuse_foreign_keys(TableReader& in, std::string_view source) {
    struct Owned {
        std::string_view key, owners;
    };
    constexpr Owned kOwned[] = {{"font", "text"},
                                {"align", "text"},
                                {"along", "text"},
                                {"rows", "shape"},
                                {"columns", "shape"},
                                {"turns", "shape"},
                                {"inner", "shape"},
                                {"sides", "shape"},
                                {"waves", "shape"},
                                {"threshold", "image"},
                                {"palette", "image, svg"},
                                {"if_open", "mesh"},
                                {"up", "mesh"},
                                {"sampling_unit_m", "sketch"},
                                {"relaxation", "sketch"},
                                {"animation", "svg, mesh"},
                                {"outline_share", "text, shape, svg"},
                                {"style", "text, shape, svg, image, mesh"}};
    for (const Owned& owned : kOwned) {
        const bool ours =
            (", " + std::string(owned.owners) + ",").find(" " + std::string(source) + ",") != std::string::npos;
        if (in.has(owned.key) && !ours) {
            in.know({owned.key});
            in.bad(owned.key, "belongs to " + std::string(owned.owners) + "; this source is " + std::string(source));
        }
    }
}

}  // namespace

std::optional<SolidStyle> read_solid_style(TableReader& in) {
    return in.choice<SolidStyle>(
        "style", {{"surface", SolidStyle::surface}, {"volume", SolidStyle::volume}, {"edges", SolidStyle::edges}});
}

Sourced read_source(TableReader& in, bool is_part) {
    in.know({"font", "style", "align", "along", "rows", "columns", "turns", "inner", "sides", "waves", "threshold",
             "palette", "outline_share", "if_open", "up", "sampling_unit_m", "relaxation", "animation"});
    std::vector<std::string_view> present;
    for (const std::string_view key : kSources) {
        if (in.has(key)) present.push_back(key);
    }
    const std::string any = "text, svg, image, mesh, csv, shape or sketch";
    if (present.empty()) {
        in.problems().add(in.line(),
                          in.path() + ": no source; write one of " + any + (is_part ? "" : ", or [[keyframe.part]]s"));
        return {};
    }
    if (present.size() > 1) {
        in.bad(present[1], "second source beside " + std::string(present[0]) + "; must be exactly one of " + any +
                               (is_part ? "" : " (several: [[keyframe.part]]s)"));
        return {};
    }
    const std::string_view name = present[0];
    refuse_foreign_keys(in, name);
    if (name == "text") return read_text(in);
    if (name == "svg") return read_svg(in, is_part);
    if (name == "image") return read_image(in);
    if (name == "mesh") return read_mesh(in, is_part);
    if (name == "shape") return read_shape(in);
    if (name == "sketch") return read_sketch(in);
    const auto file = in.file("csv", "a CSV file with the header Name,x_m,y_m,z_m[,Red,Green,Blue]");
    return {CsvSource{file.value_or("")}, Form::solid, false};
}

}  // namespace aerogram::planner
