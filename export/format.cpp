#include "export/format.hpp"

#include <algorithm>
#include <array>

#include "export/csv_zip.hpp"
#include "export/preview_html.hpp"
#include "export/qgc_plan.hpp"
#include "export/skyc.hpp"
#include "export/trajectories_bin.hpp"
#include "export/waypoints.hpp"

namespace aerogram::exporter {

std::span<const Format> formats() {
    static const std::array kFormats{trajectories_format(), csv_format(),       skyc_format(),
                                     qgc_plan_format(),     waypoints_format(), preview_format()};
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

std::string drone_name(std::size_t number, std::size_t fleet) {
    const std::size_t digits = std::max<std::size_t>(3, std::to_string(fleet).size());
    const std::string plain = std::to_string(number);
    return "drone-" + std::string(digits - std::min(digits, plain.size()), '0') + plain;
}

}  // namespace aerogram::exporter
