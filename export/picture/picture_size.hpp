#pragma once

namespace aerogram::exporter {

/// Widths that pictures may have, in pixels; their heights follow what they show.
inline constexpr int kNarrowestPicture_px = 320, kWidestPicture_px = 3840, kPicture_px = 960;

}  // namespace aerogram::exporter
