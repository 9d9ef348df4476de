#include "export/maps/kmz.hpp"

#include <algorithm>
#include <cmath>

#include "export/bytes/decimal.hpp"
#include "export/bytes/zip.hpp"
#include "export/bytes/zip_peek.hpp"
#include "export/maps/map_places.hpp"
#include "export/maps/track_corners.hpp"
#include "export/maps/xml_cursor.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr const char* kFile = "show.kmz";
constexpr double kCornerBytes = 100.0, kLargestText = 1.5e9;
constexpr std::size_t kTracksShown = 200;
constexpr std::string_view kHead =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\" "
    "xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n<Document>\n";

/// "2000-01-01T00:00:12.35Z", its seconds changed from call to call.
class WhenText {
  public:
    explicit WhenText(UtcSeconds start_s) : start_s_(start_s) {}
    void append(std::string& out, Millis time_ms) {
        const Millis second = time_ms / 1000, rest_ms = time_ms % 1000;
        if (second != second_) {
            second_ = second;
            text_ = utc_text(start_s_ + second);
            text_.pop_back();
        }
        out += text_;
        if (rest_ms != 0) {
            const int digits = rest_ms % 100 == 0 ? 1 : rest_ms % 10 == 0 ? 2 : 3;
            out += '.';
            for (int k = 0, unit = 100; k < digits; ++k, unit /= 10)
                out += static_cast<char>('0' + rest_ms / unit % 10);
        }
        out += 'Z';
    }

  private:
    UtcSeconds start_s_;
    Millis second_ = -1;
    std::string text_;
};

/// The first light that a drone shows, else white; as KML's "ffbbggrr".
std::string track_color(const std::vector<LightKey>& lights) {
    const auto lit = std::ranges::find_if(lights, [](const LightKey& k) { return k.color != Rgb{}; });
    const std::string hex = hex_from_rgb(lit == lights.end() ? Rgb{1.0, 1.0, 1.0} : lit->color);
    return "ff" + hex.substr(5, 2) + hex.substr(3, 2) + hex.substr(1, 2);
}

void append_place(std::string& out, std::string_view name, const Vec3& place_m) {
    out += "<Data name=\"" + std::string(name) + "\"><value>";
    for (const double x : {place_m.x, place_m.y, place_m.z}) {
        if (out.back() != '>') out += ' ';
        append_exact(out, x);
    }
    out += "</value></Data>";
}

void append_track(std::string& out, const OutgoingShow& show, std::size_t i, const MapCut& cut,
                  const MapPlaces& places) {
    const OutgoingDrone& drone = show.facts().drones[i];
    const std::string color = track_color(show.tracks(i).lights);
    out += "<Placemark><name>" + xml_text(drone.name) + "</name><visibility>";
    out += show.drones() <= kTracksShown ? '1' : '0';
    out += "</visibility><Style><IconStyle><color>" + color +
           "</color><scale>0.4</scale></IconStyle><LabelStyle><scale>0" + "</scale></LabelStyle><LineStyle><color>" +
           color + "</color></LineStyle></Style><ExtendedData>";
    out += "<Data name=\"number\"><value>" + std::to_string(drone.number) + "</value></Data>";
    append_place(out, "home_m", drone.home_m);
    append_place(out, "land_m", drone.land_m);
    out += "</ExtendedData><gx:Track><altitudeMode>absolute</altitudeMode>\n";
    const std::vector<Corner> corners = track_corners(show, i, cut);
    WhenText when(map_start(show.facts()));
    for (const Corner& corner : corners) {
        out += "<when>";
        when.append(out, corner.time_ms);
        out += "</when>\n";
    }
    for (const Corner& corner : corners) {
        out += "<gx:coord>";
        places.append(out, corner.place_m, ' ');
        out += "</gx:coord>\n";
    }
    out += "</gx:Track></Placemark>\n";
}

