#include "export/outgoing/read_show.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "export/bytes/utf8.hpp"
#include "export/outgoing/piecewise_fit.hpp"
#include "export/record/stands.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kHighestNumber = 100'000;
constexpr std::size_t kLongestName = 80;

Error invalid(std::string message) {
    return {ErrorCode::invalid_input, std::move(message)};
}

std::optional<std::size_t> number_in(const std::string& name) {
    const std::size_t last = name.find_last_of("0123456789");
    if (last == std::string::npos) return std::nullopt;
    std::size_t first = last;
    while (first > 0 && name[first - 1] >= '0' && name[first - 1] <= '9') --first;
    if (last - first + 1 > 9) return std::nullopt;
    const std::size_t number = std::stoul(name.substr(first, last - first + 1));
    return number >= 1 && number <= kHighestNumber ? std::optional(number) : std::nullopt;
}

/// Whether a name can be a file's everywhere.
bool names_a_file(const std::string& name) {
    if (name.empty() || name.size() > kLongestName || name.front() == '.' || name.back() == '.' || !is_plain_utf8(name))
        return false;
    if (name.front() == ' ' || name.back() == ' ') return false;
    return name.find_first_of("/\\:*?\"<>|,") == std::string::npos;
}

std::string lower(std::string text) {
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

/// Pieces from 0 to the end: what came before 0 is cut off, and first and last points are held.
void complete(RecordedDrone& drone, double duration_s) {
    const auto hold = [&](double from_s, double to_s, const Vec3& place_m) {
        drone.controls_m.push_back(place_m);
        return Piece{from_s, to_s - from_s, static_cast<std::uint32_t>(drone.controls_m.size() - 1), 0};
    };
    constexpr double kSameTime_s = 1e-6;
    while (drone.pieces.size() > 1 && drone.pieces[1].start_s <= 0.0) drone.pieces.erase(drone.pieces.begin());
    Piece& first = drone.pieces.front();
    if (first.start_s < 0.0) {
        const double cut = std::min(-first.start_s / first.duration_s, 1.0);
        if (cut >= 1.0) {
            first = hold(0.0, std::max(duration_s, kSameTime_s), last_position(drone));
        } else {
            const Bezier rest = restricted(curve_of(drone, first), cut, 1.0);
            first = {0.0, (1.0 - cut) * first.duration_s, static_cast<std::uint32_t>(drone.controls_m.size()),
                     first.degree};
            drone.controls_m.insert(drone.controls_m.end(), rest.control.begin(),
                                    rest.control.begin() + static_cast<std::ptrdiff_t>(rest.degree) + 1);
        }
    } else if (first.start_s > kSameTime_s) {
        drone.pieces.insert(drone.pieces.begin(), hold(0.0, first.start_s, first_position(drone)));
    }
    const double end = end_s(drone);
    if (end < duration_s - kSameTime_s) drone.pieces.push_back(hold(end, duration_s, last_position(drone)));
}

/// What one drone's flight says of the whole show.
struct DroneMotion {
    double aside_from_s = 0.0, aside_to_s = 0.0;  ///< when it is not straight above its first and last points
    double acceleration_mps2 = 0.0;
};

DroneMotion motion_of(const RecordedDrone& drone, const Flight& flight, double duration_s, double tolerance_m) {
    DroneMotion motion{duration_s, 0.0, largest_acceleration_mps2(flight)};
    const Vec3 first = first_position(drone), last = last_position(drone);
    const auto aside = [&](const Piece& piece, const Vec3& place) {
        for (std::size_t c = 0; c <= piece.degree; ++c)
            if (glm::length(Vec2(drone.controls_m[piece.first_control + c] - place)) > tolerance_m) return true;
        return false;
    };
    double jumps_mps2 = 0.0;
    Vec3 before_mps{};
    double before_s = 0.0;
    for (const Piece& piece : drone.pieces) {
        if (aside(piece, first)) motion.aside_from_s = std::min(motion.aside_from_s, piece.start_s);
        if (aside(piece, last)) motion.aside_to_s = std::max(motion.aside_to_s, piece.start_s + piece.duration_s);
        const Bezier speed = derivative(curve_of(drone, piece));
        const double jump_mps = before_s > 0.0 ? glm::length(speed.front() / piece.duration_s - before_mps) : 0.0;
        before_mps = speed.back() / piece.duration_s;
        // Chords of dt miss a jump by up to jump dt / 4, and many by their average as well: as much as this
        // acceleration would, for dt >= kShortestChord_s.
        constexpr double kShortestChord_s = 0.05;
        jumps_mps2 = std::max(jumps_mps2, jump_mps * (2.0 / kShortestChord_s + 2.0 / (before_s + piece.duration_s)));
        before_s = piece.duration_s;
    }
    motion.acceleration_mps2 += jumps_mps2;
    return motion;
}

}  // namespace

