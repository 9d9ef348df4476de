#include <limits>
#include <utility>

#include "export/bytes/crc32.hpp"
#include "export/bytes/sha256.hpp"
#include "export/exact/payload_cursor.hpp"
#include "export/exact/stored_acts.hpp"
#include "export/exact/trajectories_bin.hpp"
#include "export/exact/trajectories_layout.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using namespace trajectories;

struct Header {
    std::size_t scalar_bytes = 0;
    bool certified = false, planes = false;
    std::string show_hash;
    std::uint32_t payload_crc = 0;
};

Error damaged(std::string message) {
    return {ErrorCode::invalid_input, std::move(message)};
}

std::string hex(std::string_view digest) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (const char c : digest) {
        const auto byte = static_cast<std::uint8_t>(c);
        text += kDigits[byte >> 4U];
        text += kDigits[byte & 15U];
    }
    return text;
}

Result<Header> read_header(std::string_view file) {
    ByteCursor in(file, 0);
    Header header;
    if (in.bytes(kMagic.size()) != kMagic) in.complain("no trajectories.bin: it does not begin with AEROGRAM", in.at());
    const auto version = in.number<std::uint32_t>();
    if (version != kVersion) in.complain("version " + std::to_string(version) + "; this program reads version 1", 4);
    header.scalar_bytes = in.number<std::uint32_t>();
    if (header.scalar_bytes != 8 && header.scalar_bytes != 4) in.complain("scalars must have 8 or 4 bytes", 4);
    const auto flags = in.number<std::uint32_t>();
    if ((flags & ~(kCertifiedFlag | kPlanesFlag)) != 0) in.complain("unknown flags", 4);
    header.certified = (flags & kCertifiedFlag) != 0;
    header.planes = (flags & kPlanesFlag) != 0;
    if (in.number<std::uint32_t>() != kHeaderBytes) in.complain("the header must have 72 bytes", 4);
    if (in.number<std::uint64_t>() + kHeaderBytes != file.size()) in.complain("the file has not the stated length", 8);
    header.show_hash = hex(in.bytes(32));
    header.payload_crc = in.number<std::uint32_t>();
    const auto header_crc = in.number<std::uint32_t>();
    if (in.ok() && crc32(file.substr(0, kHeaderCrcOffset)) != header_crc) in.complain("the header is damaged (CRC)", 4);
    if (!in.ok()) return damaged(in.problem());
    return header;
}

void read_origin(PayloadCursor& in, RecordedShow& show) {
    geo::ShowOrigin origin;
    origin.ground.latitude_deg = in.real(90.0);
    origin.ground.longitude_deg = in.real(180.0);
    origin.ground.height_m = in.real(kLargestCoordinate_m);
    origin.heading_deg = in.real();
    const bool knows_geoid = in.one_of(2) == 1;
    const double undulation_m = in.real(kLargestCoordinate_m);
    if (knows_geoid) origin.geoid_undulation_m = undulation_m;
    if (!knows_geoid && undulation_m != 0.0) in.complain("must be 0 when unknown", 8);
    show.origin = origin;
}

void read_limits(PayloadCursor& in, RecordedShow& show) {
    Limits limits;
    for (double* value : limit_fields(limits)) {
        *value = in.real();
        if (*value < 0.0) in.complain("a limit below 0", 8);
        if (value == &limits.downwash && *value < 1.0) in.complain("downwash below 1", 8);
    }
    show.limits = limits;
    show.endurance_s = in.real();
}

geo::Obstacle read_obstacle(PayloadCursor& in) {
    geo::Obstacle obstacle;
    obstacle.name = in.text();
    const bool prism = in.one_of(2) == 1;
    obstacle.base_m = in.real(kLargestCoordinate_m);
    obstacle.height_m = in.real(kLargestCoordinate_m);
    if (prism) {
        obstacle.shape = geo::Prism{in.polygon(false)};
    } else {
        const Vec2 center_m = in.place();
        obstacle.shape = geo::Cylinder{center_m, in.real(kLargestCoordinate_m)};
    }
    return obstacle;
}

void read_airspace(PayloadCursor& in, RecordedShow& show) {
    geo::Airspace air;
    air.geofence_m = in.polygon(true);
    const std::size_t areas = in.count(4);
    for (std::size_t i = 0; i < areas && in.ok(); ++i) air.audience_m.push_back(in.polygon(false));
    const std::size_t obstacles = in.count(24);
    for (std::size_t i = 0; i < obstacles && in.ok(); ++i) air.obstacles.push_back(read_obstacle(in));
    show.airspace = std::move(air);
}

