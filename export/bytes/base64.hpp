#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace aerogram::exporter {

/// RFC 4648 base64 with padding, in one line.
[[nodiscard]] std::string base64_encoded(std::span<const std::uint8_t> bytes);
/// The bytes of base64 text, padded or not; absent for any other character, misplaced padding or a dangling digit.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> base64_decoded(std::string_view text);

}  // namespace aerogram::exporter
