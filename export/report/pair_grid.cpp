#include "export/report/pair_grid.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace aerogram::exporter {
namespace {

constexpr double kRounding_m = 1e-3;  ///< what floats may be off by, of middles and radii

/// The cell itself and half of its neighbours.
constexpr std::array<std::array<std::int32_t, 3>, 14> kHalf{{{0, 0, 0},
                                                             {1, 0, 0},
                                                             {-1, 1, 0},
                                                             {0, 1, 0},
                                                             {1, 1, 0},
                                                             {-1, -1, 1},
                                                             {0, -1, 1},
                                                             {1, -1, 1},
                                                             {-1, 0, 1},
                                                             {0, 0, 1},
                                                             {1, 0, 1},
                                                             {-1, 1, 1},
                                                             {0, 1, 1},
                                                             {1, 1, 1}}};

}  // namespace

Nearest nearest_on_line(const Vec3& a, const Vec3& b) {
    const Vec3 way = b - a;
    const double length2 = glm::dot(way, way);
    const double u = length2 > 0.0 ? std::clamp(-glm::dot(a, way) / length2, 0.0, 1.0) : 0.0;
    return {glm::length(a + u * way), u};
}

Nearest closest_approach(const Mover& a, const Mover& b) {
    const double from_s = std::max(a.begin_s, b.begin_s), to_s = std::min(a.end_s, b.end_s);
    if (from_s > to_s) return {std::numeric_limits<double>::infinity(), from_s};
    const Nearest found = nearest_on_line(b.at(from_s) - a.at(from_s), b.at(to_s) - a.at(to_s));
    return {found.distance_m, from_s + found.u * (to_s - from_s)};
}

std::size_t PairGrid::bucket(std::int32_t x, std::int32_t y, std::int32_t z) const {
    const std::uint64_t mixed = static_cast<std::uint32_t>(x) * 0x9E3779B97F4A7C15ULL ^
                                static_cast<std::uint32_t>(y) * 0xC2B2AE3D27D4EB4FULL ^
                                static_cast<std::uint32_t>(z) * 0x165667B19E3779F9ULL;
    return static_cast<std::size_t>((mixed * 0x9E3779B97F4A7C15ULL) >> 32) & mask_;
}

void PairGrid::enter(std::span<const Mover> movers, double reach_m) {
    double longest_m = 0.0;
    for (const Mover& m : movers) longest_m = std::max(longest_m, glm::length(m.to - m.from));
    const double cell_m = std::max(0.01, reach_m + longest_m + 4.0 * kRounding_m);
    mask_ = std::bit_ceil(2 * movers.size() + 1) - 1;
    starts_.assign(mask_ + 2, 0);
    unordered_.clear();
    for (std::size_t i = 0; i < movers.size(); ++i) {
        const Vec3 middle = 0.5 * (movers[i].from + movers[i].to), cell = glm::floor(middle / cell_m);
        unordered_.push_back({static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z),
                              static_cast<float>(0.5 * glm::length(movers[i].to - movers[i].from) + kRounding_m),
                              static_cast<std::int32_t>(cell.x), static_cast<std::int32_t>(cell.y),
                              static_cast<std::int32_t>(cell.z), static_cast<std::uint32_t>(i)});
        const Entry& e = unordered_.back();
        ++starts_[bucket(e.cx, e.cy, e.cz) + 1];
    }
    for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
    entries_.resize(movers.size());
    for (auto e = unordered_.rbegin(); e != unordered_.rend(); ++e)
        entries_[--starts_[bucket(e->cx, e->cy, e->cz) + 1]] = *e;
    // starts_[b + 1] is now where bucket b begins.
    for (std::size_t b = 0; b + 1 < starts_.size(); ++b) starts_[b] = starts_[b + 1];
    starts_.back() = static_cast<std::uint32_t>(movers.size());
}

void PairGrid::search(std::span<const Mover> movers, double reach_m, const Visit& visit) {
    if (movers.size() < 2) return;
    enter(movers, reach_m);
    auto reach = static_cast<float>(reach_m);
    for (const Entry& a : unordered_) {
        for (const auto& [dx, dy, dz] : kHalf) {
            const std::int32_t x = a.cx + dx, y = a.cy + dy, z = a.cz + dz;
            const std::size_t in = bucket(x, y, z);
            const bool own = dx == 0 && dy == 0 && dz == 0;
            for (std::size_t i = starts_[in]; i < starts_[in + 1]; ++i) {
                const Entry& b = entries_[i];
                const float ux = a.x - b.x, uy = a.y - b.y, uz = a.z - b.z, within = reach + a.radius + b.radius;
                if (ux * ux + uy * uy + uz * uz > within * within) continue;
                if (b.cx != x || b.cy != y || b.cz != z || (own && b.mover <= a.mover)) continue;
                reach = static_cast<float>(visit(std::min(a.mover, b.mover), std::max(a.mover, b.mover)));
            }
        }
    }
}

}  // namespace aerogram::exporter
