#include "export/scene/glb.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "export/bytes/descriptor.hpp"
#include "export/bytes/little_endian.hpp"
#include "export/outgoing/curve_fit.hpp"
#include "export/scene/glb_document.hpp"
#include "export/scene/glb_track.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr const char* kFile = "show.glb";
constexpr double kDocumentBytesADrone = 600.0, kYawKeyBytes = 30.0, kEventBytes = 20.0;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;

std::string misfit(const OutgoingShow& show, std::size_t drone, const FitError& error) {
    const FitError bound = fit_bound(show.facts().limits);
    if (error.within(bound)) return {};
    std::ostringstream text;
    text.precision(3);
    text << show.facts().drones[drone].name << ": pieces of " << kShortestPieceMs << " ms miss the flight by "
         << error.position_m << " m, " << error.speed_mps << " m/s, " << error.acceleration_mps2 << " m/s²; within "
         << bound.position_m << " m, " << bound.speed_mps << " m/s, " << bound.acceleration_mps2 << " m/s² would do";
    return text.str();
}

std::string unsuited(const OutgoingShow& show) {
    if (fit_bound(show.facts().limits).position_m <= 0.0)
        return "export_margin_m leaves no room for refitted curves; 0.01 would do";
    double bytes = 0.0;
    for (std::size_t i = 0; i < show.drones(); ++i) {
        const Fitted fitted = show.fitted(i);
        if (std::string why = misfit(show, i, fitted.error); !why.empty()) return why;
        const Tracks& tracks = show.tracks(i);
        bytes += kDocumentBytesADrone +
                 static_cast<double>((fitted.pieces.size() + 1) * (kGlbKeyBytes + sizeof(float)) +
                                     tracks.lights.size() * kGlbLightBytes) +
                 kYawKeyBytes * static_cast<double>(tracks.yaw.size()) +
                 kEventBytes * static_cast<double>(tracks.events.size());
    }
    if (bytes <= static_cast<double>(kLargestGlb)) return {};
    return "about " + std::to_string(std::llround(bytes / 1e8) / 10) +
           " GB; 1 GiB is the most that scene programs open";
}

int brightness(const Rgb8& color) {
    return std::max({color.r, color.g, color.b});
}

/// The first light that is at least half as bright as the brightest: shows often begin with a faint glow.
Rgb8 first_color(const std::vector<LightKey>& keys) {
    int brightest = 0;
    for (const LightKey& key : keys) brightest = std::max(brightest, brightness(quantised(key.color)));
    for (const LightKey& key : keys)
        if (const Rgb8 color = quantised(key.color); 2 * brightness(color) >= std::max(brightest, 1)) return color;
    return {};
}

/// The two parts of the file that the keys are in, and where everything stands in them.
struct Keys {
    GlbLayout layout;
    std::string times;
    std::vector<std::string> values;
};

Result<Keys> keys_of(const OutgoingShow& show, const Run& run) {
    std::vector<GlbTrack> tracks(show.drones());
    std::vector<std::string> misfits(show.drones());
    parallel_for(show.drones(), run, "glb", [&](std::size_t i) {
        const Fitted fitted = show.fitted(i);
        misfits[i] = misfit(show, i, fitted.error);
        tracks[i] = glb_track(fitted);
    });
    if (run.stopped()) return stopped_error();
    for (const std::string& why : misfits)
        if (!why.empty()) return Error{ErrorCode::infeasible, "glb: " + why};
    Keys keys;
    GlbLayout& layout = keys.layout;
    std::map<std::vector<Millis>, std::size_t> known;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        const auto [found, fresh] = known.try_emplace(std::move(tracks[i].times_ms), layout.times.size());
        if (fresh) {
            layout.times.push_back({keys.times.size(), static_cast<std::uint32_t>(found->first.size())});
            for (const Millis t_ms : found->first) put(keys.times, static_cast<float>(seconds_from_ms(t_ms)));
            layout.times.back().first_s = static_cast<float>(seconds_from_ms(found->first.front()));
            layout.times.back().last_s = static_cast<float>(seconds_from_ms(found->first.back()));
        }
        const std::vector<LightKey>& lights = show.tracks(i).lights;
        layout.drones.push_back({found->second, layout.values_bytes,
                                 static_cast<std::uint32_t>(layout.lights_bytes / kGlbLightBytes),
                                 static_cast<std::uint32_t>(lights.size()), first_color(lights)});
        keys.values.push_back(std::move(tracks[i].values));
        layout.values_bytes += keys.values.back().size();
        layout.lights_bytes += lights.size() * kGlbLightBytes;
    }
    layout.times_bytes = keys.times.size();
    return keys;
}

std::string chunk_head(std::uint64_t bytes, std::uint32_t kind) {
    std::string head;
    put(head, static_cast<std::uint32_t>(bytes));
    put(head, kind);
    return head;
}

Status write_glb(const OutgoingShow& show, const Seal& seal, const Keys& keys, const std::filesystem::path& path) {
    std::string document = glb_document(show, seal, keys.layout);
    document.append((4 - document.size() % 4) % 4, ' ');
    const std::string shape = glb_shape();
    const std::uint64_t bin =
        shape.size() + keys.layout.times_bytes + keys.layout.values_bytes + keys.layout.lights_bytes;
    const std::uint64_t total = 12 + 8 + document.size() + 8 + bin;
    if (total > 0xFFFFFFFFU) return Error{ErrorCode::invalid_input, "glb: more than 4 GB"};
    std::error_code ignored;
    std::filesystem::create_directories(path.parent_path(), ignored);
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    std::string head = "glTF";
    put(head, std::uint32_t{2});
    put(head, static_cast<std::uint32_t>(total));
    file << head << chunk_head(document.size(), kJsonChunk) << document << chunk_head(bin, kBinChunk) << shape
         << keys.times;
    for (const std::string& values : keys.values) file << values;
    std::string lights;
    for (std::size_t i = 0; i < show.drones(); ++i) {
        lights.clear();
        append_glb_lights(lights, show.tracks(i).lights);
        file << lights;
    }
    file.close();
    if (!file) return io_error(path, "cannot write");
    return Done{};
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    const Result<Keys> keys = keys_of(show, run);
    if (!keys) return keys.error();
    if (const Status written = write_glb(show, seal, *keys, folder / kFile); !written) return written.error();
    return std::vector<std::string>{kFile};
}

bool recognises(std::string_view, std::string_view first_bytes) {
    return first_bytes.starts_with("glTF");
}

constexpr Format kGlb{
    "glb",      "glTF 2.0 scene for Blender and engines: an animated node a drone",
    "exact",    "audio; scene programs show each drone in its first colour only, and no yaw or events",
    write,      read_glb,
    recognises, unsuited};

}  // namespace

const Format& glb_format() {
    return kGlb;
}

}  // namespace aerogram::exporter
