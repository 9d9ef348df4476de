#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "export/picture/canvas.hpp"
#include "geo/result.hpp"
#include "geo/vec3.hpp"

namespace aerogram::exporter {

inline constexpr double kPaperWidth = 595.276, kPaperHeight = 841.89;  ///< A4, points

/// DejaVu Sans, and its bold and monospaced faces.
enum class Face { regular, bold, mono };
enum class Dash { solid, dashed, dotted };
struct Stroke {
    Ink ink;
    double width = 0.5;
    Dash dash = Dash::solid;
};

/// A PDF being drawn, A4 upright. Points from the top left corner, x right, y down. Fonts are embedded; words of
/// scripts that DejaVu Sans lacks, or that join their letters, are drawn as outlines of other installed fonts.
/// Property: (1) the same calls give the same bytes: no date, no name of a file.
class Paper {
  public:
    /// Errors: invalid_input when DejaVu Sans is not installed.
    static Result<Paper> blank(const std::string& title);
    Paper(Paper&&) noexcept;
    Paper& operator=(Paper&&) noexcept;
    ~Paper();

    [[nodiscard]] double width(std::string_view utf8, Face face, double size) const;
    /// @param at  the start of the baseline.
    void text(std::string_view utf8, const Vec2& at, Face face, double size, const Ink& ink);
    void rectangle(const Vec2& corner, const Vec2& size, const Ink& ink);
    void frame(const Vec2& corner, const Vec2& size, const Stroke& stroke);
    void line(const Vec2& from, const Vec2& to, const Stroke& stroke);
    void way(std::span<const Vec2> points, const Stroke& stroke);
    void area(std::span<const Vec2> outline, const Ink& ink);
    void border(std::span<const Vec2> outline, const Stroke& stroke);  ///< closed
    void dots(std::span<const Vec2> points, double radius, const Ink& ink);
    /// Until `everywhere` only what is inside is drawn on.
    void only_inside(const Vec2& corner, const Vec2& size);
    void everywhere();
    /// What follows is drawn on a new page.
    void turn_page();
    /// The file. Nothing may be drawn after it. Errors: io when the library cannot.
    Result<std::string> finished();

  private:
    struct Impl;
    explicit Paper(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace aerogram::exporter
