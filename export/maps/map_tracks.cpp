#include "export/maps/map_tracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "export/bytes/decimal.hpp"
#include "export/bytes/text_cursor.hpp"
#include "export/maps/track_corners.hpp"
#include "export/outgoing/facts_json.hpp"
#include "export/outgoing/outgoing_show.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::int64_t kLongest_us = 10LL * 86'400 * 1'000'000;

}  // namespace

void MapGround::state(const geo::ShowOrigin& origin, double below_m) {
    frame_.emplace(origin);
    below_m_ = below_m;
}

Vec3 MapGround::to_show(const Vec3& place) {
    const geo::Geodetic at{place.y, place.x, place.z + below_m_};
    if (!frame_) {
        geo::ShowOrigin origin{at, 0.0, std::nullopt};
        origin.ground.longitude_deg = std::remainder(at.longitude_deg, 360.0);
        frame_.emplace(origin);
    }
    return frame_->to_show(at);
}

Status take_tracks(RecordedShow& show, std::vector<MapTrack> tracks, std::optional<std::int64_t> start_us,
                   const std::string& file) {
    if (tracks.empty()) return Error{ErrorCode::invalid_input, file + ": holds no tracks"};
    std::int64_t first = std::numeric_limits<std::int64_t>::max(), last = std::numeric_limits<std::int64_t>::min();
    for (const MapTrack& track : tracks) {
        first = std::min(first, track.at_us.front());
        last = std::max(last, track.at_us.back());
    }
    const std::int64_t zero = start_us.value_or(first);
    if (first - zero < -kLongest_us || last - zero > kLongest_us)
        return Error{ErrorCode::invalid_input, file + ": times are more than ten days from the start"};
    std::vector<double> times_s;
    for (MapTrack& track : tracks) {
        times_s.clear();
        for (const std::int64_t us : track.at_us) times_s.push_back(static_cast<double>(us - zero) / 1e6);
        std::vector<std::int64_t>().swap(track.at_us);
        set_pieces(track.drone, times_s, std::move(track.places_m));
        if (track.drone.name.empty()) track.drone.name = drone_name(show.drones.size() + 1, tracks.size());
        show.duration_s = std::max(show.duration_s, times_s.back());
        show.drones.push_back(std::move(track.drone));
    }
    return Done{};
}

Status take_facts(RecordedShow& show, const std::string& file, std::string_view text) {
    const auto document = JsonDocument::parse(file, text);
    if (!document) return document.error();
    JsonProblem problem;
    read_facts(document->root(problem), show);
    if (problem.found()) return problem.error();
    return Done{};
}

std::optional<Vec3> parse_place(std::string_view text, double limit) {
    TextCursor cursor(text);
    Vec3 place{};
    place.x = cursor.number(limit);
    cursor.expect(" ");
    place.y = cursor.number(limit);
    cursor.expect(" ");
    place.z = cursor.number(limit);
    if (cursor.ok() && cursor.at_end()) return place;
    std::array<double, 3> numbers{};
    std::size_t count = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = text.find_first_not_of(" \t\r\n", at);
        if (begin == std::string_view::npos) break;
        at = std::min(text.find_first_of(" \t\r\n", begin), text.size());
        const auto number = parse_number(text.substr(begin, at - begin), limit);
        if (!number || count == numbers.size()) return std::nullopt;
        numbers[count++] = *number;
    }
    if (count != numbers.size()) return std::nullopt;
    return Vec3{numbers[0], numbers[1], numbers[2]};
}

}  // namespace aerogram::exporter
