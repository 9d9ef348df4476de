#include "export/maps/track_corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kLeastFit_m = 0.002;
constexpr double kChordShare = 0.3, kThinShare = 0.65;  ///< of the fit; the rest is for jumps between milliseconds
constexpr double kKink_mps = 0.02;
constexpr std::array<Millis, 7> kSteps_ms{250, 200, 100, 50, 40, 20, 10};
constexpr std::size_t kLookedAt = 24;

/// Velocity where a piece begins or ends.
Vec3 end_velocity(const Flight& flight, const Piece& piece, bool at_end) {
    if (piece.degree == 0) return {};
    const std::size_t k = piece.first_control + (at_end ? piece.degree - std::size_t{1} : 0);
    return (static_cast<double>(piece.degree) / piece.duration_s) * (flight.controls_m[k + 1] - flight.controls_m[k]);
}

/// Times at which sampling has to stop: the given ones and jumps of the velocity; rising, from 0 to the last.
std::vector<Millis> stops(const Flight& flight, std::span<const Millis> given_ms) {
    std::vector<Millis> times(given_ms.begin(), given_ms.end());
    for (std::size_t k = 1; k < flight.pieces.size(); ++k) {
        const Vec3 jump =
            end_velocity(flight, flight.pieces[k], false) - end_velocity(flight, flight.pieces[k - 1], true);
        if (glm::dot(jump, jump) > kKink_mps * kKink_mps)
            times.push_back(std::llround(flight.pieces[k].start_s * 1000.0));
    }
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    std::erase_if(times, [&](Millis t) { return t < 0 || t > given_ms.back(); });
    return times;
}

}  // namespace

std::optional<MapCut> map_cut(const OutgoingFacts& facts) {
    const double fit_m = std::min(kMapFit_m, 0.5 * facts.limits.export_margin_m - std::sqrt(3.0) * kMapHalfDigit_m);
    if (fit_m < kLeastFit_m) return std::nullopt;
    const auto step_ms = sampling_step_ms(facts.acceleration_mps2, kChordShare * fit_m, kSteps_ms);
    if (!step_ms) return std::nullopt;
    return MapCut{*step_ms, kThinShare * fit_m};
}

std::vector<Corner> track_corners(const OutgoingShow& show, std::size_t drone, const MapCut& cut) {
    const OutgoingFacts& facts = show.facts();
    const Flight flight = show.flight(drone);
    std::array<Millis, 4> sections_ms{0, facts.takeoff_end_ms, facts.landing_begin_ms, facts.duration_ms};
    std::ranges::sort(sections_ms);
    const std::vector<Millis> stops_ms = stops(flight, sections_ms);
    std::vector<Millis> times_ms{0};
    for (std::size_t k = 1; k < stops_ms.size(); ++k) {
        const Millis from_ms = stops_ms[k - 1];
        for (const Millis t : sampling_times(stops_ms[k] - from_ms, cut.step_ms))
            if (t > 0) times_ms.push_back(from_ms + t);
    }
    const std::vector<Corner> corners = sampled(flight, times_ms);
    std::vector<Corner> kept{corners.front()};
    auto begin = corners.begin();
    for (const Millis until_ms : sections_ms) {
        const auto end = std::ranges::find(begin, corners.end(), until_ms, &Corner::time_ms);
        if (end == corners.end() || end == begin) continue;
        const std::vector<Corner> part = thinned({begin, end + 1}, cut.tolerance_m);
        kept.insert(kept.end(), part.begin() + 1, part.end());
        begin = end;
    }
    return kept;
}

double estimated_corners(const OutgoingShow& show, const MapCut& cut) {
    const std::size_t looked_at = std::min(kLookedAt, show.drones());
    double corners = 0.0;
    for (std::size_t k = 0; k < looked_at; ++k)
        corners += static_cast<double>(track_corners(show, k * show.drones() / looked_at, cut).size());
    return corners / static_cast<double>(std::max<std::size_t>(1, looked_at)) * static_cast<double>(show.drones());
}

Rounding map_rounding(const RecordedShow& show, double half_digit_m, double fit_m) {
    double shortest_s = 1.0;
    for (const RecordedDrone& drone : show.drones)
        for (const Piece& piece : drone.pieces) shortest_s = std::min(shortest_s, piece.duration_s);
    Rounding rounding;
    rounding.position_m = half_digit_m;
    rounding.fit_m = fit_m;
    rounding.speed_allowance_mps = 2.0 * std::sqrt(3.0) * half_digit_m / shortest_s;
    rounding.has_acceleration = false;
    return rounding;
}

void set_pieces(RecordedDrone& drone, const std::vector<double>& times_s, std::vector<Vec3> places_m) {
    drone.pieces.clear();
    drone.pieces.reserve(times_s.size());
    if (times_s.size() == 1) drone.pieces.push_back({times_s[0], 1.0, 0, 0});
    for (std::size_t k = 0; k + 1 < times_s.size(); ++k) {
        const bool stands = places_m[k] == places_m[k + 1];
        drone.pieces.push_back({times_s[k], times_s[k + 1] - times_s[k], static_cast<std::uint32_t>(k),
                                static_cast<std::uint8_t>(stands ? 0 : 1)});
    }
    drone.controls_m = std::move(places_m);
}

}  // namespace aerogram::exporter
