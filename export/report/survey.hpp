#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "export/outgoing/outgoing_show.hpp"
#include "export/report/report.hpp"
#include "export/verify/ground.hpp"
#include "geo/run.hpp"

/// What the report needs to know of all flights at once, from one walk along each of them.
namespace aerogram::exporter {

/// In the coordinates of the separation metric: show frame from Survey::middle_m on, z divided by the downwash.
struct Place {
    float x = 0.0F, y = 0.0F, z = 0.0F;
    bool operator==(const Place&) const = default;
};
[[nodiscard]] inline Vec3 wide(const Place& p) {
    return {p.x, p.y, p.z};
}

/// What was found along one flight.
struct Surveyed {
    std::vector<Stay> stays;  ///< on the pad and straight above it, as verify excuses
    Places places;            ///< home and landing place, show frame
    ReportTurn turn;
    double energy_s = 0.0;  ///< seconds of hovering that the flight costs
};

struct Survey {
    double duration_s = 0.0, downwash = 1.0;
    Vec3 middle_m{};
    std::size_t steps_a_second = 1;
    std::size_t instants = 0;   ///< of each drone: every step up to the first at or after the duration
    std::vector<Place> places;  ///< of drone d at instant k: [d * instants + k]
    double missed_m = 0.0;      ///< straight lines between instants miss each flight by at most that
    std::size_t seconds = 0;    ///< whole seconds 0 .. seconds - 1 of the show
    std::vector<Place> speeds;  ///< of drone d at whole second s, m/s, in the metric: [d * seconds + s]
    std::vector<Surveyed> drones;
    std::vector<ReportSeries> series;

    [[nodiscard]] double step_s() const { return 1.0 / static_cast<double>(steps_a_second); }
    [[nodiscard]] const Place& place(std::size_t drone, std::size_t k) const { return places[drone * instants + k]; }
    /// On the lines between instants; the last place holds.
    [[nodiscard]] Vec3 place_at(std::size_t drone, double t_s) const;
    [[nodiscard]] Vec3 speed(std::size_t drone, std::size_t second) const {
        return wide(speeds[drone * seconds + second]);
    }
    [[nodiscard]] Vec3 to_metric(const Vec3& show_m) const {
        const Vec3 d = show_m - middle_m;
        return {d.x, d.y, d.z / downwash};
    }
    [[nodiscard]] Vec3 from_metric(const Vec3& p) const {
        return {middle_m.x + p.x, middle_m.y + p.y, middle_m.z + p.z * downwash};
    }
    [[nodiscard]] Stance stance(std::size_t drone, double t_s) const;
    /// As verify excuses pairs (export/verify/ground.hpp).
    [[nodiscard]] bool excuses(std::size_t i, Stance a, std::size_t j, Stance b) const {
        return excused(a, b) && !too_close(drones[i].places, drones[j].places, kClosestPads_m);
    }
    [[nodiscard]] bool excuses(std::size_t i, std::size_t j, double t_s) const {
        return excuses(i, stance(i, t_s), j, stance(j, t_s));
    }
};

/// How many instants a second: enough that straight lines miss a flight with this acceleration by 3 mm, fewer where the
/// fleet is too large for that. @param seconds  of the show.
[[nodiscard]] std::size_t steps_a_second(std::size_t drones, double seconds, double acceleration_mps2);

/// Walks along all flights. @param times_s  of the series: rising, from 0 to the duration.
[[nodiscard]] Survey survey(const OutgoingShow& show, const std::vector<double>& times_s, const Run& run);

/// Largest values of one quantity in each step of the report's time, over the drones that were added.
class SeriesMaker {
  public:
    SeriesMaker(const std::vector<double>& times_s, bool planes);
    /// Every piece counts for each step that it reaches into; longer ones are cut to their steps.
    void add(const RecordedDrone& drone, double home_z_m);
    void add(const SeriesMaker& other);
    [[nodiscard]] std::vector<ReportSeries> series(const Limits& limits) const;

  private:
    enum Quantity : std::size_t { altitude, horizontal, up, down, acceleration, jerk, fast, slow, quantity_count };
    struct Reach {
        std::array<double, quantity_count> most{};
    };
    [[nodiscard]] Reach reach(std::span<const Vec3> controls, double duration_s, double home_z_m) const;
    void raise(std::size_t step, const Reach& by);

    const std::vector<double>& times_s_;
    bool planes_;
    std::vector<Reach> most_;
};

/// Seconds of hovering that a flight costs (docs/report.md): nothing on the pad.
[[nodiscard]] double hover_seconds(const RecordedDrone& drone, const std::vector<Stay>& stays, bool plane);
/// The model of hover_seconds in words.
[[nodiscard]] std::string energy_model(bool plane);

}  // namespace aerogram::exporter
