#include "planner/text/outline_text.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include "planner/text/outline_font.hpp"
#include "planner/text/text_layout.hpp"

namespace aerogram::planner {
namespace {

constexpr std::uintmax_t kLargestFont = 64U << 20U;
constexpr std::size_t kLongestText = 10'000;  ///< bytes

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    for (;;) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
        if (end == std::string_view::npos) return lines;
        text.remove_prefix(end + 1);
    }
}

}  // namespace

Result<FontData> load_font(const FontFile& file) {
    const std::string name = file.file.string();
    const auto failed = [&](const std::string& why) { return Error{ErrorCode::io, name + ": " + why}; };
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file.file, error);
    if (error) return failed("cannot be read");
    if (bytes > kLargestFont) return failed("is larger than 64 MiB: must be a font file");
    std::ifstream in(file.file, std::ios::binary);
    FontData font;
    font.bytes.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    if (!in || font.bytes.empty()) return failed("cannot be read");
    font.face = file.face;
    font.name = name;
    return font;
}

Result<Region> outline_text(const TextSource& source) {
    if (source.text.size() > kLongestText) {
        return Error{ErrorCode::invalid_input, "is longer than " + std::to_string(kLongestText) + " bytes"};
    }
    FontFile file{source.font_file.value_or(""), 0};
    if (!source.font_file) {
        const auto found = installed_font(source.font);
        if (!found) return Error{found.error().code, "font = \"" + source.font + "\": " + found.error().message};
        file = *found;
    }
    const auto font = load_font(file);
    if (!font) return font.error();
    const auto shaped = shape_text(*font, lines_of(source.text));
    if (!shaped) return shaped.error();
    Region out;
    double baseline = 0.0;
    for (const ShapedLine& line : shaped->lines) {
        const Vec2 start(-line_start_share(source.align) * line.width, baseline);
        std::vector<std::uint32_t> glyphs;
        for (const PlacedGlyph& g : line.glyphs) glyphs.push_back(g.glyph);
        auto outlines = glyph_outlines(*font, glyphs);
        if (!outlines) return outlines.error();
        for (std::size_t g = 0; g < outlines->size(); ++g) {
            for (Contour& contour : (*outlines)[g].contours) {
                for (Vec2& p : contour) p += start + line.glyphs[g].at;
                out.contours.push_back(std::move(contour));
            }
        }
        baseline -= shaped->line_pitch;
    }
    if (out.contours.empty()) return Error{ErrorCode::invalid_input, "the text draws nothing"};
    return out;
}

}  // namespace aerogram::planner
