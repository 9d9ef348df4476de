#include <algorithm>
#include <cmath>
#include <limits>

#include "export/report/page_blocks.hpp"
#include "export/report/report_words.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kSmall = 6.6;
constexpr double kInside = 14.0;  ///< between the frame and what is drawn

struct Look {
    Ink fill;
    Stroke border;
};
Look look_of(Layer layer) {
    switch (layer) {
        case Layer::ground_risk:
            return {{0.80, 0.25, 0.20, 0.05}, {{0.72, 0.13, 0.11}, 0.9, Dash::dotted}};
        case Layer::contingency:
            return {{0.90, 0.60, 0.10, 0.07}, {{0.76, 0.45, 0.02}, 0.9, Dash::dashed}};
        case Layer::flight:
            return {{0.15, 0.45, 0.75, 0.08}, {{0.10, 0.38, 0.68}, 0.9, Dash::solid}};
        case Layer::audience:
            return {{0.85, 0.20, 0.55, 0.25}, {{0.66, 0.08, 0.40}, 0.8, Dash::solid}};
        case Layer::obstacle:
            return {{0.35, 0.35, 0.38, 0.55}, {{0.20, 0.20, 0.22}, 0.8, Dash::solid}};
        case Layer::fence:
            return {{0.0, 0.0, 0.0, 0.0}, {{0.05, 0.40, 0.15}, 1.5, Dash::solid}};
        case Layer::track:
            return {{0.0, 0.0, 0.0, 0.0}, {{0.25, 0.30, 0.40, 0.35}, 0.25, Dash::solid}};
        case Layer::home:
            return {{0.0, 0.0, 0.0, 1.0}, {{0.0, 0.0, 0.0, 1.0}, 0.5, Dash::solid}};
    }
    return {};
}

struct Extent {
    Vec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};
Extent extent_of(const Plan& plan) {
    Extent extent;
    for (const PlanLayer& layer : plan.layers)
        for (const auto& shape : layer.shapes)
            for (const Vec2& p : shape) {
                extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y)};
                extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y)};
            }
    if (!(extent.low.x <= extent.high.x)) return {{-1.0, -1.0}, {1.0, 1.0}};
    return extent;
}

class PlanDrawing {
  public:
    PlanDrawing(Paper& paper, const Plan& plan, const Vec2& corner, const Vec2& size)
        : paper_(paper), plan_(plan), corner_(corner), size_(size) {
        const Extent e = extent_of(plan);
        const Vec2 wide = e.high - e.low;
        const Vec2 room = size - Vec2(2.0 * kInside, 2.0 * kInside + 10.0);
        scale_ = std::min(room.x / std::max(wide.x, 1.0), room.y / std::max(wide.y, 1.0));
        middle_m_ = 0.5 * (e.low + e.high);
    }

    void draw() {
        paper_.only_inside(corner_, size_);
        for (const PlanLayer& layer : plan_.layers) draw(layer);
        for (const PlanLayer& layer : plan_.layers) names(layer);
        paper_.everywhere();
        paper_.frame(corner_, size_, {inks::kRule, 0.6, Dash::solid});
        scale_bar();
        if (plan_.north) draw_north(paper_, corner_ + Vec2(size_.x - 26.0, 28.0), *plan_.north);
        if (plan_.name == "plan") legend();
    }

  private:
    [[nodiscard]] Vec2 at(const Vec2& m) const {
        const Vec2 p = scale_ * (m - middle_m_);
        return corner_ + 0.5 * size_ + Vec2(p.x, -p.y - 5.0);
    }
    [[nodiscard]] std::vector<Vec2> on_paper(const std::vector<Vec2>& shape) const {
        std::vector<Vec2> points;
        points.reserve(shape.size());
        for (const Vec2& m : shape) points.push_back(at(m));
        return points;
    }

    void draw(const PlanLayer& layer) {
        const Look look = look_of(layer.layer);
        for (const auto& shape : layer.shapes) {
            const std::vector<Vec2> points = on_paper(shape);
            if (layer.layer == Layer::home) {
                paper_.dots(points, points.size() > 2000 ? 0.35 : points.size() > 200 ? 0.6 : 1.0, look.fill);
            } else if (layer.layer == Layer::track) {
                paper_.way(points, look.border);
            } else {
                paper_.area(points, look.fill);
                paper_.border(points, look.border);
            }
        }
    }

