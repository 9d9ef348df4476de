#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Raw deflate (RFC 1951) of whole texts. Safe from several threads; same bytes in, same bytes out on every machine.
namespace aerogram::exporter {

[[nodiscard]] std::string deflated(std::string_view bytes);
/// @param size  of the unpacked bytes. Absent when `packed` is no whole deflate stream of exactly so many bytes.
[[nodiscard]] std::optional<std::string> inflated(std::string_view packed, std::size_t size);
/// CRC-32 as zip archives use it.
[[nodiscard]] std::uint32_t zip_crc(std::string_view bytes);

}  // namespace aerogram::exporter
