#include "planner/formation/svg_lines.hpp"

#include <algorithm>

#include "planner/sampling/stroke_graph.hpp"
#include "planner/sampling/stroke_sampling.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kChordsAtMost = 3000;

double distance_to(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 d = b - a;
    const double squared = glm::dot(d, d);
    const double t = squared > 0.0 ? std::clamp(glm::dot(p - a, d) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * d);
}

/// Leaves out points that are within `tolerance` of the chord between those kept (Douglas and Peucker 1973).
Stroke smoothed(const Stroke& line, double tolerance) {
    std::vector<bool> keep(line.size(), false);
    keep.front() = keep.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        std::size_t farthest = first;
        double most = tolerance;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double off = distance_to(line[i], line[first], line[last]);
            if (off <= most) continue;
            most = off;
            farthest = i;
        }
        if (farthest == first) continue;
        keep[farthest] = true;
        open.emplace_back(first, farthest);
        open.emplace_back(farthest, last);
    }
    Stroke out;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (keep[i]) out.push_back(line[i]);
    }
    return out;
}

/// The lines as strokes: closed ones end where they began.
std::vector<Stroke> strokes_of(const Chords& lines) {
    std::vector<Stroke> out = lines.lines;
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (lines.closed[i]) out[i].push_back(out[i].front());
    }
    return out;
}

std::vector<Vec2> equal_steps(const std::vector<Stroke>& strokes, std::size_t count, double length) {
    std::vector<Vec2> points;
    const double step = length / static_cast<double>(count);
    double passed = 0.0;
    for (const Stroke& stroke : strokes) {
        for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
            const double piece = glm::distance(stroke[i], stroke[i + 1]);
            while (points.size() < count) {
                const double next = (static_cast<double>(points.size()) + 0.5) * step - passed;
                if (next > piece) break;
                points.push_back(stroke[i] + (stroke[i + 1] - stroke[i]) * (next / std::max(piece, 1e-300)));
            }
            passed += piece;
        }
    }
    while (points.size() < count) points.push_back(strokes.back().back());  // rounding at the very end
    return points;
}

}  // namespace

double length_of(const Chords& lines) {
    double sum = 0.0;
    for (const Stroke& stroke : strokes_of(lines)) {
        for (std::size_t i = 0; i + 1 < stroke.size(); ++i) sum += glm::distance(stroke[i], stroke[i + 1]);
    }
    return sum;
}

std::vector<Vec2> line_points(const Chords& lines, std::size_t count, double spacing) {
    if (count == 0) return {};
    std::vector<Stroke> strokes = strokes_of(lines);
    std::vector<Stroke> smooth;
    std::size_t chords = 0;
    for (const Stroke& stroke : strokes) {
        smooth.push_back(smoothed(stroke, 0.05 * spacing));
        chords += smooth.back().size();
    }
    if (chords <= kChordsAtMost) {
        for (const double features : {4.0, 0.4}) {  // an eighth of this many spacings is one station
            const StrokeGraph graph = stroke_graph(smooth, features * spacing);
            if (auto points = sample_strokes(graph, Vec2(1.0), count)) return std::move(*points);
        }
    }
    return equal_steps(strokes, count, length_of(lines));
}

}  // namespace aerogram::planner
