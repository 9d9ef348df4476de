#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "geo/random.hpp"
#include "planner/adjacency/adjacency.hpp"
#include "planner/transition/interpolation.hpp"
#include "planner/transition/spectral.hpp"
#include "planner/transition/turn.hpp"

/// Groups that travel as bodies, and how well a transition keeps them together (DESIGN.md 7). Shared by the tests and
/// by the study of all methods.
namespace aerogram::planner::bodies {

struct Move {
    Points from_m, to_m;
    std::vector<std::uint32_t> body;  ///< by drone
};

inline constexpr double kSpacing_m = 2.2;
inline constexpr double kBodyWeight = 10.0;

inline Vec3 direction(Random& random) {
    for (;;) {
        const Vec3 v{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
        const double length = glm::length(v);
        if (length > 0.1 && length <= 1.0) return v / length;
    }
}
/// n scattered points about the origin, no two closer than the spacing.
inline Points cluster(Random& random, std::size_t n) {
    Points out;
    for (double half = kSpacing_m; out.size() < n; half *= 1.002) {
        const Vec3 p{random.between(-half, half), random.between(-half, half), random.between(-half, half)};
        const auto clear = [&](const Vec3& q) { return glm::distance(p, q) >= kSpacing_m; };
        if (std::all_of(out.begin(), out.end(), clear)) out.push_back(p);
    }
    Vec3 middle{};
    for (const Vec3& p : out) middle += p / static_cast<double>(n);
    for (Vec3& p : out) p -= middle;
    return out;
}

/// Six groups of six on a ring of 14 m, its places in turn 3 m higher: every group moves on by `places`, turns with the
/// ring, and besides by up to own_turn_rad about an axis of its own.
inline Move ring_of_bodies(int places, double own_turn_rad, std::uint64_t seed) {
    Random random(seed);
    Move out;
    const auto angle = [](int place) { return place * std::numbers::pi / 3.0; };
    const auto center = [&](int place) {
        return Vec3{14.0 * std::cos(angle(place)), 14.0 * std::sin(angle(place)), place % 2 == 0 ? 60.0 : 63.0};
    };
    for (int g = 0; g < 6; ++g) {
        const Points shape = cluster(random, 6);
        const Turn own{direction(random), own_turn_rad * random.between(-1.0, 1.0)};
        for (const Vec3& p : shape) {
            out.from_m.push_back(center(g) + p);
            out.to_m.push_back(center(g + places) + turned(own, 1.0, turned({{0, 0, 1}, angle(places)}, 1.0, p)));
            out.body.push_back(static_cast<std::uint32_t>(g));
        }
    }
    return out;
}

/// Two groups of eighteen, 20 m apart, change places and turn by up to own_turn_rad.
inline Move swapping_bodies(double own_turn_rad, std::uint64_t seed) {
    Random random(seed);
    Move out;
    for (std::uint32_t g = 0; g < 2; ++g) {
        const Vec3 place{g == 0 ? 10.0 : -10.0, 0.0, 0.0}, height{0.0, 0.0, 50.0};
        const Points shape = cluster(random, 18);
        const Turn own{direction(random), own_turn_rad * random.between(-1.0, 1.0)};
        for (const Vec3& p : shape) {
            out.from_m.push_back(height + place + p);
            out.to_m.push_back(height - place + turned(own, 1.0, p));
            out.body.push_back(g);
        }
    }
    return out;
}

/// The ring of six groups; everybody goes to somebody's place.
inline Move shuffled_places(std::uint64_t seed) {
    Move out = ring_of_bodies(0, 0.0, seed);
    Random random(seed);
    for (std::size_t i = out.to_m.size() - 1; i > 0; --i) std::swap(out.to_m[i], out.to_m[random.below(i + 1)]);
    return out;
}

/// Delaunay neighbours, ties inside bodies ten times as strong.
inline SpectralKeyframe keyframe(const Points& points_m, const std::vector<std::uint32_t>& body) {
    std::map<std::uint32_t, Group> groups;
    for (std::uint32_t i = 0; i < body.size(); ++i) {
        Group& group = groups[body[i]];
        group.weight = kBodyWeight;
        group.drones.push_back(DroneId{i});
    }
    std::vector<Group> list;
    for (auto& [number, group] : groups) list.push_back(std::move(group));
    SpectralKeyframe out;
    out.positions_m = points_m;
    out.graph = edited_adjacency(delaunay_adjacency(points_m), points_m, list, {});
    return out;
}
inline SpectralKeyframe source(const Move& move) {
    return keyframe(move.from_m, move.body);
}
inline SpectralKeyframe target(const Move& move) {
    return keyframe(move.to_m, move.body);
}

inline double smallest_distance_m(const Points& points_m) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        for (std::size_t j = i + 1; j < points_m.size(); ++j) {
            least = std::min(least, glm::distance(points_m[i], points_m[j]));
        }
    }
    return least;
}

/// What a path from a move's source to its target does, over 61 instants.
struct Quality {
    double distortion = 0.0;  ///< mean |length / (length on its linear way) - 1| of the edges inside bodies
    double separation = 0.0;  ///< smallest distance over the smallest in either keyframe
    double path_ratio = 0.0;  ///< flown length over straight
};
/// @param at  called with a share in [0, 1] and the places to fill.
template <class At>
Quality quality(const Move& move, const At& at) {
    constexpr int kSteps = 60;
    Quality out;
    double distortions = 0.0, flown_m = 0.0, direct_m = 0.0;
    double least_m = std::numeric_limits<double>::infinity();
    std::size_t count = 0;
    Points now(move.from_m.size()), before;
    const std::array<AdjacencyGraph, 2> graphs{source(move).graph, target(move).graph};
    for (int step = 0; step <= kSteps; ++step) {
        const double t = static_cast<double>(step) / kSteps;
        at(t, std::span<Vec3>(now));
        least_m = std::min(least_m, smallest_distance_m(now));
        for (const AdjacencyGraph& graph : graphs) {
            for (const Edge& e : graph.edges) {
                if (move.body[e.a] != move.body[e.b]) continue;
                const double linear_m = (1.0 - t) * glm::distance(move.from_m[e.a], move.from_m[e.b]) +
                                        t * glm::distance(move.to_m[e.a], move.to_m[e.b]);
                distortions += std::abs(glm::distance(now[e.a], now[e.b]) / linear_m - 1.0);
                ++count;
            }
        }
        for (std::size_t i = 0; i < before.size(); ++i) flown_m += glm::distance(before[i], now[i]);
        before = now;
    }
    for (std::size_t i = 0; i < now.size(); ++i) direct_m += glm::distance(move.from_m[i], move.to_m[i]);
    out.distortion = count > 0 ? distortions / static_cast<double>(count) : 0.0;
    out.separation = least_m / std::min(smallest_distance_m(move.from_m), smallest_distance_m(move.to_m));
    out.path_ratio = direct_m > 0.0 ? flown_m / direct_m : 1.0;
    return out;
}

}  // namespace aerogram::planner::bodies
