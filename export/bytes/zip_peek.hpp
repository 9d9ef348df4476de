#pragma once
#include <optional>
#include <string_view>

namespace aerogram::exporter {

/// The name of a ZIP archive's first entry, from its beginning; absent when the bytes are no archive or too few.
[[nodiscard]] inline std::optional<std::string_view> first_zip_entry(std::string_view bytes) {
    constexpr std::size_t kHeader = 30, kNameLength = 26;
    if (bytes.size() < kHeader || !bytes.starts_with("PK\x03\x04")) return std::nullopt;
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
    const std::size_t length = byte(kNameLength) | byte(kNameLength + 1) << 8;
    if (bytes.size() - kHeader < length) return std::nullopt;
    return bytes.substr(kHeader, length);
}

}  // namespace aerogram::exporter
