#include <cmath>

#include "planner/drawing/region_clip.hpp"

namespace aerogram::planner {
namespace {

constexpr double kMiterLimit = 4.0;

void add(Region& region, Contour contour) {
    const double area = doubled_area(contour);
    if (area == 0.0) return;
    if (area < 0.0) contour = Contour(contour.rbegin(), contour.rend());
    region.contours.push_back(std::move(contour));
}

Vec2 normal(const Vec2& a, const Vec2& b) {
    const Vec2 d = glm::normalize(b - a);
    return {-d.y, d.x};
}

}  // namespace

Region stroked(const Chords& lines, double width) {
    Region out;
    const double half = 0.5 * width;
    for (std::size_t l = 0; l < lines.lines.size(); ++l) {
        const Stroke& line = lines.lines[l];
        const std::size_t n = line.size(), pieces = lines.closed[l] ? n : n - 1;
        for (std::size_t i = 0; i < pieces; ++i) {
            const Vec2 a = line[i], b = line[(i + 1) % n], across = half * normal(a, b);
            add(out, {a - across, b - across, b + across, a + across});
            if (i + 1 == pieces && !lines.closed[l]) break;
            const Vec2 next = half * normal(b, line[(i + 2) % n]);
            const double side = across.x * next.y - across.y * next.x > 0.0 ? -1.0 : 1.0;  // the outside of the turn
            const Vec2 both = across + next;
            const double share = glm::dot(both, both) / (4.0 * half * half);  // the square of the half angle's cosine
            Contour corner{b, b + side * across, b + side * next};
            if (share * kMiterLimit * kMiterLimit >= 1.0)
                corner.insert(corner.begin() + 2, b + side * 0.5 * both / share);
            add(out, std::move(corner));
        }
    }
    return out;
}

}  // namespace aerogram::planner
