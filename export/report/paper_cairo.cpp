#include <cairo-pdf.h>
#include <cairo.h>

#include <array>
#include <map>

#include "export/picture/lettering.hpp"
#include "export/report/paper.hpp"
#include "planner/text/utf8.hpp"

namespace aerogram::exporter {
namespace {

struct Deleter {
    void operator()(cairo_surface_t* p) const { cairo_surface_destroy(p); }
    void operator()(cairo_t* p) const { cairo_destroy(p); }
};

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

/// Scripts whose letters stand side by side, in reading order, as DejaVu Sans has them: Latin, Greek, Cyrillic, signs
/// and boxes.
bool is_plain(char32_t c) {
    return (c >= 0x20 && c < 0x300 && c != 0x7F) || (c >= 0x370 && c < 0x530) || (c >= 0x2010 && c < 0x2028) ||
           (c >= 0x2030 && c < 0x205F) || (c >= 0x20A0 && c < 0x2600);
}

/// The text without what is not UTF-8: the library refuses such metadata.
std::string valid(std::string_view text) {
    std::string clean;
    while (!text.empty()) {
        const std::string_view character = planner::first_character(text);
        const bool malformed = character.size() == 1 && planner::code_point(character) >= 0x80;
        clean += malformed ? "?" : std::string(character);
        text.remove_prefix(character.size());
    }
    return clean;
}

}  // namespace

struct Paper::Impl {
    explicit Impl(Lettering letters) : lettering(std::move(letters)) {}

    std::string bytes;  // outlives the surface, which writes to it
    Lettering lettering;
    std::unique_ptr<cairo_surface_t, Deleter> surface;
    std::unique_ptr<cairo_t, Deleter> pen;
    std::map<std::string, Label, std::less<>> labels;  // in letters of size 1; finding their fonts takes long

    const Label& label(const std::string& text) {
        const auto found = labels.find(text);
        return found != labels.end() ? found->second : labels.emplace(text, lettering.label(text, 1.0)).first->second;
    }

    void use(const Ink& ink) const { cairo_set_source_rgba(pen.get(), ink.r, ink.g, ink.b, ink.opacity); }
    void use(Face face, double size) const {
        cairo_select_font_face(pen.get(), face == Face::mono ? "DejaVu Sans Mono" : "DejaVu Sans",
                               CAIRO_FONT_SLANT_NORMAL,
                               face == Face::regular ? CAIRO_FONT_WEIGHT_NORMAL : CAIRO_FONT_WEIGHT_BOLD);
        cairo_set_font_size(pen.get(), size);
    }
    void use(const Stroke& stroke) const {
        use(stroke.ink);
        cairo_set_line_width(pen.get(), stroke.width);
        cairo_set_line_join(pen.get(), CAIRO_LINE_JOIN_ROUND);
        const std::array<double, 2> dashes{4.0, 2.5}, dots{1.0, 1.8};
        const double* pattern = stroke.dash == Dash::dashed ? dashes.data() : dots.data();
        cairo_set_dash(pen.get(), pattern, stroke.dash == Dash::solid ? 0 : 2, 0.0);
    }
    void path(std::span<const Vec2> points) const {
        cairo_new_path(pen.get());
        for (std::size_t i = 0; i < points.size(); ++i)
            (i == 0 ? cairo_move_to : cairo_line_to)(pen.get(), points[i].x, points[i].y);
    }
    /// True when the chosen font draws all of it, letter by letter.
    [[nodiscard]] bool draws(const std::string& text) const {
        std::string_view rest = text;
        while (!rest.empty()) {
            const std::string_view character = planner::first_character(rest);
            const char32_t code = planner::code_point(character);
            if (!is_plain(code) || (character.size() == 1 && code >= 0x80)) return false;
            rest.remove_prefix(character.size());
        }
        cairo_glyph_t* glyphs = nullptr;
        int count = 0;
        const cairo_status_t status =
            cairo_scaled_font_text_to_glyphs(cairo_get_scaled_font(pen.get()), 0.0, 0.0, text.data(),
                                             static_cast<int>(text.size()), &glyphs, &count, nullptr, nullptr, nullptr);
        bool all = status == CAIRO_STATUS_SUCCESS;
        for (int i = 0; i < count; ++i) all = all && glyphs[i].index != 0;
        cairo_glyph_free(glyphs);
        return all;
    }
    void fill(const planner::Region& region, const Vec2& at, double scale) const {
        cairo_new_path(pen.get());
        for (const planner::Contour& contour : region.contours) {
            for (std::size_t i = 0; i < contour.size(); ++i) {
                const Vec2 p = at + scale * contour[i];
                (i == 0 ? cairo_move_to : cairo_line_to)(pen.get(), p.x, p.y);
            }
            cairo_close_path(pen.get());
        }
        cairo_fill(pen.get());
    }
};

Paper::Paper(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
}
Paper::Paper(Paper&&) noexcept = default;
Paper& Paper::operator=(Paper&&) noexcept = default;
Paper::~Paper() = default;

Result<Paper> Paper::blank(const std::string& title) {
    auto lettering = Lettering::load();
    if (!lettering) return lettering.error();
    auto impl = std::make_unique<Impl>(std::move(*lettering));
    impl->surface.reset(cairo_pdf_surface_create_for_stream(append, &impl->bytes, kPaperWidth, kPaperHeight));
    cairo_surface_t* surface = impl->surface.get();
    cairo_pdf_surface_restrict_to_version(surface, CAIRO_PDF_VERSION_1_5);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, valid(title).c_str());
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_MOD_DATE, nullptr);
    impl->pen.reset(cairo_create(surface));
    return Paper(std::move(impl));
}

