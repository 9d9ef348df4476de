#include <algorithm>
#include <cmath>

#include "export/report/emergency.hpp"

/// Everybody leaves the show at once. Only the manoeuvres count then, so that a second at which all stand as they did a
/// second ago needs no new search.
namespace aerogram::exporter {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr std::size_t kSecondsATask = 8;
constexpr double kCrossing_m = 3.0;  ///< of the way home in one step of time

class AllLeave {
  public:
    AllLeave(const Survey& all, const EmergencyModel& model)
        : all_(all), model_(model), enough_(resolution_m(all, model)) {}

    void at(std::size_t second, Manoeuvres& found) {
        const double alarm_s = static_cast<double>(second);
        const std::size_t n = all_.drones.size();
        std::vector<Stop> before = std::move(stops_);
        stops_.clear();
        for (std::size_t d = 0; d < n; ++d) stops_.push_back(stop_of(all_, model_, d, second));
        if (same_as(before)) {
            found = last_;
            for (Found* each : {&found.hold, &found.land, &found.back}) each->time_s += 1.0;
        } else {
            found = {};
            hold(found.hold);
            found.land = found.back = found.hold;
            land(found.land);
            back(found.back);
            for (Found* each : {&found.hold, &found.land, &found.back}) each->time_s += alarm_s;
        }
        last_ = found;
    }

  private:
    [[nodiscard]] bool same_as(const std::vector<Stop>& before) const {
        return before.size() == stops_.size() && std::ranges::equal(before, stops_, [](const Stop& a, const Stop& b) {
                   return a.from == b.from && a.speed_mps == b.speed_mps && a.in_air == b.in_air &&
                          a.stance == b.stance;
               });
    }
    [[nodiscard]] bool counts(std::size_t i, std::size_t j) const {
        return !all_.excuses(i, stops_[i].stance, j, stops_[j].stance);
    }

    /// Some pair that counts, at the alarm: where the search begins.
    void begin(Found& found) const {
        std::size_t last = stops_.size();
        for (std::size_t d = 0; d < stops_.size(); ++d) {
            if (!stops_[d].in_air) continue;
            if (last < d) found.note(glm::length(stops_[d].from - stops_[last].from), last, d, 0.0);
            last = d;
        }
        if (last == stops_.size() || std::isfinite(found.distance)) return;
        for (std::size_t d = 0; d < stops_.size(); ++d) {
            if (d != last && counts(last, d)) found.note(glm::length(stops_[d].from - stops_[last].from), last, d, 0.0);
        }
    }

    void hold(Found& found) {
        begin(found);
        if (!std::isfinite(found.distance)) return;
        double longest_s = 0.0;
        for (const Stop& stop : stops_) longest_s = std::max(longest_s, stop.brake_s);
        for (double from_s = 0.0; from_s == 0.0 || from_s < longest_s; from_s += all_.step_s()) {
            movers_.clear();
            const double to_s = std::min(from_s + all_.step_s(), longest_s);
            for (std::uint32_t d = 0; d < stops_.size(); ++d)
                movers_.push_back({stops_[d].at(from_s), stops_[d].at(to_s), from_s, to_s, d});
            grid_.search(movers_, found.distance, [&](std::size_t i, std::size_t j) {
                const Nearest near = closest_approach(movers_[i], movers_[j]);
                if (near.distance_m < found.distance && counts(i, j)) found.note(near.distance_m, i, j, near.u);
                return found.distance;
            });
        }
    }

    /// What a drone does from the end of its waiting on, and how it stands meanwhile.
    struct Part {
        Mover way;
        Stance stance = Stance::flying;
    };
    /// Whatever parts two drones have, in the pairs that overlap in time.
    void meet(const std::vector<Part>& a, const std::vector<Part>& b, std::size_t i, std::size_t j,
              Found& found) const {
        for (const Part& p : a) {
            for (const Part& q : b) {
                Mover x = p.way, y = q.way;
                const double end_s = std::min(x.end_s, y.end_s);
                if (end_s == kForever) x.end_s = y.end_s = std::max(x.begin_s, y.begin_s);  // both stand
                const Nearest near = closest_approach(x, y);
                if (near.distance_m < found.distance && !all_.excuses(i, p.stance, j, q.stance))
                    found.note(near.distance_m, i, j, near.u);
            }
        }
    }
    static Part stands(const Vec3& at, double from_s, Stance stance) { return {{at, at, from_s, kForever, 0}, stance}; }

    void landing(std::size_t d, std::vector<Part>& parts) const {
        parts.clear();
        const Stop& stop = stops_[d];
        if (!stop.in_air) {
            parts.push_back(stands(stop.hold, model_.wait_s, Stance::on_pad));
            return;
        }
        const Vec3 down{stop.hold.x, stop.hold.y, std::min(stop.hold.z, ground_z(all_, d))};
        const double down_s = model_.wait_s + (stop.hold.z - down.z) / model_.land_mps;
        parts.push_back({{stop.hold, down, model_.wait_s, down_s, 0}, stop.stance});
        parts.push_back(stands(down, down_s, stop.stance == Stance::above_pad ? Stance::on_pad : Stance::flying));
    }

