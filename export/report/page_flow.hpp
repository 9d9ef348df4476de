#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "export/report/paper.hpp"

namespace aerogram::exporter {

namespace inks {
inline constexpr Ink kText{0.09, 0.11, 0.14}, kDim{0.38, 0.42, 0.47}, kRule{0.75, 0.78, 0.82},
    kStripe{0.955, 0.962, 0.972};
inline constexpr Ink kBad{0.70, 0.10, 0.09}, kGood{0.07, 0.42, 0.20}, kPaper{1.0, 1.0, 1.0};
inline constexpr Ink kBadGround{0.99, 0.92, 0.91}, kGoodGround{0.92, 0.97, 0.93};
}  // namespace inks

inline constexpr double kEdge = 40.0;  ///< of the paper, left and right
inline constexpr double kColumn = kPaperWidth - 2.0 * kEdge;

/// The text in lines that are at most `width` wide, broken at spaces and, where a word alone is too wide, inside it;
/// the last of `most` lines ends in "…" where there is more. Never empty.
[[nodiscard]] std::vector<std::string> wrapped(const Paper& paper, std::string_view text, Face face, double size,
                                               double width, std::size_t most = 1000);
/// One line, with "…" where it was too long.
[[nodiscard]] std::string cut(const Paper& paper, std::string_view text, Face face, double size, double width);

/// What stands on the edges of every page.
struct PageEdges {
    std::string title, right, foot;
    std::string banner;     ///< in white on red across the top; empty: none
    std::size_t pages = 0;  ///< 0: not known yet
};

/// Pages filled from top to bottom.
class PageFlow {
  public:
    PageFlow(Paper& paper, const PageEdges& edges);

    [[nodiscard]] Paper& paper() { return paper_; }
    [[nodiscard]] double y() const { return y_; }
    [[nodiscard]] double room() const;  ///< left on this page
    [[nodiscard]] double whole_room() const;
    [[nodiscard]] bool at_top() const;
    [[nodiscard]] std::size_t page() const { return page_; }
    void skip(double height) { y_ += height; }
    void new_page();
    /// A new page unless this much is left.
    void need(double height);
    /// Lines over the column's width (or narrower); broken over pages.
    void words(std::string_view text, Face face, double size, const Ink& ink, double indent = 0.0);

  private:
    void begin_page();

    Paper& paper_;
    PageEdges edges_;
    std::size_t page_ = 1;
    double y_ = 0.0;
};

/// Draws pages twice: first to count them, then with their number. @param draw  the same calls both times.
Result<std::string> drawn_pages(const std::string& title, PageEdges edges, const std::function<void(PageFlow&)>& draw);

}  // namespace aerogram::exporter
