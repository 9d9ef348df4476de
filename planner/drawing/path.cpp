#include "planner/drawing/path.hpp"

#include <algorithm>
#include <cmath>

#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

constexpr double kTurn_rad = radians(15.0);
constexpr double kChordsAtMost = 200.0;

double cross(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}

double angle_between(const Vec2& a, const Vec2& b) {
    return std::abs(std::atan2(cross(a, b), glm::dot(a, b)));
}

/// How many chords of equal parameter steps follow a cubic closely enough.
double chords_needed(const Vec2& a, const PathStep& s, double tolerance) {
    const Vec2 bend = glm::max(glm::abs(a - 2.0 * s.first + s.second), glm::abs(s.first - 2.0 * s.second + s.to));
    const double by_distance =
        std::sqrt(0.75 * glm::length(bend) / tolerance);  // an upper bound of the second derivative
    const Vec2 legs[] = {s.first - a, s.second - s.first, s.to - s.second};
    double turn = 0.0;
    Vec2 before{};
    for (const Vec2& leg : legs) {
        if (leg == Vec2{}) continue;
        if (before != Vec2{}) turn += angle_between(before, leg);
        before = leg;
    }
    const double size =
        std::max({glm::distance(a, s.first), glm::distance(s.first, s.second), glm::distance(s.second, s.to)});
    const double by_turn = size > 0.1 * tolerance ? turn / kTurn_rad : 1.0;
    return std::clamp(std::ceil(std::max(by_distance, by_turn)), 1.0, kChordsAtMost);
}

Vec2 on_cubic(const Vec2& a, const PathStep& s, double t) {
    const double u = 1.0 - t;
    return u * u * u * a + 3.0 * u * u * t * s.first + 3.0 * u * t * t * s.second + t * t * t * s.to;
}

}  // namespace

void PathPen::begin() {
    if (open_) return;
    path_.push_back({StepKind::move, {}, {}, here_});
    start_ = here_;
    open_ = true;
}

void PathPen::move(const Vec2& to) {
    here_ = start_ = to;
    open_ = false;
    last_ = Last::other;
}

void PathPen::line(const Vec2& to) {
    begin();
    path_.push_back({StepKind::line, {}, {}, to});
    here_ = to;
    last_ = Last::other;
}

void PathPen::cubic(const Vec2& first, const Vec2& second, const Vec2& to) {
    begin();
    path_.push_back({StepKind::curve, first, second, to});
    here_ = to;
    control_ = second;
    last_ = Last::cubic;
}

void PathPen::smooth_cubic(const Vec2& second, const Vec2& to) {
    cubic(last_ == Last::cubic ? 2.0 * here_ - control_ : here_, second, to);
}

void PathPen::quadratic(const Vec2& control, const Vec2& to) {
    cubic(here_ + (control - here_) * (2.0 / 3.0), to + (control - to) * (2.0 / 3.0), to);
    control_ = control;
    last_ = Last::quadratic;
}

void PathPen::smooth_quadratic(const Vec2& to) {
    quadratic(last_ == Last::quadratic ? 2.0 * here_ - control_ : here_, to);
}

void PathPen::arc(const Vec2& radii, double turn_rad, bool large, bool sweep, const Vec2& to) {
    if (to == here_) return;
    double rx = std::abs(radii.x), ry = std::abs(radii.y);
    if (rx == 0.0 || ry == 0.0) return line(to);
    const Vec2 along(std::cos(turn_rad), std::sin(turn_rad)), across(-along.y, along.x);
    const Vec2 half = 0.5 * (here_ - to);
    const Vec2 p(glm::dot(half, along), glm::dot(half, across));
    const double stretch = (p.x / rx) * (p.x / rx) + (p.y / ry) * (p.y / ry);
    if (stretch > 1.0) {
        rx *= std::sqrt(stretch);
        ry *= std::sqrt(stretch);
    }
    const Vec2 unit(p.x / rx, p.y / ry);  // the half chord on the unit circle
    const double share = std::sqrt(std::max(0.0, 1.0 / std::max(glm::dot(unit, unit), 1e-300) - 1.0));
    const Vec2 centre = (large == sweep ? -share : share) * Vec2(unit.y, -unit.x);
    const double from = std::atan2(unit.y - centre.y, unit.x - centre.x);
    double swept = std::atan2(-unit.y - centre.y, -unit.x - centre.x) - from;
    if (sweep && swept < 0.0) swept += 2.0 * kPi;
    if (!sweep && swept > 0.0) swept -= 2.0 * kPi;
    const Vec2 middle = 0.5 * (here_ + to);
    const auto place = [&](const Vec2& q) {
        const Vec2 scaled((q.x + centre.x) * rx, (q.y + centre.y) * ry);
        return middle + along * scaled.x + across * scaled.y;
    };
    const double parts = std::ceil(std::abs(swept) / (0.5 * kPi) - 1e-9);
    const double step = swept / std::max(parts, 1.0), reach = 4.0 / 3.0 * std::tan(0.25 * step);
    const Vec2 end = to;
    for (double k = 0.0; k < std::max(parts, 1.0); k += 1.0) {
        const double a = from + k * step, b = a + step;
        const Vec2 first(std::cos(a) - reach * std::sin(a), std::sin(a) + reach * std::cos(a));
        const Vec2 second(std::cos(b) + reach * std::sin(b), std::sin(b) - reach * std::cos(b));
        cubic(place(first), place(second), k + 1.0 < parts ? place({std::cos(b), std::sin(b)}) : end);
    }
    last_ = Last::other;
}

void PathPen::close() {
    if (!open_) return;
    path_.push_back({StepKind::close, {}, {}, start_});
    here_ = start_;
    open_ = false;
    last_ = Last::other;
}

Path transformed(const Path& path, const Affine& by) {
    Path out;
    out.reserve(path.size());
    for (const PathStep& s : path) out.push_back({s.kind, by(s.first), by(s.second), by(s.to)});
    return out;
}

Chords chords_of(const Path& path, double tolerance) {
    Chords out;
    Stroke line;
    const auto finish = [&](bool closed) {
        while (closed && line.size() > 1 && line.back() == line.front()) line.pop_back();
        if (line.size() > 1) {
            out.lines.push_back(std::move(line));
            out.closed.push_back(closed && out.lines.back().size() > 2);
        }
        line.clear();
    };
    const auto add = [&](const Vec2& p) {
        if (line.empty() || line.back() != p) line.push_back(p);
    };
    Vec2 here{};
    for (const PathStep& s : path) {
        if (s.kind == StepKind::move) finish(false);
        if (s.kind == StepKind::curve) {
            const double count = chords_needed(here, s, tolerance);
            for (double k = 1.0; k < count; k += 1.0) add(on_cubic(here, s, k / count));
        }
        if (s.kind == StepKind::close) {
            finish(true);
        } else {
            add(s.to);
        }
        here = s.to;
    }
    finish(false);
    return out;
}

}  // namespace aerogram::planner
