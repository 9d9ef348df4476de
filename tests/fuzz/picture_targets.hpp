#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "planner/picture/contours.hpp"
#include "planner/picture/picture.hpp"

/// What the fuzz target of pictures does with any bytes: they are a picture whose pixels and contours are sound, or
/// are refused with a message. Build tests/fuzz/picture_fuzz.cpp with -fsanitize=fuzzer,address,undefined; the corpus
/// tests/fuzz/corpus/picture, which make_pictures.py draws, is replayed by a unit test.
namespace aerogram::planner::fuzz {

inline void insist_picture(bool sound) {
    if (!sound) std::abort();
}

inline void check_contours(const Picture& picture) {
    Bitmap bitmap{picture.width, picture.height, {}};
    for (std::size_t p = 0; p < picture.width * picture.height; ++p)
        bitmap.set.push_back(luminance(picture.light(p)) * picture.alpha(p) > 0.05 ? 1 : 0);
    if (std::count(bitmap.set.begin(), bitmap.set.end(), 1) == 0) return;
    const auto region = contours_of(bitmap, 0);
    insist_picture(region.ok() && !region->contours.empty());
    const double width = static_cast<double>(picture.width), height = static_cast<double>(picture.height);
    for (const Contour& contour : region->contours) {
        insist_picture(contour.size() >= 3);
        for (const Vec2& p : contour)
            insist_picture(p.x >= -1.0 && p.y >= -1.0 && p.x <= width + 1.0 && p.y <= height + 1.0);
    }
}

inline void check_picture(const Result<Picture>& picture) {
    if (!picture) {
        insist_picture(picture.error().code == ErrorCode::invalid_input && !picture.error().message.empty());
        return;
    }
    insist_picture(picture->width > 0 && picture->height > 0 && picture->width <= kMostPixels / picture->height);
    insist_picture(picture->rgba.size() == 4 * picture->width * picture->height);
    if (picture->width * picture->height <= 20'000) check_contours(*picture);
}

inline void try_picture(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG")) return check_picture(decode_png(bytes));
    if (bytes.starts_with("\xFF\xD8")) return check_picture(decode_jpeg(bytes));
    insist_picture(!decode_png(bytes).ok() || !decode_jpeg(bytes).ok());
}

}  // namespace aerogram::planner::fuzz
