#include "export/maps/czml.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "export/bytes/decimal.hpp"
#include "export/maps/czml_packet.hpp"
#include "export/maps/map_lights.hpp"
#include "export/maps/map_places.hpp"
#include "export/maps/track_corners.hpp"
#include "export/outgoing/facts_json.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr const char* kFile = "show.czml";
constexpr double kCornerBytes = 48.0, kSampleBytes = 20.0, kPacketBytes = 700.0, kLargestText = 5e8;
constexpr std::size_t kBatch = 256;  ///< drones made side by side before they are written

/// "12.5": seconds without idle zeros.
void append_seconds(std::string& out, Millis time_ms) {
    const int digits = time_ms % 1000 == 0 ? 0 : time_ms % 100 == 0 ? 1 : time_ms % 10 == 0 ? 2 : 3;
    for (int k = digits; k < 3; ++k) time_ms /= 10;
    append_units(out, time_ms, digits);
}

void append_array(std::string& out, const Vec3& v) {
    out += "{\"array\":[";
    append_exact(out, v.x);
    for (const double x : {v.y, v.z}) {
        out += ',';
        append_exact(out, x);
    }
    out += "]}";
}

/// "rrggbbaa" as CZML's colour.
std::string color(std::string_view rgba) {
    std::string out = "{\"rgba\":[";
    for (std::size_t k = 0; k < rgba.size(); k += 2) {
        if (k > 0) out += ',';
        out += std::to_string(std::stoi(std::string(rgba.substr(k, 2)), nullptr, 16));
    }
    return out + "]}";
}

struct Clock {
    std::string epoch, interval;
};
Clock clock_of(const OutgoingFacts& facts) {
    const UtcSeconds start_s = map_start(facts);
    const std::string epoch = utc_text(start_s);
    return {epoch, epoch + "/" + utc_text_ms(start_s * 1000 + facts.duration_ms)};
}

std::string document_packet(const OutgoingFacts& facts, const Seal& seal) {
    const Clock clock = clock_of(facts);
    const std::string title = (seal.certified ? std::string() : std::string(kMapUncertified)) + facts.title;
    return R"({"id":"document","name":)" + json_text(title) + R"(,"version":"1.0","clock":{"interval":")" +
           clock.interval + R"(","currentTime":")" + clock.epoch +
           R"(","multiplier":1,"range":"CLAMPED","step":"SYSTEM_CLOCK_MULTIPLIER"},"properties":{"start_utc":")" +
           clock.epoch + R"(","aerogram":)" + facts_json(facts, seal) + "}}";
}

/// What a click on the show tells; CesiumJS shows descriptions of entities, not of documents.
std::string show_packet(const OutgoingFacts& facts, const Seal& seal, const MapPlaces& places) {
    std::string at;
    places.append(at, Vec3{}, ',');
    const std::string text = std::string(seal.certified ? "Certified" : "NOT CERTIFIED") + " drone show, " +
                             std::to_string(facts.drones.size()) + " drones. Show hash " +
                             (seal.show_hash.empty() ? "none" : seal.show_hash) + ".";
    return R"({"id":"origin","name":)" + json_text("Origin of " + facts.title) + R"(,"description":)" +
           json_text(text) + R"(,"position":{"cartographicDegrees":[)" + at +
           R"(]},"point":{"pixelSize":8,"color":{"rgba":[255,255,255,255]}}})";
}

