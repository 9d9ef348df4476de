#include "planner/formation/svg_colors.hpp"

#include <algorithm>
#include <cmath>

#include "planner/drawing/region_clip.hpp"

namespace aerogram::planner {
namespace {

constexpr double kCells = 1'000'000.0;
constexpr double kPenCells = 2.0;  ///< lines are painted at least this wide

struct Crossing {
    double x = 0.0;
    int turn = 0;
};

}  // namespace

InkColors::InkColors(const Ink& ink) {
    Region all;
    for (const InkLayer& layer : ink.layers) {
        all.contours.insert(all.contours.end(), layer.area.contours.begin(), layer.area.contours.end());
    }
    const Bounds box = bounds_of(all);
    const Vec2 size = glm::max(box.size(), Vec2(1e-9 * std::max(box.size().x, box.size().y) + 1e-300));
    cell_ = std::max(std::sqrt(size.x * size.y / kCells), std::max(size.x, size.y) / 20'000.0);
    low_ = box.low;
    across_ = static_cast<std::ptrdiff_t>(size.x / cell_) + 1;
    up_ = static_cast<std::ptrdiff_t>(size.y / cell_) + 1;
    top_.assign(static_cast<std::size_t>(across_ * up_), 0);
    for (const InkLayer& layer : ink.layers) {
        light_.push_back(layer.color);
        const auto index = layer.dark ? 0U : static_cast<std::uint32_t>(light_.size());
        paint(layer.area, index);
        if (!layer.lines.lines.empty()) paint(stroked(layer.lines, kPenCells * cell_), index);
    }
}

/// Cells whose middle the contours wind round.
void InkColors::paint(const Region& area, std::uint32_t layer) {
    if (area.contours.empty()) return;
    const Bounds box = bounds_of(area);
    const auto row_of = [&](double y) { return static_cast<std::ptrdiff_t>(std::ceil((y - low_.y) / cell_ - 0.5)); };
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>(row_of(box.low.y), 0),
                         end = std::min(row_of(box.high.y), up_);
    if (first >= end) return;
    std::vector<std::vector<Crossing>> rows(static_cast<std::size_t>(end - first));
    for (const Contour& contour : area.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
            const Vec2 lower = a.y < b.y ? a : b, upper = a.y < b.y ? b : a;
            for (std::ptrdiff_t r = std::max(row_of(lower.y), first); r < std::min(row_of(upper.y), end); ++r) {
                const double y = low_.y + (static_cast<double>(r) + 0.5) * cell_;
                const double x = lower.x + (upper.x - lower.x) * (y - lower.y) / (upper.y - lower.y);
                rows[static_cast<std::size_t>(r - first)].push_back({x, a.y < b.y ? 1 : -1});
            }
        }
    }
    for (std::ptrdiff_t r = first; r < end; ++r) {
        auto& row = rows[static_cast<std::size_t>(r - first)];
        std::sort(row.begin(), row.end(), [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
        int winding = 0;
        for (std::size_t k = 0; k + 1 < row.size(); ++k) {
            winding += row[k].turn;
            if (winding == 0) continue;
            const auto from =
                std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::ceil((row[k].x - low_.x) / cell_ - 0.5)), 0);
            const auto to =
                std::min(static_cast<std::ptrdiff_t>(std::ceil((row[k + 1].x - low_.x) / cell_ - 0.5)), across_);
            if (from >= to) continue;
            std::fill(top_.begin() + r * across_ + from, top_.begin() + r * across_ + to, layer);
        }
    }
}

std::uint32_t InkColors::layer(std::ptrdiff_t column, std::ptrdiff_t row) const {
    if (column < 0 || row < 0 || column >= across_ || row >= up_) return 0;
    return top_[static_cast<std::size_t>(row * across_ + column)];
}

Rgb InkColors::at(const Vec2& place, double reach) const {
    const auto column = static_cast<std::ptrdiff_t>(std::floor((place.x - low_.x) / cell_));
    const auto row = static_cast<std::ptrdiff_t>(std::floor((place.y - low_.y) / cell_));
    const auto cells = std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(reach / cell_), 200);
    std::uint32_t best = 0;
    for (std::ptrdiff_t y = -cells; y <= cells; ++y) {
        for (std::ptrdiff_t x = -cells; x <= cells; ++x) {
            if (x * x + y * y <= cells * cells) best = std::max(best, layer(column + x, row + y));
        }
    }
    for (std::ptrdiff_t ring = cells + 1; best == 0 && ring < std::max(across_, up_); ++ring) {
        for (std::ptrdiff_t k = -ring; k <= ring; ++k) {
            best = std::max({best, layer(column + k, row - ring), layer(column + k, row + ring),
                             layer(column - ring, row + k), layer(column + ring, row + k)});
        }
    }
    return best == 0 ? Rgb{1.0, 1.0, 1.0} : light_[best - 1];
}

}  // namespace aerogram::planner
