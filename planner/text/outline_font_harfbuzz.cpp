#include <hb-ot.h>
#include <hb.h>

#include <algorithm>
#include <memory>

#include "planner/text/directions.hpp"
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
    std::size_t begin = 0, end = 0;  ///< code points
    hb_script_t script = HB_SCRIPT_COMMON;
    hb_direction_t direction = HB_DIRECTION_LTR;
};

bool neutral(hb_script_t script) {
    return script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED || script == HB_SCRIPT_UNKNOWN;
}

/// Each character's script. What belongs to none (spaces, digits, marks) goes with what stands before it, at the start
/// of a line with what comes.
std::vector<hb_script_t> scripts_of(std::u32string_view line) {
    hb_unicode_funcs_t* unicode = hb_unicode_funcs_get_default();
    std::vector<hb_script_t> scripts;
    for (const char32_t code : line) {
        const hb_script_t own = hb_unicode_script(unicode, code);
        scripts.push_back(neutral(own) && !scripts.empty() ? scripts.back() : own);
    }
    const auto first = std::find_if_not(scripts.begin(), scripts.end(), neutral);
    if (first != scripts.end()) std::fill(scripts.begin(), first, *first);
    return scripts;
}

/// The stretches in the order in which they are seen.
std::vector<Stretch> stretches_of(std::u32string_view line) {
    const std::vector<hb_script_t> scripts = scripts_of(line);
    std::vector<Stretch> out;
    for (const DirectedRun& run : runs_as_seen(line)) {
        const std::size_t first = out.size();
        for (std::size_t i = run.begin; i < run.end; ++i) {
            if (out.size() > first && out.back().script == scripts[i]) {
                out.back().end = i + 1;
            } else {
                out.push_back({i, i + 1, scripts[i], run.right_to_left ? HB_DIRECTION_RTL : HB_DIRECTION_LTR});
            }
        }
        if (run.right_to_left) std::reverse(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
    }
    return out;
}

/// The line as HarfBuzz counts it.
const std::uint32_t* numbers(std::u32string_view line) {
    static_assert(sizeof(char32_t) == sizeof(std::uint32_t));
    return reinterpret_cast<const std::uint32_t*>(line.data());
}

/// Shapes lines in one font.
class Shaper {
  public:
    explicit Shaper(const FontData& font)
        : font_(font),
          blob_(hb_blob_create(font.bytes.data(), static_cast<unsigned>(font.bytes.size()), HB_MEMORY_MODE_READONLY,
                               nullptr, nullptr)),
          face_(hb_face_create(blob_.get(), font.face & 0xFFFFU)),
          shaper_(hb_font_create(face_.get())) {
        const auto em = static_cast<int>(units_per_em());
        hb_font_set_scale(shaper_.get(), em, em);
        hb_ot_font_set_funcs(shaper_.get());
        if (const unsigned instance = font.face >> 16U; instance > 0) {
            hb_font_set_var_named_instance(shaper_.get(), instance - 1);
        }
    }
    [[nodiscard]] bool usable() const { return hb_face_get_glyph_count(face_.get()) > 0; }
    [[nodiscard]] unsigned units_per_em() const { return hb_face_get_upem(face_.get()); }

    [[nodiscard]] double line_pitch() const {
        const double em = units_per_em();
        hb_font_extents_t extents{};
        const bool told = hb_font_get_h_extents(shaper_.get(), &extents) != 0;
        const double pitch = static_cast<double>(extents.ascender) - extents.descender + extents.line_gap;
        return told && pitch > 0.5 * em && pitch < 4.0 * em ? pitch : 1.2 * em;
    }

    Result<ShapedLine> shape(std::u32string_view line) const {
        ShapedLine out;
        for (const Stretch& stretch : stretches_of(line)) {
            if (const Status done = append(line, stretch, out); !done) return done.error();
        }
        return out;
    }

  private:
    Status append(std::u32string_view line, const Stretch& stretch, ShapedLine& out) const {
        const Owned<hb_buffer_t> buffer(hb_buffer_create());
        hb_buffer_add_codepoints(buffer.get(), numbers(line), static_cast<int>(line.size()),
                                 static_cast<unsigned>(stretch.begin), static_cast<int>(stretch.end - stretch.begin));
        hb_buffer_set_script(buffer.get(), stretch.script);
        hb_buffer_set_direction(buffer.get(), stretch.direction);
        hb_buffer_set_language(buffer.get(), hb_language_from_string("und", -1));  // never that of the user's system
        hb_shape(shaper_.get(), buffer.get(), nullptr, 0);
        if (hb_buffer_allocation_successful(buffer.get()) == 0) {
            return Error{ErrorCode::invalid_input, font_.name + " makes too much of the text"};
        }
        unsigned count = 0;
        const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
        const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer.get(), &count);
        Vec2 pen(out.width, 0.0);
        for (unsigned i = 0; i < count; ++i) {
            if (infos[i].codepoint == 0) return missing(line, stretch, infos[i].cluster);
            if (i == 0 || infos[i].cluster != infos[i - 1].cluster) {
                out.letters.push_back({out.glyphs.size(), out.glyphs.size(), pen.x, pen.x});
            }
            out.glyphs.push_back({infos[i].codepoint, pen + Vec2(places[i].x_offset, places[i].y_offset)});
            pen += Vec2(places[i].x_advance, places[i].y_advance);
            out.letters.back().end = out.glyphs.size();
            out.letters.back().right = pen.x;
        }
        out.width = pen.x;
        return Done{};
    }

    /// Names what the font does not draw among the characters that `cluster` begins.
    [[nodiscard]] Error missing(std::u32string_view line, const Stretch& stretch, std::size_t cluster) const {
        char32_t character = line[cluster];
        for (std::size_t i = cluster; i < stretch.end; ++i) {
            hb_codepoint_t glyph = 0;
            if (hb_font_get_nominal_glyph(shaper_.get(), line[i], &glyph) != 0 && glyph != 0) continue;
            character = line[i];
            break;
        }
        std::string what = "character " + name_of_character(character) + " is not in the font " + font_.name;
        const auto other = installed_family_with(character);
        what += other ? "; the installed font \"" + *other + "\" has it" : "; no installed font has it";
        return {ErrorCode::invalid_input, what};
    }

    const FontData& font_;
    Owned<hb_blob_t> blob_;
    Owned<hb_face_t> face_;
    Owned<hb_font_t> shaper_;
};

}  // namespace

Result<ShapedText> shape_text(const FontData& font, std::span<const std::string_view> lines) {
    const Shaper shaper(font);
    if (!shaper.usable()) return Error{ErrorCode::invalid_input, font.name + " is not a font"};
    ShapedText out;
    out.units_per_em = shaper.units_per_em();
    out.line_pitch = shaper.line_pitch();
    for (const std::string_view line : lines) {
        const auto characters = code_points(line);
        if (!characters) return characters.error();
        auto shaped = shaper.shape(*characters);
        if (!shaped) return shaped.error();
        out.lines.push_back(std::move(*shaped));
    }
    return out;
}

}  // namespace aerogram::planner
