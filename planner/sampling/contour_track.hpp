#pragma once
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sampling/region.hpp"

namespace aerogram::planner {

/// A contour by the distance along it. The contour must outlive the track.
class ContourTrack {
  public:
    explicit ContourTrack(const Contour& contour);

    [[nodiscard]] double length() const { return along_.back(); }
    [[nodiscard]] double of_vertex(std::size_t i) const { return along_[i]; }
    /// @param distance  any: it goes round and round.
    [[nodiscard]] Vec2 at(double distance) const;
    /// The shorter way round between two places.
    [[nodiscard]] double way(double a, double b) const;
    /// The line from one place on to another, both included. @param from  in [0, length). @param to  > from, at most
    /// from + length.
    [[nodiscard]] std::vector<Vec2> between(double from, double to) const;

  private:
    const Contour& contour_;
    std::vector<double> along_;  ///< length up to each vertex, and back to the first
};

/// A contour turns sharply at a corner: by more than 30 degrees. The indices of a contour's corners, ascending.
[[nodiscard]] std::vector<std::size_t> corners_of(const Contour& contour);

/// Distances along the track of its contour's corners, ascending; those nearer than `close` to each other are one,
/// halfway.
[[nodiscard]] std::vector<double> corner_places(const Contour& contour, const ContourTrack& track, double close);

}  // namespace aerogram::planner
