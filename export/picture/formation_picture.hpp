#pragma once
#include <span>
#include <string>

#include "export/picture/formation_facts.hpp"
#include "export/picture/picture_size.hpp"
#include "export/picture/sky_view.hpp"
#include "geo/result.hpp"
#include "geo/vec3.hpp"
#include "planner/formation/formation.hpp"

namespace aerogram::exporter {

/// Where the three views of a formation stand on a page: the front, the side right of it with the same heights, the top
/// below it with the same x; all at one scale.
struct ThreeViews {
    Box frame;  ///< what is in sight
    SkyView front, top, side;
    SkyStyle style;
    double bottom_px = 0.0;  ///< of the lowest view, its scale's numbers included
};
/// @param drones  at least one. @param width_px  of the page.
[[nodiscard]] ThreeViews three_views(std::span<const PictureDrone> drones, const FormationFacts& facts, int width_px);

/// The slots as drones of a picture.
[[nodiscard]] std::vector<PictureDrone> picture_drones(const planner::Formation& formation);

/// One keyframe's formation as a PNG: seen from the front, the right and above, in its colours, with metre scales;
/// below what there is to say about it and how far the drones are from each other.
/// @param width_px  in [kNarrowestPicture_px, kWidestPicture_px]; the height follows the formation's proportions.
/// Property: (1) same formation, same bytes. Errors: as Lettering::load and Canvas::png.
Result<std::string> formation_picture(const planner::Formation& formation, const FormationFacts& facts, int width_px);

}  // namespace aerogram::exporter
