#pragma once
#include <cstdlib>
#include <string>
#include <string_view>

#include "export/bytes/crc32.hpp"
#include "export/bytes/little_endian.hpp"
#include "export/bytes/sha256.hpp"
#include "export/bytes/zip.hpp"
#include "export/certificate_json.hpp"
#include "export/exact/trajectories_bin.hpp"
#include "export/manifest_json.hpp"
#include "export/verify/judge.hpp"

/// What the fuzz targets of the export readers do with any bytes: they are read or refused as invalid input, and what
/// is read is sound. Hashes and checksums would stop nearly every input at the door, so each is tried once more with
/// them made to fit. Build tests/fuzz/NAME_fuzz.cpp with -fsanitize=fuzzer,address,undefined; corpora:
/// tests/fuzz/corpus/NAME.
namespace aerogram::exporter::fuzz {

inline void insist(bool holds) {
    if (!holds) std::abort();
}

template <class T>
bool read_or_refused(const Result<T>& result) {
    if (!result.ok()) insist(result.error().code == ErrorCode::invalid_input && !result.error().message.empty());
    return result.ok();
}

/// Small shows are also searched for their closest pair, which must end in bounded time and memory.
inline void check_separation(const RecordedShow& show) {
    std::size_t pieces = 0;
    for (const RecordedDrone& drone : show.drones) pieces += drone.pieces.size();
    if (pieces > 2'000 || show.duration_s > 3'600.0) return;
    const auto found = verify_separation(show, 1.0, 3.0, Run{});
    if (read_or_refused(found)) insist(found->lower_bound_m <= found->attained_m);
}

inline void check_trajectories(std::string_view bytes) {
    const auto show = read_trajectories(bytes);
    if (!read_or_refused(show)) return;
    insist(!show->drones.empty() && show->duration_s > 0.0);
    for (const RecordedDrone& drone : show->drones) {
        insist(!drone.pieces.empty());
        for (const Piece& piece : drone.pieces) {
            insist(piece.duration_s > 0.0 && piece.first_control + std::size_t{piece.degree} < drone.controls_m.size());
        }
        for (const Vec3& p : drone.controls_m) insist(is_finite(p));
    }
    check_separation(*show);
}

inline void try_trajectories(std::string_view bytes) {
    check_trajectories(bytes);
    if (bytes.size() < 72) return;
    std::string sealed(bytes);
    std::string word;
    const auto overwrite = [&](std::size_t at, auto value) {
        word.clear();
        put(word, value);
        sealed.replace(at, word.size(), word);
    };
    const std::string_view payload = bytes.substr(72);
    overwrite(24, std::uint64_t{payload.size()});
    const std::string hash = sha256_hex(payload);
    for (std::size_t i = 0; i < 32; ++i)
        sealed[32 + i] = static_cast<char>(std::stoi(hash.substr(2 * i, 2), nullptr, 16));
    overwrite(64, crc32(payload));
    overwrite(68, crc32(std::string_view(sealed).substr(0, 68)));
    check_trajectories(sealed);
}

inline void try_zip(std::string_view bytes) {
    UnzipLimits limits;
    limits.entry_bytes = limits.total_bytes = std::size_t{1} << 24U;
    const auto files = unzip_bytes(bytes, limits);
    if (!read_or_refused(files)) return;
    std::size_t total = 0;
    for (const FileBytes& file : *files) {
        insist(!file.path.empty() && file.path.front() != '/' &&
               ("/" + file.path + "/").find("/../") == std::string::npos);
        total += file.bytes.size();
    }
    insist(total <= limits.total_bytes);
}

inline void check_manifest(std::string_view bytes) {
    const auto manifest = read_manifest(bytes);
    if (!read_or_refused(manifest)) return;
    const auto again = read_manifest(manifest_json(*manifest));
    insist(again.ok() && again->files.size() == manifest->files.size());
}

inline void try_manifest(std::string_view bytes) {
    check_manifest(bytes);
    constexpr std::string_view kKey = "\"manifest_sha256\": \"";
    const std::size_t key = bytes.find(kKey);
    if (key == std::string_view::npos || bytes.size() < key + kKey.size() + 65) return;
    std::string sealed(bytes);
    sealed.replace(key + kKey.size(), 64, std::string(64, '0'));
    check_manifest(sealed.replace(key + kKey.size(), 64, sha256_hex(sealed)));
}

inline void try_certificate(std::string_view bytes) {
    read_or_refused(read_certificate(bytes));
}

}  // namespace aerogram::exporter::fuzz
