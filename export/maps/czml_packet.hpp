#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/maps/map_lights.hpp"
#include "export/maps/map_tracks.hpp"
#include "geo/result.hpp"

/// One packet of a CZML text.
namespace aerogram::exporter {

/// How our own packets say that they are linear between samples and held outside.
inline constexpr std::string_view kCzmlLinear =
    R"("interpolationAlgorithm":"LINEAR","interpolationDegree":1,"forwardExtrapolationType":"HOLD","backwardExtrapolationType":"HOLD")";

struct CzmlColor {
    std::int64_t at_us = 0;
    Rgb8 color;
};

/// A packet whose position changes with time. Places are longitude and latitude in degrees, and metres above the
/// ellipsoid; times are microseconds since 1970.
struct CzmlTrack {
    MapTrack track;
    std::vector<CzmlColor> colors;
};

struct CzmlPacket {
    std::optional<CzmlTrack> track;
    std::optional<std::string> facts;      ///< of our own documents, facts_json()
    std::optional<std::int64_t> start_us;  ///< of our own documents
    std::string name;                      ///< of documents
    bool document = false;
};

/// Any packet, carefully. Errors: invalid_input with the key.
Result<CzmlPacket> read_czml_packet(std::string_view text);

/// A drone's packet as our own writer leaves it, quickly; absent for all others, also broken ones.
[[nodiscard]] std::optional<CzmlTrack> read_plain_czml_packet(std::string_view text);

}  // namespace aerogram::exporter
