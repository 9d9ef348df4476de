#include <cmath>

#include "geo/units.hpp"
#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

enum class Kind { cylinder, box, prism };

constexpr const char* kPolygonForm =
    "must be a list of >= 3 [latitude, longitude] pairs in degrees, latitude from -90 to 90, longitude from -180 to "
    "180";

// A polygon of latitudes and longitudes in the show frame. @param name  e.g. "airspace.audience[1]".
geo::Polygon read_polygon(const TomlValue& value, const std::string& name, const geo::ShowFrame& frame,
                          Problems& problems) {
    const std::vector<Vec2> corners_deg = pairs_of(value, 90.0, 180.0);
    if (corners_deg.size() < 3) {
        problems.add(value.line, name + " = " + shown(value) + ": " + kPolygonForm);
        return {};
    }
    geo::Polygon polygon;
    for (const Vec2& corner : corners_deg) {
        const Vec3 p = frame.to_show({corner.x, corner.y, frame.origin().ground.height_m});
        polygon.emplace_back(p.x, p.y);
    }
    if (geo::is_simple(polygon)) return polygon;
    problems.add(value.line, name + " = " + shown(value) + ": must be a simple polygon: edges must not cross or touch");
    return {};
}

geo::Polygon box_of(const Vec2& center_m, const Vec2& size_m, double rotate_deg) {
    const double c = std::cos(radians(rotate_deg));
    const double s = std::sin(radians(rotate_deg));
    geo::Polygon corners;
    for (const Vec2& sign : {Vec2(-0.5, -0.5), Vec2(0.5, -0.5), Vec2(0.5, 0.5), Vec2(-0.5, 0.5)}) {
        const Vec2 d(sign.x * size_m.x, sign.y * size_m.y);
        corners.emplace_back(center_m.x + c * d.x - s * d.y, center_m.y + s * d.x + c * d.y);
    }
    return corners;
}

std::optional<geo::Cylinder> read_cylinder(TableReader& in) {
    in.need("center_m", "write center_m = [x, y]");
    in.need("radius_m", "write radius_m = 4");
    const auto center_m = in.vec2("center_m");
    const auto radius_m = in.number("radius_m", more_than(0.0));
    if (!center_m || !radius_m) return std::nullopt;
    return geo::Cylinder{*center_m, *radius_m};
}

std::optional<geo::Prism> read_box(TableReader& in) {
    in.need("center_m", "write center_m = [x, y]");
    in.need("size_m", "write size_m = [width, depth]");
    const auto center_m = in.vec2("center_m");
    const auto size_m = in.numbers("size_m", 2, 2, "two numbers > 0: [width, depth]", more_than(0.0));
    const double rotate_deg = in.number("rotate_deg", {-360.0, 360.0}).value_or(0.0);
    if (!center_m || !size_m) return std::nullopt;
    return geo::Prism{box_of(*center_m, {(*size_m)[0], (*size_m)[1]}, rotate_deg)};
}

std::optional<geo::Prism> read_prism(TableReader& in) {
    if (!in.need("outline_m", "write outline_m = [[x, y], [x, y], [x, y]]")) return std::nullopt;
    geo::Prism prism{pairs_of(*in.find("outline_m"), 1e6, 1e6)};
    if (prism.outline_m.size() < 3) {
        in.bad("outline_m", "must be a list of >= 3 [x, y] pairs in metres");
        return std::nullopt;
    }
    if (geo::is_simple(prism.outline_m)) return prism;
    in.bad("outline_m", "must be a simple polygon: edges must not cross or touch");
    return std::nullopt;
}