std::string area_packet(const MapArea& area, std::size_t number, const MapPlaces& places) {
    std::string out = R"({"id":"area-)" + std::to_string(number) + R"(","name":)" + json_text(area.name) +
                      R"(,"properties":{"kind":")" + area.kind +
                      R"("},"polygon":{"positions":{"cartographicDegrees":[)" +
                      places.ring(area.outline_m, area.base_m, ",", false) + "]}";
    const Vec3 middle{area.outline_m.front().x, area.outline_m.front().y, 0.0};
    out += ",\"height\":";
    append_fixed(out, places.height_m(middle + Vec3(0.0, 0.0, area.base_m)), 3);
    if (area.top_m != area.base_m) {
        out += ",\"extrudedHeight\":";
        append_fixed(out, places.height_m(middle + Vec3(0.0, 0.0, area.top_m)), 3);
    }
    return out + R"(,"material":{"solidColor":{"color":)" + color(area.fill) + R"(}},"outline":true,"outlineColor":)" +
           color(area.stroke) + "}}";
}

void append_drone(std::string& out, const OutgoingShow& show, std::size_t i, const MapCut& cut, const MapPlaces& places,
                  const Clock& clock) {
    const OutgoingDrone& drone = show.facts().drones[i];
    const std::string name = json_text(drone.name);
    out += "{\"id\":" + name + ",\"name\":" + name + ",\"properties\":{\"number\":" + std::to_string(drone.number) +
           ",\"home_m\":";
    append_array(out, drone.home_m);
    out += ",\"land_m\":";
    append_array(out, drone.land_m);
    out +=
        "},\"position\":{\"epoch\":\"" + clock.epoch + "\"," + std::string(kCzmlLinear) + ",\"cartographicDegrees\":[";
    for (const Corner& corner : track_corners(show, i, cut)) {
        if (out.back() != '[') out += ',';
        append_seconds(out, corner.time_ms);
        out += ',';
        places.append(out, corner.place_m, ',');
    }
    out +=
        R"(]},"point":{"pixelSize":5,"outlineWidth":1,"outlineColor":{"rgba":[128,128,128,255]},"color":{"epoch":")" +
        clock.epoch + "\"," + std::string(kCzmlLinear) + ",\"rgba\":[";
    for (const ColorSample& sample : color_samples(show.tracks(i).lights)) {
        if (out.back() != '[') out += ',';
        append_seconds(out, sample.time_ms);
        for (const std::uint8_t byte : {sample.color.r, sample.color.g, sample.color.b}) {
            out += ',';
            append_units(out, byte, 0);
        }
        out += ",255";
    }
    out += "]}}}";
}

std::string unsuited(const OutgoingShow& show) {
    const OutgoingFacts& facts = show.facts();
    if (!facts.origin) return "the show has no origin on the globe";
    const auto cut = map_cut(facts);
    if (!cut) return "export_margin_m leaves no room for straight lines and millimetres; 0.01 would do for most shows";
    double bytes = estimated_corners(show, *cut) * kCornerBytes;
    for (std::size_t i = 0; i < show.drones(); ++i)
        bytes += kPacketBytes + 1.5 * kSampleBytes * static_cast<double>(show.tracks(i).lights.size());
    if (bytes <= kLargestText) return {};
    return "about " + std::to_string(std::llround(bytes / 1e6)) + " MB of text; browsers hold 500 MB at most";
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    if (std::string why = unsuited(show); !why.empty()) return Error{ErrorCode::invalid_input, "czml: " + why};
    const OutgoingFacts& facts = show.facts();
    const MapCut cut = *map_cut(facts);
    const MapPlaces places(*facts.origin, 0.0);
    const Clock clock = clock_of(facts);
    std::ofstream out(folder / kFile, std::ios::binary);
    out << "[\n" << document_packet(facts, seal) << ",\n" << show_packet(facts, seal, places);
    std::size_t number = 0;
    for (const MapArea& area : map_areas(facts, flight_volumes(show, run)))
        out << ",\n" << area_packet(area, ++number, places);
    std::vector<std::string> texts(kBatch);
    for (std::size_t first = 0; first < show.drones() && !run.stopped(); first += kBatch) {
        const std::size_t count = std::min(kBatch, show.drones() - first);
        run.report("czml", static_cast<double>(first) / static_cast<double>(show.drones()));
        parallel_for(count, run, {}, [&](std::size_t k) {
            texts[k] = ",\n";
            append_drone(texts[k], show, first + k, cut, places, clock);
        });
        for (std::size_t k = 0; k < count; ++k) out << texts[k];
    }
    out << "\n]\n";
    out.close();
    if (run.stopped()) return stopped_error();
    if (!out) return Error{ErrorCode::io, (folder / kFile).string() + ": cannot be written"};
    return std::vector<std::string>{kFile};
}

bool recognises(std::string_view path, std::string_view first_bytes) {
    if (path.ends_with(".czml")) return true;
    const std::string_view beginning = first_bytes.substr(0, 400);
    return beginning.starts_with('[') && beginning.find("\"document\"") != std::string_view::npos &&
           beginning.find("\"version\"") != std::string_view::npos;
}

constexpr Format kCzml{"czml",     "CZML for CesiumJS: tracks, lights, flight volumes and airspace on a globe",
                       "linear",   "yaw, payload events; lights are 8-bit display colours",
                       write,      read_czml,
                       recognises, unsuited};

}  // namespace

const Format& czml_format() {
    return kCzml;
}

}  // namespace aerogram::exporter
