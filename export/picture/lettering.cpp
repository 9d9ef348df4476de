#include "export/picture/lettering.hpp"

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "planner/text/utf8.hpp"

namespace aerogram::exporter {
namespace {

using planner::FontData;

constexpr std::size_t kMostCharacters = 300;  ///< no line of a picture shows more
constexpr std::string_view kFamily = "DejaVu Sans";
constexpr std::string_view kCut = "…";

/// The characters of a text; what is malformed or a control character is replaced.
std::vector<std::string> characters_of(std::string_view text) {
    std::vector<std::string> out;
    while (!text.empty() && out.size() < kMostCharacters) {
        const std::string_view character = planner::first_character(text);
        const char32_t code = planner::code_point(character);
        const bool malformed = character.size() == 1 && code >= 0x80;
        out.emplace_back(malformed ? "?" : code < 0x20 || code == 0x7F ? " " : std::string(character));
        text.remove_prefix(character.size());
    }
    return out;
}

std::optional<planner::ShapedText> shaped(const FontData& font, std::string_view line) {
    const std::array lines{line};
    auto text = planner::shape_text(font, lines);
    return text ? std::optional(std::move(*text)) : std::nullopt;
}

/// Adds one stretch of text in a font that draws all of it.
bool append(Label& label, const FontData& font, std::string_view line, double size_px) {
    const auto text = shaped(font, line);
    if (!text || text->units_per_em <= 0.0) return false;
    const double scale = size_px / text->units_per_em;
    std::vector<std::uint32_t> glyphs;
    for (const auto& placed : text->lines.front().glyphs) glyphs.push_back(placed.glyph);
    auto outlines = planner::glyph_outlines(font, glyphs);
    if (!outlines) return false;
    for (std::size_t g = 0; g < glyphs.size(); ++g) {
        const Vec2 start = text->lines.front().glyphs[g].at;
        for (planner::Contour& contour : (*outlines)[g].contours) {
            for (Vec2& p : contour) p = Vec2(label.width, 0.0) + scale * Vec2(start.x + p.x, -(start.y + p.y));
            label.outlines.contours.push_back(std::move(contour));
        }
    }
    label.width += scale * text->lines.front().width;
    return true;
}

/// The first installed font that draws a character, if any.
std::optional<FontData> font_with(const std::string& character) {
    const auto family = planner::installed_family_with(planner::code_point(character));
    const auto file = family ? planner::installed_font(*family) : Error{};
    auto font = file ? planner::load_font(*file) : file.error();
    if (!font || !shaped(*font, character)) return std::nullopt;
    return std::move(*font);
}

/// Stretches of a text, each in one font.
Label in_several_fonts(const FontData& main, const std::vector<std::string>& characters, double size_px) {
    std::map<std::string, std::optional<FontData>> others;  // by character
    Label label;
    std::string stretch;
    const FontData* used = &main;
    const auto finish = [&] {
        if (!stretch.empty() && !append(label, *used, stretch, size_px)) append(label, main, "?", size_px);
        stretch.clear();
    };
    for (const std::string& character : characters) {
        const FontData* wanted = &main;
        bool drawn = true;
        if (!shaped(main, character)) {
            const auto [other, fresh] = others.try_emplace(character);
            if (fresh && used != &main && shaped(*used, character)) {
                other->second = *used;
            } else if (fresh) {
                other->second = font_with(character);
            }
            drawn = other->second.has_value();
            if (drawn) wanted = &*other->second;
        }
        const bool same = wanted == used || (wanted->name == used->name && wanted->face == used->face);
        if (!same) {
            finish();
            used = wanted;
        }
        stretch += drawn ? character : "?";
    }
    finish();
    return label;
}

Label drawn(const FontData& main, const std::vector<std::string>& characters, std::size_t count, double size_px) {
    std::vector<std::string> shown(characters.begin(), characters.begin() + static_cast<std::ptrdiff_t>(count));
    if (count < characters.size()) {
        while (!shown.empty() && shown.back() == " ") shown.pop_back();
        shown.emplace_back(kCut);
    }
    std::string text;
    for (const std::string& character : shown) text += character;
    Label label;
    if (text.empty() || append(label, main, text, size_px)) return label;
    return in_several_fonts(main, shown, size_px);
}

}  // namespace

Result<Lettering> Lettering::load() {
    const auto file = planner::installed_font(std::string(kFamily));
    if (!file) {
        return Error{file.error().code, "the labels of pictures need the font \"" + std::string(kFamily) +
                                            "\" (Debian package fonts-dejavu-core): " + file.error().message};
    }
    auto font = planner::load_font(*file);
    if (!font) return font.error();
    return Lettering(std::move(*font));
}

Label Lettering::label(std::string_view utf8, double size_px, double longest_px) const {
    const std::vector<std::string> characters = characters_of(utf8);
    Label whole = drawn(font_, characters, characters.size(), size_px);
    if (whole.width <= longest_px) return whole;
    std::size_t fits = 0, too_many = characters.size();
    while (too_many - fits > 1) {
        const std::size_t middle = (fits + too_many) / 2;
        (drawn(font_, characters, middle, size_px).width <= longest_px ? fits : too_many) = middle;
    }
    return drawn(font_, characters, fits, size_px);
}

}  // namespace aerogram::exporter
