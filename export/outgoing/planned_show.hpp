#pragma once
#include <span>
#include <vector>

#include "export/outgoing/curve_fit.hpp"
#include "export/outgoing/outgoing_show.hpp"

namespace aerogram::exporter {

/// A plan on its way out, whole or some of its drones.
class PlannedShow final : public OutgoingShow {
  public:
    /// @param plan  must outlive this.
    explicit PlannedShow(const planner::FlightPlan& plan);
    /// @param drones  at least one, rising, below plan.drones().
    PlannedShow(const planner::FlightPlan& plan, std::span<const DroneId> drones);

    [[nodiscard]] const OutgoingFacts& facts() const override { return facts_; }
    [[nodiscard]] const Tracks& tracks(std::size_t drone) const override;
    [[nodiscard]] Flight flight(std::size_t drone) const override;
    [[nodiscard]] Fitted fitted(std::size_t drone) const override;
    [[nodiscard]] const planner::FlightPlan* whole_plan() const override;

  private:
    [[nodiscard]] DroneId id(std::size_t drone) const { return DroneId(facts_.drones[drone].number - 1); }

    const planner::FlightPlan& plan_;
    OutgoingFacts facts_;
    std::vector<ActFitter> fitters_;  ///< one an act
};

}  // namespace aerogram::exporter
