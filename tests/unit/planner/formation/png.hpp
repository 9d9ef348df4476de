#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

/// PNG files made by tests: RGBA, stored without compression (RFC 1950, 1951, 2083).
namespace aerogram::planner::testing {

inline std::string big_endian(std::uint32_t v) {
    std::string out;
    for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(v >> static_cast<unsigned>(shift) & 0xFFU);
    return out;
}

inline std::uint32_t crc32(std::string_view bytes) {
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char byte : bytes) {
        crc ^= static_cast<std::uint8_t>(byte);
        for (int i = 0; i < 8; ++i) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return ~crc;
}

inline std::string chunk(const std::string& kind, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size())) + kind + data + big_endian(crc32(kind + data));
}

/// @param pixel  (x, y) from the upper left: red, green, blue, alpha.
template <class Pixel>
std::string png(std::uint32_t width, std::uint32_t height, const Pixel& pixel) {
    std::string raw;
    for (std::uint32_t y = 0; y < height; ++y) {
        raw += '\0';  // no filter
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::array<std::uint8_t, 4> rgba = pixel(x, y);
            for (const std::uint8_t c : rgba) raw += static_cast<char>(c);
        }
    }
    std::string packed("\x78\x01", 2);
    std::uint32_t a = 1, b = 0;
    for (std::size_t from = 0; from < raw.size(); from += 65535) {
        const std::string part = raw.substr(from, 65535);
        const auto size = static_cast<std::uint32_t>(part.size());
        packed += from + 65535 >= raw.size() ? '\1' : '\0';
        for (const std::uint32_t v : {size, ~size}) {
            packed += static_cast<char>(v & 0xFFU);
            packed += static_cast<char>(v >> 8U & 0xFFU);
        }
        packed += part;
    }
    for (const char byte : raw) {
        a = (a + static_cast<std::uint8_t>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    packed += big_endian(b << 16U | a);
    return std::string("\x89PNG\r\n\x1a\n") +
           chunk("IHDR", big_endian(width) + big_endian(height) + std::string("\x08\x06\0\0\0", 5)) +
           chunk("IDAT", packed) + chunk("IEND", "");
}

/// A file of one test's own, gone with this.
class OwnFile {
  public:
    OwnFile(const std::string& name, const std::string& bytes)
        : path_(std::filesystem::path(::testing::TempDir()) /
                (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + name)) {
        std::ofstream(path_, std::ios::binary) << bytes;
    }
    ~OwnFile() { std::filesystem::remove(path_); }
    OwnFile(const OwnFile&) = delete;
    OwnFile& operator=(const OwnFile&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace aerogram::planner::testing
