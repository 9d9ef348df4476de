#include "export/convert_compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "export/bytes/decimal.hpp"
#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kArithmetic_m = 1e-6;

Bezier piece_curve(const Flight& flight, const Piece& piece) {
    Bezier curve;
    curve.degree = piece.degree;
    for (std::size_t c = 0; c <= curve.degree; ++c) curve.control[c] = flight.controls_m[piece.first_control + c];
    return curve;
}

/// A polynomial on [from_s, to_s], or the point where the pieces end.
Bezier stretch(const Flight& flight, std::size_t k, double from_s, double to_s) {
    const Piece& piece = flight.pieces[k];
    const Bezier whole = piece_curve(flight, piece);
    const double u = std::clamp((from_s - piece.start_s) / piece.duration_s, 0.0, 1.0);
    const double v = std::clamp((to_s - piece.start_s) / piece.duration_s, 0.0, 1.0);
    if (u == 0.0 && v == 1.0) return whole;
    if (v <= u) {
        Bezier point;
        point.control[0] = value(whole, u);
        return point;
    }
    return restricted(whole, u, v);
}

constexpr double kResolved_m = 1e-5;
constexpr int kMostHalvings = 24;

/// An upper bound, to kResolved_m, of how long the curve's vector gets; no more is found out below `least_m`.
double longest(const Bezier& curve, double least_m, int halvings) {
    double hull_m = 0.0;
    for (const Vec3& p : curve.controls()) hull_m = std::max(hull_m, glm::length(p));
    const double attained_m = std::max(glm::length(curve.front()), glm::length(curve.back()));
    if (hull_m <= std::max(least_m, attained_m + kResolved_m) || halvings == 0) return hull_m;
    const auto [left, right] = split(curve, 0.5);
    const double first_m = longest(left, std::max(least_m, attained_m), halvings - 1);
    return std::max(first_m, longest(right, std::max(least_m, first_m), halvings - 1));
}

double farthest(const Bezier& a, const Bezier& b, double least_m) {
    Bezier difference = elevated(a, std::max(a.degree, b.degree));
    const Bezier other = elevated(b, difference.degree);
    for (std::size_t c = 0; c <= difference.degree; ++c) difference.control[c] -= other.control[c];
    return longest(difference, least_m, kMostHalvings);
}

/// Walks over all times at which either flight begins another piece.
Deviation of_one(const Flight& a, const Flight& b, double end_s) {
    Deviation worst;
    std::size_t i = 0, j = 0;
    /// When another polynomial (or the point before or behind all) begins, after at_s.
    const auto next_s = [end_s](const Flight& flight, std::size_t k, double at_s) {
        const Piece& piece = flight.pieces[k];
        if (at_s < piece.start_s) return piece.start_s;
        if (k + 1 < flight.pieces.size()) return flight.pieces[k + 1].start_s;
        const double over_s = piece.start_s + piece.duration_s;
        return at_s < over_s ? over_s : end_s;
    };
    for (double at_s = 0.0; at_s < end_s;) {
        const double to_s = std::max(at_s, std::min({next_s(a, i, at_s), next_s(b, j, at_s), end_s}));
        if (to_s > at_s) {
            const double off_m = farthest(stretch(a, i, at_s, to_s), stretch(b, j, at_s, to_s), worst.position_m);
            if (off_m > worst.position_m) worst = {off_m, 0, at_s};
        }
        if (to_s >= end_s) break;
        const auto follow = [to_s](const Flight& flight, std::size_t& k) {
            while (k + 1 < flight.pieces.size() && flight.pieces[k + 1].start_s <= to_s) ++k;
        };
        follow(a, i);
        follow(b, j);
        at_s = to_s;
    }
    return worst;
}

double fastest_mps(const OutgoingShow& show) {
    double fastest = 0.0;
    for (std::size_t i = 0; i < show.drones(); ++i) {
        const Flight flight = show.flight(i);
        for (const Piece& piece : flight.pieces)
            for (const Vec3& v : derivative(piece_curve(flight, piece)).controls())
                fastest = std::max(fastest, glm::length(v) / piece.duration_s);
    }
    return fastest;
}

/// The largest difference of any colour component; fades are linear, so it is at a key or just before one.
double light_difference(const std::vector<LightKey>& a, const std::vector<LightKey>& b) {
    std::vector<Millis> times;
    for (const auto* keys : {&a, &b})
        for (const LightKey& key : *keys) times.push_back(key.time_ms);
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    double worst = 0.0;
    for (const Millis ms : times) {
        for (const double t_s : {seconds_from_ms(ms) - 1e-6, seconds_from_ms(ms) + 1e-6}) {
            const Rgb x = light_at(a, t_s), y = light_at(b, t_s);
            worst = std::max({worst, std::abs(x.r - y.r), std::abs(x.g - y.g), std::abs(x.b - y.b)});
        }
    }
    return worst;
}

bool dark(const std::vector<LightKey>& keys) {
    return std::ranges::all_of(keys, [](const LightKey& key) { return key.color == Rgb{}; });
}