std::vector<std::size_t> numbers_of(const std::vector<RecordedDrone>& drones) {
    std::vector<std::size_t> numbers, places;
    for (const RecordedDrone& drone : drones) {
        places.push_back(places.size() + 1);
        if (const auto number = number_in(drone.name)) numbers.push_back(*number);
    }
    const std::set<std::size_t> distinct(numbers.begin(), numbers.end());
    return distinct.size() == drones.size() ? numbers : places;
}

Result<std::unique_ptr<ReadShow>> ReadShow::of(RecordedShow show, const ReadShowOptions& options, const Run& run) {
    if (!show.timed)
        return invalid(
            "says where, not when: waypoints without times cannot become a flight; convert a file with "
            "times (trajectories.bin, .skyc, csv.zip...) instead");
    if (show.drones.empty()) return invalid("holds no drones");
    if (const Status sound = well_formed(show); !sound) return sound.error();
    std::unique_ptr<ReadShow> result(new ReadShow);
    result->show_ = std::move(show);
    result->take_facts(options);
    result->note_drones();
    if (!options.drones.empty()) {
        std::vector<RecordedDrone> kept;
        std::vector<OutgoingDrone> facts;
        for (const std::size_t number : options.drones) {
            const auto found = std::ranges::find(result->facts_.drones, number, &OutgoingDrone::number);
            if (found == result->facts_.drones.end()) return invalid("has no drone " + std::to_string(number));
            const auto i = static_cast<std::size_t>(found - result->facts_.drones.begin());
            facts.push_back(std::move(*found));
            found->number = 0;
            kept.push_back(std::move(result->show_.drones[i]));
        }
        result->show_.drones = std::move(kept);
        result->facts_.drones = std::move(facts);
    }
    const double duration_s = seconds_from_ms(result->facts_.duration_ms);
    for (RecordedDrone& drone : result->show_.drones) complete(drone, duration_s);
    const auto standing = stands(result->show_, run);
    if (!standing) return standing.error();
    for (const Stand& stand : *standing) {
        if (!stand.aloft) continue;
        OutgoingFacts& facts = result->facts_;
        facts.keyframes.push_back({{}, stand.from_ms, stand.to_ms, stand.places_m});
        const auto cue = std::ranges::find_if(facts.cues, [&](const Cue& c) {
            return c.time_ms >= stand.from_ms - 1000 && c.time_ms <= stand.to_ms && !c.name.empty();
        });
        facts.keyframes.back().name =
            cue != facts.cues.end() ? cue->name : "formation " + std::to_string(facts.keyframes.size());
    }
    result->note_motion(run);
    if (run.stopped()) return stopped_error();
    return result;
}