    void names(const PlanLayer& layer) {
        for (std::size_t i = 0; i < layer.labels.size() && i < layer.shapes.size(); ++i) {
            Vec2 middle{0.0, kPaperHeight};  // above the shape, so that it is seen
            for (const Vec2& p : on_paper(layer.shapes[i])) {
                middle.x += p.x / static_cast<double>(layer.shapes[i].size());
                middle.y = std::min(middle.y, p.y - 4.0);
            }
            middle.y = std::max(middle.y, corner_.y + 10.0);
            const std::string name = cut(paper_, layer.labels[i], Face::bold, kSmall, 120.0);
            const double wide = paper_.width(name, Face::bold, kSmall);
            middle.x = std::clamp(middle.x - 0.5 * wide, corner_.x + 3.0, corner_.x + size_.x - wide - 3.0);
            paper_.rectangle({middle.x - 1.5, middle.y - 5.5}, {wide + 3.0, 8.0}, {1.0, 1.0, 1.0, 0.75});
            paper_.text(name, middle, Face::bold, kSmall, inks::kText);
        }
    }

    void scale_bar() {
        const Vec2 left = corner_ + Vec2(8.0, size_.y - 8.0);
        draw_scale_bar(paper_, left, scale_, 0.25 * size_.x);
        const std::string axes = "→ " + plan_.across + "   ↑ " + plan_.up;
        paper_.text(axes, {corner_.x + size_.x - paper_.width(axes, Face::regular, kSmall) - 6.0, left.y + 1.5},
                    Face::regular, kSmall, inks::kDim);
    }

    void legend() {
        double x = corner_.x;
        const double y = corner_.y + size_.y + 11.0;
        for (const PlanLayer& layer : plan_.layers) {
            const Look look = look_of(layer.layer);
            if (layer.layer == Layer::home) {
                paper_.dots(std::array{Vec2{x + 6.0, y - 2.5}}, 1.2, look.fill);
            } else if (layer.layer == Layer::track) {
                paper_.line({x, y - 2.5}, {x + 12.0, y - 2.5}, {look.border.ink, 0.8, Dash::solid});
            } else {
                paper_.rectangle({x, y - 6.0}, {12.0, 7.0}, look.fill);
                paper_.frame({x, y - 6.0}, {12.0, 7.0}, look.border);
            }
            paper_.text(layer.name, {x + 15.0, y}, Face::regular, kSmall, inks::kText);
            x += 25.0 + paper_.width(layer.name, Face::regular, kSmall);
        }
    }

    Paper& paper_;
    const Plan& plan_;
    Vec2 corner_, size_;
    double scale_ = 1.0;
    Vec2 middle_m_{};
};

}  // namespace

void draw_north(Paper& paper, const Vec2& middle, const Vec2& north) {
    const Vec2 up(north.x, -north.y), side(-up.y, up.x);
    const std::array<Vec2, 3> dark{middle + 15.0 * up, middle - 9.0 * up + 6.0 * side, middle - 5.0 * up};
    const std::array<Vec2, 3> light{middle + 15.0 * up, middle - 9.0 * up - 6.0 * side, middle - 5.0 * up};
    paper.area(dark, inks::kText);
    paper.border(light, {inks::kText, 0.6, Dash::solid});
    paper.text("N", middle + 21.0 * up + Vec2(-2.8, 2.6), Face::bold, 7.5, inks::kText);
}

void draw_scale_bar(Paper& paper, const Vec2& corner, double scale, double longest) {
    const double most_m = longest / scale, power = std::pow(10.0, std::floor(std::log10(most_m)));
    double length_m = power;
    for (const double factor : {2.0, 5.0})
        if (factor * power <= most_m) length_m = factor * power;
    const double wide = length_m * scale;
    paper.line(corner, corner + Vec2(wide, 0.0), {inks::kText, 1.2, Dash::solid});
    for (const double end : {0.0, wide})
        paper.line(corner + Vec2(end, -3.0), corner + Vec2(end, 1.0), {inks::kText, 0.8, Dash::solid});
    const std::string text = fixed_text(length_m, length_m < 1.0 ? 2 : 0) + " m";
    paper.text(text, corner + Vec2(wide + 4.0, 1.5), Face::bold, kSmall, inks::kText);
}

void draw_plan(PageFlow& flow, const Plan& plan) {
    const Extent e = extent_of(plan);
    const double shape = (e.high.y - e.low.y) / std::max(e.high.x - e.low.x, 1.0);
    const double most = plan.name == "plan" ? 375.0 : 190.0;
    const double height = std::clamp(shape * (kColumn - 2.0 * kInside) + 2.0 * kInside + 14.0, 130.0, most);
    const double head = 14.0, below = plan.name == "plan" ? 20.0 : 8.0;
    flow.need(head + height + below);
    flow.paper().text(cut(flow.paper(), plan.title, Face::bold, 8.5, kColumn), {kEdge, flow.y() + 9.0}, Face::bold, 8.5,
                      inks::kText);
    flow.skip(head);
    PlanDrawing(flow.paper(), plan, {kEdge, flow.y()}, {kColumn, height}).draw();
    flow.skip(height + below);
}

}  // namespace aerogram::exporter
