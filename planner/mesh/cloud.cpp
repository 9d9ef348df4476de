#include "planner/mesh/cloud.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "geo/contract.hpp"
#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kPiecesPerPoint = 20, kPiecesAtLeast = 12'000, kPiecesAtMost = 300'000;
constexpr std::size_t kJumpRounds = 4;
constexpr double kPoor = 0.6, kRich = 1.5;  ///< shares of the mean mass: from below the first, to above the second
constexpr double kShare2 = 0.17, kShare3 = 0.06;  ///< size of a piece whose longest edge was halved down to 1
constexpr double kLeastPiece = 1.0 / 6.0;         ///< of the mean size: long pieces that small are not cut

template <std::size_t N>
using Simplex = std::array<Vec3, N>;

template <std::size_t N>
double size_of(const Simplex<N>& s) {
    const Vec3 across = glm::cross(s[1] - s[0], s[2] - s[0]);
    if constexpr (N == 3)
        return 0.5 * glm::length(across);
    else
        return std::abs(glm::dot(across, s[3] - s[0])) / 6.0;
}

struct Edge {
    std::size_t from = 0, to = 1;
    double squared = -1.0;
};

template <std::size_t N>
Edge longest_edge(const Simplex<N>& s) {
    Edge longest;
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = i + 1; j < N; ++j) {
            const double squared = glm::dot(s[i] - s[j], s[i] - s[j]);
            if (squared > longest.squared) longest = {i, j, squared};
        }
    }
    return longest;
}

/// Halves a simplex across its longest edge until no edge is longer than `reach`, or it is no larger than `least`;
/// calls visit(centre, size).
template <std::size_t N, class Visit>
void halve(const Simplex<N>& s, double size, double reach, double least, const Visit& visit) {
    const Edge longest = longest_edge(s);
    if (longest.squared <= reach * reach || size <= least) {
        Vec3 centre{};
        for (const Vec3& p : s) centre += p;
        visit(centre / static_cast<double>(N), size);
        return;
    }
    Simplex<N> first = s, second = s;
    first[longest.to] = second[longest.from] = 0.5 * (s[longest.from] + s[longest.to]);
    halve<N>(first, 0.5 * size, reach, least, visit);
    halve<N>(second, 0.5 * size, reach, least, visit);
}

/// The place of a cell of 2^-21 of the box along Morton's curve.
std::uint64_t along_morton(const Vec3& share) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        auto v = static_cast<std::uint64_t>(std::clamp(share[axis], 0.0, 2097151.0));
        v = (v | v << 32) & 0x1F00000000FFFFULL;
        v = (v | v << 16) & 0x1F0000FF0000FFULL;
        v = (v | v << 8) & 0x100F00F00F00F00FULL;
        v = (v | v << 4) & 0x10C30C30C30C30C3ULL;
        v = (v | v << 2) & 0x1249249249249249ULL;
        code |= v << axis;
    }
    return code;
}

/// Sorts the pieces along Morton's curve; where there are far too many, those of a cell of side `cell` become one.
void put_in_order(std::vector<Cloud::Piece>& pieces, double cell, bool merge) {
    Vec3 low(1e300), high(-1e300);
    for (const auto& piece : pieces) {
        low = glm::min(low, piece.at);
        high = glm::max(high, piece.at);
    }
    const Vec3 size = high - low;
    cell = std::max({cell, size.x / 2097151.0, size.y / 2097151.0, size.z / 2097151.0});
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    order.reserve(pieces.size());
    for (std::uint32_t i = 0; i < pieces.size(); ++i) order.emplace_back(along_morton((pieces[i].at - low) / cell), i);
    std::sort(order.begin(), order.end());
    std::vector<Cloud::Piece> sorted;
    for (std::size_t k = 0; k < order.size();) {
        std::size_t end = k + 1;
        while (merge && end < order.size() && order[end].first == order[k].first) ++end;
        Cloud::Piece all;
        Vec3 moment{};
        for (std::size_t n = k; n < end; ++n) {
            const Cloud::Piece& piece = pieces[order[n].second];
            all.size += piece.size;
            all.mass += piece.mass;
            moment += piece.size * piece.at;
        }
        const Vec3 centre = moment / all.size;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t n = k; n < end; ++n) {
            const Cloud::Piece& piece = pieces[order[n].second];
            const double squared = glm::dot(piece.at - centre, piece.at - centre);
            if (squared >= nearest) continue;
            nearest = squared;
            all.at = piece.at;
            all.of = piece.of;
        }
        sorted.push_back(all);
        k = end;
    }
    pieces = std::move(sorted);
}

template <std::size_t N, class At>
Cloud cloud_of_simplices(std::size_t simplices, const At& at, std::size_t pieces, const DensityField& density) {
    Cloud cloud;
    cloud.dimension = static_cast<int>(N) - 1;
    double whole = 0.0;
    for (std::size_t i = 0; i < simplices; ++i) whole += size_of<N>(at(i));
    AEROGRAM_REQUIRE(whole > 0.0, simplices);
    const double wanted = static_cast<double>(pieces), power = 1.0 / cloud.dimension;
    const double reach = std::pow(whole / ((N == 3 ? kShare2 : kShare3) * wanted), power);
    const double least = kLeastPiece * whole / wanted;
    const auto gather = [&](const DensityField& weight) {
        cloud.mass = cloud.size = 0.0;
        for (std::size_t i = 0; i < simplices; ++i) {
            const Simplex<N> s = at(i);
            const double all = size_of<N>(s);
            if (all <= 0.0) continue;
            halve<N>(s, all, reach, least, [&](const Vec3& centre, double size) {
                const double mass = weight ? weight(centre) * size : size;
                if (!(mass > 0.0)) return;
                cloud.pieces.push_back({centre, static_cast<std::uint32_t>(i), size, mass});
                cloud.size += size;
                cloud.mass += mass;
            });
        }
    };
    gather(density);
    if (cloud.pieces.empty()) gather({});
    put_in_order(cloud.pieces, std::pow(whole / wanted, power), cloud.pieces.size() > 2 * pieces);
    return cloud;
}

