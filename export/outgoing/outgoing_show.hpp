#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "export/outgoing/fitted.hpp"
#include "export/outgoing/flight.hpp"
#include "geo/airspace.hpp"
#include "geo/limits.hpp"
#include "geo/show_frame.hpp"
#include "geo/tracks.hpp"
#include "planner/mission/export_wishes.hpp"
#include "planner/motion/flight_plan.hpp"

/// What writers write: a show as it goes out, whether it was planned (planned_show.hpp) or read from another file
/// (`aerogram convert`). Writers take nothing else, so that every format can be made from both.
namespace aerogram::exporter {

struct OutgoingDrone {
    std::string name;        ///< "drone-017": the same in every file
    std::size_t number = 0;  ///< 17
    Vec3 home_m{}, land_m{};
    std::size_t pad = 0;  ///< the number of its pad; 0: its own
};

/// A formation that the fleet stands in, or flows through.
struct OutgoingKeyframe {
    std::string name;
    Millis stands_from_ms = 0, stands_to_ms = 0;  ///< equal: passed without a stop
    Points places_m;                              ///< of each drone that goes out, while it stands
};

/// Everything that is not one drone's.
struct OutgoingFacts {
    std::string title;
    std::vector<OutgoingDrone> drones;  ///< those that go out: all of a show, or those that were asked for
    std::size_t fleet = 0;              ///< drones of the whole show
    std::optional<geo::ShowOrigin> origin;
    Limits limits;
    geo::Airspace airspace;
    double endurance_s = 900.0;
    Millis duration_ms = 0;
    Millis takeoff_end_ms = 0;    ///< until here everybody climbs straight up from home
    Millis landing_begin_ms = 0;  ///< from here on everybody sinks straight down
    std::vector<OutgoingKeyframe> keyframes;
    std::vector<Cue> cues;
    std::optional<std::filesystem::path> audio;
    double acceleration_mps2 = 0.0;  ///< the largest of any drone at any instant, an upper bound
    bool rides = false;              ///< formations do not stand still: the show rides along a route
    planner::ExportWishes exporting;
    planner::ReportWishes reporting;
};

class OutgoingShow {
  public:
    OutgoingShow() = default;
    OutgoingShow(const OutgoingShow&) = delete;
    OutgoingShow& operator=(const OutgoingShow&) = delete;
    virtual ~OutgoingShow() = default;

    [[nodiscard]] virtual const OutgoingFacts& facts() const = 0;
    [[nodiscard]] std::size_t drones() const { return facts().drones.size(); }

    // Of one drone; safe from several threads. @param drone  below drones(): its place in facts().drones.
    [[nodiscard]] virtual const Tracks& tracks(std::size_t drone) const = 0;
    /// Exact.
    [[nodiscard]] virtual Flight flight(std::size_t drone) const = 0;
    /// As C1 cubics of at least kShortestPieceMs (but where an act is shorter), with what that misses by.
    [[nodiscard]] virtual Fitted fitted(std::size_t drone) const = 0;

    /// The plan behind it, where the whole of a plan goes out; null for subsets and for shows that were read.
    [[nodiscard]] virtual const planner::FlightPlan* whole_plan() const { return nullptr; }
};

/// "drone-001": the drone's stable name in every file; as many digits as the fleet needs, at least three.
[[nodiscard]] std::string drone_name(std::size_t number, std::size_t fleet);

}  // namespace aerogram::exporter
