#include "planner/sampling/stroke_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geo/units.hpp"
#include "planner/sampling/stroke_pieces.hpp"

namespace aerogram::planner {
namespace {

constexpr double kSnapShare = 1.0 / 40.0;  ///< of the cap height
constexpr double kCloseShare = 1.0 / 8.0;  ///< of the cap height
constexpr double kCornerTurn_rad = radians(55.0);

/// Builds the graph of one letter from its pieces.
class GraphBuilder {
  public:
    GraphBuilder(StrokePieces cut, double close) : cut_(std::move(cut)), close_(close) { index_pieces(); }

    StrokeGraph build() {
        open_closed_curves();
        stations_.assign(cut_.vertices.size(), std::nullopt);
        used_.assign(cut_.pieces.size(), false);
        replace_dots();
        find_stations();
        for (std::size_t p = 0; p < cut_.pieces.size(); ++p) {
            if (dot_of_piece_[p]) {
                add_dot(p);
            } else if (!used_[p]) {
                trace(p);
            }
        }
        return std::move(graph_);
    }

  private:
    void index_pieces() {
        at_vertex_.assign(cut_.vertices.size(), {});
        for (std::size_t p = 0; p < cut_.pieces.size(); ++p) {
            at_vertex_[cut_.pieces[p].from].push_back(p);
            at_vertex_[cut_.pieces[p].to].push_back(p);
        }
        find_figures();
    }

    /// Labels every piece with the separate figure (connected component) that it belongs to.
    void find_figures() {
        figure_.assign(cut_.pieces.size(), kNone);
        figures_ = 0;
        for (std::size_t start = 0; start < cut_.pieces.size(); ++start) {
            if (figure_[start] != kNone) continue;
            std::vector<std::size_t> open{start};
            figure_[start] = figures_;
            while (!open.empty()) {
                const StrokePiece piece = cut_.pieces[open.back()];
                open.pop_back();
                for (const std::size_t v : {piece.from, piece.to}) {
                    for (const std::size_t next : at_vertex_[v]) {
                        if (figure_[next] != kNone) continue;
                        figure_[next] = figures_;
                        open.push_back(next);
                    }
                }
            }
            ++figures_;
        }
    }

    struct Bounds {
        Vec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    };
    Bounds bounds_of(std::size_t figure) const {
        Bounds box;
        for (std::size_t p = 0; p < cut_.pieces.size(); ++p) {
            if (figure_[p] != figure) continue;
            for (const std::size_t v : {cut_.pieces[p].from, cut_.pieces[p].to}) {
                box.low = glm::min(box.low, cut_.vertices[v]);
                box.high = glm::max(box.high, cut_.vertices[v]);
            }
        }
        return box;
    }

    Vec2 other_end(std::size_t piece, std::size_t v) const {
        return cut_.vertices[cut_.pieces[piece].from == v ? cut_.pieces[piece].to : cut_.pieces[piece].from];
    }

    /// How far the line turns at a vertex of two pieces; 0 goes straight on.
    double turn_rad(std::size_t v) const {
        const Vec2 in = cut_.vertices[v] - other_end(at_vertex_[v][0], v);
        const Vec2 out = other_end(at_vertex_[v][1], v) - cut_.vertices[v];
        return std::abs(std::atan2(in.x * out.y - in.y * out.x, glm::dot(in, out)));
    }

    bool is_smooth(std::size_t v) const { return at_vertex_[v].size() == 2 && turn_rad(v) <= kCornerTurn_rad; }

    /// A figure without ends, corners and junctions gets a vertex at its top (the middle of a flat top) to start from.
    void open_closed_curves() {
        for (std::size_t figure = 0; figure < figures_; ++figure) {
            bool closed = true;
            std::size_t top = kNone;
            double top_y = -std::numeric_limits<double>::infinity();
            for (std::size_t p = 0; p < cut_.pieces.size(); ++p) {
                if (figure_[p] != figure) continue;
                const auto [from, to] = cut_.pieces[p];
                closed = closed && is_smooth(from) && is_smooth(to);
                const double y = cut_.vertices[from].y + cut_.vertices[to].y;
                if (y > top_y) {
                    top_y = y;
                    top = p;
                }
            }
            if (closed) tops_.push_back(top_vertex(top));
        }
    }

    std::size_t top_vertex(std::size_t top_piece) {
        const auto [from, to] = cut_.pieces[top_piece];
        const double rise = cut_.vertices[to].y - cut_.vertices[from].y;
        if (std::abs(rise) > 1e-9 * close_) return rise > 0.0 ? to : from;
        const std::size_t middle = cut_.vertices.size();
        cut_.vertices.push_back(0.5 * (cut_.vertices[from] + cut_.vertices[to]));
        cut_.pieces[top_piece] = {from, middle};
        cut_.pieces.push_back({middle, to});
        index_pieces();
        return middle;
    }

