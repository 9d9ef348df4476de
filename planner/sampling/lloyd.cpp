#include "planner/sampling/lloyd.hpp"

#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"
#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kJumpRounds = 6;
constexpr double kPoor = 0.6, kRich = 1.5;  ///< shares of the mean mass: from below the first, to above the second

/// What a site owns.
struct Cell {
    double mass = 0.0;
    Vec2 moment{};
};

double bucket_side(const DensityRaster& density, std::size_t sites) {
    const auto lit = std::count_if(density.mass.begin(), density.mass.end(), [](float m) { return m > 0.0F; });
    const double cells = std::max(static_cast<double>(lit), 1.0) / static_cast<double>(sites);
    return density.cell * std::max(std::sqrt(cells), 1e-3);
}

/// Calls visit(site, centre, mass) for every cell of mass, row by row.
template <class Visit>
void for_each_owned(const std::vector<Vec2>& sites, const DensityRaster& density, double side, const Visit& visit) {
    const SiteGrid grid(sites, side);
    for (std::size_t row = 0; row < density.up; ++row) {
        const float* mass = density.mass.data() + row * density.across;
        for (std::size_t column = 0; column < density.across; ++column) {
            if (mass[column] <= 0.0F) continue;
            const Vec2 p = density.centre(column, row);
            visit(grid.nearest(p), p, static_cast<double>(mass[column]));
        }
    }
}

/// Poor sites go beside rich ones, the poorest to the richest.
void jump(std::vector<Vec2>& sites, std::size_t fixed, const std::vector<Cell>& cells, double distance) {
    double total = 0.0;
    for (const Cell& c : cells) total += c.mass;
    const double mean = total / static_cast<double>(sites.size());
    std::vector<std::size_t> poor, rich;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (i >= fixed && cells[i].mass < kPoor * mean) poor.push_back(i);
        if (cells[i].mass > kRich * mean) rich.push_back(i);
    }
    const auto by_mass = [&](std::size_t a, std::size_t b) {
        return cells[a].mass != cells[b].mass ? cells[a].mass < cells[b].mass : a < b;
    };
    std::sort(poor.begin(), poor.end(), by_mass);
    std::sort(rich.rbegin(), rich.rend(), by_mass);
    for (std::size_t k = 0; k < std::min(poor.size(), rich.size()); ++k) {
        const Vec2 centre = cells[rich[k]].moment / cells[rich[k]].mass;
        const double sign = k % 2 == 0 ? 1.0 : -1.0;
        sites[poor[k]] = centre + Vec2(0.31 * distance * sign, 0.17 * distance);
    }
}

/// The place of (x, y) along Hilbert's curve through a square of 2^order cells a side.
std::uint64_t along_hilbert(std::uint32_t order, std::uint32_t x, std::uint32_t y) {
    std::uint64_t d = 0;
    for (std::uint32_t s = 1U << (order - 1); s > 0; s /= 2) {
        const std::uint32_t rx = (x & s) != 0 ? 1 : 0, ry = (y & s) != 0 ? 1 : 0;
        d += std::uint64_t{s} * s * ((3 * rx) ^ ry);
        if (ry == 0) {
            if (rx == 1) {
                x = (1U << order) - 1 - x;
                y = (1U << order) - 1 - y;
            }
            std::swap(x, y);
        }
    }
    return d;
}

}  // namespace

void relax(std::vector<Vec2>& sites, std::size_t fixed, const DensityRaster& density, std::size_t rounds,
           const Run& run) {
    AEROGRAM_REQUIRE(!sites.empty() && fixed <= sites.size(), sites.size(), fixed);
    const double side = bucket_side(density, sites.size());
    std::vector<Cell> cells;
    for (std::size_t round = 0; round < rounds && !run.stopped(); ++round) {
        cells.assign(sites.size(), {});
        for_each_owned(sites, density, side, [&](std::size_t i, const Vec2& p, double mass) {
            cells[i].mass += mass;
            cells[i].moment += mass * p;
        });
        for (std::size_t i = fixed; i < sites.size(); ++i) {
            if (cells[i].mass > 0.0) sites[i] = cells[i].moment / cells[i].mass;
        }
        if (round < kJumpRounds && round + 1 < rounds) jump(sites, fixed, cells, side);
    }
}

double coverage_cost(const std::vector<Vec2>& sites, const DensityRaster& density) {
    double cost = 0.0;
    for_each_owned(sites, density, bucket_side(density, sites.size()), [&](std::size_t i, const Vec2& p, double mass) {
        cost += mass * glm::dot(p - sites[i], p - sites[i]);
    });
    return cost * density.cell * density.cell;
}

double mean_distance(const std::vector<Vec2>& sites, const DensityRaster& area) {
    double cost = 0.0;
    for_each_owned(sites, area, bucket_side(area, sites.size()),
                   [&](std::size_t i, const Vec2& p, double mass) { cost += mass * glm::distance(p, sites[i]); });
    return cost / area.total();
}

std::vector<Vec2> spread_by_mass(const DensityRaster& density, std::size_t count) {
    struct Place {
        std::uint64_t along;
        std::size_t cell;
    };
    std::uint32_t order = 1;
    while ((std::size_t{1} << order) < std::max(density.across, density.up)) ++order;
    std::vector<Place> places;
    double total = 0.0;
    for (std::size_t c = 0; c < density.mass.size(); ++c) {
        if (density.mass[c] <= 0.0F) continue;
        total += static_cast<double>(density.mass[c]);
        places.push_back({along_hilbert(order, static_cast<std::uint32_t>(c % density.across),
                                        static_cast<std::uint32_t>(c / density.across)),
                          c});
    }
    AEROGRAM_REQUIRE(!places.empty());
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.along < b.along; });
    std::vector<Vec2> out;
    double before = 0.0;
    for (const Place& place : places) {
        const double mass = static_cast<double>(density.mass[place.cell]);
        // Several places in one cell stand side by side.
        for (std::size_t in_cell = 0; out.size() < count; ++in_cell) {
            const double wanted = total * (static_cast<double>(out.size()) + 0.5) / static_cast<double>(count);
            if (wanted > before + mass && &place != &places.back()) break;
            const double share = std::clamp((wanted - before) / mass, 0.0, 1.0) - 0.5;
            out.push_back(density.centre(place.cell % density.across, place.cell / density.across) +
                          density.cell * Vec2(share, 0.01 * static_cast<double>(in_cell)));
        }
        before += mass;
    }
    return out;
}

}  // namespace aerogram::planner
