#include <algorithm>
#include <cmath>

#include "export/bytes/json_document.hpp"
#include "export/waypoint/mission_items.hpp"
#include "export/waypoint/mission_reading.hpp"
#include "export/waypoint/plan_rules.hpp"
#include "export/waypoint/qgc_plan.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kAny = 1e9;
constexpr double kHighest_m = 100'000.0;
constexpr std::size_t kMostItems = 65'536;

std::string stem(std::string_view path) {
    path = path.substr(path.rfind('/') == std::string_view::npos ? 0 : path.rfind('/') + 1);
    return std::string(path.substr(0, path.rfind('.') == 0 ? path.npos : path.rfind('.')));
}

MissionItem read_item(const JsonNode& node) {
    MissionItem item;
    item.frame = static_cast<int>(node["frame"].whole(0, 255));
    item.command = static_cast<int>(node["command"].whole(0, 65'535));
    static_cast<void>(node["autoContinue"].flag());
    const JsonNode params = node["params"];
    if (params.size() != item.params.size()) {
        params.fail("must be exactly 7 numbers or nulls");
        return item;
    }
    for (std::size_t k = 0; k < item.params.size(); ++k)
        if (const JsonNode param = params.at(k); !param.is_null()) item.params[k] = param.number(-kAny, kAny);
    return item;
}

RecordedDrone read_drone(const FileBytes& file, const JsonNode& root) {
    const JsonProblem& problem = root.problem();
    const JsonNode mission = root["mission"], home = mission["plannedHomePosition"], items = mission["items"];
    static_cast<void>(mission["firmwareType"].whole(0, 255));
    const double home_amsl_m = home.at(2).number(-kHighest_m, kHighest_m);
    MissionReading reading(geo::Geodetic{home.at(0).number(-90.0, 90.0), home.at(1).number(-180.0, 180.0), 0.0},
                           home_amsl_m);
    if (items.size() > kMostItems) items.fail("must be at most " + std::to_string(kMostItems) + " items");
    for (std::size_t k = 0; k < items.size() && !problem.found(); ++k) {
        const JsonNode node = items.at(k);
        if (node["type"].text() != "SimpleItem") node["type"].fail("must be \"SimpleItem\"; others are not read");
        const MissionItem item = read_item(node);
        if (problem.found()) break;
        if (const Status taken = reading.take(item); !taken) node.fail(taken.error().message);
    }
    RecordedDrone drone = reading.drone();
    drone.name = stem(file.path);
    if (drone.waypoints.empty()) items.fail("needs at least one place to fly to");
    return drone;
}

constexpr std::size_t kMostOutlines = 1000, kMostCorners = 10'000, kCircleCorners = 64;

geo::Geodetic read_corner(const JsonNode& node) {
    return {node.at(0).number(-90.0, 90.0), node.at(1).number(-180.0, 180.0), 0.0};
}

GeodeticFence::Outline read_outline(const JsonNode& node) {
    GeodeticFence::Outline outline;
    if (node.size() < 3 || node.size() > kMostCorners)
        node.fail("must be 3 to " + std::to_string(kMostCorners) + " corners");
    for (std::size_t k = 0; k < node.size() && !node.problem().found(); ++k) outline.push_back(read_corner(node.at(k)));
    return outline;
}

/// A circle by corners on it, or, where nobody may enter it, by sides outside it.
GeodeticFence::Outline read_circle(const JsonNode& node, bool inclusion) {
    const geo::ShowFrame frame(geo::ShowOrigin{read_corner(node["center"]), 0.0, {}});
    const double half_turn = kPi / static_cast<double>(kCircleCorners);
    const double radius_m = node["radius"].number(1e-3, 1e6) / (inclusion ? 1.0 : std::cos(half_turn));
    GeodeticFence::Outline outline;
    for (std::size_t k = 0; k < kCircleCorners; ++k) {
        const double turn = 2.0 * half_turn * static_cast<double>(k);
        outline.push_back(frame.to_geodetic({radius_m * std::cos(turn), radius_m * std::sin(turn), 0.0}));
    }
    return outline;
}

GeodeticFence read_fence(const JsonNode& node) {
    GeodeticFence fence;
    if (node["version"].whole(0, 1000) != 2)
        node["version"].fail("must be 2: ground stations pass over others in silence");
    const auto read_all = [&](const char* key, const auto& read_one) {
        const auto list = node.find(key);
        if (!list) return;
        if (list->size() > kMostOutlines) list->fail("must be at most " + std::to_string(kMostOutlines));
        for (std::size_t k = 0; k < list->size() && !node.problem().found(); ++k) {
            const bool inclusion = list->at(k)["inclusion"].flag();
            (inclusion ? fence.inside : fence.outside).push_back(read_one(list->at(k), inclusion));
        }
    };
    read_all("polygons", [](const JsonNode& one, bool) { return read_outline(one["polygon"]); });
    read_all("circles", [](const JsonNode& one, bool inclusion) { return read_circle(one["circle"], inclusion); });
    return fence;
}

bool same(const GeodeticFence& a, const GeodeticFence& b) {
    const auto same_places = [](const GeodeticFence::Outline& p, const GeodeticFence::Outline& q) {
        return std::ranges::equal(p, q, [](const geo::Geodetic& x, const geo::Geodetic& y) {
            return x.latitude_deg == y.latitude_deg && x.longitude_deg == y.longitude_deg;
        });
    };
    return std::ranges::equal(a.inside, b.inside, same_places) && std::ranges::equal(a.outside, b.outside, same_places);
}

/// What is ours in the file; every file of one show must say the same.
struct OwnWords {
    std::string title;
    std::optional<std::string> show_hash;
    std::optional<bool> certified;
    std::string timing;
    std::optional<UtcSeconds> start_utc_s;
    bool operator==(const OwnWords&) const = default;
};

/// A plan of ours is held to every rule of the loader as well.
OwnWords read_own(const JsonNode& root) {
    const auto own = root.find("aerogram");
    if (!own) return {};
    check_plan_rules(root);
    OwnWords words;
    words.title = (*own)["title"].text();
    words.show_hash = (*own)["showHash"].text();
    words.certified = (*own)["certified"].flag();
    words.timing = (*own)["timing"].text();
    if (own->has("startUtc")) {
        const JsonNode start = (*own)["startUtc"];
        words.start_utc_s = parse_utc(start.text());
        if (!words.start_utc_s) start.fail(R"(must be a moment such as "2026-12-31T22:00:00Z")");
    }
    return words;
}

}  // namespace

Result<RecordedShow> read_qgc_plan(std::span<const FileBytes> files) {
    if (files.empty()) return Error{ErrorCode::invalid_input, "qgc: needs at least one file"};
    RecordedShow show;
    show.format = "qgc";
    show.timed = false;
    show.rounding = mission_rounding();
    std::optional<OwnWords> words;
    for (const FileBytes& file : files) {
        const auto document = JsonDocument::parse(file.path, file.bytes);
        if (!document) return document.error();
        JsonProblem problem;
        const JsonNode root = document->root(problem);
        if (root["fileType"].text() != "Plan") root["fileType"].fail("must be \"Plan\"");
        static_cast<void>(root["groundStation"].text());
        static_cast<void>(root["version"].whole(1, 1));
        const OwnWords own = read_own(root);
        if (words && own != *words) root["aerogram"].fail("says another show than the file before");
        words = own;
        show.drones.push_back(read_drone(file, root));
        if (const auto node = root.find("geoFence")) {
            GeodeticFence fence = read_fence(*node);
            if (show.fence && !same(*show.fence, fence)) node->fail("is another fence than in the file before");
            show.fence = std::move(fence);
        }
        if (problem.found()) return problem.error();
    }
    show.title = words->title;
    show.show_hash = words->show_hash;
    show.certified = words->certified;
    settle_times(show, words->start_utc_s);
    const std::string found = show.timing.empty() ? "none" : show.timing;
    if (words->show_hash && !words->timing.starts_with(found + ":"))
        return Error{ErrorCode::invalid_input, files[0].path + ": aerogram.timing: is not what the items do: " + found};
    return show;
}

}  // namespace aerogram::exporter
