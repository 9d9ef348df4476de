#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "planner/mesh/sharp_edges.hpp"
#include "planner/mesh/spread_apart.hpp"

namespace aerogram::planner {

/// Points on the sharp edges of a mesh: some at corners, which stay, and some that can slide along their line.
class EdgePoints {
  public:
    explicit EdgePoints(const TriangleMesh& mesh);

    [[nodiscard]] bool none() const { return edges_.lines.empty(); }
    [[nodiscard]] std::size_t lines() const { return edges_.lines.size(); }

    /// The corners, and equal steps of about `step` between them, without those nearer than half a step to another.
    /// @param lines  else only the corners where lines meet, and spikes. None where that would be more than `most`.
    void place_by_step(double step, bool lines, std::size_t most);
    /// Exactly `count`: corners first (the farthest apart where there are too many), then equal steps. There must be
    /// sharp edges. Returns the smallest step on a line.
    double place(std::size_t count);
    void clear();

    [[nodiscard]] const Points& points() const { return points_; }
    [[nodiscard]] Freedom freedom(std::size_t i) const;
    Vec3 move(std::size_t i, const Vec3& wanted);

  private:
    struct Slider {
        std::size_t line = 0;
        double along = 0.0;
    };
    void add(const Vec3& at, std::optional<Slider> slider);
    void measure_lines();

    const TriangleMesh& mesh_;
    SharpEdges edges_;
    std::vector<LineTrack> tracks_;  ///< measured when they are needed
    double reach_ = 0.0;             ///< over which a line's direction is taken
    Points points_;
    std::vector<std::optional<Slider>> sliders_;
};

}  // namespace aerogram::planner
