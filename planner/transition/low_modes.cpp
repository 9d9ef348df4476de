#include "planner/transition/low_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geo/contract.hpp"
#include "planner/adjacency/subgraph.hpp"
#include "planner/transition/lanczos.hpp"

namespace aerogram::planner {
namespace {

using dense::Matrix;

constexpr double kEverything = std::numeric_limits<double>::infinity();

struct Component {
    std::vector<std::uint32_t> members;
    LowModes modes;
};

std::vector<Component> components(const AdjacencyGraph& graph) {
    const std::vector<std::uint32_t> of = components_of(graph);
    std::vector<Component> out;
    for (std::uint32_t i = 0; i < graph.n; ++i) {
        if (of[i] == out.size()) out.emplace_back();
        out[of[i]].members.push_back(i);
    }
    return out;
}

Result<LowModes> modes_of(const AdjacencyGraph& graph, std::size_t count, double gap, const Run& run) {
    if (graph.n > std::max(kDenseComponent, 6 * count)) return lanczos_low_modes(graph, count, gap, run);
    Eigenbasis all = laplacian_eigenbasis(graph);
    const std::size_t kept = std::min(all.values.size(), 2 * count + 1);
    const double known_below = kept < all.values.size() ? all.values[kept] : kEverything;
    all.values.resize(kept);
    return LowModes{std::move(all.values), column_block(all.modes, 0, kept), known_below};
}

/// Orthonormal, constant on every component, sums 0: all but the constant of the Laplacian's kernel.
Matrix kernel(const std::vector<Component>& parts, std::size_t n) {
    // Householder's reflection of the first coordinate vector onto the constant one, in coordinates √size per part.
    const std::size_t c = parts.size();
    std::vector<double> root(c), v(c);
    for (std::size_t k = 0; k < c; ++k) {
        root[k] = std::sqrt(static_cast<double>(parts[k].members.size()));
        v[k] = root[k] / std::sqrt(static_cast<double>(n));
    }
    v[0] += 1.0;
    double length2 = 0.0;
    for (const double x : v) length2 += x * x;
    Matrix out(n, c - 1);
    for (std::size_t j = 1; j < c; ++j) {
        for (std::size_t k = 0; k < c; ++k) {
            const double entry = ((j == k ? 1.0 : 0.0) - 2.0 / length2 * v[j] * v[k]) / root[k];
            for (const std::uint32_t i : parts[k].members) out(i, j - 1) = entry;
        }
    }
    return out;
}

/// A mode of the whole graph: which component's, and its column there. Kernel columns come first.
struct Place {
    double value = 0.0;
    std::size_t component = 0, column = 0;
    bool in_kernel = false;
};

/// How many of the values make whole eigenspaces; see low_eigenbasis.
std::size_t cut_of(const std::vector<Place>& places, double known_below, std::size_t count, double gap) {
    const auto is_gap = [&](std::size_t k) {
        const double next = k < places.size() ? places[k].value : known_below;
        return k == 0 || next - places[k - 1].value > gap;
    };
    for (std::size_t k = std::min(count, places.size()); k <= std::min(2 * count, places.size()); ++k) {
        if (is_gap(k)) return k;
    }
    std::size_t before = std::min(count, places.size());
    while (!is_gap(before)) --before;
    return before;
}

}  // namespace

Result<Eigenbasis> low_eigenbasis(const AdjacencyGraph& graph, std::size_t count, const Run& run) {
    AEROGRAM_REQUIRE(graph.n >= 1, graph.n);
    if (count == 0) return Eigenbasis{Matrix(graph.n, 0), {}, {}};
    const double gap = kEigenspaceTolerance * largest_eigenvalue(graph);
    std::vector<Component> parts = components(graph);
    std::vector<Place> places;
    double known_below = kEverything;
    const std::size_t still = parts.size() - 1;
    for (std::size_t k = 0; k < std::min(still, 2 * count + 1); ++k) places.push_back({0.0, 0, k, true});
    for (std::size_t p = 0; p < parts.size() && still <= 2 * count; ++p) {
        if (parts[p].members.size() == 1) continue;
        auto modes = modes_of(induced_subgraph(graph, parts[p].members), count, gap, run);
        if (!modes) return modes.error();
        parts[p].modes = std::move(*modes);
        known_below = std::min(known_below, parts[p].modes.known_below);
        for (std::size_t k = 0; k < parts[p].modes.values.size(); ++k) {
            places.push_back({parts[p].modes.values[k], p, k, false});
        }
    }
    if (still > 2 * count) known_below = 0.0;
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.value < b.value; });
    std::erase_if(places, [&](const Place& p) { return p.value > known_below; });
    const std::size_t cut = cut_of(places, known_below, count, gap);

    Eigenbasis out{Matrix(graph.n, cut), {}, {}};
    const Matrix still_modes = cut > 0 && still > 0 ? kernel(parts, graph.n) : Matrix{};
    for (std::size_t k = 0; k < cut; ++k) {
        const Place& place = places[k];
        out.values.push_back(place.value);
        if (place.in_kernel) {
            std::ranges::copy(still_modes.column(place.column), out.modes.column(k).begin());
            continue;
        }
        const Component& part = parts[place.component];
        for (std::size_t i = 0; i < part.members.size(); ++i) {
            out.modes(part.members[i], k) = part.modes.vectors(i, place.column);
        }
    }
    out.spaces = eigenspaces(out.values, gap);
    for (const Eigenspace& space : out.spaces) {
        set_column_block(out.modes, space.first, canonical_basis(column_block(out.modes, space.first, space.last)));
    }
    return out;
}

}  // namespace aerogram::planner