    void returning(std::size_t d, std::vector<Part>& parts) const {
        parts.clear();
        const Stop& stop = stops_[d];
        if (!stop.in_air) {
            parts.push_back(stands(stop.hold, model_.wait_s, Stance::on_pad));
            return;
        }
        const Way way = way_home(all_, model_, d, stop);
        parts.push_back({{way.hold, way.high, way.rise_s, way.cross_s, 0}, stop.stance});
        parts.push_back({{way.high, way.above_home, way.cross_s, way.sink_s, 0}, Stance::flying});
        if (way.sink_s == way.cross_s) parts.pop_back();
        parts.push_back({{way.above_home, way.home, way.sink_s, way.home_s, 0}, Stance::above_pad});
        parts.push_back(stands(way.home, way.home_s, Stance::on_pad));
    }

    /// Pairs whose upright ways are near each other, seen from above; drones never come nearer than that.
    template <class Parts>
    void search_columns(const Parts& parts, Found& found) {
        std::vector<Part> first, second;
        grid_.search(movers_, found.distance, [&](std::size_t i, std::size_t j) {
            const std::size_t a = movers_[i].drone, b = movers_[j].drone;
            if (a == b || (!stops_[a].in_air && !stops_[b].in_air) || found.distance <= enough_) return found.distance;
            parts(a, first);
            parts(b, second);
            meet(first, second, std::min(a, b), std::max(a, b), found);
            return found.distance;
        });
    }

    void column(std::uint32_t drone, const Vec3& at) {
        const Vec3 flat{at.x, at.y, 0.0};
        movers_.push_back({flat, flat, 0.0, 0.0, drone});
    }

    void land(Found& found) {
        if (!std::isfinite(found.distance)) return;
        movers_.clear();
        for (std::uint32_t d = 0; d < stops_.size(); ++d) column(d, stops_[d].hold);
        search_columns([this](std::size_t d, std::vector<Part>& parts) { landing(d, parts); }, found);
    }

    void back(Found& found) {
        if (!std::isfinite(found.distance)) return;
        movers_.clear();
        ways_.clear();
        for (std::uint32_t d = 0; d < stops_.size(); ++d) {
            column(d, stops_[d].hold);
            ways_.push_back(stops_[d].in_air ? way_home(all_, model_, d, stops_[d]) : Way{});
            const Vec3 home = home_of(all_, d);
            if (stops_[d].in_air && (home.x != stops_[d].hold.x || home.y != stops_[d].hold.y)) column(d, home);
        }
        search_columns([this](std::size_t d, std::vector<Part>& parts) { returning(d, parts); }, found);
        cross(found);
    }

    /// Pairs of which one at least is between the columns, step by step.
    void cross(Found& found) {
        double begin_s = kForever, end_s = 0.0, low = kForever, high = -kForever;
        for (std::size_t d = 0; d < ways_.size(); ++d) {
            const Way& way = ways_[d];
            if (!(way.sink_s > way.cross_s)) continue;
            begin_s = std::min(begin_s, way.cross_s), end_s = std::max(end_s, way.sink_s);
            low = std::min(low, way.high.z), high = std::max(high, way.high.z);
        }
        const double step_s = std::clamp(kCrossing_m / model_.return_mps, 0.25, 2.0);
        for (double from_s = begin_s; from_s < end_s && found.distance > enough_; from_s += step_s) {
            movers_.clear();
            crossing_.clear();
            for (std::uint32_t d = 0; d < ways_.size(); ++d)
                if (stops_[d].in_air) enter(d, from_s, from_s + step_s, low - found.distance, high + found.distance);
            grid_.search(movers_, found.distance, [&](std::size_t i, std::size_t j) {
                if (!(crossing_[i] || crossing_[j]) || movers_[i].drone == movers_[j].drone) return found.distance;
                const Nearest near = closest_approach(movers_[i], movers_[j]);
                found.note(near.distance_m, movers_[i].drone, movers_[j].drone, near.u);
                return found.distance;
            });
        }
    }

    /// What of a drone's way home lies between two times and two heights.
    void enter(std::uint32_t d, double from_s, double to_s, double low, double high) {
        const Way& way = ways_[d];
        const auto add = [&](const Vec3& a, const Vec3& b, double begin_s, double end_s, bool crosses) {
            const Mover whole{a, b, begin_s, end_s, d};
            const double begins_s = std::max(begin_s, from_s), ends_s = std::min(end_s, to_s);
            if (!(ends_s > begins_s)) return;
            const Vec3 p = whole.at(begins_s), q = whole.at(ends_s);
            if (std::max(p.z, q.z) < low || std::min(p.z, q.z) > high) return;
            movers_.push_back({p, q, begins_s, ends_s, d});
            crossing_.push_back(crosses);
        };
        add(way.hold, way.high, way.rise_s, way.cross_s, false);
        add(way.high, way.above_home, way.cross_s, way.sink_s, true);
        add(way.above_home, way.home, way.sink_s, way.home_s, false);
    }

    const Survey& all_;
    const EmergencyModel& model_;
    double enough_;  ///< closer is reported as nothing
    std::vector<Stop> stops_;
    std::vector<Way> ways_;
    std::vector<Mover> movers_;
    std::vector<bool> crossing_;
    Manoeuvres last_;
    PairGrid grid_;
};

}  // namespace

std::vector<Manoeuvres> all_leave(const Survey& all, const EmergencyModel& model, const Run& run) {
    std::vector<Manoeuvres> worst(all.seconds);
    parallel_for((all.seconds + kSecondsATask - 1) / kSecondsATask, run, "everybody leaves", [&](std::size_t task) {
        AllLeave leave(all, model);
        for (std::size_t s = task * kSecondsATask; s < std::min(all.seconds, (task + 1) * kSecondsATask); ++s) {
            if (run.stopped()) return;
            leave.at(s, worst[s]);
        }
    });
    return worst;
}

}  // namespace aerogram::exporter
