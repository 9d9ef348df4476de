#include "planner/picture/palette.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace aerogram::planner {
namespace {

constexpr int kRounds = 8;  ///< of k-means

using Indices = std::vector<std::size_t>;

double channel(const Rgb& c, int i) {
    return i == 0 ? c.r : i == 1 ? c.g : c.b;
}

/// The channel in which a box of colours is widest, and how wide.
std::pair<int, double> widest(const std::vector<Rgb>& colors, const Indices& box) {
    std::pair<int, double> best{0, -1.0};
    for (int i = 0; i < 3; ++i) {
        double low = 1e300, high = -1e300;
        for (const std::size_t c : box) {
            low = std::min(low, channel(colors[c], i));
            high = std::max(high, channel(colors[c], i));
        }
        if (high - low > best.second) best = {i, high - low};
    }
    return best;
}

Rgb mean(const std::vector<Rgb>& colors, const Indices& box) {
    Rgb sum;
    for (const std::size_t c : box) sum = {sum.r + colors[c].r, sum.g + colors[c].g, sum.b + colors[c].b};
    const auto n = static_cast<double>(box.size());
    return {sum.r / n, sum.g / n, sum.b / n};
}

double squared_distance(const Rgb& a, const Rgb& b) {
    return (a.r - b.r) * (a.r - b.r) + (a.g - b.g) * (a.g - b.g) + (a.b - b.b) * (a.b - b.b);
}

std::vector<Indices> median_cut(const std::vector<Rgb>& colors, std::size_t most) {
    std::vector<Indices> boxes(1, Indices(colors.size()));
    std::iota(boxes[0].begin(), boxes[0].end(), std::size_t{0});
    while (boxes.size() < most) {
        std::size_t next = 0;
        std::pair<int, double> cut{0, 0.0};
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            const auto [axis, width] = widest(colors, boxes[b]);
            if (width > cut.second) {
                next = b;
                cut = {axis, width};
            }
        }
        if (cut.second <= 0.0) break;
        Indices& box = boxes[next];
        std::sort(box.begin(), box.end(), [&](std::size_t a, std::size_t b) {
            const double x = channel(colors[a], cut.first), y = channel(colors[b], cut.first);
            return x != y ? x < y : a < b;
        });
        const auto half = box.begin() + static_cast<std::ptrdiff_t>(box.size() / 2);
        Indices upper(half, box.end());
        box.erase(half, box.end());
        boxes.push_back(std::move(upper));
    }
    return boxes;
}

}  // namespace

std::vector<Rgb> reduced(const std::vector<Rgb>& colors, std::size_t most) {
    if (colors.empty() || std::set<Rgb>(colors.begin(), colors.end()).size() <= most) return colors;
    std::vector<Indices> boxes = median_cut(colors, most);
    std::vector<std::size_t> nearest(colors.size(), 0);
    std::vector<Rgb> palette;
    for (int round = 0; round <= kRounds; ++round) {
        palette.clear();
        for (const Indices& box : boxes) {
            if (!box.empty()) palette.push_back(mean(colors, box));
        }
        boxes.assign(palette.size(), {});
        for (std::size_t c = 0; c < colors.size(); ++c) {
            double best = std::numeric_limits<double>::infinity();
            for (std::size_t p = 0; p < palette.size(); ++p) {
                const double now = squared_distance(colors[c], palette[p]);
                if (now >= best) continue;
                best = now;
                nearest[c] = p;
            }
            boxes[nearest[c]].push_back(c);
        }
    }
    std::vector<Rgb> out;
    out.reserve(colors.size());
    for (const std::size_t p : nearest) out.push_back(palette[p]);
    return out;
}

}  // namespace aerogram::planner
