#include <algorithm>
#include <array>
#include <cmath>

#include "export/report/chord_index.hpp"
#include "export/report/emergency.hpp"

/// One drone leaves the show and all others fly on. Three questions of one kind, each in a space that drifts as fast as
/// the drone rises or sinks: who comes near this place later?
namespace aerogram::exporter {
namespace {

constexpr std::size_t kSecondsATask = 24;
constexpr double kCrossing_m = 2.0;  ///< of the way home, looked at in one go

/// What a question at an earlier second has shown. Who stays where it was, from then or from later on, is met by nobody
/// whom it was not met by before; and distances change by no more than it moves.
struct Known {
    Vec3 at{};
    double begin_s = 0.0, least = -1.0;
    Stance stance = Stance::flying;

    /// The same as index.ask, of a drone that stays without end.
    void ask(const ChordIndex& index, const ChordIndex::Question& q, Found& found) {
        if (q.begin_s >= begin_s && q.stance == stance && least - glm::length(q.at - at) >= found.distance) return;
        index.ask(q, found);
        *this = {q.at, q.begin_s, found.distance, q.stance};
    }
};
/// Of one drone, from second to second.
struct Memory {
    Known hold, land, home;
};

class OneLeaves {
  public:
    OneLeaves(const Survey& all, const EmergencyModel& model)
        : all_(all), model_(model), enough_(resolution_m(all, model)) {
        for (const Place& p : all.places) highest_ = std::max(highest_, static_cast<double>(p.z));
    }

    /// Standing, lying on the ground, crossing.
    void without_drift(const ChordIndex& index, std::size_t drone, std::size_t second, Memory& memory,
                       Manoeuvres& worst) const {
        const Stop stop = stop_of(all_, model_, drone, second);
        if (!stop.in_air) return;
        const double alarm_s = static_cast<double>(second);
        ask(memory.hold, index, {drone, stop.stance, stop.hold, alarm_s + stop.brake_s}, worst.hold);
        const Stance down = stop.stance == Stance::above_pad ? Stance::on_pad : Stance::flying;
        ask(memory.land, index, {drone, down, landed(drone, stop), alarm_s + landed_s(drone, stop)}, worst.land);
        const Way way = way_home(all_, model_, drone, stop);
        ask(memory.home, index, {drone, Stance::on_pad, way.home, alarm_s + way.home_s}, worst.back);
        cross(index, drone, alarm_s, way, worst.back);
    }

    void sinking(const ChordIndex& index, std::size_t drone, std::size_t second, Manoeuvres& worst) const {
        const Stop stop = stop_of(all_, model_, drone, second);
        if (!stop.in_air) return;
        const double alarm_s = static_cast<double>(second);
        ask(index, {drone, stop.stance, stop.hold, alarm_s + model_.wait_s, alarm_s + landed_s(drone, stop)},
            worst.land);
        const Way way = way_home(all_, model_, drone, stop);
        ask(index, {drone, Stance::above_pad, way.above_home, alarm_s + way.sink_s, alarm_s + way.home_s}, worst.back);
    }

    void rising(const ChordIndex& index, std::size_t drone, std::size_t second, Manoeuvres& worst) const {
        const Stop stop = stop_of(all_, model_, drone, second);
        if (!stop.in_air) return;
        const double alarm_s = static_cast<double>(second);
        const Way way = way_home(all_, model_, drone, stop);
        ask(index, {drone, stop.stance, stop.hold, alarm_s + way.rise_s, alarm_s + way.cross_s}, worst.back);
    }

  private:
    void ask(Known& known, const ChordIndex& index, const ChordIndex::Question& question, Found& found) const {
        if (found.distance > enough_) known.ask(index, question, found);
    }
    void ask(const ChordIndex& index, const ChordIndex::Question& question, Found& found) const {
        if (found.distance > enough_) index.ask(question, found);
    }
    [[nodiscard]] Vec3 landed(std::size_t drone, const Stop& stop) const {
        return {stop.hold.x, stop.hold.y, std::min(stop.hold.z, ground_z(all_, drone))};
    }
    [[nodiscard]] double landed_s(std::size_t drone, const Stop& stop) const {
        return model_.wait_s + (stop.hold.z - landed(drone, stop).z) / model_.land_mps;
    }

