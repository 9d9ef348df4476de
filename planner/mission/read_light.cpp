#include <algorithm>

#include "planner/mission/sections.hpp"

namespace aerogram::planner {
namespace {

std::optional<LightVolume> read_volume(TableReader& light) {
    auto in = light.table("volume");
    if (!in) return std::nullopt;
    LightVolume out;
    out.center_m = in->vec3("center_m").value_or(Vec3{});
    if (in->has("size_m") == in->has("radius_m"))
        in->problems().add(in->line(), in->path() + ": must have either size_m = [x, y, z] or radius_m");
    const auto size_m = in->numbers("size_m", 3, 3, "three numbers > 0: [x, y, z]", more_than(0.0, 10000.0));
    if (size_m) out.size_m = Vec3((*size_m)[0], (*size_m)[1], (*size_m)[2]);
    out.radius_m = in->number("radius_m", more_than(0.0, 10000.0));
    in->finish();
    return out;
}

// A list of pictures, or one.
std::vector<std::filesystem::path> read_images(TableReader& in) {
    std::vector<std::filesystem::path> out;
    if (in.has("image") && in.has("images")) in.bad("images", "stands beside image; must be one of the two");
    if (const auto one = in.file("image", "a PNG or JPEG file")) out.push_back(*one);
    const TomlValue* value = in.find("images");
    if (!value) return out;
    const auto* array = std::get_if<TomlArray>(&value->data);
    bool sound = array && !array->empty();
    for (std::size_t i = 0; sound && i < array->size(); ++i) {
        const auto* name = std::get_if<std::string>(&(*array)[i].data);
        std::error_code failed;
        const auto file = in.problems().resolved(name ? *name : "");
        sound = name && name->find('\0') == std::string::npos && std::filesystem::is_regular_file(file, failed);
        if (sound) out.push_back(file);
        if (name && !sound) in.bad("images", "there is no file " + file.generic_string());
        if (!name) in.bad("images", "must be a list of PNG or JPEG files");
    }
    if (!array || array->empty()) in.bad("images", "must be a list of PNG or JPEG files");
    return out;
}

void read_target(TableReader& in, const Mission& mission, Light& out) {
    if (const auto name = in.text("keyframe")) {
        out.keyframe = *name;
        const bool known = std::ranges::any_of(mission.keyframes,
                                               [&](const Keyframe& k) { return k.name == *name || k.clip == *name; });
        if (!known) in.bad("keyframe", "no keyframe is called so");
    }
    out.start_s = in.number("start_s", {-86400.0, 86400.0}).value_or(0.0);
    if (out.keyframe.empty() && out.start_s < 0.0) in.bad("start_s", "must be >= 0 without a keyframe");
    out.duration_s = in.number("duration_s", more_than(0.0, 86400.0));
    if (const auto name = in.text("group")) {
        const auto group = std::ranges::find(mission.groups, *name, &Group::name);
        if (group == mission.groups.end()) {
            in.bad("group", "no [[group]] is called so");
        } else {
            out.group = static_cast<std::size_t>(group - mission.groups.begin());
        }
    }
    out.volume = read_volume(in);
}

void read_look(TableReader& in, Light& out) {
    if (in.has("color") && in.has("colors")) in.bad("colors", "stands beside color; must be one of the two");
    if (const auto one = in.text("color")) {
        const Result<Rgb> color = rgb_from_hex(*one);
        if (!color) in.bad("color", "must be \"#rgb\" or \"#rrggbb\"");
        if (color) out.colors = {*color};
    }
    if (auto several = read_colors(in, "colors", 1)) out.colors = std::move(*several);
    out.blend =
        in.choice<LightBlend>(
              "blend", {{"replace", LightBlend::replace}, {"add", LightBlend::add}, {"multiply", LightBlend::multiply}})
            .value_or(out.blend);
    out.opacity = in.number("opacity", {0.0, 1.0}).value_or(out.opacity);
    out.fade_in_s = in.number("fade_in_s", at_least(0.0, 3600.0)).value_or(0.0);
    out.fade_out_s = in.number("fade_out_s", at_least(0.0, 3600.0)).value_or(0.0);
}

// Parameters of one effect or another; those of others are refused.
void read_parameters(TableReader& in, Light& out) {
    using enum LightEffect;
    struct Owned {
        std::string_view key;
        std::initializer_list<LightEffect> effects;
    };
    const Owned owned[] = {{"direction", {sweep, gradient, chase}},
                           {"width_m", {sweep}},
                           {"period_s", {sweep, chase, pulse, sparkle, gradient}},
                           {"length", {chase}},
                           {"share", {sparkle}},
                           {"radial", {sweep, gradient}},
                           {"in_time", {gradient}},
                           {"image", {image}},
                           {"images", {image}},
                           {"image_size_m", {image}}};
    for (const Owned& key : owned) {
        if (in.has(key.key) && std::ranges::find(key.effects, out.effect) == key.effects.end())
            in.bad(key.key, "this effect has no " + std::string(key.key));
    }
    out.direction = read_direction(in, "direction");
    out.width_m = in.number("width_m", more_than(0.0, 10000.0)).value_or(out.width_m);
    out.period_s = in.number("period_s", {0.04, 86400.0}).value_or(out.effect == gradient ? 0.0 : out.period_s);
    out.length = static_cast<std::uint32_t>(in.integer("length", 1, 100000).value_or(out.length));
    out.share = in.number("share", {0.0, 1.0, true}).value_or(out.share);
    out.radial = in.flag("radial").value_or(false);
    out.in_time = in.flag("in_time").value_or(false);
    if (in.has("direction") && out.radial) in.bad("direction", "stands beside radial; must be one of the two");
    if (in.has("direction") && out.in_time) in.bad("direction", "a gradient in time has no direction");
    if (out.effect == image) {
        for (const std::string_view key : {"color", "colors"})
            if (in.has(key)) in.bad(key, "a picture brings its own colours");
    }
    out.images = read_images(in);
    if (out.effect == image && !in.has("image") && !in.has("images")) in.need("image", "write image = \"flag.png\"");
    if (const auto size_m = in.numbers("image_size_m", 2, 2, "[width, height], each > 0", more_than(0.0, 10000.0)))
        out.image_size_m = {(*size_m)[0], (*size_m)[1]};
    if (out.effect == image && out.keyframe.empty() && !in.has("image_size_m"))
        in.need("image_size_m", "without a keyframe the picture's plane needs a size: write image_size_m = [40, 30]");
}

}  // namespace

void read_light_effects(TableReader& root, Mission& mission) {
    using enum LightEffect;
    for (TableReader& in : root.tables("light")) {
        Light light;
        light.line = in.line();
        in.need("effect", "write effect = \"sweep\"");
        const auto effect = in.choice<LightEffect>("effect", {{"fade", fade},
                                                              {"sweep", sweep},
                                                              {"chase", chase},
                                                              {"pulse", pulse},
                                                              {"sparkle", sparkle},
                                                              {"gradient", gradient},
                                                              {"image", image}});
        light.effect = effect.value_or(fade);
        read_target(in, mission, light);
        read_look(in, light);
        if (effect) {
            read_parameters(in, light);
        } else {
            in.know({"direction", "width_m", "period_s", "length", "share", "radial", "in_time", "image", "images",
                     "image_size_m"});
        }
        if (light.effect == gradient && light.colors.size() < 2 && effect)
            in.bad(in.has("colors") ? "colors" : "effect", "a gradient needs colors = [...] with at least two");
        in.finish();
        mission.lights.push_back(std::move(light));
    }
}

}  // namespace aerogram::planner
