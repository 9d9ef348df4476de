// doc.kml but for its tracks: what is said of the show, and the areas that people look at.
#include <algorithm>
#include <cmath>

#include "export/bytes/decimal.hpp"
#include "export/maps/kmz.hpp"
#include "export/maps/map_places.hpp"
#include "export/maps/xml_cursor.hpp"
#include "export/outgoing/facts_json.hpp"
#include "export/outgoing/program.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kHomesShown = 200;  ///< more would hide each other

std::string element(std::string_view name, std::string_view text) {
    return "<" + std::string(name) + ">" + xml_text(text) + "</" + std::string(name) + ">\n";
}
std::string data(std::string_view name, std::string_view text) {
    return "<Data name=\"" + std::string(name) + "\">" + "<value>" + xml_text(text) + "</value></Data>\n";
}

/// "rrggbbaa" as KML's "aabbggrr".
std::string kml_color(std::string_view rgba) {
    return std::string(rgba.substr(6, 2)) + std::string(rgba.substr(4, 2)) + std::string(rgba.substr(2, 2)) +
           std::string(rgba.substr(0, 2));
}

std::string style_of(const MapArea& area) {
    return "<Style><LineStyle><color>" + kml_color(area.stroke) +
           "</color><width>2</width></LineStyle><PolyStyle><color>" + kml_color(area.fill) +
           "</color></PolyStyle></Style>\n";
}

std::string placemark(const MapArea& area, const MapPlaces& places) {
    const bool flat = area.top_m == area.base_m;
    std::string out =
        "<Placemark>" + element("name", area.name) + style_of(area) + "<ExtendedData>\n" + data("kind", area.kind);
    if (!flat) {
        std::string base, top;
        append_fixed(base, area.base_m, 3);
        append_fixed(top, area.top_m, 3);
        out += data("base_m", base) + data("top_m", top);
    }
    out += "</ExtendedData>\n<Polygon>";
    out += flat ? "<altitudeMode>clampToGround</altitudeMode>"
                : "<extrude>1</extrude><altitudeMode>absolute</altitudeMode>";
    out += "<outerBoundaryIs><LinearRing><coordinates>\n" + places.ring(area.outline_m, area.top_m, "\n", true) +
           "\n</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>\n";
    return out;
}

std::string folder(std::string_view name, bool shown, std::string_view content) {
    if (content.empty()) return {};
    return "<Folder>" + element("name", name) + "<visibility>" + (shown ? "1" : "0") + "</visibility>\n" +
           std::string(content) + "</Folder>\n";
}

std::string homes(const OutgoingFacts& facts, const MapPlaces& places) {
    const bool shown = facts.drones.size() <= kHomesShown;
    std::string out;
    for (const OutgoingDrone& drone : facts.drones) {
        out += "<Placemark><name>" + xml_text(drone.name) + "</name><visibility>" + (shown ? "1" : "0") +
               "</visibility><styleUrl>#home</styleUrl><Point><altitudeMode>absolute</altitudeMode><coordinates>";
        places.append(out, drone.home_m, ',');
        out += "</coordinates></Point></Placemark>\n";
    }
    return out;
}

/// The view that opens: from behind the audience, far enough away for the whole show.
std::string look_at(const OutgoingFacts& facts, const FlightVolumes& volumes, const MapPlaces& places) {
    Vec2 low{0.0, 0.0}, high{0.0, 0.0};
    for (const Vec2& p : volumes.flight_m) low = glm::min(low, p), high = glm::max(high, p);
    const Vec2 middle = 0.5 * (low + high);
    std::string at;
    places.append(at, {middle.x, middle.y, 0.5 * volumes.flight_height_m}, ',');
    Fields fields(at, ',');
    const std::string longitude(*fields.next()), latitude(*fields.next()), altitude(*fields.next());
    double heading_deg = std::fmod(facts.origin->heading_deg, 360.0);
    if (heading_deg < 0.0) heading_deg += 360.0;
    std::string heading, range;
    append_fixed(heading, heading_deg, 3);
    append_fixed(range, 2.0 * glm::length(high - low) + 100.0, 0);
    return "<LookAt><longitude>" + longitude + "</longitude><latitude>" + latitude + "</latitude><altitude>" +
           altitude + "</altitude><heading>" + heading + "</heading><tilt>70</tilt><range>" + range +
           "</range><altitudeMode>absolute</altitudeMode></LookAt>\n";
}

std::string about(const OutgoingFacts& facts, const Seal& seal) {
    std::string text = std::string(seal.certified ? "Certified" : "NOT CERTIFIED") + " drone show by " +
                       std::string(kProgramName) + " " + std::string(kProgramVersion) + ".";
    if (!seal.show_hash.empty()) text += " Show hash " + seal.show_hash + ".";
    text += " Show time 0 is " + utc_text(map_start(facts)) +
            (facts.exporting.start_utc_s ? "." : ", which stands for no date.");
    return text;
}

std::string notes(const OutgoingFacts& facts, const Seal& seal) {
    std::string out = "<ExtendedData>\n" + data("aerogram", facts_json(facts, seal)) +
                      data("show_hash", seal.show_hash) + data("certified", seal.certified ? "true" : "false") +
                      data("start_utc", utc_text(map_start(facts)));
    const geo::ShowOrigin& origin = *facts.origin;
    const auto number = [&](std::string_view name, double value) {
        std::string text;
        append_exact(text, value);
        out += data(name, text);
    };
    number("origin_latitude_deg", origin.ground.latitude_deg);
    number("origin_longitude_deg", origin.ground.longitude_deg);
    std::string amsl;
    append_fixed(amsl, origin.ground.height_m - origin.geoid_undulation_m.value_or(0.0), 3);
    out += data("origin_amsl_m", amsl);
    number("heading_deg", origin.heading_deg);
    return out + "</ExtendedData>\n";
}

}  // namespace

std::string kml_document(const OutgoingShow& show, const Seal& seal, const Run& run, std::string_view tracks,
                         std::string_view links) {
    const OutgoingFacts& facts = show.facts();
    const FlightVolumes volumes = flight_volumes(show, run);
    const MapPlaces places(*facts.origin, facts.origin->geoid_undulation_m.value_or(0.0));
    std::string areas, ground;
    for (const MapArea& area : map_areas(facts, volumes)) {
        const bool volume = area.kind == "flight" || area.kind == "contingency" || area.kind == "ground-risk";
        (volume ? areas : ground) += placemark(area, places);
    }
    std::string out =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\" "
        "xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n<Document>\n";
    out += element("name", (seal.certified ? std::string() : std::string(kMapUncertified)) + facts.title);
    out += element("description", about(facts, seal)) + look_at(facts, volumes, places);
    out += "<Style id=\"home\"><IconStyle><color>ffffffff</color><scale>0.5</scale></IconStyle></Style>\n";
    out += notes(facts, seal) + folder("Flight volumes", true, areas) + folder("Airspace", true, ground) +
           folder("Homes", facts.drones.size() <= kHomesShown, homes(facts, places)) +
           folder("Tracks", facts.drones.size() <= kHomesShown, std::string(tracks) + std::string(links));
    return out + "</Document>\n</kml>\n";
}

}  // namespace aerogram::exporter