    void replace_dots() {
        dot_of_piece_.assign(cut_.pieces.size(), std::nullopt);
        for (std::size_t figure = 0; figure < figures_; ++figure) {
            const Bounds box = bounds_of(figure);
            if (std::max(box.high.x - box.low.x, box.high.y - box.low.y) > close_) continue;
            for (std::size_t p = 0; p < cut_.pieces.size(); ++p) {
                if (figure_[p] == figure) dot_of_piece_[p] = figure;
            }
        }
    }

    void add_dot(std::size_t piece) {
        const std::size_t figure = *dot_of_piece_[piece];
        const auto first = std::find(figure_.begin(), figure_.end(), figure) - figure_.begin();
        if (static_cast<std::size_t>(first) != piece) return;
        const Bounds box = bounds_of(figure);
        const std::size_t station = graph_.stations.size();
        graph_.stations.push_back({0.5 * (box.low + box.high), StationKind::end});
        graph_.edges.push_back({station, station, {graph_.stations.back().at}});
    }

    /// Ends first, then corners and tops, then junctions; each kind in drawing order; later ones close to an earlier
    /// are passages.
    void find_stations() {
        std::vector<std::size_t> ends, corners, junctions;
        for (std::size_t v = 0; v < cut_.vertices.size(); ++v) {
            const std::size_t degree = at_vertex_[v].size();
            if (degree == 0 || dot_of_piece_[at_vertex_[v].front()]) continue;
            if (degree == 1) ends.push_back(v);
            if (degree > 2) junctions.push_back(v);
            if (degree == 2 && !is_smooth(v)) corners.push_back(v);
        }
        corners.insert(corners.end(), tops_.begin(), tops_.end());
        std::vector<Vec2> shown;
        const auto add = [&](const std::vector<std::size_t>& vertices, StationKind kind) {
            for (const std::size_t v : vertices) {
                const Vec2 at = cut_.vertices[v];
                const bool free = std::none_of(shown.begin(), shown.end(),
                                               [&](const Vec2& s) { return glm::distance(s, at) < close_; });
                if (free) shown.push_back(at);
                const bool split = at_vertex_[v].size() > 2;
                if (free || split) stations_[v] = graph_.stations.size();
                if (free || split) graph_.stations.push_back({at, free ? kind : StationKind::passage});
            }
        };
        add(ends, StationKind::end);
        add(corners, StationKind::end);
        add(junctions, StationKind::junction);
    }

    /// Adds the edge through a piece: back to the station before it, then on to the one after.
    void trace(std::size_t piece) {
        std::vector<std::size_t> back = walk(piece, cut_.pieces[piece].from),
                                 ahead = walk(piece, cut_.pieces[piece].to);
        StrokeEdge edge;
        edge.from = station_of(back.back());
        edge.to = station_of(ahead.back());
        std::reverse(back.begin(), back.end());
        for (const std::size_t v : back) edge.path.push_back(cut_.vertices[v]);
        for (const std::size_t v : ahead) edge.path.push_back(cut_.vertices[v]);
        graph_.edges.push_back(std::move(edge));
    }

    /// The vertices from `v` on, leaving `piece` behind, up to a station or a dead end.
    std::vector<std::size_t> walk(std::size_t piece, std::size_t v) {
        std::vector<std::size_t> passed{v};
        used_[piece] = true;
        while (!stations_[v]) {
            const auto next =
                std::find_if(at_vertex_[v].begin(), at_vertex_[v].end(), [&](std::size_t p) { return !used_[p]; });
            if (next == at_vertex_[v].end()) break;
            used_[*next] = true;
            v = cut_.pieces[*next].from == v ? cut_.pieces[*next].to : cut_.pieces[*next].from;
            passed.push_back(v);
        }
        return passed;
    }

    /// The station at a vertex where an edge stops; an end too close to another station becomes a passage.
    std::size_t station_of(std::size_t v) {
        if (!stations_[v]) {
            stations_[v] = graph_.stations.size();
            graph_.stations.push_back({cut_.vertices[v], StationKind::passage});
        }
        return *stations_[v];
    }

    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    StrokePieces cut_;
    double close_;
    std::vector<std::vector<std::size_t>> at_vertex_;  ///< pieces that meet there
    std::vector<std::size_t> figure_;                  ///< by piece
    std::size_t figures_ = 0;
    std::vector<std::optional<std::size_t>> dot_of_piece_;  ///< the figure, where it is a dot
    std::vector<std::size_t> tops_;
    std::vector<std::optional<std::size_t>> stations_;  ///< by vertex
    std::vector<bool> used_;
    StrokeGraph graph_;
};

}  // namespace

StrokeGraph stroke_graph(std::span<const Stroke> strokes, double cap_height) {
    const double close = kCloseShare * cap_height;
    return GraphBuilder(cut_strokes(without_thickening(strokes, close), kSnapShare * cap_height), close).build();
}

void append(StrokeGraph& text, const StrokeGraph& letter) {
    const std::size_t offset = text.stations.size();
    text.stations.insert(text.stations.end(), letter.stations.begin(), letter.stations.end());
    for (StrokeEdge edge : letter.edges) {
        edge.from += offset;
        edge.to += offset;
        text.edges.push_back(std::move(edge));
    }
}

}  // namespace aerogram::planner
