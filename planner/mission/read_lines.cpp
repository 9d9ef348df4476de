#include <algorithm>
#include <cmath>

#include "geo/units.hpp"
#include "planner/mission/sections.hpp"

namespace aerogram::planner {
namespace {

// A length of no consequence: only an arc's shape counts.
constexpr double kArcRadius = 100.0;

// An arc in quarters at most, one cubic each: from left to right, bending upwards where the angle is positive.
DrawnLine arc(double arc_rad) {
    DrawnLine out;
    out.bezier = true;
    const auto pieces = static_cast<int>(std::ceil(std::abs(arc_rad) / (0.5 * kPi) - 1e-9));
    const double step = std::abs(arc_rad) / pieces, reach = 4.0 / 3.0 * std::tan(0.25 * step);
    const double up = arc_rad > 0.0 ? 1.0 : -1.0;
    const auto at = [&](double angle) { return kArcRadius * Vec2(std::sin(angle), up * std::cos(angle)); };
    const auto along = [&](double angle) { return kArcRadius * reach * Vec2(std::cos(angle), -up * std::sin(angle)); };
    double angle = -0.5 * std::abs(arc_rad);
    out.points.push_back(at(angle));
    for (int i = 0; i < pieces; ++i, angle += step) {
        out.points.push_back(at(angle) + along(angle));
        out.points.push_back(at(angle + step) - along(angle + step));
        out.points.push_back(at(angle + step));
    }
    return out;
}

bool without_length(const std::vector<Vec2>& points) {
    return std::ranges::all_of(points, [&](const Vec2& p) { return p == points.front(); });
}

}  // namespace

std::optional<DrawnLine> read_drawn_line(TableReader& in, bool closed) {
    DrawnLine line;
    line.closed = closed;
    if (in.has("polyline") == in.has("bezier")) {
        if (in.has("polyline")) {
            in.pairs("polyline", 0, "");
            in.find("bezier");
            in.bad("bezier", "stands beside polyline; must be one of the two");
        } else {
            in.need("polyline", "write polyline = [[x, z], ...] or bezier = [[x, z], ...]");
            in.know({"polyline", "bezier"});
        }
        return std::nullopt;
    }
    line.bezier = in.has("bezier");
    const std::string_view key = line.bezier ? "bezier" : "polyline";
    in.know({"polyline", "bezier"});
    const std::size_t least = closed ? 3 : line.bezier ? 4 : 2;
    auto points = in.pairs(key, least, "a list of >= " + std::to_string(least) + " [x, z] pairs");
    if (!points) return std::nullopt;
    line.points = std::move(*points);
    if (line.bezier && line.points.size() % 3 != (closed ? 0U : 1U)) {
        in.bad(key, closed ? "a closed line of cubic curves has 3 points a curve (its start and two handles)"
                           : "cubic curves have 3 points each (two handles and the end) after the first point");
        return std::nullopt;
    }
    if (without_length(line.points)) {
        in.bad(key, "must have a length");
        return std::nullopt;
    }
    return line;
}

std::optional<DrawnLine> read_along(TableReader& text) {
    auto in = text.table("along");
    if (!in) return std::nullopt;
    std::optional<DrawnLine> line;
    if (in->has("arc_deg")) {
        constexpr std::string_view kOther[] = {"polyline", "bezier", "closed"};
        in->misplaced(kOther, "stands beside arc_deg; must be one of the two");
        const auto arc_deg = in->number("arc_deg", {-360.0, 360.0});
        if (arc_deg && std::abs(*arc_deg) < 1.0) in->bad("arc_deg", "must be at least 1 degree, up or (negative) down");
        if (arc_deg && std::abs(*arc_deg) >= 1.0) line = arc(radians(*arc_deg));
    } else {
        const bool closed = in->flag("closed").value_or(false);
        in->know({"arc_deg"});
        line = read_drawn_line(*in, closed);
    }
    in->finish();
    return line;
}

}  // namespace aerogram::planner
