#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "planner/drawing/region_clip.hpp"
#include "planner/drawing/svg.hpp"

/// Drawings made by hand for the tests of the reader.
namespace aerogram::planner::testing {

/// A drawing of 100 x 100 units around `inside`.
inline std::string page(std::string_view inside) {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 100\">\n" + std::string(inside) + "\n</svg>\n";
}

inline Drawing drawing_of(std::string_view inside) {
    auto drawing = parse_svg(page(inside));
    EXPECT_TRUE(drawing.ok()) << (drawing ? "" : drawing.error().message);
    return drawing ? std::move(*drawing) : Drawing{};
}

inline DrawnShape only_shape(std::string_view inside) {
    Drawing drawing = drawing_of(inside);
    EXPECT_EQ(drawing.shapes.size(), 1U) << inside;
    return drawing.shapes.empty() ? DrawnShape{} : drawing.shapes.front();
}

/// How often the contours wind round a point.
inline int winding(const Region& region, const Vec2& p) {
    int turns = 0;
    for (const Contour& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
            const double side = (b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y);
            if (a.y <= p.y && b.y > p.y && side > 0.0) ++turns;
            if (a.y > p.y && b.y <= p.y && side < 0.0) --turns;
        }
    }
    return turns;
}

inline double area_of(const Region& region) {
    double sum = 0.0;
    for (const Contour& contour : region.contours) sum += 0.5 * doubled_area(contour);
    return std::abs(sum);
}

inline double length_of(const Stroke& line, bool closed) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) sum += glm::distance(line[i], line[i + 1]);
    return closed ? sum + glm::distance(line.back(), line.front()) : sum;
}

inline std::string all_warnings(const Drawing& drawing) {
    std::string out;
    for (const std::string& w : drawing.warnings) out += w + "\n";
    return out;
}

inline std::string message_of(std::string_view bytes) {
    const auto drawing = parse_svg(bytes);
    EXPECT_FALSE(drawing.ok()) << bytes.substr(0, 200);
    return drawing ? std::string() : drawing.error().message;
}

}  // namespace aerogram::planner::testing
