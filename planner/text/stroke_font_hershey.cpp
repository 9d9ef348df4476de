extern "C" {  // a C header that does not say so
#include <hersheyfont.h>
}

#include <memory>

#include "planner/text/stroke_font.hpp"

namespace aerogram::planner {
namespace {

constexpr unsigned char kFirstPrintable = 32, kLastPrintable = 126;

Glyph to_glyph(const hershey_glyph& source) {
    Glyph glyph;
    glyph.width = source.width;
    // The library has already turned the font file's y axis, which points down, to point up from the baseline.
    for (const hershey_path* path = source.paths; path != nullptr; path = path->next) {
        Stroke stroke;
        for (unsigned short v = 0; v < path->nverts; ++v) stroke.emplace_back(path->verts[v].x, path->verts[v].y);
        if (!stroke.empty()) glyph.strokes.push_back(std::move(stroke));
    }
    return glyph;
}

}  // namespace

Result<StrokeFont> load_stroke_font(const std::string& name) {
    const std::unique_ptr<hershey_font, decltype(&hershey_font_free)> font(hershey_font_load(name.c_str()),
                                                                           &hershey_font_free);
    if (!font) {
        return Error{ErrorCode::io, "the stroke font " + name + " is not installed (package hershey-fonts-data)"};
    }
    StrokeFont out;
    for (unsigned char c = kFirstPrintable; c <= kLastPrintable; ++c) {
        const hershey_glyph* glyph = hershey_font_glyph(font.get(), c);
        if (glyph != nullptr && glyph->width > 0) out.glyphs[c] = to_glyph(*glyph);
    }
    return out;
}

}  // namespace aerogram::planner
