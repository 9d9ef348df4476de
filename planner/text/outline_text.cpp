#include "planner/text/outline_text.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#include "planner/text/baseline.hpp"
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

Result<FontData> font_of(const TextSource& source) {
    if (source.font_file) return load_font({*source.font_file, 0});
    const auto found = installed_font(source.font);
    if (!found) return Error{found.error().code, "font = \"" + source.font + "\": " + found.error().message};
    return load_font(*found);
}

/// Where the letters of a line stand: under the lines before it, or along a drawn line.
class LineFrames {
  public:
    static Result<LineFrames> of(const TextSource& source, const ShapedLine& line, double baseline) {
        LineFrames out;
        out.start_ = {-line_start_share(source.align) * line.width, baseline};
        if (!source.along) return out;
        auto along = Baseline::of(*source.along, line.width);
        if (!along) return along.error();
        out.along_ = std::move(*along);
        return out;
    }
    /// Puts a letter's glyph in its place.
    void place(Region& glyph, const ShapedLetter& letter, const Vec2& at) const {
        if (!along_) {
            return move(glyph, [&](const Vec2& p) { return p + at + start_; });
        }
        const double middle = 0.5 * (letter.left + letter.right);
        const LetterFrame frame = along_->at(middle);
        move(glyph, [&](const Vec2& p) { return frame.place(p + at, middle); });
    }

  private:
    template <class Placed>
    static void move(Region& glyph, const Placed& placed) {
        for (Contour& contour : glyph.contours) {
            for (Vec2& p : contour) p = placed(p);
        }
    }
    Vec2 start_{};
    std::optional<Baseline> along_;
};

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
    const auto lines = lines_of(source.text);
    if (source.along && lines.size() > 1) return several_lines_along(lines.size());
    const auto font = font_of(source);
    if (!font) return font.error();
    const auto shaped = shape_text(*font, lines);
    if (!shaped) return shaped.error();
    std::vector<std::uint32_t> glyphs;
    for (const ShapedLine& line : shaped->lines) {
        for (const PlacedGlyph& g : line.glyphs) glyphs.push_back(g.glyph);
    }
    auto outlines = glyph_outlines(*font, glyphs);
    if (!outlines) return outlines.error();
    Region out;
    double baseline = 0.0;
    auto outline = outlines->begin();
    for (const ShapedLine& line : shaped->lines) {
        if (line.width <= 0.0 && source.along) break;
        const auto frames = LineFrames::of(source, line, baseline);
        if (!frames) return frames.error();
        for (const ShapedLetter& letter : line.letters) {
            for (std::size_t g = letter.begin; g < letter.end; ++g, ++outline) {
                frames->place(*outline, letter, line.glyphs[g].at);
                std::move(outline->contours.begin(), outline->contours.end(), std::back_inserter(out.contours));
            }
        }
        baseline -= shaped->line_pitch;
    }
    if (out.contours.empty()) return Error{ErrorCode::invalid_input, "the text draws nothing"};
    return out;
}

}  // namespace aerogram::planner
