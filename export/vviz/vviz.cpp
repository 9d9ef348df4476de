#include "export/vviz/vviz.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "export/bytes/decimal.hpp"
#include "export/bytes/file_writer.hpp"
#include "export/outgoing/facts_json.hpp"
#include "export/outgoing/polyline.hpp"
#include "export/vviz/light_samples.hpp"
#include "export/vviz/vviz_frame.hpp"
#include "export/vviz/vviz_reader.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr const char* kFile = "show.vviz";
constexpr double kLargestFile = 4e9;
constexpr double kHalfMillimetre_m = 0.0005;
constexpr std::size_t kBlock = 256;  ///< drones whose text is held at once

/// units / 1000, without idle zeros: "0", "-0.25", "12.007".
void append_thousandths(std::string& out, std::int64_t units) {
    append_units(out, units, 3);
    while (out.back() == '0') out.pop_back();
    if (out.back() == '.') out.pop_back();
}

struct Millimetres {
    std::int64_t x = 0, y = 0, z = 0;
    bool operator==(const Millimetres&) const = default;
};
Millimetres rounded(const Vec3& p) {
    return {in_units(p.x, 3), in_units(p.y, 3), in_units(p.z, 3)};
}

/// What all drones of a file share.
struct Layout {
    VvizFit fit;
    std::vector<Millis> times_ms;
    planner::VvizFlavour flavour = planner::VvizFlavour::verge;
};

void append_traversal(std::string& out, std::span<const Corner> corners, const Layout& layout) {
    Millimetres at = rounded(to_vviz(corners[0].place_m, layout.flavour));
    for (std::size_t k = 1; k < corners.size(); ++k) {
        const Millimetres to = rounded(to_vviz(corners[k].place_m, layout.flavour));
        const Millis dt_ms = corners[k].time_ms - corners[k - 1].time_ms;
        out += k == 1 ? "{\"dx\":" : ",{\"dx\":";
        append_thousandths(out, to.x - at.x);
        out += ",\"dy\":";
        append_thousandths(out, to.y - at.y);
        out += ",\"dz\":";
        append_thousandths(out, to.z - at.z);
        if (dt_ms != layout.fit.step_ms) {
            out += ",\"dt\":";
            append_thousandths(out, dt_ms);
        }
        out += '}';
        at = to;
    }
}

void append_lights(std::string& out, std::span<const LightKey> keys) {
    std::int64_t before = -1;
    for (const LightSample& sample : light_samples(keys, kVvizFrame_ms)) {
        out += before < 0 ? "{\"r\":" : ",{\"r\":";
        append_units(out, sample.color.r, 0);
        out += ",\"g\":";
        append_units(out, sample.color.g, 0);
        out += ",\"b\":";
        append_units(out, sample.color.b, 0);
        if (before >= 0 && sample.frame - before != 1) {
            out += ",\"frames\":";
            append_units(out, sample.frame - before, 0);
        }
        out += '}';
        before = sample.frame;
    }
}

/// The first step stays one sample long: a program that counts time from the first sample is late by no more.
std::vector<Corner> corners_of(const OutgoingShow& show, std::size_t drone, const Layout& layout) {
    const std::vector<Corner> all = sampled(show.flight(drone), layout.times_ms);
    std::vector<Corner> corners{all.front()};
    const std::vector<Corner> rest = thinned(std::span(all).subspan(1), layout.fit.tolerance_m);
    corners.insert(corners.end(), rest.begin(), rest.end());
    return corners;
}

/// A place that the drone's own path does not tell.
void append_place(std::string& out, std::string_view key, const Millimetres& place, const Millimetres& told) {
    if (place == told) return;
    out.append(",\"").append(key).append("\":[");
    append_thousandths(out, place.x);
    out += ',';
    append_thousandths(out, place.y);
    out += ',';
    append_thousandths(out, place.z);
    out += ']';
}

void append_performance(std::string& out, const OutgoingShow& show, std::size_t drone, const Layout& layout) {
    const std::vector<Corner> corners = corners_of(show, drone, layout);
    const Tracks& tracks = show.tracks(drone);
    const OutgoingDrone& facts = show.facts().drones[drone];
    const auto place = [&](const Vec3& p) { return rounded(to_vviz(p, layout.flavour)); };
    const Millimetres start = place(corners.front().place_m);
    out += "{\"id\":";
    append_units(out, static_cast<std::int64_t>(drone), 0);
    out += ",\"name\":" + json_text(facts.name);
    append_place(out, "home", place(facts.home_m), start);
    append_place(out, "land", place(facts.land_m), place(corners.back().place_m));
    out += ",\"agentDescription\":{\"homeX\":";
    append_thousandths(out, start.x);
    out += ",\"homeY\":";
    append_thousandths(out, start.y);
    out += ",\"homeZ\":";
    append_thousandths(out, start.z);
    out += ",\"homeH\":";
    append_thousandths(out, in_units(-degrees(yaw_at(tracks.yaw, 0.0)), 3));
    out += ",\"airframe\":\"generic\",\"agentTraversal\":[";
    append_traversal(out, corners, layout);
    out += "]},\"payloadDescription\":[{\"id\":0,\"type\":\"Light\",\"payloadActions\":[";
    append_lights(out, tracks.lights);
    out += "]}]}";
}

