#include <png.h>

#include <string>

#include "planner/picture/picture.hpp"

namespace aerogram::planner {

Result<Picture> decode_png(std::string_view bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    const auto failed = [&](const std::string& why) {
        png_image_free(&image);
        return Error{ErrorCode::invalid_input, why};
    };
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
        return failed("is not a whole PNG file: " + std::string(image.message));
    }
    Picture picture;
    picture.width = image.width;
    picture.height = image.height;
    if (picture.width > kMostPixels / picture.height) {
        return failed("has " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                      " pixels; must be at most 40 million");
    }
    image.format = PNG_FORMAT_RGBA;
    picture.rgba.resize(4 * picture.width * picture.height);
    if (png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr) == 0) {
        return failed("is not a whole PNG file: " + std::string(image.message));
    }
    return picture;
}

}  // namespace aerogram::planner
