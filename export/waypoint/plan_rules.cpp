#include "export/waypoint/plan_rules.hpp"

#include <array>
#include <string>

#include "export/waypoint/mission_items.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kAny = 1e9;
constexpr std::size_t kParams = 7, kYaw = 3;

void require(bool holds, const JsonNode& node, int rule, const std::string& what) {
    if (!holds) node.fail("rule " + std::to_string(rule) + ": " + what);
}

/// Kinds of numbers and texts fail as JSON fields do: with place and what is expected.
void expect_numbers(const JsonNode& array, std::size_t count, int rule) {
    require(array.size() == count, array, rule, "must be " + std::to_string(count) + " numbers");
    if (array.problem().found()) return;
    constexpr std::array kLimits{90.0, 180.0, kAny};
    for (std::size_t k = 0; k < count; ++k) static_cast<void>(array.at(k).number(-kLimits[k], kLimits[k]));
}

void check_item(const JsonNode& item, std::size_t place) {
    require(item["type"].text() == "SimpleItem", item["type"], 5, "must be \"SimpleItem\"");
    static_cast<void>(item["frame"].whole(0, 255));
    const std::int64_t command = item["command"].whole(0, 65'535);
    static_cast<void>(item["autoContinue"].flag());
    const JsonNode params = item["params"];
    require(params.size() == kParams, params, 6, "must be exactly 7 numbers or nulls");
    for (std::size_t k = 0; k < kParams && !item.problem().found(); ++k)
        if (const JsonNode param = params.at(k); !param.is_null()) static_cast<void>(param.number(-kAny, kAny));
    const JsonNode id = item["doJumpId"];
    require(id.whole(0, 1'000'000) == static_cast<std::int64_t>(place), id, 7, "must be " + std::to_string(place));
    int altitudes = 0;
    for (const char* key : {"AltitudeMode", "Altitude", "AMSLAltAboveTerrain"}) altitudes += item.has(key) ? 1 : 0;
    require(altitudes == 0 || altitudes == 3, item, 8,
            "AltitudeMode, Altitude and AMSLAltAboveTerrain must all be there, or none");
    if (command == mav::kSpline && !item.problem().found())
        require(!params.at(kYaw).is_null(), params.at(kYaw), 13, "must be a number");
}

void check_mission(const JsonNode& mission) {
    expect_numbers(mission["plannedHomePosition"], 3, 3);
    static_cast<void>(mission["firmwareType"].whole(0, 255));
    static_cast<void>(mission["version"].whole(2, 2));
    static_cast<void>(mission["vehicleType"].whole(0, 255));
    static_cast<void>(mission["cruiseSpeed"].number(0.0, kAny));
    static_cast<void>(mission["hoverSpeed"].number(0.0, kAny));
    const JsonNode items = mission["items"];
    for (std::size_t k = 0; k < items.size() && !mission.problem().found(); ++k) check_item(items.at(k), k + 1);
}

void check_fence(const JsonNode& fence) {
    static_cast<void>(fence["version"].whole(2, 2));
    const JsonNode polygons = fence["polygons"], circles = fence["circles"];
    for (std::size_t k = 0; k < polygons.size() && !fence.problem().found(); ++k) {
        const JsonNode polygon = polygons.at(k), corners = polygon["polygon"];
        static_cast<void>(polygon["version"].whole(1, 1));
        static_cast<void>(polygon["inclusion"].flag());
        require(corners.size() >= 3, corners, 10, "must be at least three corners");
        for (std::size_t c = 0; c < corners.size() && !fence.problem().found(); ++c)
            expect_numbers(corners.at(c), 2, 10);
    }
    for (std::size_t k = 0; k < circles.size() && !fence.problem().found(); ++k) {
        const JsonNode circle = circles.at(k);
        static_cast<void>(circle["version"].whole(1, 1));
        static_cast<void>(circle["inclusion"].flag());
        expect_numbers(circle["circle"]["center"], 2, 11);
        static_cast<void>(circle["circle"]["radius"].number(0.0, kAny));
    }
}

void check_rally(const JsonNode& rally) {
    static_cast<void>(rally["version"].whole(2, 2));
    const JsonNode points = rally["points"];
    for (std::size_t k = 0; k < points.size() && !rally.problem().found(); ++k) expect_numbers(points.at(k), 3, 12);
}

}  // namespace

void check_plan_rules(const JsonNode& root) {
    for (const char* key : {"fileType", "groundStation", "version", "mission", "geoFence", "rallyPoints"})
        require(root.has(key), root, 1, std::string(key) + " is missing");
    require(root["fileType"].text() == "Plan", root["fileType"], 2, "must be \"Plan\"");
    static_cast<void>(root["groundStation"].text());
    static_cast<void>(root["version"].whole(1, 1));
    check_mission(root["mission"]);
    check_fence(root["geoFence"]);
    check_rally(root["rallyPoints"]);
}

}  // namespace aerogram::exporter
