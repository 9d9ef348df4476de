#include <hb-ot.h>
#include <hb.h>

#include <algorithm>
#include <memory>

#include "planner/text/outline_font.hpp"
#include "planner/text/utf8.hpp"

namespace aerogram::planner {
namespace {

struct Deleter {
    void operator()(hb_blob_t* p) const { hb_blob_destroy(p); }
    void operator()(hb_face_t* p) const { hb_face_destroy(p); }
    void operator()(hb_font_t* p) const { hb_font_destroy(p); }
    void operator()(hb_buffer_t* p) const { hb_buffer_destroy(p); }
};
template <class T>
using Owned = std::unique_ptr<T, Deleter>;

/// A stretch of a line in one script and direction.
struct Stretch {
    std::size_t begin = 0, end = 0;  ///< bytes
    hb_script_t script = HB_SCRIPT_COMMON;
    hb_direction_t direction = HB_DIRECTION_LTR;
};

bool neutral(hb_script_t script) {
    return script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED || script == HB_SCRIPT_UNKNOWN;
}

hb_direction_t direction_of(hb_script_t script) {
    const hb_direction_t own = hb_script_get_horizontal_direction(script);
    return own == HB_DIRECTION_RTL ? HB_DIRECTION_RTL : HB_DIRECTION_LTR;
}

/// The stretches in the order in which they are seen. What belongs to no script (spaces, marks) goes with what stands
/// before it; digits run left to right.
std::vector<Stretch> stretches_of(std::string_view line) {
    hb_unicode_funcs_t* unicode = hb_unicode_funcs_get_default();
    std::vector<Stretch> out;
    for (std::size_t at = 0; at < line.size();) {
        const std::string_view character = first_character(line.substr(at));
        const hb_codepoint_t code = code_point(character);
        const bool digit = hb_unicode_general_category(unicode, code) == HB_UNICODE_GENERAL_CATEGORY_DECIMAL_NUMBER;
        Stretch now{at, at + character.size(), hb_unicode_script(unicode, code), HB_DIRECTION_LTR};
        if (digit) now.script = HB_SCRIPT_LATIN;
        at = now.end;
        const bool plain = neutral(now.script);
        now.direction = direction_of(now.script);
        if (!out.empty() && (plain || now.script == out.back().script || neutral(out.back().script))) {
            if (!plain && neutral(out.back().script)) {
                out.back().script = now.script;
                out.back().direction = now.direction;
            }
            out.back().end = now.end;
        } else {
            out.push_back(now);
        }
    }
    const auto strong = std::find_if(out.begin(), out.end(), [](const Stretch& s) { return !neutral(s.script); });
    if (strong != out.end() && strong->direction == HB_DIRECTION_RTL) std::reverse(out.begin(), out.end());
    return out;
}

Error missing(const FontData& font, std::string_view character) {
    std::string what = "character " + name_of_character(character) + " is not in the font " + font.name;
    const auto other = installed_family_with(code_point(character));
    what += other ? "; the installed font \"" + *other + "\" has it" : "; no installed font has it";
    return {ErrorCode::invalid_input, what};
}

Status shape_stretch(const FontData& font, hb_font_t* shaper, std::string_view line, const Stretch& stretch,
                     ShapedLine& out) {
    const Owned<hb_buffer_t> buffer(hb_buffer_create());
    hb_buffer_add_utf8(buffer.get(), line.data(), static_cast<int>(line.size()), static_cast<unsigned>(stretch.begin),
                       static_cast<int>(stretch.end - stretch.begin));
    hb_buffer_set_script(buffer.get(), stretch.script);
    hb_buffer_set_direction(buffer.get(), stretch.direction);
    hb_buffer_guess_segment_properties(buffer.get());
    hb_buffer_set_language(buffer.get(), hb_language_from_string("und", -1));  // never that of the user's system
    hb_shape(shaper, buffer.get(), nullptr, 0);
    unsigned count = 0;
    const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
    const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer.get(), &count);
    Vec2 pen(out.width, 0.0);
    for (unsigned i = 0; i < count; ++i) {
        if (infos[i].codepoint == 0) return missing(font, first_character(line.substr(infos[i].cluster)));
        out.glyphs.push_back({infos[i].codepoint, pen + Vec2(places[i].x_offset, places[i].y_offset)});
        pen += Vec2(places[i].x_advance, places[i].y_advance);
    }
    out.width = pen.x;
    return Done{};
}

}  // namespace

Result<ShapedText> shape_text(const FontData& font, std::span<const std::string_view> lines) {
    const Owned<hb_blob_t> blob(hb_blob_create(font.bytes.data(), static_cast<unsigned>(font.bytes.size()),
                                               HB_MEMORY_MODE_READONLY, nullptr, nullptr));
    const Owned<hb_face_t> face(hb_face_create(blob.get(), font.face));
    if (hb_face_get_glyph_count(face.get()) == 0) return Error{ErrorCode::invalid_input, font.name + " is not a font"};
    const Owned<hb_font_t> shaper(hb_font_create(face.get()));
    const auto em = static_cast<int>(hb_face_get_upem(face.get()));
    hb_font_set_scale(shaper.get(), em, em);
    hb_ot_font_set_funcs(shaper.get());

    ShapedText out;
    out.units_per_em = em;
    hb_font_extents_t extents{};
    const bool told = hb_font_get_h_extents(shaper.get(), &extents) != 0;
    const double pitch = static_cast<double>(extents.ascender) - extents.descender + extents.line_gap;
    out.line_pitch = told && pitch > 0.5 * em && pitch < 4.0 * em ? pitch : 1.2 * em;
    for (const std::string_view line : lines) {
        ShapedLine shaped;
        for (const Stretch& stretch : stretches_of(line)) {
            if (const Status done = shape_stretch(font, shaper.get(), line, stretch, shaped); !done)
                return done.error();
        }
        out.lines.push_back(std::move(shaped));
    }
    return out;
}

}  // namespace aerogram::planner
