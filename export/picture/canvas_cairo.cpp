#include <cairo.h>

#include <numbers>

#include "export/picture/canvas.hpp"
#include "geo/contract.hpp"

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

}  // namespace

Ink lamp_ink(const Rgb& linear, double opacity) {
    const std::string hex = hex_from_rgb(linear);
    const auto channel = [&](std::size_t at) { return std::stoi(hex.substr(at, 2), nullptr, 16) / 255.0; };
    return {channel(1), channel(3), channel(5), opacity};
}

struct Canvas::Impl {
    std::unique_ptr<cairo_surface_t, Deleter> surface;
    std::unique_ptr<cairo_t, Deleter> pen;

    void use(const Ink& ink) const { cairo_set_source_rgba(pen.get(), ink.r, ink.g, ink.b, ink.opacity); }
    void circle(const Vec2& middle, double radius) const {
        cairo_new_path(pen.get());
        cairo_arc(pen.get(), middle.x, middle.y, radius, 0.0, 2.0 * std::numbers::pi);
    }
};

Canvas::Canvas(int width, int height, const Ink& ground) : impl_(std::make_unique<Impl>()) {
    AEROGRAM_REQUIRE(width >= 1 && width <= kLargestCanvas_px && height >= 1 && height <= kLargestCanvas_px, width,
                     height);
    impl_->surface.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
    impl_->pen.reset(cairo_create(impl_->surface.get()));
    impl_->use(ground);
    cairo_paint(impl_->pen.get());
}

Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;
Canvas::~Canvas() = default;

void Canvas::rectangle(const Vec2& corner, const Vec2& size, const Ink& ink) {
    impl_->use(ink);
    cairo_rectangle(impl_->pen.get(), corner.x, corner.y, size.x, size.y);
    cairo_fill(impl_->pen.get());
}

void Canvas::line(const Vec2& from, const Vec2& to, double width, const Ink& ink) {
    impl_->use(ink);
    cairo_set_line_width(impl_->pen.get(), width);
    cairo_move_to(impl_->pen.get(), from.x, from.y);
    cairo_line_to(impl_->pen.get(), to.x, to.y);
    cairo_stroke(impl_->pen.get());
}

void Canvas::disc(const Vec2& middle, double radius, const Ink& ink) {
    impl_->use(ink);
    impl_->circle(middle, radius);
    cairo_fill(impl_->pen.get());
}

void Canvas::ring(const Vec2& middle, double radius, double width, const Ink& ink) {
    impl_->use(ink);
    cairo_set_line_width(impl_->pen.get(), width);
    impl_->circle(middle, radius);
    cairo_stroke(impl_->pen.get());
}

void Canvas::fill(const planner::Region& region, const Vec2& at, const Ink& ink) {
    impl_->use(ink);
    for (const planner::Contour& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 p = at + contour[i];
            (i == 0 ? cairo_move_to : cairo_line_to)(impl_->pen.get(), p.x, p.y);
        }
        cairo_close_path(impl_->pen.get());
    }
    cairo_fill(impl_->pen.get());
}

void Canvas::only_inside(const Vec2& corner, const Vec2& size) {
    cairo_save(impl_->pen.get());
    cairo_rectangle(impl_->pen.get(), corner.x, corner.y, size.x, size.y);
    cairo_clip(impl_->pen.get());
}

void Canvas::everywhere() {
    cairo_restore(impl_->pen.get());
}

Result<std::string> Canvas::png() const {
    cairo_status_t status = cairo_status(impl_->pen.get());
    std::string bytes;
    if (status == CAIRO_STATUS_SUCCESS) {
        cairo_surface_flush(impl_->surface.get());
        status = cairo_surface_write_to_png_stream(impl_->surface.get(), append, &bytes);
    }
    if (status != CAIRO_STATUS_SUCCESS) {
        return Error{ErrorCode::io, std::string("the picture could not be drawn: ") + cairo_status_to_string(status)};
    }
    return bytes;
}

}  // namespace aerogram::exporter
