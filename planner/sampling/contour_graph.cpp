#include "planner/sampling/contour_graph.hpp"

#include <algorithm>

#include "planner/sampling/contour_track.hpp"

namespace aerogram::planner {
namespace {

void add_dot(StrokeGraph& graph, const Contour& contour) {
    const Bounds box = bounds_of({{contour}});
    const Vec2 middle = 0.5 * (box.low + box.high);
    const std::size_t station = graph.stations.size();
    graph.stations.push_back({middle, StationKind::end});
    graph.edges.push_back({station, station, {middle}});
}

}  // namespace

StrokeGraph contour_graph(const Region& region, double close) {
    StrokeGraph graph;
    for (const Contour& contour : region.contours) {
        const ContourTrack track(contour);
        if (track.length() <= close || track.length() <= 0.0) {
            add_dot(graph, contour);
            continue;
        }
        std::vector<double> places = corner_places(contour, track, close);
        if (places.empty()) {
            const auto top = std::max_element(contour.begin(), contour.end(),
                                              [](const Vec2& a, const Vec2& b) { return a.y < b.y; });
            places.push_back(track.of_vertex(static_cast<std::size_t>(top - contour.begin())));
        }
        const std::size_t first = graph.stations.size();
        for (const double place : places) graph.stations.push_back({track.at(place), StationKind::end});
        for (std::size_t k = 0; k < places.size(); ++k) {
            const bool last = k + 1 == places.size();
            const double to = last ? places.front() + track.length() : places[k + 1];
            graph.edges.push_back({first + k, last ? first : first + k + 1, track.between(places[k], to)});
        }
    }
    return graph;
}

}  // namespace aerogram::planner
