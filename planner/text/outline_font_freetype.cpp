#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "planner/text/outline_font.hpp"

namespace aerogram::planner {
namespace {

constexpr double kChordsPerEm = 2000.0;  ///< an em divided by how far chords may be off their curve
constexpr double kFewestChords = 6.0, kMostChords = 64.0;
constexpr std::size_t kMostPoints = 4'000'000;

struct Deleter {
    void operator()(FT_LibraryRec_* p) const { FT_Done_FreeType(p); }
    void operator()(FT_FaceRec_* p) const { FT_Done_Face(p); }
};

/// Collects one glyph's contours from FreeType's callbacks.
struct Pen {
    Region region;
    double tolerance = 1.0;

    [[nodiscard]] Vec2 last() const { return region.contours.back().back(); }
    void line(const Vec2& to) {
        if (to != last()) region.contours.back().push_back(to);
    }
    /// @param bend  how far the curve is from its chord at most, about.
    template <class Curve>
    void curve(double bend, const Curve& at) {
        const double chords = std::clamp(std::ceil(std::sqrt(bend / tolerance)), kFewestChords, kMostChords);
        for (double i = 1.0; i <= chords; i += 1.0) line(at(i / chords));
    }
};

Vec2 place(const FT_Vector* v) {
    return {static_cast<double>(v->x), static_cast<double>(v->y)};
}

int move_to(const FT_Vector* to, void* user) {
    static_cast<Pen*>(user)->region.contours.push_back({place(to)});
    return 0;
}

int line_to(const FT_Vector* to, void* user) {
    static_cast<Pen*>(user)->line(place(to));
    return 0;
}

int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
    Pen& pen = *static_cast<Pen*>(user);
    const Vec2 a = pen.last(), b = place(control), c = place(to);
    pen.curve(0.25 * glm::length(a - 2.0 * b + c),
              [&](double t) { return (1 - t) * (1 - t) * a + 2 * t * (1 - t) * b + t * t * c; });
    return 0;
}

int cubic_to(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user) {
    Pen& pen = *static_cast<Pen*>(user);
    const Vec2 a = pen.last(), b = place(first), c = place(second), d = place(to);
    pen.curve(0.75 * std::max(glm::length(a - 2.0 * b + c), glm::length(b - 2.0 * c + d)), [&](double t) {
        const double s = 1 - t;
        return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
    });
    return 0;
}

/// Without the last point where it repeats the first; contours of fewer than three points enclose nothing.
Region tidied(Region region) {
    for (Contour& contour : region.contours) {
        while (contour.size() > 1 && contour.back() == contour.front()) contour.pop_back();
    }
    std::erase_if(region.contours, [](const Contour& c) { return c.size() < 3; });
    return region;
}

/// A font's outlines, one glyph after another.
class Outlines {
  public:
    Outlines(const FontData& font, FT_Face face) : font_(font), face_(face), space_(FT_Get_Char_Index(face, ' ')) {
        callbacks_.move_to = move_to;
        callbacks_.line_to = line_to;
        callbacks_.conic_to = conic_to;
        callbacks_.cubic_to = cubic_to;
    }

    [[nodiscard]] Error unusable(const std::string& what) const {
        return {ErrorCode::invalid_input, font_.name + what};
    }
    [[nodiscard]] Result<Region> of(std::uint32_t glyph) const {
        if (FT_Load_Glyph(face_, glyph, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP) != 0 ||
            face_->glyph->format != FT_GLYPH_FORMAT_OUTLINE) {
            return unusable(": a glyph has no outline; choose another font");
        }
        Pen pen;
        pen.tolerance = std::max(1.0, static_cast<double>(face_->units_per_EM)) / kChordsPerEm;
        if (FT_Outline_Decompose(&face_->glyph->outline, &callbacks_, &pen) != 0) {
            return unusable(": a glyph's outline is broken; choose another font");
        }
        const bool coloured = FT_HAS_COLOR(face_) || FT_HAS_SVG(face_);
        if (coloured && pen.region.contours.empty() && glyph != space_) {
            return unusable(": a glyph is a coloured picture without outline; choose another font");
        }
        return tidied(std::move(pen.region));
    }

  private:
    const FontData& font_;
    FT_Face face_;
    FT_UInt space_;
    FT_Outline_Funcs callbacks_{};
};

std::size_t points_of(const Region& region) {
    std::size_t points = 0;
    for (const Contour& contour : region.contours) points += contour.size();
    return points;
}

}  // namespace

Result<std::vector<Region>> glyph_outlines(const FontData& font, std::span<const std::uint32_t> glyphs) {
    const auto unusable = [&](const std::string& what) { return Error{ErrorCode::invalid_input, font.name + what}; };
    FT_Library raw_library = nullptr;
    if (FT_Init_FreeType(&raw_library) != 0) return unusable(": FreeType does not start");
    const std::unique_ptr<FT_LibraryRec_, Deleter> library(raw_library);
    FT_Face raw_face = nullptr;
    if (FT_New_Memory_Face(raw_library, reinterpret_cast<const FT_Byte*>(font.bytes.data()),
                           static_cast<FT_Long>(font.bytes.size()), static_cast<FT_Long>(font.face), &raw_face) != 0) {
        return unusable(" is not a font");
    }
    const std::unique_ptr<FT_FaceRec_, Deleter> face(raw_face);
    if (!FT_IS_SCALABLE(raw_face)) return unusable(" has bitmaps, not outlines; choose another font");
    const Outlines outlines(font, raw_face);
    std::map<std::uint32_t, Region> drawn;
    std::vector<Region> out;
    std::size_t points = 0;
    for (const std::uint32_t glyph : glyphs) {
        auto known = drawn.find(glyph);
        if (known == drawn.end()) {
            auto region = outlines.of(glyph);
            if (!region) return region.error();
            known = drawn.emplace(glyph, std::move(*region)).first;
        }
        points += points_of(known->second);
        if (points > kMostPoints) return unusable(": more than 4 million points for this text; choose another font");
        out.push_back(known->second);
    }
    return out;
}

}  // namespace aerogram::planner
