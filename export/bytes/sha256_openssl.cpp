#include <openssl/sha.h>

#include <array>

#include "export/bytes/sha256.hpp"

namespace aerogram::exporter {

std::string sha256_hex(std::string_view bytes) {
    std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
    const void* data = bytes.data();
    SHA256(static_cast<const unsigned char*>(data), bytes.size(), digest.data());
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string hex;
    hex.reserve(2 * digest.size());
    for (const unsigned char byte : digest) {
        hex += kDigits[byte >> 4U];
        hex += kDigits[byte & 15U];
    }
    return hex;
}

}  // namespace aerogram::exporter