std::string counted(std::size_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// What is compared, one sentence each where it was lost.
class Losses {
  public:
    Losses(const OutgoingShow& show, const RecordedShow& given, const RecordedShow& read)
        : show_(show), given_(given), read_(read) {}

    std::vector<std::string> told(std::string_view stated) {
        if (!read_.timed) add("when anybody is where: it holds waypoints without times");
        lights();
        yaw_and_events();
        whole_show();
        pass_on(stated);
        return std::move(told_);
    }

  private:
    void add(std::string what) { told_.push_back(std::move(what)); }

    void lights() {
        double worst = 0.0;
        std::size_t lit = 0, lost = 0;
        for (std::size_t i = 0; i < show_.drones(); ++i) {
            const auto &before = show_.tracks(i).lights, &after = read_.drones[i].tracks.lights;
            if (dark(before)) continue;
            ++lit;
            if (dark(after)) ++lost;
            worst = std::max(worst, light_difference(before, after));
        }
        if (lit > 0 && lost == lit) return add("lights");
        std::array<char, 120> text{};
        std::snprintf(text.data(), text.size(), "lights: at moments they differ by up to %.0f/255",
                      std::ceil(worst * 255.0 - 1e-6));
        if (worst * 255.0 > 1.0 + 1e-6) add(text.data());
    }

    void yaw_and_events() {
        std::size_t turning = 0, turning_after = 0, events = 0, events_after = 0;
        for (std::size_t i = 0; i < show_.drones(); ++i) {
            const auto turns = [](const Tracks& t) { return !t.yaw.empty(); };
            if (turns(show_.tracks(i))) ++turning;
            if (turns(read_.drones[i].tracks)) ++turning_after;
            events += show_.tracks(i).events.size();
            events_after += read_.drones[i].tracks.events.size();
        }
        if (turning_after < turning) add("yaw of " + counted(turning - turning_after, "drone"));
        if (events_after < events) add(counted(events - events_after, "payload event"));
    }

    void whole_show() {
        const OutgoingFacts& facts = show_.facts();
        if (read_.cues.size() < facts.cues.size()) add(counted(facts.cues.size() - read_.cues.size(), "cue"));
        if (facts.origin && !read_.origin && read_.timed) add("the place on the globe (origin, heading)");
        if (given_.limits && !read_.limits) add("limits");
        const geo::Airspace& air = facts.airspace;
        const bool airspace = !air.geofence_m.empty() || !air.audience_m.empty() || !air.obstacles.empty();
        if (airspace && !read_.airspace) add("airspace (geofence, audience, obstacles)");
        if (given_.endurance_s && !read_.endurance_s) add("endurance");
        if (given_.show_hash && !read_.show_hash) add("show hash");
        if (given_.certified && !read_.certified) add("the mark that says whether it is certified");
        if (!facts.title.empty() && read_.title.empty()) add("title");
    }

    /// Parts of what the format states that speak of none of the above.
    void pass_on(std::string_view stated) {
        constexpr std::array<std::string_view, 24> kMeasured{
            "yaw",   "heading",   "event",    "payload", "pyro",     "cue",      "origin", "globe",
            "limit", "airspace",  "geofence", "fence",   "audience", "obstacle", "hash",   "light",
            "colo",  "endurance", "title",    "certif",  "time",     "when",     "audio",  "name"};
        constexpr std::array<std::string_view, 3> kBetween{", ", "; ", " and "};
        while (!stated.empty()) {
            std::size_t end = stated.size(), next = stated.size();
            for (const std::string_view mark : kBetween) {
                const std::size_t found = stated.find(mark);
                if (found < end) end = found, next = found + mark.size();
            }
            const std::string part(stated.substr(0, end));
            stated.remove_prefix(next);
            const bool measured = std::ranges::any_of(
                kMeasured, [&](std::string_view word) { return part.find(word) != std::string::npos; });
            if (!measured && part.find_first_not_of(' ') != std::string::npos && part != "nothing") add(part);
        }
    }

    const OutgoingShow& show_;
    const RecordedShow &given_, &read_;
    std::vector<std::string> told_;
};

}  // namespace

Result<Deviation> deviation(const OutgoingShow& show, const RecordedShow& read, const Run& run) {
    AEROGRAM_REQUIRE(read.drones.size() == show.drones(), read.drones.size(), show.drones());
    std::vector<Deviation> of(show.drones());
    parallel_for(show.drones(), run, "comparing", [&](std::size_t i) {
        const RecordedDrone& drone = read.drones[i];
        const double end_s = std::max(seconds_from_ms(show.facts().duration_ms), read.duration_s);
        of[i] = of_one(show.flight(i), Flight{drone.pieces, drone.controls_m}, end_s);
    });
    if (run.stopped()) return stopped_error();
    Deviation worst;
    for (std::size_t i = 0; i < of.size(); ++i)
        if (of[i].position_m > worst.position_m) worst = {of[i].position_m, i, of[i].time_s};
    return worst;
}

double stated_accuracy_m(const OutgoingShow& show, const RecordedShow& read) {
    const Rounding& r = read.rounding;
    const double late_m = r.time_s > 0.0 ? r.time_s * fastest_mps(show) : 0.0;
    return r.fit_m + std::sqrt(3.0) * r.position_m + late_m + kArithmetic_m;
}

std::vector<std::string> losses(const OutgoingShow& show, const RecordedShow& given, const RecordedShow& read,
                                std::string_view stated) {
    AEROGRAM_REQUIRE(read.drones.size() == show.drones(), read.drones.size(), show.drones());
    return Losses(show, given, read).told(stated);
}

}  // namespace aerogram::exporter
