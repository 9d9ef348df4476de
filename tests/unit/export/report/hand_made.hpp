#pragma once
#include <string>
#include <utility>
#include <vector>

#include "export/outgoing/outgoing_show.hpp"
#include "geo/random.hpp"

/// Shows made by hand, or at random, for the tests of the report's numbers.
namespace aerogram::exporter::hand_made {

class Show final : public OutgoingShow {
  public:
    Show() { facts_.title = "Hand-made"; }
    Show(Show&& other) noexcept
        : facts_(std::move(other.facts_)), flights_(std::move(other.flights_)), tracks_(std::move(other.tracks_)) {}

    /// A drone whose home is on the ground under where it begins, unless said.
    std::size_t add(Flight flight, std::optional<Vec3> home_m = {}) {
        const Vec3 begins = flight.controls_m.front();
        const Vec3 home = home_m.value_or(Vec3{begins.x, begins.y, 0.0});
        const std::size_t number = facts_.drones.size() + 1;
        facts_.drones.push_back({drone_name(number, 100), number, home, home});
        facts_.fleet = number;
        const Piece& last = flight.pieces.back();
        const auto end_ms = static_cast<Millis>((last.start_s + last.duration_s) * 1000.0 + 0.5);
        facts_.duration_ms = std::max(facts_.duration_ms, end_ms);
        facts_.acceleration_mps2 = std::max(facts_.acceleration_mps2, largest_acceleration_mps2(flight));
        flights_.push_back(std::move(flight));
        tracks_.emplace_back();
        return number - 1;
    }
    OutgoingFacts& set() { return facts_; }
    Tracks& set_tracks(std::size_t drone) { return tracks_[drone]; }

    [[nodiscard]] const OutgoingFacts& facts() const override { return facts_; }
    [[nodiscard]] const Tracks& tracks(std::size_t drone) const override { return tracks_[drone]; }
    [[nodiscard]] Flight flight(std::size_t drone) const override { return flights_[drone]; }
    [[nodiscard]] Fitted fitted(std::size_t /*drone*/) const override { return {}; }

  private:
    OutgoingFacts facts_;
    std::vector<Flight> flights_;
    std::vector<Tracks> tracks_;
};

/// Builds a flight piece by piece.
class Way {
  public:
    explicit Way(const Vec3& from) : at_(from) {}
    Way& piece(double duration_s, std::vector<Vec3> controls) {
        flight_.pieces.push_back({time_s_, duration_s, static_cast<std::uint32_t>(flight_.controls_m.size()),
                                  static_cast<std::uint8_t>(controls.size() - 1)});
        at_ = controls.back();
        time_s_ += duration_s;
        flight_.controls_m.insert(flight_.controls_m.end(), controls.begin(), controls.end());
        return *this;
    }
    Way& stand(double duration_s) { return piece(duration_s, {at_}); }
    /// At constant speed.
    Way& straight(double duration_s, const Vec3& to) { return piece(duration_s, {at_, to}); }
    /// From rest to rest.
    Way& smooth(double duration_s, const Vec3& to) { return piece(duration_s, {at_, at_, to, to}); }
    [[nodiscard]] Flight flight() const { return flight_; }
    operator Flight() const { return flight_; }  // NOLINT(google-explicit-constructor): that is what it is for

  private:
    Vec3 at_;
    double time_s_ = 0.0;
    Flight flight_;
};

inline Vec3 place(Random& random, double half_m) {
    const double x = random.between(-half_m, half_m), y = random.between(-half_m, half_m);
    return {x, y, random.between(6.0, 6.0 + half_m)};
}

/// Drones that take off from pads 3 m apart, fly from place to place in a box without regard for each other, and land.
inline Show random_show(std::size_t drones, std::size_t legs, double half_m, std::uint64_t seed) {
    Random random(seed);
    Show show;
    for (std::size_t d = 0; d < drones; ++d) {
        const Vec3 pad{3.0 * static_cast<double>(d), -10.0, 0.0};
        Way way(pad);
        way.stand(1.0 + 0.25 * static_cast<double>(d)).smooth(4.0, pad + Vec3{0.0, 0.0, 5.0});
        for (std::size_t l = 0; l < legs; ++l) {
            way.smooth(random.between(5.0, 8.0), place(random, half_m));
            if (random.between(0.0, 1.0) < 0.3) way.stand(random.between(0.5, 3.0));
        }
        way.smooth(8.0, pad + Vec3{0.0, 0.0, 5.0}).smooth(5.0, pad);
        show.add(way);
    }
    show.set().limits.speed_horizontal_mps = 8.0;
    return show;
}

}  // namespace aerogram::exporter::hand_made