    void cross(const ChordIndex& index, std::size_t drone, double alarm_s, const Way& way, Found& found) const {
        if (way.high.z - highest_ > found.distance || alarm_s + way.cross_s > all_.duration_s) return;
        if (found.distance <= enough_) return;
        const double length = glm::length(way.above_home - way.high), pieces = std::ceil(length / kCrossing_m);
        for (double p = 0.0; p < pieces; p += 1.0) {
            const double u = p / pieces, v = (p + 1.0) / pieces;
            const double span_s = way.sink_s - way.cross_s;
            index.ask(Mover{glm::mix(way.high, way.above_home, u), glm::mix(way.high, way.above_home, v),
                            alarm_s + way.cross_s + u * span_s, alarm_s + way.cross_s + v * span_s,
                            static_cast<std::uint32_t>(drone)},
                      Stance::flying, found);
        }
    }

    const Survey& all_;
    const EmergencyModel& model_;
    double enough_;  ///< closer is reported as touching
    double highest_ = -std::numeric_limits<double>::infinity();
};

/// From the alarm until the drone that left descends or rises: part of all three manoeuvres. One drone that brakes
/// among the others that fly on, for each of them at once, step by step.
class Braking {
  public:
    Braking(const Survey& all, const EmergencyModel& model)
        : all_(all), model_(model), enough_(resolution_m(all, model)) {}

    void at(std::size_t second, Manoeuvres& worst) {
        const double alarm_s = static_cast<double>(second);
        stops_.clear();
        for (std::size_t d = 0; d < all_.drones.size(); ++d) stops_.push_back(stop_of(all_, model_, d, second));
        Found found;
        found.distance = std::max({worst.hold.distance, worst.land.distance, worst.back.distance});
        if (!std::isfinite(found.distance) || found.distance <= enough_) return;
        for (double from_s = 0.0; from_s < model_.wait_s - 1e-9; from_s += all_.step_s())
            step(alarm_s, from_s, std::min(from_s + all_.step_s(), model_.wait_s), found);
        for (Found* each : {&worst.hold, &worst.land, &worst.back})
            each->note(found.distance, found.first, found.second, found.time_s);
    }

    /// The closest pair at the alarm itself, of which one at least is in the air: no manoeuvre does better.
    void begin(std::size_t second, Found& found) {
        movers_.clear();
        stops_.clear();
        for (std::uint32_t d = 0; d < all_.drones.size(); ++d) {
            stops_.push_back(stop_of(all_, model_, d, second));
            const double t_s = static_cast<double>(second);
            movers_.push_back({stops_.back().from, stops_.back().from, t_s, t_s, d});
        }
        const auto note = [&](std::size_t i, std::size_t j) {
            const double distance = glm::length(movers_[i].from - movers_[j].from);
            if (!(distance < found.distance) || !(stops_[i].in_air || stops_[j].in_air)) return;
            const double t_s = static_cast<double>(second);
            const std::size_t first = stops_[i].in_air ? i : j;
            if (!all_.excuses(i, j, t_s)) found.note(distance, first, i + j - first, t_s);
        };
        for (std::size_t d = 0; d + 1 < movers_.size(); ++d) note(d, d + 1);
        for (std::size_t i = 0; i < stops_.size() && !std::isfinite(found.distance); ++i) {
            if (!stops_[i].in_air) continue;
            for (std::size_t j = 0; j < stops_.size(); ++j)
                if (j != i) note(i, j);
        }
        if (!std::isfinite(found.distance)) return;
        grid_.search(movers_, found.distance, [&](std::size_t i, std::size_t j) {
            note(i, j);
            return found.distance;
        });
    }

