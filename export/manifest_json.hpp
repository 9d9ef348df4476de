#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/record/recorded_show.hpp"
#include "geo/airspace.hpp"
#include "geo/limits.hpp"
#include "geo/result.hpp"
#include "geo/show_frame.hpp"
#include "geo/vec3.hpp"

/// manifest.json: what an exported folder holds and how each file can be checked (docs/formats/manifest.md).
namespace aerogram::exporter {

struct ManifestFile {
    std::string path;    ///< relative to the folder, with '/'
    std::string format;  ///< registry name, or "certificate"
    std::uint64_t bytes = 0;
    std::string sha256;                      ///< 64 lower-case hex digits
    std::optional<std::string> timing;       ///< "exact", "linear", "none: separation not claimed"; flight files only
    std::optional<double> min_separation_m;  ///< certified lower bound of what the file says; absent: none is claimed
};

/// One format of the folder with its stated rounding, or why it was left out.
struct ManifestFormat {
    std::string name;
    std::string skipped;  ///< empty: written
    Rounding rounding;
};

struct ManifestDrone {
    std::string name;  ///< "drone-001", the same in every file
    Vec3 pad_m{};      ///< show frame
};

struct Manifest {
    std::string program, version;
    std::string show_name;
    std::string show_hash;
    bool certified = false;
    double duration_s = 0.0;
    geo::ShowOrigin origin;
    Limits limits;
    double endurance_s = 0.0;
    geo::Airspace airspace;
    std::vector<ManifestFormat> formats;
    std::vector<ManifestFile> files;  ///< every file of the folder but the manifest itself
    std::size_t fleet = 0;            ///< drones of the whole show; more than `drones`: a part of it went out
    std::vector<ManifestDrone> drones;
};

/// The file's text. Its field "manifest_sha256" is the SHA-256 of the text with that field's 64 digits all '0'.
/// Properties: (1) same manifest, same bytes (2) read_manifest gives it back, numbers bit for bit.
std::string manifest_json(const Manifest& manifest);

/// Reads and checks a manifest.
/// Errors: invalid_input naming the field: not JSON, missing or wrong type, another version, numbers out of range, a
/// path that is absolute or leaves the folder or occurs twice, or its own SHA-256 does not fit its text.
Result<Manifest> read_manifest(std::string_view bytes);

}  // namespace aerogram::exporter
