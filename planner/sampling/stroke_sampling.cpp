#include "planner/sampling/stroke_sampling.hpp"

#include <algorithm>
#include <limits>

#include "planner/sampling/edge_placing.hpp"

namespace aerogram::planner {
namespace {

/// Which stations are occupied, in order of importance: kind by kind, then farthest from those already taken.
std::vector<bool> occupied_stations(const std::vector<Station>& stations, const Vec2& scale, std::size_t count) {
    std::vector<bool> taken(stations.size(), false);
    std::vector<double> distance(stations.size(), std::numeric_limits<double>::infinity());
    std::size_t left = count;
    for (const StationKind kind : {StationKind::end, StationKind::junction}) {
        const auto of_kind =
            std::count_if(stations.begin(), stations.end(), [&](const Station& s) { return s.kind == kind; });
        const bool all = static_cast<std::size_t>(of_kind) <= left;
        for (std::size_t round = 0; round < static_cast<std::size_t>(of_kind) && left > 0; ++round) {
            std::size_t next = stations.size();
            for (std::size_t i = 0; i < stations.size(); ++i) {
                if (taken[i] || stations[i].kind != kind) continue;
                if (next == stations.size() || (!all && distance[i] > distance[next])) next = i;
            }
            taken[next] = true;
            --left;
            for (std::size_t i = 0; i < stations.size(); ++i) {
                distance[i] = std::min(distance[i], glm::distance(stations[i].at * scale, stations[next].at * scale));
            }
        }
        if (!all) break;
    }
    return taken;
}

}  // namespace

std::optional<std::vector<Vec2>> sample_strokes(const StrokeGraph& drawing, const Vec2& scale, std::size_t count) {
    std::vector<std::vector<Vec2>> paths;
    std::vector<double> lengths;
    for (const StrokeEdge& edge : drawing.edges) {
        std::vector<Vec2> path;
        for (const Vec2& p : edge.path) path.push_back(p * scale);
        lengths.push_back(length_of(path));
        paths.push_back(std::move(path));
    }
    std::vector<bool> to_place = occupied_stations(drawing.stations, scale, count);
    const auto stations = static_cast<std::size_t>(std::count(to_place.begin(), to_place.end(), true));
    const bool dots_only = std::all_of(lengths.begin(), lengths.end(), [](double length) { return length <= 0.0; });
    if (dots_only && stations < count) return std::nullopt;
    const std::vector<std::size_t> inside = points_inside(lengths, count - stations);

    std::vector<Vec2> standing;  // so far; later lines keep clear of earlier ones
    for (std::size_t i = 0; i < to_place.size(); ++i) {
        if (to_place[i]) standing.push_back(drawing.stations[i].at * scale);
    }
    std::vector<Vec2> points;
    const auto place = [&](std::size_t station) {
        if (to_place[station]) points.push_back(drawing.stations[station].at * scale);
        to_place[station] = false;
    };
    for (std::size_t e = 0; e < drawing.edges.size(); ++e) {
        place(drawing.edges[e].from);
        if (inside[e] > 0) {
            const std::vector<Vec2> between = points_along(paths[e], inside[e], standing);
            points.insert(points.end(), between.begin(), between.end());
            standing.insert(standing.end(), between.begin(), between.end());
        }
        place(drawing.edges[e].to);
    }
    return points;
}

}  // namespace aerogram::planner
