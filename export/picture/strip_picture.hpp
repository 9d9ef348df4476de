#pragma once
#include <string>
#include <vector>

#include "export/picture/sky_view.hpp"
#include "geo/result.hpp"

namespace aerogram::exporter {

/// One picture of a strip: the same drones at another moment, or another frame of a clip.
struct StripFrame {
    std::string caption;
    std::vector<PictureDrone> drones;  ///< at least one
};
inline constexpr std::size_t kMostStripFrames = 48;

/// The frames seen from the front, row by row at one scale around one box, as a PNG.
/// @param frames  1 to kMostStripFrames. @param width_px  as formation_picture.
/// Property: (1) same frames, same bytes. Errors: as formation_picture.
Result<std::string> strip_picture(const std::string& title, const std::string& of,
                                  const std::vector<StripFrame>& frames, int width_px);

}  // namespace aerogram::exporter
