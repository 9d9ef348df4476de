#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geo/result.hpp"
#include "geo/vec3.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// A font file, and which of its faces is meant: counted from 0 in the lower 16 bits, in the upper ones the named
/// instance of a variable font, counted from 1; 0: as it is by default.
struct FontFile {
    std::filesystem::path file;
    unsigned face = 0;
};

/// The installed font of this name: a family ("DejaVu Sans": its regular upright face) or a full name ("DejaVu Sans
/// Bold"), upper and lower case alike. Names are never replaced by similar ones.
/// Errors: invalid_input with the nearest installed names.
Result<FontFile> installed_font(const std::string& name);

/// A family among the installed fonts that draws the character by outlines; the first by name.
[[nodiscard]] std::optional<std::string> installed_family_with(char32_t character);

/// A font's bytes, as shaping and drawing want them.
struct FontData {
    std::string bytes;
    unsigned face = 0;  ///< as FontFile's
    std::string name;   ///< for messages
};
/// Errors: io when it cannot be read or is larger than 64 MiB.
Result<FontData> load_font(const FontFile& file);

/// One glyph of a line: what to draw, and where its origin is.
struct PlacedGlyph {
    std::uint32_t glyph = 0;
    Vec2 at{};
};
/// Glyphs that belong together: a letter with its marks, a ligature, a syllable; a space.
struct ShapedLetter {
    std::size_t begin = 0, end = 0;  ///< into ShapedLine::glyphs
    double left = 0.0, right = 0.0;  ///< the room that it takes in the line
};
/// A line of text in font units, from x = 0 on the baseline y = 0, left to right as it is seen.
struct ShapedLine {
    std::vector<PlacedGlyph> glyphs;
    std::vector<ShapedLetter> letters;
    double width = 0.0;  ///< from the first origin to where the next glyph would stand
};
/// What the font makes of lines: kerning, ligatures, joined forms, marks, right to left where the script runs so. Each
/// line runs as its first letter does; words, numbers and brackets inside keep their own direction (directions.hpp).
/// Errors: invalid_input when the file is no font, a line is not UTF-8, or naming the first character that the font
/// does not draw.
struct ShapedText {
    std::vector<ShapedLine> lines;
    double line_pitch = 0.0;  ///< between baselines
    double units_per_em = 0.0;
};
Result<ShapedText> shape_text(const FontData& font, std::span<const std::string_view> lines);

/// The outlines of glyphs in font units, curves as chords off by at most 1/2000 em.
/// @returns one a glyph; spaces have no contours.
/// Errors: invalid_input when the file is no font, a glyph has no outline (fonts of bitmaps, or of coloured pictures),
/// or all of them together would have more than 4 million points.
Result<std::vector<Region>> glyph_outlines(const FontData& font, std::span<const std::uint32_t> glyphs);

}  // namespace aerogram::planner