void ReadShow::take_facts(const ReadShowOptions& options) {
    facts_.title = show_.title;
    facts_.fleet = show_.drones.size();
    facts_.origin = options.origin ? options.origin : show_.origin;
    facts_.limits = show_.limits.value_or(Limits{});
    facts_.airspace = show_.airspace.value_or(geo::Airspace{});
    facts_.endurance_s = show_.endurance_s.value_or(facts_.endurance_s);
    double end = show_.duration_s;
    for (const RecordedDrone& drone : show_.drones) end = std::max(end, end_s(drone));
    facts_.duration_ms = std::max<Millis>(1, static_cast<Millis>(std::ceil(end * 1000.0 - 1e-3)));
    facts_.cues = show_.cues;
    facts_.exporting = options.exporting;
    if (!show_.limits) assumed_.emplace_back("limits are those of the standard preset: it states none");
    if (!facts_.origin) assumed_.emplace_back("its place on the globe is not known");
}

void ReadShow::note_drones() {
    const std::vector<std::size_t> numbers = numbers_of(show_.drones);
    std::set<std::string> names;
    bool usable = true, stated = true;
    for (std::size_t i = 0; i < show_.drones.size(); ++i) {
        const RecordedDrone& drone = show_.drones[i];
        usable = usable && names_a_file(drone.name) && names.insert(lower(drone.name)).second;
        stated = stated && drone.home_m && drone.land_m;
        facts_.fleet = std::max(facts_.fleet, numbers[i]);
        facts_.drones.push_back({drone.name, numbers[i], drone.home_m.value_or(first_position(drone)),
                                 drone.land_m.value_or(last_position(drone))});
    }
    if (!stated) assumed_.emplace_back("homes and landing places are where drones begin and end");
    if (usable) return;
    for (OutgoingDrone& drone : facts_.drones) drone.name = drone_name(drone.number, facts_.fleet);
    assumed_.emplace_back("drones are named drone-001, ...: their names could not all name files");
}

void ReadShow::note_motion(const Run& run) {
    std::vector<DroneMotion> motions(drones());
    const double duration_s = seconds_from_ms(facts_.duration_ms);
    const double tolerance_m = standing_tolerance_m(show_.rounding);
    parallel_for(drones(), run, "reading",
                 [&](std::size_t i) { motions[i] = motion_of(show_.drones[i], flight(i), duration_s, tolerance_m); });
    double from_s = duration_s, to_s = 0.0;
    for (const DroneMotion& motion : motions) {
        from_s = std::min(from_s, motion.aside_from_s);
        to_s = std::max(to_s, motion.aside_to_s);
        facts_.acceleration_mps2 = std::max(facts_.acceleration_mps2, motion.acceleration_mps2);
    }
    facts_.takeoff_end_ms = static_cast<Millis>(std::floor(from_s * 1000.0 + 1e-3));
    facts_.landing_begin_ms = std::min(facts_.duration_ms, static_cast<Millis>(std::ceil(to_s * 1000.0 - 1e-3)));
    facts_.rides = facts_.keyframes.empty();
    if (facts_.takeoff_end_ms > facts_.landing_begin_ms) {  // nobody ever moves sideways
        facts_.takeoff_end_ms = facts_.rides ? 0 : facts_.keyframes.front().stands_from_ms;
        facts_.landing_begin_ms = facts_.rides ? facts_.duration_ms : facts_.keyframes.back().stands_to_ms;
    }
}

const Tracks& ReadShow::tracks(std::size_t drone) const {
    return show_.drones[drone].tracks;
}

Flight ReadShow::flight(std::size_t drone) const {
    return {show_.drones[drone].pieces, show_.drones[drone].controls_m};
}

Fitted ReadShow::fitted(std::size_t drone) const {
    Fitted fitted = piecewise_fit(flight(drone), facts_.duration_ms, facts_.limits);
    // Speeds of a file of straight lines are those of its chords: a smooth curve beside them has others, and should.
    if (!show_.rounding.has_acceleration) fitted.error.speed_mps = fitted.error.acceleration_mps2 = 0.0;
    return fitted;
}

}  // namespace aerogram::exporter
