#include "export/bytes/json_document.hpp"
#include "export/waypoint/mission_items.hpp"
#include "export/waypoint/mission_reading.hpp"
#include "export/waypoint/plan_rules.hpp"
#include "export/waypoint/qgc_plan.hpp"

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
