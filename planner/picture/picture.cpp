#include "planner/picture/picture.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <system_error>

namespace aerogram::planner {
namespace {

constexpr std::uintmax_t kLargestFile = 64U << 20U;

std::array<double, 256> linear_table() {
    std::array<double, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double v = static_cast<double>(i) / 255.0;
        table[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
    }
    return table;
}

}  // namespace

Rgb Picture::light(std::size_t pixel) const {
    static const std::array<double, 256> kLinear = linear_table();
    const std::uint8_t* p = rgba.data() + 4 * pixel;
    return {kLinear[p[0]], kLinear[p[1]], kLinear[p[2]]};
}

Result<Picture> read_picture(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error) return Error{ErrorCode::io, "cannot be read"};
    if (size > kLargestFile) return Error{ErrorCode::io, "is larger than 64 MiB: must be a PNG or JPEG file"};
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (!in) return Error{ErrorCode::io, "cannot be read"};
    if (bytes.starts_with("\x89PNG")) return decode_png(bytes);
    if (bytes.starts_with("\xFF\xD8")) return decode_jpeg(bytes);
    return Error{ErrorCode::invalid_input, "is neither PNG nor JPEG"};
}

}  // namespace aerogram::planner