/// The place of 0, 0, 0 on the map; left out where its height above the sea is not known.
std::string reference_frame(const OutgoingFacts& facts) {
    if (!facts.origin || !facts.origin->geoid_undulation_m) return {};
    const geo::Geodetic& ground = facts.origin->ground;
    std::string text = "\"globalReferenceFrame\":{\"lat\":";
    append_fixed(text, ground.latitude_deg, 8);
    text += ",\"lon\":";
    append_fixed(text, ground.longitude_deg, 8);
    text += ",\"alt\":";
    append_fixed(text, ground.height_m - *facts.origin->geoid_undulation_m, 3);
    return text + "},\n";
}

std::string beginning(const OutgoingFacts& facts, const Seal& seal, const Layout& layout) {
    std::string text = "{\"version\":\"1.0\",\n\"performanceName\":";
    text += json_text((seal.certified ? "" : "UNCERTIFIED ") + facts.title);
    text += ",\n\"coordinateFrame\":\"ogl\",\n" + reference_frame(facts) + "\"defaultPositionRate\":";
    append_thousandths(text, 1'000'000 / layout.fit.step_ms);
    text += ",\n\"defaultColorRate\":";
    append_thousandths(text, 1'000'000 / kVvizFrame_ms);
    text += ",\n\"timeOffsetSecs\":0,\n\"aerogram\":{\"flavour\":";
    text += layout.flavour == planner::VvizFlavour::verge ? "\"verge\"" : "\"finale\"";
    return text + ",\"facts\":" + facts_json(facts, seal) + "},\n\"performances\":[\n";
}

std::optional<Layout> layout_of(const OutgoingFacts& facts) {
    const auto fit = vviz_fit(facts);
    if (!fit) return std::nullopt;
    return Layout{*fit, sampling_times(facts.duration_ms, fit->step_ms), facts.exporting.vviz};
}

std::string unsuited(const OutgoingShow& show) {
    const auto layout = layout_of(show.facts());
    if (!layout)
        return "export_margin_m leaves no room for millimetres and straight lines between samples; 0.01 would do for "
               "most shows";
    const std::size_t probes = std::min<std::size_t>(show.drones(), 8);
    std::string text;
    for (std::size_t k = 0; k < probes; ++k) append_performance(text, show, k * show.drones() / probes, *layout);
    const double bytes =
        static_cast<double>(text.size()) / static_cast<double>(probes) * static_cast<double>(show.drones());
    if (bytes <= kLargestFile) return {};
    return "about " + std::to_string(std::llround(bytes / 1e9)) + " GB of text; 4 GB is the most we write";
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    if (std::string why = unsuited(show); !why.empty()) return Error{ErrorCode::invalid_input, "vviz: " + why};
    const Layout layout = *layout_of(show.facts());
    auto file = FileWriter::create(folder / kFile);
    if (!file) return file.error();
    if (const Status put = file->append(beginning(show.facts(), seal, layout)); !put) return put.error();
    Run quiet = run;
    quiet.progress = nullptr;
    std::vector<std::string> texts(std::min(show.drones(), kBlock));
    for (std::size_t from = 0; from < show.drones(); from += kBlock) {
        const std::size_t count = std::min(kBlock, show.drones() - from);
        parallel_for(count, quiet, "", [&](std::size_t k) {
            texts[k].clear();
            append_performance(texts[k], show, from + k, layout);
            texts[k] += from + k + 1 < show.drones() ? ",\n" : "\n";
        });
        if (run.stopped()) return stopped_error();
        for (std::size_t k = 0; k < count; ++k)
            if (const Status put = file->append(texts[k]); !put) return put.error();
        run.report("vviz", static_cast<double>(from + count) / static_cast<double>(show.drones()));
    }
    if (const Status put = file->append("]}\n"); !put) return put.error();
    if (const Status closed = file->close(); !closed) return closed.error();
    return std::vector<std::string>{kFile};
}

bool recognises(std::string_view path, std::string_view first_bytes) {
    return path.ends_with(".vviz") || (first_bytes.find("\"defaultPositionRate\"") != std::string_view::npos &&
                                       first_bytes.find_first_not_of(" \t\r\n") == first_bytes.find('{'));
}

constexpr Format kVviz{
    "vviz",     "VVIZ for Verge Aero, Finale 3D, Depence and FWsim: JSON of steps and colours",
    "linear",   "yaw but the first heading, payload events; a colour that jumps fades in the 20 ms before",
    write,      read_vviz,
    recognises, unsuited};

}  // namespace

std::optional<VvizFit> vviz_fit(const OutgoingFacts& facts) {
    constexpr std::array<Millis, 9> kSteps{250, 200, 125, 100, 50, 40, 25, 20, 10};
    const double pair_m = std::min(facts.limits.export_margin_m, kVvizPairCost_m);
    const double each_m = pair_m / 2.0 - std::sqrt(3.0) * kHalfMillimetre_m;
    const auto step_ms = sampling_step_ms(facts.acceleration_mps2, each_m / 5.0, kSteps);
    if (!step_ms || each_m <= 0.0) return std::nullopt;
    const double dt_s = seconds_from_ms(*step_ms);
    return VvizFit{*step_ms, each_m - facts.acceleration_mps2 * dt_s * dt_s / 8.0};
}

const Format& vviz_format() {
    return kVviz;
}

}  // namespace aerogram::exporter
