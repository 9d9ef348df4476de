#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geo/color.hpp"
#include "geo/result.hpp"

namespace aerogram::planner {

/// An image as it comes from a file: sRGB and straight alpha, 4 bytes a pixel, row by row from the top left.
struct Picture {
    std::size_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;

    /// Linear light, alpha left aside.
    [[nodiscard]] Rgb light(std::size_t pixel) const;
    [[nodiscard]] double alpha(std::size_t pixel) const { return rgba[4 * pixel + 3] / 255.0; }
};

inline constexpr std::size_t kMostPixels = 40'000'000;

/// Relative luminance of linear light (Rec. 709), in [0, 1].
[[nodiscard]] constexpr double luminance(const Rgb& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// Reads a PNG or JPEG file.
/// Errors: io when it cannot be read or is larger than 64 MiB; invalid_input when it is neither, damaged, cut short, or
/// has more than 40 million pixels.
Result<Picture> read_picture(const std::filesystem::path& file);

/// From the bytes of such a file. Errors: invalid_input, as above, without the file's name.
Result<Picture> decode_png(std::string_view bytes);
Result<Picture> decode_jpeg(std::string_view bytes);

}  // namespace aerogram::planner
