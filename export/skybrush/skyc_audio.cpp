#include "export/skybrush/skyc_audio.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "export/bytes/files.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kMediaTypes{{{".mp3", "audio/mpeg"},
                                                                                    {".wav", "audio/wav"},
                                                                                    {".ogg", "audio/ogg"},
                                                                                    {".oga", "audio/ogg"},
                                                                                    {".m4a", "audio/mp4"},
                                                                                    {".aac", "audio/aac"},
                                                                                    {".flac", "audio/flac"}}};

/// Of the file's ending, or empty.
std::pair<std::string_view, std::string_view> type_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    const auto found =
        std::ranges::find(kMediaTypes, std::string_view(ending), [](const auto& type) { return type.first; });
    return found == kMediaTypes.end() ? std::pair<std::string_view, std::string_view>() : *found;
}

}  // namespace

std::string skyc_audio_problem(const std::optional<std::filesystem::path>& file) {
    if (!file) return {};
    const std::string name = "audio file " + file->string();
    if (type_of(*file).first.empty()) return name + ": its ending is none of mp3, wav, ogg, oga, m4a, aac, flac";
    std::error_code failure;
    if (!std::filesystem::is_regular_file(*file, failure)) return name + ": is missing";
    const std::uintmax_t bytes = std::filesystem::file_size(*file, failure);
    if (failure) return name + ": cannot be read: " + failure.message();
    if (bytes > kLargestSkycAudio)
        return name + ": " + std::to_string(bytes) + " bytes; 64 MiB is the most a show carries";
    return {};
}

Result<std::optional<SkycAudio>> skyc_audio(const std::optional<std::filesystem::path>& file) {
    if (!file) return std::optional<SkycAudio>();
    if (std::string why = skyc_audio_problem(file); !why.empty())
        return Error{ErrorCode::invalid_input, "skyc: " + why};
    auto bytes = read_file(*file, kLargestSkycAudio);
    if (!bytes) return bytes.error();
    const auto [ending, media_type] = type_of(*file);
    return std::optional(SkycAudio{"audio" + std::string(ending), std::string(media_type), std::move(*bytes)});
}

}  // namespace aerogram::exporter
