#pragma once
#include <cstddef>

#include "geo/vec3.hpp"
#include "planner/transition/interpolation.hpp"

namespace aerogram::planner {

/// What a simulated fleet flew, kept as a few hundred rows of positions however long it takes.
class FlownRows {
  public:
    /// @param step_m  a row is kept whenever the fastest drone has come this much further; doubled as rows fill up.
    FlownRows(const Points& start_m, double step_m);

    /// @param furthest_m  how far the fastest drone came since the last call.
    void add(const Points& now_m, double furthest_m);

    /// The motion through the rows: smoothed over `smooth` rows, then bent so that it ends at `end_m`.
    [[nodiscard]] Interpolation motion(const Points& end_m, double smooth) &&;

  private:
    std::size_t drones_;
    double step_m_, since_m_ = 0.0;
    std::vector<Points> rows_;
};

}  // namespace aerogram::planner
