#include "planner/mission/sections.hpp"

namespace aerogram::planner {
namespace {

constexpr std::string_view kColorForm = "\"#rgb\" or \"#rrggbb\"";

std::optional<Rgb> color_of(const TomlValue& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    if (!text) return std::nullopt;
    const Result<Rgb> color = rgb_from_hex(*text);
    return color ? std::optional(*color) : std::nullopt;
}

std::optional<Paint> read_table(TableReader in) {
    std::optional<Paint> out;
    std::vector<std::string_view> present;
    for (const std::string_view key : {"gradient", "palette", "image"}) {
        if (in.has(key)) present.push_back(key);
    }
    if (present.size() != 1) {
        in.problems().add(in.line(), in.path() + ": must have exactly one of gradient, palette and image");
        in.know({"gradient", "palette", "image", "direction", "radial", "by"});
        return std::nullopt;
    }
    if (present[0] == "gradient") {
        Gradient gradient;
        gradient.colors = read_colors(in, "gradient", 2).value_or(std::vector<Rgb>{});
        gradient.radial = in.flag("radial").value_or(false);
        if (gradient.radial && in.has("direction")) in.bad("direction", "stands beside radial; must be one of the two");
        gradient.direction = read_direction(in, "direction").value_or(gradient.direction);
        if (!gradient.colors.empty()) out = std::move(gradient);
    } else if (present[0] == "palette") {
        Palette palette;
        palette.colors = read_colors(in, "palette", 1).value_or(std::vector<Rgb>{});
        palette.by =
            in.choice<PaletteBy>("by", {{"slot", PaletteBy::slot}, {"random", PaletteBy::random}}).value_or(palette.by);
        if (!palette.colors.empty()) out = std::move(palette);
    } else if (const auto file = in.file("image", "a PNG or JPEG file")) {
        out = ProjectedPicture{*file};
    }
    in.finish();
    return out;
}

}  // namespace

std::optional<std::vector<Rgb>> read_colors(TableReader& in, std::string_view key, std::size_t least) {
    const TomlValue* value = in.find(key);
    if (!value) return std::nullopt;
    const auto* array = std::get_if<TomlArray>(&value->data);
    std::vector<Rgb> colors;
    for (std::size_t i = 0; array && i < array->size(); ++i) {
        const auto color = color_of((*array)[i]);
        if (color) colors.push_back(*color);
    }
    if (array && colors.size() == array->size() && colors.size() >= least) return colors;
    in.bad(key, "must be a list of >= " + std::to_string(least) + " colours, each " + std::string(kColorForm));
    return std::nullopt;
}

std::optional<Vec3> read_direction(TableReader& in, std::string_view key) {
    const auto direction = in.vec3(key);
    if (direction && *direction == Vec3{}) {
        in.bad(key, "must have a length");
        return std::nullopt;
    }
    return direction;
}

std::optional<Paint> read_paint(TableReader& in, std::string_view key) {
    const TomlValue* value = in.find(key);
    if (!value) return std::nullopt;
    if (std::holds_alternative<TomlTable>(value->data)) return read_table(*in.table(key));
    if (const auto color = color_of(*value)) return *color;
    in.bad(key, "must be " + std::string(kColorForm) +
                    ", or a table with a gradient, a palette or an image, as in { gradient = [\"#f00\", \"#00f\"] }");
    return std::nullopt;
}

}  // namespace aerogram::planner
