#pragma once
#include <array>
#include <vector>

#include "export/record/recorded_show.hpp"

namespace aerogram::exporter {

/// Turns the rows of uniform cubic B-splines, one row after another, into Bézier pieces of recorded drones. Written
/// apart from the planner's evaluation, so that `verify` does not repeat its mistakes.
class KnotPieces {
  public:
    /// @param drones  the pieces of one act are added to these.
    KnotPieces(std::vector<RecordedDrone>& drones, double start_s, double knot_step_s)
        : drones_(drones), start_s_(start_s), knot_step_s_(knot_step_s) {}

    /// The next row, one control point a drone. From the fourth on, each row adds one cubic piece to every drone.
    void add_row(std::vector<Vec3> row);

  private:
    std::vector<RecordedDrone>& drones_;
    double start_s_, knot_step_s_;
    std::array<std::vector<Vec3>, 4> rows_;  ///< row k in place k % 4
    std::size_t added_ = 0;
};

}  // namespace aerogram::exporter
