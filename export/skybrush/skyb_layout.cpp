#include "export/skybrush/skyb_layout.hpp"

#include "export/bytes/deflate.hpp"
#include "geo/contract.hpp"

namespace aerogram::exporter::skyb {

/// Begun with ones, as zip's checksum is, a reflected CRC of 32 bits sees the first four bytes inverted.
std::uint32_t checksum(std::string_view file) {
    AEROGRAM_REQUIRE(file.size() >= kCrcAt + kCrcBytes, file.size());
    std::string bytes(file);
    bytes.replace(kCrcAt, kCrcBytes, kCrcBytes, '\0');
    for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>(~bytes[i]);
    return ~zip_crc(bytes);
}

}  // namespace aerogram::exporter::skyb
