#include "export/bytes/utf8.hpp"

#include <cstdint>

namespace aerogram::exporter {
namespace {

struct Lead {
    std::size_t followers = 0;
    std::uint32_t bits = 0;
    std::uint32_t smallest = 0;  ///< code points below have a shorter form
};

/// What a first byte announces; followers > 3: not a first byte.
Lead lead(std::uint8_t byte) {
    if (byte < 0x80) return {0, byte, 0};
    if (byte >= 0xC0 && byte < 0xE0) return {1, byte & 0x1FU, 0x80};
    if (byte >= 0xE0 && byte < 0xF0) return {2, byte & 0x0FU, 0x800};
    if (byte >= 0xF0 && byte < 0xF8) return {3, byte & 0x07U, 0x10000};
    return {4, 0, 0};
}

}  // namespace

bool is_plain_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        auto [followers, code, smallest] = lead(static_cast<std::uint8_t>(text[at]));
        if (followers > 3 || text.size() - at <= followers) return false;
        for (std::size_t i = 1; i <= followers; ++i) {
            const auto byte = static_cast<std::uint8_t>(text[at + i]);
            if ((byte & 0xC0U) != 0x80U) return false;
            code = code << 6U | (byte & 0x3FU);
        }
        const bool surrogate = code >= 0xD800 && code < 0xE000;
        const bool control = code < 0x20 || code == 0x7F;
        if (code < smallest || code > 0x10FFFF || surrogate || control) return false;
        at += followers + 1;
    }
    return true;
}

}  // namespace aerogram::exporter
