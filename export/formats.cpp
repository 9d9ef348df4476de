#include "export/formats.hpp"
#include "export/bytes/files.hpp"

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

Status add_companion(const Format& format, const std::filesystem::path& folder, std::vector<FileBytes>& files) {
    constexpr const char* kName = "show.json";
    const bool there = std::ranges::any_of(files, [&](const FileBytes& file) { return file.path.ends_with(kName); });
    std::error_code failure;
    if (!format.per_drone || there || !std::filesystem::is_regular_file(folder / kName, failure)) return Done{};
    auto bytes = read_file(folder / kName);
    if (!bytes) return bytes.error();
    if (format.recognises(kName, *bytes)) files.push_back({kName, std::move(*bytes)});
    return Done{};
}

}  // namespace aerogram::exporter