/// What a site owns.
struct Cell {
    double mass = 0.0, pull = 0.0;
    Vec3 moment{};
    double nearest = std::numeric_limits<double>::infinity(), farthest = -1.0;  ///< squared, from the centre
    std::size_t nearest_piece = 0, farthest_piece = 0;
};

double bucket_side(const Cloud& cloud, std::size_t sites) {
    return std::pow(cloud.size / static_cast<double>(sites), 1.0 / cloud.dimension);
}

/// Lloyd's relaxation with weight w comes to rest where the sites' density is w^(d / (d + 2)), which asks for this
/// power of the density wanted (Gersho 1979).
std::vector<double> pulls(const Cloud& cloud) {
    const double mean = cloud.mass / cloud.size, power = 2.0 / cloud.dimension;
    std::vector<double> out;
    out.reserve(cloud.pieces.size());
    for (const auto& p : cloud.pieces) {
        const double density = p.mass / p.size / mean;
        out.push_back(std::abs(density - 1.0) < 1e-9 ? p.mass : p.mass * std::pow(density, power));
    }
    return out;
}

/// Poor sites go to the edges of rich cells, the poorest to the richest.
void jump(Points& sites, std::size_t fixed, const Cloud& cloud, const std::vector<Cell>& cells, const Settle& settle) {
    const double mean = cloud.mass / static_cast<double>(sites.size());
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
        const Cloud::Piece& piece = cloud.pieces[cells[rich[k]].farthest_piece];
        sites[poor[k]] = settle(poor[k], piece.at, piece);
    }
}

}  // namespace

std::size_t pieces_for(std::size_t count) {
    return std::clamp(kPiecesPerPoint * count, kPiecesAtLeast, kPiecesAtMost);
}

Cloud cloud_of(const TriangleMesh& mesh, std::size_t pieces, const DensityField& density) {
    const auto at = [&](std::size_t i) {
        const auto& [a, b, c] = mesh.triangles[i];
        return Simplex<3>{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    };
    return cloud_of_simplices<3>(mesh.triangles.size(), at, pieces, density);
}

Cloud cloud_of(const TetrahedralMesh& inside, std::size_t pieces, const DensityField& density) {
    const auto at = [&](std::size_t i) {
        const auto& [a, b, c, d] = inside.tetrahedra[i];
        return Simplex<4>{inside.vertices[a], inside.vertices[b], inside.vertices[c], inside.vertices[d]};
    };
    return cloud_of_simplices<4>(inside.tetrahedra.size(), at, pieces, density);
}

std::vector<std::size_t> spread_by_mass(const Cloud& cloud, std::size_t count) {
    std::vector<std::size_t> out;
    double before = 0.0;
    for (std::size_t k = 0; k < cloud.pieces.size(); ++k) {
        before += cloud.pieces[k].mass;
        const auto wanted = [&] {
            return cloud.mass * (static_cast<double>(out.size()) + 0.5) / static_cast<double>(count);
        };
        while (out.size() < count && (wanted() <= before || k + 1 == cloud.pieces.size())) out.push_back(k);
    }
    return out;
}

void relax(Points& sites, std::size_t fixed, const Cloud& cloud, std::size_t rounds, const Settle& settle,
           const Run& run) {
    AEROGRAM_REQUIRE(!sites.empty() && fixed <= sites.size(), sites.size(), fixed);
    const std::vector<double> pull = pulls(cloud);
    std::vector<std::size_t> owner(cloud.pieces.size());
    std::vector<Cell> cells;
    for (std::size_t round = 0; round < rounds && !run.stopped(); ++round) {
        const SpaceGrid grid(sites, bucket_side(cloud, sites.size()));
        cells.assign(sites.size(), {});
        for (std::size_t k = 0; k < cloud.pieces.size(); ++k) {
            const Cloud::Piece& piece = cloud.pieces[k];
            Cell& cell = cells[owner[k] = grid.nearest(piece.at)];
            cell.mass += piece.mass;
            cell.pull += pull[k];
            cell.moment += pull[k] * piece.at;
        }
        for (Cell& cell : cells) {
            if (cell.pull > 0.0) cell.moment /= cell.pull;
        }
        for (std::size_t k = 0; k < cloud.pieces.size(); ++k) {
            Cell& cell = cells[owner[k]];
            const Vec3 d = cloud.pieces[k].at - cell.moment;
            const double squared = glm::dot(d, d);
            if (squared < cell.nearest) {
                cell.nearest = squared;
                cell.nearest_piece = k;
            }
            if (squared > cell.farthest) {
                cell.farthest = squared;
                cell.farthest_piece = k;
            }
        }
        for (std::size_t i = fixed; i < sites.size(); ++i) {
            if (cells[i].pull > 0.0) sites[i] = settle(i, cells[i].moment, cloud.pieces[cells[i].nearest_piece]);
        }
        if (round < kJumpRounds && round + 1 < rounds) jump(sites, fixed, cloud, cells, settle);
    }
}

double mean_distance(const Cloud& cloud, const Points& points) {
    AEROGRAM_REQUIRE(!points.empty());
    const SpaceGrid grid(points, bucket_side(cloud, points.size()));
    double sum = 0.0;
    for (const auto& piece : cloud.pieces) sum += piece.mass * glm::distance(piece.at, points[grid.nearest(piece.at)]);
    return sum / cloud.mass;
}

}  // namespace aerogram::planner
