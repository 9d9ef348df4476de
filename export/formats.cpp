#include "export/formats.hpp"

#include <algorithm>
#include <array>

#include "export/exact/trajectories_bin.hpp"
#include "export/maps/czml.hpp"
#include "export/maps/kmz.hpp"
#include "export/preview/preview_html.hpp"
#include "export/scene/glb.hpp"
#include "export/skybrush/csv_zip.hpp"
#include "export/skybrush/skyb.hpp"
#include "export/skybrush/skyc.hpp"
#include "export/vehicle/crazyflie.hpp"
#include "export/vehicle/px4_csv.hpp"
#include "export/vviz/vviz.hpp"
#include "export/waypoint/qgc_plan.hpp"
#include "export/waypoint/waypoints.hpp"

namespace aerogram::exporter {

std::span<const Format> formats() {
    static const std::array kFormats{trajectories_format(), csv_format(),       skyc_format(),     skyb_format(),
                                     vviz_format(),         kmz_format(),       czml_format(),     glb_format(),
                                     px4_csv_format(),      crazyflie_format(), qgc_plan_format(), waypoints_format(),
                                     preview_format()};
    return kFormats;
}

const Format* find_format(std::string_view name) {
    const auto found = std::ranges::find(formats(), name, &Format::name);
    return found == formats().end() ? nullptr : &*found;
}

const Format* recognise(std::string_view path, std::string_view bytes) {
    const auto found = std::ranges::find_if(formats(), [&](const Format& f) { return f.recognises(path, bytes); });
    return found == formats().end() ? nullptr : &*found;
}

}  // namespace aerogram::exporter