  private:
    /// Those that brake first, then all as they fly on.
    void step(double alarm_s, double from_s, double to_s, Found& found) {
        movers_.clear();
        bool moves = false;
        for (std::uint32_t d = 0; d < stops_.size(); ++d) {
            if (!stops_[d].in_air) continue;
            movers_.push_back({stops_[d].at(from_s), stops_[d].at(to_s), alarm_s + from_s, alarm_s + to_s, d});
            moves = moves || movers_.back().from != movers_.back().to;
        }
        const std::size_t braking = movers_.size();
        for (std::uint32_t d = 0; d < stops_.size(); ++d) {
            movers_.push_back({all_.place_at(d, alarm_s + from_s), all_.place_at(d, alarm_s + to_s), alarm_s + from_s,
                               alarm_s + to_s, d});
            moves = moves || movers_.back().from != movers_.back().to;
        }
        if (!moves && from_s > 0.0) return;
        grid_.search(movers_, found.distance, [&](std::size_t i, std::size_t j) {
            if (i >= braking || j < braking || movers_[i].drone == movers_[j].drone) return found.distance;
            const Nearest near = closest_approach(movers_[i], movers_[j]);
            if (!(near.distance_m < found.distance)) return found.distance;
            const Stop& stop = stops_[movers_[i].drone];
            const Stance stance = near.u - alarm_s < stop.brake_s ? Stance::flying : stop.stance;
            const std::uint32_t other = movers_[j].drone;
            if (!all_.excuses(movers_[i].drone, stance, other, all_.stance(other, near.u)))
                found.note(near.distance_m, movers_[i].drone, other, near.u);
            return found.distance;
        });
    }

    const Survey& all_;
    const EmergencyModel& model_;
    double enough_;
    std::vector<Stop> stops_;
    std::vector<Mover> movers_;
    PairGrid grid_;
};

/// Each second on its own.
template <class Step>
void for_seconds(const Survey& all, const EmergencyModel& model, const Run& run, std::string_view stage,
                 const Step& step) {
    parallel_for((all.seconds + kSecondsATask - 1) / kSecondsATask, run, stage, [&](std::size_t task) {
        Braking braking(all, model);
        for (std::size_t s = task * kSecondsATask; s < std::min(all.seconds, (task + 1) * kSecondsATask); ++s) {
            if (run.stopped()) return;
            step(braking, s);
        }
    });
}

/// Everybody at every second; first those who were the worst a second ago, so that most others are soon seen to be
/// farther.
template <class Step>
void for_everybody(const Survey& all, const Run& run, std::string_view stage, std::vector<Manoeuvres>& worst,
                   const Step& step) {
    parallel_for((all.seconds + kSecondsATask - 1) / kSecondsATask, run, stage, [&](std::size_t task) {
        std::vector<Memory> memory(all.drones.size());
        for (std::size_t s = task * kSecondsATask; s < std::min(all.seconds, (task + 1) * kSecondsATask); ++s) {
            const auto ask = [&](std::size_t d) { step(d, s, memory[d], worst[s]); };
            if (s > task * kSecondsATask) {
                const Manoeuvres& before = worst[s - 1];
                for (const Found* found : {&before.hold, &before.land, &before.back}) ask(found->first);
            }
            for (std::size_t d = 0; d < all.drones.size() && !run.stopped(); ++d) ask(d);
        }
    });
}

}  // namespace

std::vector<Manoeuvres> one_leaves(const Survey& all, const EmergencyModel& model, const Run& run) {
    std::vector<Manoeuvres> worst(all.seconds);
    for_seconds(all, model, run, "one drone leaves", [&](Braking& braking, std::size_t s) {
        Found found;
        braking.begin(s, found);
        worst[s] = {found, found, found};
    });
    const OneLeaves one(all, model);
    {
        const ChordIndex index(all, 0.0, run);
        for_everybody(all, run, "one drone holds", worst,
                      [&](std::size_t d, std::size_t s, Memory& memory, Manoeuvres& found) {
                          one.without_drift(index, d, s, memory, found);
                      });
    }
    {
        const ChordIndex index(all, -model.land_mps, run);
        for_everybody(all, run, "one drone lands", worst,
                      [&](std::size_t d, std::size_t s, Memory& /*none*/, Manoeuvres& found) {
                          one.sinking(index, d, s, found);
                      });
    }
    {
        const ChordIndex index(all, model.rise_mps, run);
        for_everybody(
            all, run, "one drone returns", worst,
            [&](std::size_t d, std::size_t s, Memory& /*none*/, Manoeuvres& found) { one.rising(index, d, s, found); });
    }
    for_seconds(all, model, run, "one drone brakes", [&](Braking& braking, std::size_t s) { braking.at(s, worst[s]); });
    return worst;
}

}  // namespace aerogram::exporter
