#include "export/bytes/crc32.hpp"

#include <array>
#include <cstddef>

namespace aerogram::exporter {
namespace {

// tables[j][b]: the effect of byte b followed by j zero bytes; four bytes a step.
constexpr auto kTables = [] {
    std::array<std::array<std::uint32_t, 256>, 4> tables{};
    for (std::uint32_t b = 0; b < 256; ++b) {
        std::uint32_t crc = b;
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
        tables[0][b] = crc;
    }
    for (std::size_t j = 1; j < 4; ++j) {
        for (std::size_t b = 0; b < 256; ++b) {
            const std::uint32_t before = tables[j - 1][b];
            tables[j][b] = (before >> 8U) ^ tables[0][before & 255U];
        }
    }
    return tables;
}();

}  // namespace

std::uint32_t crc32(std::string_view bytes) {
    std::uint32_t crc = 0xFFFFFFFFU;
    std::size_t at = 0;
    const auto byte = [&](std::size_t i) { return std::uint32_t{static_cast<std::uint8_t>(bytes[i])}; };
    for (; at + 4 <= bytes.size(); at += 4) {
        crc ^= byte(at) | byte(at + 1) << 8U | byte(at + 2) << 16U | byte(at + 3) << 24U;
        crc = kTables[3][crc & 255U] ^ kTables[2][(crc >> 8U) & 255U] ^ kTables[1][(crc >> 16U) & 255U] ^
              kTables[0][crc >> 24U];
    }
    for (; at < bytes.size(); ++at) crc = (crc >> 8U) ^ kTables[0][(crc ^ byte(at)) & 255U];
    return ~crc;
}

}  // namespace aerogram::exporter
