#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "export/bytes/zip.hpp"
#include "export/maps/czml.hpp"
#include "export/maps/kmz.hpp"
#include "export/scene/glb.hpp"
#include "export/skybrush/csv_zip_reader.hpp"
#include "export/skybrush/light_program.hpp"
#include "export/skybrush/skyb.hpp"
#include "export/skybrush/skyb_layout.hpp"
#include "export/skybrush/skyc.hpp"
#include "export/vehicle/crazyflie.hpp"
#include "export/vehicle/px4_csv.hpp"
#include "export/vviz/vviz_reader.hpp"
#include "export/waypoint/qgc_plan.hpp"
#include "export/waypoint/waypoints.hpp"
#include "tests/fuzz/export_targets.hpp"

/// What the fuzz targets of the formats of other programs do with any bytes: they are a sound show, or refused with a
/// message that names the file. Build and corpora as in export_targets.hpp.
namespace aerogram::exporter::fuzz {

using Reader = Result<RecordedShow> (*)(std::span<const FileBytes>);

inline void try_reader(Reader read, const std::string& path, std::string bytes) {
    const auto show = read(std::vector<FileBytes>{{path, std::move(bytes)}});
    if (!read_or_refused(show)) return insist(show.error().message.starts_with(path + ":"));
    insist(!show->drones.empty());
    insist(show->timed ? well_formed(*show).ok() : !show->drones[0].waypoints.empty());
}

/// Compressed bytes are hard to mutate: what does not begin like an archive becomes its only entry.
inline void try_archive(Reader read, const std::string& path, const std::string& entry, std::string_view bytes) {
    if (bytes.starts_with("PK")) return try_reader(read, path, std::string(bytes));
    const auto archive = zip_bytes(std::vector<FileBytes>{{entry, std::string(bytes)}});
    insist(archive.ok());
    try_reader(read, path, *archive);
}

inline void try_skyc(std::string_view bytes) {
    try_archive(read_skyc, "a.skyc", "show.json", bytes);
}
/// Once as it is, once with a checksum that fits.
inline void try_skyb(std::string_view bytes) {
    try_reader(read_skyb, "skyb/a.skyb", std::string(bytes));
    if (bytes.size() < skyb::kCrcAt + skyb::kCrcBytes) return;
    std::string sealed(bytes), crc;
    put(crc, skyb::checksum(bytes));
    try_reader(read_skyb, "skyb/a.skyb", sealed.replace(skyb::kCrcAt, skyb::kCrcBytes, crc));
}
inline void try_csv_zip(std::string_view bytes) {
    try_archive(read_csv_zip, "csv.zip", "a.csv", bytes);
}
inline void try_vviz(std::string_view bytes) {
    try_reader(read_vviz, "a.vviz", std::string(bytes));
}
inline void try_kmz(std::string_view bytes) {
    try_archive(read_kmz, "a.kmz", "doc.kml", bytes);
}
inline void try_czml(std::string_view bytes) {
    try_reader(read_czml, "a.czml", std::string(bytes));
}
/// Once as it is, once with lengths that fit; what does not begin like GLB becomes its JSON, above a few floats.
inline void try_glb(std::string_view bytes) {
    try_reader(read_glb, "a.glb", std::string(bytes));
    std::string file(bytes), word;
    if (!bytes.starts_with("glTF")) {
        file = "glTF";
        put(file, std::uint32_t{2});
        put(file, std::uint32_t{0});
        put(file, static_cast<std::uint32_t>(bytes.size()));
        file += "JSON" + std::string(bytes);
        put(file, std::uint32_t{80});
        file += std::string("BIN\0", 4);
        for (int k = 0; k < 20; ++k) put(file, static_cast<float>(k));
    }
    put(word, static_cast<std::uint32_t>(file.size()));
    if (file.size() >= 12) try_reader(read_glb, "a.glb", file.replace(8, 4, word));
}
/// As a drone's file, and as what stands beside one.
inline void try_vehicle(Reader read, std::string_view bytes, const std::string& sound) {
    try_reader(read, "a.csv", std::string(bytes));
    const auto show = read(std::vector<FileBytes>{{"show.json", std::string(bytes)}, {"a.csv", sound}});
    if (read_or_refused(show)) insist(well_formed(*show).ok());
}
inline void try_px4_csv(std::string_view bytes) {
    try_vehicle(read_px4_csv, bytes, "t,px,py,pz\n0,1,2,-3\n1,2,3,-4\n");
}
inline void try_crazyflie(std::string_view bytes) {
    try_vehicle(read_crazyflie, bytes,
                "duration,x^0\n1,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n");
}
inline void try_qgc_plan(std::string_view bytes) {
    try_reader(read_qgc_plan, "a.plan", std::string(bytes));
}
inline void try_waypoints(std::string_view bytes) {
    try_reader(read_waypoints, "a.waypoints", std::string(bytes));
}

/// What was read is written, read again, and shows the same light at every key.
inline void try_light_program(std::string_view bytes) {
    const std::vector<std::uint8_t> program(bytes.begin(), bytes.end());
    LightProgramLimits limits;
    limits.instructions = 10'000;
    const auto keys = decoded_light_program(program, limits);
    if (!read_or_refused(keys)) return;
    const Millis end_ms = (keys->empty() ? 0 : keys->back().time_ms) + 1'000;
    if (end_ms > 80'000'000) return;  // beyond what a reader follows
    const auto again = decoded_light_program(light_program(*keys, end_ms));
    insist(again.ok());
    Millis before_ms = 0;
    for (const LightKey& key : *keys) {
        insist(key.time_ms >= before_ms);
        before_ms = key.time_ms;
        const double t_s = static_cast<double>(key.time_ms) / 1000.0;
        insist(quantised(light_at(*again, t_s)) == quantised(light_at(*keys, t_s)));
    }
}

}  // namespace aerogram::exporter::fuzz
