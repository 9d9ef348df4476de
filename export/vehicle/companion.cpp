#include "export/vehicle/companion.hpp"

#include <algorithm>
#include <charconv>
#include <tuple>

#include "export/bytes/json_document.hpp"
#include "export/outgoing/facts_json.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kFarthest_m = 1e8;
constexpr std::int64_t kLongest_ms = 604'800'000, kMostChannel = 1'000'000;

/// Shortest digits that give the same number back.
void append(std::string& out, double value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof(digits), value).ptr;
    out.append(digits, end);
}

void append(std::string& out, std::string_view key, const Vec3& p) {
    out += ",\"";
    out += key;
    out += "\":[";
    append(out, p.x);
    out += ',';
    append(out, p.y);
    out += ',';
    append(out, p.z);
    out += ']';
}

void append(std::string& out, const std::vector<PayloadEvent>& events) {
    if (events.empty()) return;
    out += ",\"events_ms_channel_on\":[";
    for (const PayloadEvent& event : events) {
        if (&event != &events.front()) out += ',';
        out += '[' + std::to_string(event.time_ms) + ',' + std::to_string(event.channel) +
               (event.on ? ",true]" : ",false]");
    }
    out += ']';
}

std::string beginning(std::string_view format) {
    return "{\"format\":\"" + std::string(format) + '"';
}

void read_events(const JsonNode& list, std::vector<PayloadEvent>& events) {
    for (std::size_t k = 0; k < list.size() && !list.problem().found(); ++k) {
        const JsonNode event = list.at(k);
        events.push_back({event.at(0).whole(0, kLongest_ms),
                          static_cast<int>(event.at(1).whole(-kMostChannel, kMostChannel)), event.at(2).flag()});
        if (k > 0 && events[k].time_ms < events[k - 1].time_ms) event.fail("times must not fall");
    }
}

/// The whole number a name ends in, before its ending; names without one come last.
std::uint64_t number_in(const std::string& path) {
    const std::string name = file_name(path);
    const std::size_t stem = std::min(name.rfind('.'), name.size());
    std::size_t first = stem;
    while (first > 0 && name[first - 1] >= '0' && name[first - 1] <= '9') --first;
    std::uint64_t number = UINT64_MAX;
    if (first < stem) std::from_chars(name.data() + first, name.data() + stem, number);
    return number;
}

}  // namespace

std::string companion_text(const OutgoingShow& show, const Seal& seal, std::string_view format,
                           const std::function<std::string(std::size_t)>& file_of) {
    std::string text = beginning(format) + ",\n\"show\":" + facts_json(show.facts(), seal) + ",\n\"drones\":[";
    for (std::size_t i = 0; i < show.drones(); ++i) {
        const OutgoingDrone& drone = show.facts().drones[i];
        text += i > 0 ? ",\n" : "\n";
        text += "{\"file\":" + json_text(file_of(i)) + ",\"name\":" + json_text(drone.name) +
                ",\"number\":" + std::to_string(drone.number);
        append(text, "home_m", drone.home_m);
        append(text, "land_m", drone.land_m);
        append(text, show.tracks(i).events);
        text += '}';
    }
    return text + "\n]}\n";
}

bool is_companion(std::string_view format, std::string_view first_bytes) {
    return first_bytes.starts_with(beginning(format));
}

Result<Companion> read_companion(const FileBytes& file, std::string_view format) {
    const auto document = JsonDocument::parse(file.path, file.bytes);
    if (!document) return document.error();
    JsonProblem problem;
    const JsonNode root = document->root(problem);
    Companion companion;
    if (root["format"].text() != format) root["format"].fail("must be \"" + std::string(format) + '"');
    read_facts(root["show"], companion.show);
    const JsonNode drones = root["drones"];
    for (std::size_t k = 0; k < drones.size() && !problem.found(); ++k) {
        const JsonNode node = drones.at(k);
        RecordedDrone drone;
        drone.name = node["name"].text();
        drone.home_m = node["home_m"].point(kFarthest_m);
        drone.land_m = node["land_m"].point(kFarthest_m);
        if (const auto events = node.find("events_ms_channel_on")) read_events(*events, drone.tracks.events);
        if (!companion.drones.emplace(node["file"].text(), std::move(drone)).second)
            node.fail("has the file of another");
    }
    if (problem.found()) return problem.error();
    return companion;
}

std::vector<const FileBytes*> in_order_of_numbers(std::span<const FileBytes> files) {
    std::vector<const FileBytes*> order;
    for (const FileBytes& file : files) order.push_back(&file);
    std::ranges::sort(order, {}, [](const FileBytes* file) { return std::tuple(number_in(file->path), file->path); });
    return order;
}

std::string file_name(const std::string& path) {
    return path.substr(path.rfind('/') + 1);  // npos + 1 is 0
}

}  // namespace aerogram::exporter
