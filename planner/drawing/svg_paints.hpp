#pragma once
#include <map>
#include <string_view>

#include "geo/color.hpp"
#include "planner/drawing/css_sheet.hpp"
#include "planner/drawing/svg_style.hpp"
#include "planner/drawing/xml_tree.hpp"

namespace aerogram::planner {

/// The one colour that stands for a gradient: the mean of its stops in linear light, weighted by their opacity.
class GradientMeans {
  public:
    GradientMeans(const XmlTree& tree, DrawingWarnings& warnings) : tree_(tree), warnings_(warnings) {}

    struct Mean {
        bool known = false;
        Rgb light;
        double alpha = 1.0;  ///< mean of the stops' opacities
    };
    /// @param element  kNothing, or what a paint refers to; stops may be those of a gradient that it refers to.
    [[nodiscard]] Mean mean(std::size_t element, const std::map<std::string_view, std::size_t>& by_id,
                            const CssSheet& sheet, std::size_t& tries);

  private:
    const XmlTree& tree_;
    DrawingWarnings& warnings_;
    std::map<std::size_t, Mean> known_;
};

}  // namespace aerogram::planner