double Paper::width(std::string_view utf8, Face face, double size) const {
    if (utf8.empty()) return 0.0;
    const std::string text(utf8);
    impl_->use(face, size);
    if (!impl_->draws(text)) return size * impl_->label(text).width;
    cairo_text_extents_t extents;
    cairo_text_extents(impl_->pen.get(), text.c_str(), &extents);
    return extents.x_advance;
}

void Paper::text(std::string_view utf8, const Vec2& at, Face face, double size, const Ink& ink) {
    if (utf8.empty()) return;
    const std::string text(utf8);
    impl_->use(face, size);
    impl_->use(ink);
    if (!impl_->draws(text)) return impl_->fill(impl_->label(text).outlines, at, size);
    cairo_move_to(impl_->pen.get(), at.x, at.y);
    cairo_show_text(impl_->pen.get(), text.c_str());
}

void Paper::rectangle(const Vec2& corner, const Vec2& size, const Ink& ink) {
    impl_->use(ink);
    cairo_new_path(impl_->pen.get());
    cairo_rectangle(impl_->pen.get(), corner.x, corner.y, size.x, size.y);
    cairo_fill(impl_->pen.get());
}

void Paper::frame(const Vec2& corner, const Vec2& size, const Stroke& stroke) {
    impl_->use(stroke);
    cairo_new_path(impl_->pen.get());
    cairo_rectangle(impl_->pen.get(), corner.x, corner.y, size.x, size.y);
    cairo_stroke(impl_->pen.get());
}

void Paper::line(const Vec2& from, const Vec2& to, const Stroke& stroke) {
    way(std::array{from, to}, stroke);
}

void Paper::way(std::span<const Vec2> points, const Stroke& stroke) {
    impl_->use(stroke);
    impl_->path(points);
    cairo_stroke(impl_->pen.get());
}

void Paper::area(std::span<const Vec2> outline, const Ink& ink) {
    impl_->use(ink);
    impl_->path(outline);
    cairo_fill(impl_->pen.get());
}

void Paper::border(std::span<const Vec2> outline, const Stroke& stroke) {
    impl_->use(stroke);
    impl_->path(outline);
    cairo_close_path(impl_->pen.get());
    cairo_stroke(impl_->pen.get());
}

void Paper::dots(std::span<const Vec2> points, double radius, const Ink& ink) {
    impl_->use(Stroke{ink, 2.0 * radius, Dash::solid});
    cairo_new_path(impl_->pen.get());
    for (const Vec2& p : points) {
        cairo_move_to(impl_->pen.get(), p.x, p.y);
        cairo_line_to(impl_->pen.get(), p.x, p.y);
    }
    cairo_set_line_cap(impl_->pen.get(), CAIRO_LINE_CAP_ROUND);
    cairo_stroke(impl_->pen.get());
    cairo_set_line_cap(impl_->pen.get(), CAIRO_LINE_CAP_BUTT);
}

void Paper::only_inside(const Vec2& corner, const Vec2& size) {
    cairo_save(impl_->pen.get());
    cairo_new_path(impl_->pen.get());
    cairo_rectangle(impl_->pen.get(), corner.x, corner.y, size.x, size.y);
    cairo_clip(impl_->pen.get());
}

void Paper::everywhere() {
    cairo_restore(impl_->pen.get());
}

void Paper::turn_page() {
    cairo_show_page(impl_->pen.get());
}

Result<std::string> Paper::finished() {
    cairo_surface_finish(impl_->surface.get());
    cairo_status_t status = cairo_status(impl_->pen.get());
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(impl_->surface.get());
    if (status != CAIRO_STATUS_SUCCESS) {
        return Error{ErrorCode::io, std::string("the PDF could not be drawn: ") + cairo_status_to_string(status)};
    }
    return std::move(impl_->bytes);
}

}  // namespace aerogram::exporter
