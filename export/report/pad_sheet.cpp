#include <algorithm>
#include <optional>

#include "export/bytes/decimal.hpp"
#include "export/report/report_files.hpp"
#include "geo/show_frame.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kVehiclesALink = 250;

/// A field as RFC 4180 has it.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

}  // namespace

PadSheet pad_sheet(const OutgoingFacts& facts, const std::string& show_hash, bool certified) {
    PadSheet sheet{facts.title, show_hash, facts.origin, certified, facts.fleet, {}};
    for (const OutgoingDrone& drone : facts.drones) {
        // Vehicles are numbered as the pads they stand on: whoever goes out, and whose part it flies, keeps link and
        // id.
        const std::size_t pad = drone.pad == 0 ? drone.number : drone.pad;
        sheet.rows.push_back({pad, drone.number, drone.name, (pad - 1) / kVehiclesALink + 1,
                              (pad - 1) % kVehiclesALink + 1, drone.home_m});
    }
    std::stable_sort(sheet.rows.begin(), sheet.rows.end(),
                     [](const PadSheet::Row& a, const PadSheet::Row& b) { return a.pad < b.pad; });
    return sheet;
}

std::string pads_csv(const PadSheet& sheet) {
    const std::optional<geo::ShowFrame> frame =
        sheet.origin ? std::optional<geo::ShowFrame>(*sheet.origin) : std::nullopt;
    std::string text = "pad,drone,name,link,system_id,x_m,y_m,z_m,latitude_deg,longitude_deg,height_m\n";
    for (const PadSheet::Row& row : sheet.rows) {
        for (const std::size_t number : {row.pad, row.drone}) text += std::to_string(number) + ',';
        text += field(row.name) + ',' + std::to_string(row.link) + ',' + std::to_string(row.system_id);
        for (const double metres : {row.home_m.x, row.home_m.y, row.home_m.z}) append_fixed(text += ',', metres, 3);
        if (frame) {
            const geo::Geodetic place = frame->to_geodetic(row.home_m);
            append_fixed(text += ',', place.latitude_deg, 8);
            append_fixed(text += ',', place.longitude_deg, 8);
            append_fixed(text += ',', place.height_m, 3);
        } else {
            text += ",,,";
        }
        text += '\n';
    }
    return text;
}

}  // namespace aerogram::exporter