std::optional<geo::Obstacle> read_obstacle(TableReader& in) {
    geo::Obstacle out;
    out.name = in.name("name").value_or(in.path());
    in.need("kind", "write kind = \"cylinder\", \"box\" or \"prism\"");
    in.need("height_m", "write height_m = 25");
    const auto kind =
        in.choice<Kind>("kind", {{"cylinder", Kind::cylinder}, {"box", Kind::box}, {"prism", Kind::prism}});
    const auto height_m = in.number("height_m", more_than(0.0, 10000.0));
    out.base_m = in.number("base_m", {-10000.0, 10000.0}).value_or(0.0);
    out.height_m = height_m.value_or(0.0);
    bool shaped = false;
    if (kind == Kind::cylinder) {
        if (const auto cylinder = read_cylinder(in)) shaped = (out.shape = *cylinder, true);
    } else if (kind) {
        if (auto prism = kind == Kind::box ? read_box(in) : read_prism(in))
            shaped = (out.shape = std::move(*prism), true);
    } else {
        in.know({"center_m", "radius_m", "size_m", "rotate_deg", "outline_m"});
    }
    in.finish();
    return shaped && height_m ? std::optional(out) : std::nullopt;
}

// Pads must be where drones may be.
void check_pads(const Mission& mission, TableReader& airspace) {
    const Points& pads_m = mission.fleet.pads_m;
    const auto pad = [&](std::size_t i) {
        return "pad " + std::to_string(i + 1) + " at [" + shown(std::round(pads_m[i].x * 100.0) / 100.0) + ", " +
               shown(std::round(pads_m[i].y * 100.0) / 100.0) + "] m ";
    };
    const auto first = [&](const auto& wrong, const std::string& key, int line, const std::string& what) {
        for (std::size_t i = 0; i < pads_m.size(); ++i) {
            if (!wrong(pads_m[i])) continue;
            airspace.problems().add(line, key + ": " + pad(i) + what);
            return;
        }
    };
    const geo::Airspace& a = mission.airspace;
    if (!a.geofence_m.empty()) {
        first(
            [&](const Vec3& p) {
                return geo::signed_distance(a.geofence_m, {p.x, p.y}) <= 0.0;
            },
            "airspace.geofence", airspace.line_of("geofence"), "stands outside the fence: must be inside");
    }
    for (const geo::Polygon& area : a.audience_m) {
        first(
            [&](const Vec3& p) {
                return geo::signed_distance(area, {p.x, p.y}) >= 0.0;
            },
            "airspace.audience", airspace.line_of("audience"), "stands in an audience area: must be outside");
    }
    for (const geo::Obstacle& obstacle : a.obstacles) {
        first([&](const Vec3& p) { return geo::clearance(obstacle, p) <= 0.0; }, "airspace.obstacle",
              airspace.line_of("obstacle"), "stands in " + obstacle.name + ": must be outside");
    }
}

}  // namespace

void read_airspace(TableReader& root, Mission& mission) {
    auto airspace = root.table("airspace");
    if (!airspace) return;
    const geo::ShowFrame frame(mission.origin);
    if (const TomlValue* fence = airspace->find("geofence")) {
        mission.airspace.geofence_m = read_polygon(*fence, "airspace.geofence", frame, root.problems());
    }
    if (const TomlValue* audience = airspace->find("audience")) {
        if (const auto* areas = std::get_if<TomlArray>(&audience->data)) {
            for (std::size_t i = 0; i < areas->size(); ++i) {
                const std::string name = "airspace.audience[" + std::to_string(i + 1) + "]";
                auto polygon = read_polygon((*areas)[i], name, frame, root.problems());
                if (!polygon.empty()) mission.airspace.audience_m.push_back(std::move(polygon));
            }
        } else {
            airspace->bad("audience", "must be a list of polygons, each a list of [latitude, longitude] pairs");
        }
    }
    for (TableReader& entry : airspace->tables("obstacle")) {
        const double weight = entry.number("weight", at_least(0.0, 1e6)).value_or(0.0);
        if (auto obstacle = read_obstacle(entry)) {
            mission.airspace.obstacles.push_back(std::move(*obstacle));
            mission.obstacle_weights.push_back(weight);
        }
    }
    check_pads(mission, *airspace);
    airspace->finish();
}

}  // namespace aerogram::planner
