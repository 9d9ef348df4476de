#include "planner/drawing/svg_paints.hpp"

#include <algorithm>

namespace aerogram::planner {
namespace {

constexpr int kLinksAtMost = 32;  ///< gradients that refer to one another

}  // namespace

GradientMeans::Mean GradientMeans::mean(std::size_t element, const std::map<std::string_view, std::size_t>& by_id,
                                        const CssSheet& sheet, std::size_t& tries) {
    if (element == kNothing) return {};
    if (const auto found = known_.find(element); found != known_.end()) return found->second;
    Mean out;
    std::size_t holder = element;
    for (int link = 0; link < kLinksAtMost && !out.known; ++link) {
        const std::string_view name = local_name(tree_.elements[holder].name);
        if (name != "linearGradient" && name != "radialGradient") break;
        Rgb sum;
        double weight = 0.0, stops = 0.0;
        const ElementStyle own = style_of(tree_, holder, {}, sheet, 0.0, warnings_, tries);
        for (std::size_t c = tree_.elements[holder].first_child; c != kNothing; c = tree_.elements[c].next) {
            if (local_name(tree_.elements[c].name) != "stop") continue;
            const ElementStyle style = style_of(tree_, c, own, sheet, 0.0, warnings_, tries);
            const Rgb stop = style.stop.value_or(Rgb{});
            const double share = style.stop_opacity + 1e-9;
            sum = {sum.r + share * stop.r, sum.g + share * stop.g, sum.b + share * stop.b};
            weight += share;
            stops += 1.0;
        }
        if (weight > 0.0) out = {true, {sum.r / weight, sum.g / weight, sum.b / weight}, std::min(weight / stops, 1.0)};
        std::string_view link_to = tree_.attribute(holder, "href");
        if (link_to.empty()) link_to = tree_.attribute(holder, "xlink:href");
        const auto next = link_to.starts_with('#') ? by_id.find(link_to.substr(1)) : by_id.end();
        if (next == by_id.end()) break;
        holder = next->second;
    }
    known_[element] = out;
    return out;
}

}  // namespace aerogram::planner
