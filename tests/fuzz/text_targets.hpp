#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "planner/text/directions.hpp"
#include "planner/text/outline_font.hpp"
#include "planner/text/outline_text.hpp"
#include "planner/text/text_layout.hpp"
#include "planner/text/utf8.hpp"

/// What the fuzz targets of texts and fonts do with any bytes: they draw something finite, or are refused with a
/// message. Build with -fsanitize=fuzzer,address,undefined; the corpora tests/fuzz/corpus/font and text are replayed by
/// a unit test. tests/fuzz/make_fonts.py draws the fonts.
namespace aerogram::planner::fuzz {

inline void insist(bool sound) {
    if (!sound) std::abort();
}

inline bool finite(const Vec2& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Bytes that may be a font: a line of each script in it, and its first glyphs.
inline void try_font(std::string_view bytes) {
    const FontData font{std::string(bytes), 0, "any.ttf"};
    std::vector<std::uint32_t> glyphs{0, 1, 2, 3, 4, 5, 6, 7};
    for (const std::string_view line : {"AV fi A\u0301", "\u0628\u0628 A", "\u0915\u093F"}) {
        const auto text = shape_text(font, std::array{line});
        insist(text.ok() || !text.error().message.empty());
        if (!text) continue;
        const ShapedLine& shaped = text->lines.front();
        insist(std::isfinite(shaped.width) && shaped.glyphs.size() < 100'000);
        for (const PlacedGlyph& glyph : shaped.glyphs) {
            insist(finite(glyph.at));
            glyphs.push_back(glyph.glyph);
        }
        insist(shaped.letters.empty() || shaped.letters.back().end == shaped.glyphs.size());
    }
    for (const std::uint32_t glyph : glyphs) {
        const auto outlines = glyph_outlines(font, std::array{glyph});
        insist(outlines.ok() || outlines.error().message.starts_with("any.ttf"));
        if (!outlines) continue;
        insist(outlines->size() == 1);
        for (const Contour& contour : outlines->front().contours) {
            insist(contour.size() > 2 && std::all_of(contour.begin(), contour.end(), finite));
        }
    }
}

/// Bytes that may be a text; the first says how it is written.
inline void try_text(std::string_view bytes, const std::filesystem::path& font) {
    TextSource source;
    const unsigned how = bytes.empty() ? 0U : static_cast<unsigned char>(bytes.front());
    source.text = std::string(bytes.substr(bytes.empty() ? 0 : 1));
    source.align = how % 3 == 0 ? TextAlign::left : how % 3 == 1 ? TextAlign::center : TextAlign::right;
    if ((how & 4U) != 0) source.along = DrawnLine{{{0, 0}, {1, 2}, {3, -1}, {4, 0}}, (how & 8U) == 0, false};
    if (const auto letters = stroke_text(source)) {
        for (const auto& letter : *letters) {
            for (const Stroke& stroke : letter) insist(std::all_of(stroke.begin(), stroke.end(), finite));
        }
    } else {
        insist(!letters.error().message.empty());
    }
    source.font_file = font;
    if (const auto region = outline_text(source)) {
        insist(!region->contours.empty());
        for (const Contour& c : region->contours) insist(std::all_of(c.begin(), c.end(), finite));
    } else {
        insist(!region.error().message.empty());
    }
    if (const auto characters = code_points(source.text)) {
        std::size_t seen = 0;
        for (const DirectedRun& run : runs_as_seen(*characters)) seen += run.end - run.begin;
        insist(seen == characters->size());
    }
}

}  // namespace aerogram::planner::fuzz
