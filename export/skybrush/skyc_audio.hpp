#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "geo/result.hpp"

namespace aerogram::exporter {

inline constexpr std::size_t kLargestSkycAudio = std::size_t{64} << 20U;  ///< bytes

/// A show's music on its way into an archive.
struct SkycAudio {
    std::string entry;       ///< "audio.mp3"
    std::string media_type;  ///< by the file's ending: "audio/mpeg"
    std::string bytes;
};

/// Why a show's music cannot go into an archive, or empty: no such file, more than 64 MB of it, or an ending that is
/// not mp3, wav, ogg, oga, m4a, aac or flac.
[[nodiscard]] std::string skyc_audio_problem(const std::optional<std::filesystem::path>& file);
/// Absent where the show has none. Errors: invalid_input with skyc_audio_problem; io.
Result<std::optional<SkycAudio>> skyc_audio(const std::optional<std::filesystem::path>& file);

}  // namespace aerogram::exporter
