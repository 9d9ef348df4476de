#include <algorithm>

#include "planner/mission/read_source.hpp"

namespace aerogram::planner {
namespace {

using enum ShapeKind;

bool is_area(ShapeKind kind) {
    return kind == disc || kind == ring || kind == square || kind == polygon || kind == star || kind == heart;
}
bool has_skin(ShapeKind kind) {
    return kind == sphere || kind == dome || kind == cube || kind == torus || kind == cylinder || kind == cone;
}

// A key that only some kinds have.
struct Owner {
    std::string_view key, owners;
    bool has;
};

void read_numbers(TableReader& in, ShapeSource& out) {
    const auto count = [&](std::string_view key, std::int64_t least,
                           std::int64_t most) -> std::optional<std::uint32_t> {
        const auto n = in.integer(key, least, most);
        return n ? std::optional(static_cast<std::uint32_t>(*n)) : std::nullopt;
    };
    out.rows = count("rows", 1, 100000);
    out.columns = count("columns", 1, 100000);
    out.sides = count("sides", 3, 1000).value_or(out.sides);
    out.turns = in.number("turns", more_than(0.0, 1000.0)).value_or(out.turns);
    out.waves = in.number("waves", more_than(0.0, 1000.0)).value_or(out.waves);
    const double most = out.kind == torus ? 0.49 : 0.99;
    out.inner = out.kind == torus ? 0.25 : out.kind == star ? 0.45 : out.inner;
    out.inner = in.number("inner", {0.0, most, true}).value_or(out.inner);
}

void read_style(TableReader& in, ShapeSource& out, bool area, bool skin) {
    if (area) {
        out.area_style =
            in.choice<AreaStyle>(
                  "style", {{"outline", AreaStyle::outline}, {"fill", AreaStyle::fill}, {"solid", AreaStyle::solid}})
                .value_or(out.area_style);
    } else if (skin) {
        out.solid_style = read_solid_style(in).value_or(out.solid_style);
        if (out.solid_style == SolidStyle::edges && (out.kind == sphere || out.kind == torus))
            in.bad("style", "this shape has no edges; must be \"surface\" or \"volume\"");
    } else {
        in.know({"style"});
    }
    out.outline_share = in.number("outline_share", {0.0, 1.0});
}

}  // namespace

Sourced read_shape(TableReader& in) {
    ShapeSource out;
    const auto kind = in.choice<ShapeKind>("shape", {{"line", line},
                                                     {"circle", circle},
                                                     {"spiral", spiral},
                                                     {"disc", disc},
                                                     {"ring", ring},
                                                     {"square", square},
                                                     {"polygon", polygon},
                                                     {"star", star},
                                                     {"heart", heart},
                                                     {"grid", grid},
                                                     {"wave", wave},
                                                     {"sphere", sphere},
                                                     {"dome", dome},
                                                     {"helix", helix},
                                                     {"cube", cube},
                                                     {"torus", torus},
                                                     {"cylinder", cylinder},
                                                     {"cone", cone}});
    out.kind = kind.value_or(line);
    const bool area = kind && is_area(*kind), skin = kind && has_skin(*kind);
    read_numbers(in, out);
    read_style(in, out, area, skin);
    if (!kind) return {out, Form::unknown, false};
    const bool filled = area && out.area_style == AreaStyle::fill;
    for (const Owner& owner :
         {Owner{"rows", "grid", kind == grid}, Owner{"columns", "grid", kind == grid},
          Owner{"sides", "polygon and star", kind == polygon || kind == star},
          Owner{"turns", "helix and spiral", kind == helix || kind == spiral}, Owner{"waves", "wave", kind == wave},
          Owner{"inner", "ring, star and torus", kind == ring || kind == star || kind == torus},
          Owner{"style", "areas and solids", area || skin},
          Owner{"outline_share", "filled areas (disc, ring, square, polygon, star, heart)", filled}}) {
        if (in.has(owner.key) && !owner.has) in.bad(owner.key, "belongs to " + std::string(owner.owners));
    }
    const bool solid = skin || kind == helix || kind == wave;
    const Form form = area && out.area_style == AreaStyle::solid ? Form::extruded : solid ? Form::solid : Form::flat;
    const bool dense = (area && out.area_style != AreaStyle::outline) || (skin && out.solid_style != SolidStyle::edges);
    return {out, form, dense};
}

}  // namespace aerogram::planner
