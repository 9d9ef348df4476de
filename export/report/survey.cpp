#include "export/report/survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kDronesATask = 64;
constexpr std::size_t kMostPlaces = 25'000'000;  ///< 300 MB
constexpr double kMissedWanted_m = 0.003;

Place narrow(const Vec3& p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

RecordedDrone recorded(const OutgoingShow& show, std::size_t drone) {
    Flight flight = show.flight(drone);
    const OutgoingDrone& facts = show.facts().drones[drone];
    RecordedDrone recorded;
    recorded.home_m = facts.home_m;
    recorded.land_m = facts.land_m;
    recorded.pieces = std::move(flight.pieces);
    recorded.controls_m = std::move(flight.controls_m);
    return recorded;
}

/// From when to when a drone is off the ground.
ReportTurn turn_of(const OutgoingDrone& facts, const std::vector<Stay>& stays, double duration_s) {
    ReportTurn turn{facts.number, 0.0, duration_s, facts.home_m, facts.land_m};
    const auto on_pad = [](const Stay& s) { return s.stance == Stance::on_pad; };
    if (!stays.empty() && on_pad(stays.front()) && stays.front().begin_s <= 0.0)
        turn.leaves_s = std::clamp(stays.front().end_s, 0.0, duration_s);
    if (!stays.empty() && on_pad(stays.back()) && stays.back().end_s >= duration_s)
        turn.lands_s = std::clamp(stays.back().begin_s, turn.leaves_s, duration_s);
    return turn;
}

/// What straight lines between instants miss a flight by: A dt² / 8 of its accelerations, and v dt / 4 of each jump of
/// its velocity by v.
double missed(const RecordedDrone& drone, double step_s) {
    double acceleration = 0.0, jumps = 0.0, in_step = 0.0;
    std::size_t step = 0;
    Vec3 velocity{};
    bool first = true;
    for (const Piece& piece : drone.pieces) {
        const Vec3* c = &drone.controls_m[piece.first_control];
        const double degree = piece.degree;
        const Vec3 begins = piece.degree == 0 ? Vec3{} : degree / piece.duration_s * (c[1] - c[0]);
        const auto now = static_cast<std::size_t>(std::max(0.0, piece.start_s) / step_s);
        if (now != step) in_step = 0.0, step = now;
        const double after_instant_s = piece.start_s - static_cast<double>(now) * step_s;
        const bool at_instant = std::min(after_instant_s, step_s - after_instant_s) < 1e-9;
        if (!first && !at_instant) in_step += glm::length(begins - velocity);
        first = false;
        jumps = std::max(jumps, in_step);
        velocity = piece.degree == 0 ? Vec3{} : degree / piece.duration_s * (c[piece.degree] - c[piece.degree - 1]);
        const double per_s2 = degree * (degree - 1.0) / (piece.duration_s * piece.duration_s);
        for (std::size_t i = 0; i + 2 <= piece.degree; ++i)
            acceleration = std::max(acceleration, per_s2 * glm::length(c[i + 2] - 2.0 * c[i + 1] + c[i]));
    }
    return acceleration * step_s * step_s / 8.0 + jumps * step_s / 4.0;
}

Vec3 middle_of(const OutgoingShow& show) {
    Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const OutgoingDrone& d : show.facts().drones) low = glm::min(low, d.home_m), high = glm::max(high, d.home_m);
    return 0.5 * (low + high);
}

/// Fills in one drone's rows. @returns what straight lines miss it by, rounding included.
double sample(const RecordedDrone& drone, std::size_t d, Survey& into) {
    const Flight flight{drone.pieces, drone.controls_m};
    FlightCursor cursor(flight);
    double farthest = 0.0;
    for (std::size_t k = 0; k < into.instants; ++k) {
        const double t_s = std::min(static_cast<double>(k) * into.step_s(), into.duration_s);
        const Vec3 p = into.to_metric(cursor.position_at(t_s));
        farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        into.places[d * into.instants + k] = narrow(p);
    }
    FlightCursor again(flight);
    for (std::size_t s = 0; s < into.seconds; ++s) {
        const Vec3 v = again.state_at(static_cast<double>(s)).velocity_mps;
        into.speeds[d * into.seconds + s] = narrow({v.x, v.y, v.z / into.downwash});
    }
    constexpr double kFloat = 1.0 / (1 << 23);
    return missed(drone, into.step_s()) + kFloat * farthest;
}

}  // namespace