std::string unsuited(const OutgoingShow& show) {
    const OutgoingFacts& facts = show.facts();
    if (!facts.origin) return "the show has no origin on the globe";
    if (!facts.origin->geoid_undulation_m)
        return "heights are above sea level: the mission has to state geoid_undulation_m";
    const auto cut = map_cut(facts);
    if (!cut) return "export_margin_m leaves no room for straight lines and millimetres; 0.01 would do for most shows";
    const double bytes = estimated_corners(show, *cut) * kCornerBytes;
    if (bytes <= kLargestText) return {};
    return "about " + std::to_string(std::llround(bytes / 1e9)) + " GB of KML; viewers open 1.5 GB at most";
}

/// A part of a large fleet's drones.
struct Linked {
    std::string path, name;
    std::size_t first = 0, end = 0;
};

std::vector<Linked> linked(const OutgoingFacts& facts) {
    std::vector<Linked> parts;
    const std::size_t drones = facts.drones.size();
    for (std::size_t first = 0; first < drones && drones > kKmlDrones; first += kKmlDrones) {
        const std::size_t end = std::min(drones, first + kKmlDrones);
        parts.push_back({"tracks/" + std::to_string(parts.size() + 1) + ".kml",
                         "Drones " + std::to_string(facts.drones[first].number) + " to " +
                             std::to_string(facts.drones[end - 1].number),
                         first, end});
    }
    return parts;
}

std::string links_of(const std::vector<Linked>& parts) {
    std::string out;
    for (const Linked& part : parts)
        out += "<NetworkLink><name>" + part.name + "</name><visibility>0</visibility><Link><href>" + part.path +
               "</href></Link></NetworkLink>\n";
    return out;
}

Result<std::vector<std::string>> write(const OutgoingShow& show, const Seal& seal, const std::filesystem::path& folder,
                                       const Run& run) {
    if (std::string why = unsuited(show); !why.empty()) return Error{ErrorCode::invalid_input, "kmz: " + why};
    const OutgoingFacts& facts = show.facts();
    const MapCut cut = *map_cut(facts);
    const MapPlaces places(*facts.origin, *facts.origin->geoid_undulation_m);
    const std::vector<Linked> parts = linked(facts);
    std::string tracks;
    if (parts.empty()) {
        std::vector<std::string> texts(show.drones());
        parallel_for(show.drones(), run, "kmz", [&](std::size_t i) { append_track(texts[i], show, i, cut, places); });
        for (const std::string& text : texts) tracks += text;
    }
    std::vector<PackedEntry> entries(1 + parts.size());
    parallel_for(parts.size(), run, "kmz", [&](std::size_t k) {
        std::string text(kHead);
        text += "<name>" + parts[k].name + "</name>\n";
        for (std::size_t i = parts[k].first; i < parts[k].end && !run.stopped(); ++i)
            append_track(text, show, i, cut, places);
        entries[1 + k] = packed_entry(parts[k].path, text += "</Document>\n</kml>\n");
    });
    entries[0] = packed_entry("doc.kml", kml_document(show, seal, run, tracks, links_of(parts)));
    if (run.stopped()) return stopped_error();
    if (const Status written = write_zip(folder / kFile, entries); !written) return written.error();
    return std::vector<std::string>{kFile};
}

bool recognises(std::string_view path, std::string_view first_bytes) {
    if (const auto entry = first_zip_entry(first_bytes)) return path.ends_with(".kmz") || entry->ends_with(".kml");
    return path.ends_with(".kml") || (first_bytes.starts_with("<?xml") && first_bytes.find("<kml") < 1000);
}

constexpr Format kKmz{
    "kmz",      "KML in a zip: tracks, homes, flight volumes and airspace for Google Earth and authorities",
    "linear",   "lights but for one colour a drone, yaw, payload events",
    write,      read_kmz,
    recognises, unsuited};

}  // namespace

const Format& kmz_format() {
    return kKmz;
}

}  // namespace aerogram::exporter
