#include <algorithm>
#include <array>
#include <cmath>

#include "export/report/chord_index.hpp"
#include "export/report/emergency.hpp"

/// One drone leaves the show and all others fly on. Three questions of one kind, each in a space that drifts as fast as
/// the drone rises or sinks: who comes near this place later?
namespace aerogram::exporter {
namespace {

constexpr std::size_t kSecondsATask = 8;
constexpr double kCrossing_m = 2.0;  ///< of the way home, looked at in one go

class OneLeaves {
  public:
    OneLeaves(const Survey& all, const EmergencyModel& model) : all_(all), model_(model) {
        for (const Place& p : all.places) highest_ = std::max(highest_, static_cast<double>(p.z));
    }

    /// Braking, standing, lying on the ground, crossing.
    void without_drift(const ChordIndex& index, std::size_t drone, std::size_t second, Manoeuvres& worst) const {
        const Stop stop = stop_of(all_, model_, drone, second);
        if (!stop.in_air) return;
        const double alarm_s = static_cast<double>(second);
        index.ask({drone, stop.stance, stop.hold, alarm_s + stop.brake_s}, worst.hold);
        const Stance down = stop.stance == Stance::above_pad ? Stance::on_pad : Stance::flying;
        index.ask({drone, down, landed(drone, stop), alarm_s + landed_s(drone, stop)}, worst.land);
        cross(index, drone, alarm_s, way_home(all_, model_, drone, stop), worst.back);
        stop_short(index, drone, alarm_s, stop, worst);
    }

    void sinking(const ChordIndex& index, std::size_t drone, std::size_t second, Manoeuvres& worst) const {
        const Stop stop = stop_of(all_, model_, drone, second);
        if (!stop.in_air) return;
        const double alarm_s = static_cast<double>(second);
        index.ask({drone, stop.stance, stop.hold, alarm_s + model_.wait_s, alarm_s + landed_s(drone, stop)},
                  worst.land);
        const Way way = way_home(all_, model_, drone, stop);
        index.ask({drone, Stance::above_pad, way.above_home, alarm_s + way.sink_s, alarm_s + way.home_s}, worst.back);
    }

    void rising(const ChordIndex& index, std::size_t drone, std::size_t second, Manoeuvres& worst) const {
        const Stop stop = stop_of(all_, model_, drone, second);
        if (!stop.in_air) return;
        const double alarm_s = static_cast<double>(second);
        const Way way = way_home(all_, model_, drone, stop);
        index.ask({drone, stop.stance, stop.hold, alarm_s + way.rise_s, alarm_s + way.cross_s}, worst.back);
    }

  private:
    [[nodiscard]] Vec3 landed(std::size_t drone, const Stop& stop) const {
        return {stop.hold.x, stop.hold.y, std::min(stop.hold.z, ground_z(all_, drone))};
    }
    [[nodiscard]] double landed_s(std::size_t drone, const Stop& stop) const {
        return model_.wait_s + (stop.hold.z - landed(drone, stop).z) / model_.land_mps;
    }

    /// From the alarm until it descends or rises: part of all three manoeuvres.
    void stop_short(const ChordIndex& index, std::size_t drone, double alarm_s, const Stop& stop,
                    Manoeuvres& worst) const {
        Found found;
        found.distance = std::max({worst.hold.distance, worst.land.distance, worst.back.distance});
        const double before = found.distance;
        for (double from_s = 0.0; from_s < stop.brake_s; from_s += all_.step_s()) {
            const double to_s = std::min(from_s + all_.step_s(), stop.brake_s);
            index.ask(Mover{stop.at(from_s), stop.at(to_s), alarm_s + from_s, alarm_s + to_s,
                            static_cast<std::uint32_t>(drone)},
                      Stance::flying, found);
        }
        index.ask({drone, stop.stance, stop.hold, alarm_s + stop.brake_s, alarm_s + model_.wait_s}, found);
        if (!(found.distance < before)) return;
        for (Found* each : {&worst.hold, &worst.land, &worst.back})
            each->note(found.distance, found.first, found.second, found.time_s);
    }

    void cross(const ChordIndex& index, std::size_t drone, double alarm_s, const Way& way, Found& found) const {
        index.ask({drone, Stance::on_pad, way.home, alarm_s + way.home_s}, found);
        if (way.high.z - highest_ > found.distance || alarm_s + way.cross_s > all_.duration_s) return;
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
    double highest_ = -std::numeric_limits<double>::infinity();
};

/// Everybody at every second; first those who were the worst a second ago, so that most others are soon seen to be
/// farther.
template <class Step>
void for_everybody(const Survey& all, const Run& run, std::string_view stage, std::vector<Manoeuvres>& worst,
                   const Step& step) {
    parallel_for((all.seconds + kSecondsATask - 1) / kSecondsATask, run, stage, [&](std::size_t task) {
        for (std::size_t s = task * kSecondsATask; s < std::min(all.seconds, (task + 1) * kSecondsATask); ++s) {
            if (s > task * kSecondsATask) {
                const Manoeuvres& before = worst[s - 1];
                for (const Found* found : {&before.hold, &before.land, &before.back}) step(found->first, s, worst[s]);
            }
            for (std::size_t d = 0; d < all.drones.size() && !run.stopped(); ++d) step(d, s, worst[s]);
        }
    });
}

}  // namespace

std::vector<Manoeuvres> one_leaves(const Survey& all, const EmergencyModel& model, const Run& run) {
    std::vector<Manoeuvres> worst(all.seconds);
    const OneLeaves one(all, model);
    {
        const ChordIndex index(all, 0.0, run);
        for_everybody(all, run, "one drone holds", worst,
                      [&](std::size_t d, std::size_t s, Manoeuvres& found) { one.without_drift(index, d, s, found); });
    }
    {
        const ChordIndex index(all, -model.land_mps, run);
        for_everybody(all, run, "one drone lands", worst,
                      [&](std::size_t d, std::size_t s, Manoeuvres& found) { one.sinking(index, d, s, found); });
    }
    const ChordIndex index(all, model.rise_mps, run);
    for_everybody(all, run, "one drone returns", worst,
                  [&](std::size_t d, std::size_t s, Manoeuvres& found) { one.rising(index, d, s, found); });
    return worst;
}

}  // namespace aerogram::exporter