std::size_t steps_a_second(std::size_t drones, double seconds, double acceleration_mps2) {
    std::size_t steps = 1;
    for (const std::size_t more : {2U, 4U, 5U, 8U, 10U, 20U}) {
        const double miss = acceleration_mps2 / (8.0 * static_cast<double>(steps * steps));
        const double places = static_cast<double>(drones) * (seconds * static_cast<double>(more) + 2.0);
        if (miss <= kMissedWanted_m || places > static_cast<double>(kMostPlaces)) break;
        steps = more;
    }
    return steps;
}

Vec3 Survey::place_at(std::size_t drone, double t_s) const {
    const double at = std::clamp(t_s, 0.0, duration_s) * static_cast<double>(steps_a_second);
    const std::size_t k = std::min(static_cast<std::size_t>(at), instants - 1);
    if (k + 1 == instants) return wide(place(drone, k));
    const double end = std::min(static_cast<double>(k + 1), duration_s * static_cast<double>(steps_a_second));
    const double length = end - static_cast<double>(k);
    const double u = length > 0.0 ? std::min(1.0, (at - static_cast<double>(k)) / length) : 0.0;
    return (1.0 - u) * wide(place(drone, k)) + u * wide(place(drone, k + 1));
}

Stance Survey::stance(std::size_t drone, double t_s) const {
    const std::vector<Stay>& stays = drones[drone].stays;
    auto after = std::ranges::upper_bound(stays, t_s, {}, &Stay::begin_s);
    if (after == stays.begin()) return Stance::flying;
    const Stay& last = *std::prev(after);
    return t_s <= last.end_s ? last.stance : Stance::flying;
}

Survey survey(const OutgoingShow& show, const std::vector<double>& times_s, const Run& run) {
    const OutgoingFacts& facts = show.facts();
    Survey all;
    all.duration_s = seconds_from_ms(facts.duration_ms);
    all.downwash = facts.limits.downwash;
    all.middle_m = middle_of(show);
    all.steps_a_second = steps_a_second(show.drones(), all.duration_s,
                                        std::max(facts.acceleration_mps2, facts.limits.acceleration_mps2));
    all.instants = static_cast<std::size_t>(std::ceil(all.duration_s / all.step_s() - 1e-9)) + 1;
    all.seconds = static_cast<std::size_t>(all.duration_s) + 1;
    all.places.resize(show.drones() * all.instants);
    all.speeds.resize(show.drones() * all.seconds);
    all.drones.resize(show.drones());
    const bool planes = facts.limits.plane.has_value();
    std::vector<double> missed_m(show.drones());
    const std::size_t tasks = (show.drones() + kDronesATask - 1) / kDronesATask;
    std::vector<SeriesMaker> made(std::max(1U, run.threads) * 2, SeriesMaker(times_s, planes));
    parallel_for(made.size(), run, "surveying the flights", [&](std::size_t part) {
        for (std::size_t task = part; task < tasks && !run.stopped(); task += made.size()) {
            for (std::size_t d = task * kDronesATask; d < std::min(show.drones(), (task + 1) * kDronesATask); ++d) {
                const RecordedDrone drone = recorded(show, d);
                missed_m[d] = sample(drone, d, all);
                Surveyed& found = all.drones[d];
                found.stays = stays(drone, kStraightAbove_m);
                found.places = places_of(drone);
                found.turn = turn_of(facts.drones[d], found.stays, all.duration_s);
                found.energy_s = hover_seconds(drone, found.stays, planes);
                made[part].add(drone, facts.drones[d].home_m.z);
            }
        }
    });
    all.missed_m = *std::ranges::max_element(missed_m);
    for (std::size_t part = 1; part < made.size(); ++part) made[0].add(made[part]);
    all.series = made[0].series(facts.limits);
    return all;
}

}  // namespace aerogram::exporter