void read_pads(PayloadCursor& in, std::size_t drones, RecordedShow& show) {
    if (drones == 0 || drones > in.left() / (3 * in.scalar_bytes())) in.complain("an impossible number of drones");
    if (!in.ok()) return;
    const std::vector<Vec3> pads = in.points(drones);
    show.drones.resize(drones);
    for (std::size_t i = 0; i < drones; ++i) {
        show.drones[i].name = drone_name(i + 1, drones);
        show.drones[i].home_m = show.drones[i].land_m = pads[i];
    }
}

/// A time not before `clock_ms`, which becomes it.
std::int32_t later(PayloadCursor& in, std::int32_t& clock_ms) {
    const auto time_ms = in.number<std::int32_t>();
    if (time_ms < clock_ms) in.complain("a time before the one before", 4);
    return clock_ms = time_ms;
}

Tracks read_tracks(PayloadCursor& in) {
    constexpr std::int32_t kFirst = std::numeric_limits<std::int32_t>::min();
    Tracks tracks;
    std::int32_t clock_ms = kFirst;
    tracks.lights.resize(in.count(8 + 3 * in.scalar_bytes()));
    for (LightKey& key : tracks.lights) {
        key.time_ms = later(in, clock_ms);
        key.fade = in.one_of(2) == 1;
        for (double* share : {&key.color.r, &key.color.g, &key.color.b}) *share = in.scalar(kLargestNumber);
    }
    clock_ms = kFirst;
    tracks.yaw.resize(in.count(4 + in.scalar_bytes()));
    for (YawKey& key : tracks.yaw) {
        key.time_ms = later(in, clock_ms);
        key.yaw_rad = in.scalar(kLargestNumber);
    }
    clock_ms = kFirst;
    tracks.events.resize(in.count(12));
    for (PayloadEvent& event : tracks.events) {
        event.time_ms = later(in, clock_ms);
        event.channel = in.number<std::int32_t>();
        event.on = in.one_of(2) == 1;
    }
    return tracks;
}

void read_names(PayloadCursor& in, RecordedShow& show) {
    const std::size_t cues = in.count(8);
    for (std::size_t i = 0; i < cues && in.ok(); ++i) {
        const Millis time_ms = in.number<std::int32_t>();
        show.cues.push_back({time_ms, in.text()});
    }
    const std::size_t keyframes = in.count(12);
    for (std::size_t i = 0; i < keyframes && in.ok(); ++i) {
        in.text();
        const auto from_ms = in.number<std::int32_t>();
        if (in.number<std::int32_t>() < from_ms) in.complain("a keyframe that ends before it begins", 4);
    }
}

void read_plane_limits(PayloadCursor& in, RecordedShow& show) {
    PlaneLimits& plane = show.limits->plane.emplace();
    for (double* value : plane_fields(plane)) {
        *value = in.real();
        if (*value < 0.0) in.complain("a limit below 0", 8);
    }
}

Result<RecordedShow> read_payload(std::string_view payload, std::size_t scalar_bytes, bool planes) {
    PayloadCursor in(payload, kHeaderBytes, scalar_bytes);
    RecordedShow show;
    show.format = "trajectories";
    show.title = in.text();
    const std::size_t drones = in.number<std::uint32_t>();
    read_origin(in, show);
    read_limits(in, show);
    read_airspace(in, show);
    read_pads(in, drones, show);
    if (!in.ok()) return damaged(in.problem());
    const std::vector<StoredAct> acts = read_acts(in, drones);
    for (RecordedDrone& drone : show.drones) drone.tracks = read_tracks(in);
    read_names(in, show);
    if (planes) read_plane_limits(in, show);
    if (in.left() != 0) in.complain("bytes left over");
    if (!in.ok()) return damaged(in.problem());
    const std::string problem = add_pieces(acts, scalar_bytes, show.drones);
    if (!problem.empty()) return damaged(problem);
    show.rounding = stated_rounding(acts, scalar_bytes, show.drones);
    show.duration_s = seconds_from_ms(Millis{acts.back().start_ms} + acts.back().duration_ms);
    return show;
}

}  // namespace

Result<RecordedShow> read_trajectories(std::string_view bytes) {
    const Result<Header> header = read_header(bytes);
    if (!header) return header.error();
    const std::string_view payload = bytes.substr(kHeaderBytes);
    if (crc32(payload) != header->payload_crc) return damaged("byte 72: the payload is damaged (CRC)");
    if (header->scalar_bytes == 8 && sha256_hex(payload) != header->show_hash) {
        return damaged("byte 32: the show hash is not that of the payload");
    }
    Result<RecordedShow> show = read_payload(payload, header->scalar_bytes, header->planes);
    if (!show) return show;
    show->show_hash = header->show_hash;
    show->certified = header->certified;
    return show;
}

}  // namespace aerogram::exporter
