#pragma once
#include <cstddef>
#include <vector>

#include "geo/vec3.hpp"
#include "planner/sketch/sketch_region.hpp"

namespace aerogram::planner {

/// Places of a square lattice.
struct Lattice {
    Vec2 low{};  ///< of column 0, row 0
    double unit = 1.0;
    std::size_t across = 0, up = 0;

    [[nodiscard]] Vec2 at(std::size_t column, std::size_t row) const {
        return low + unit * Vec2(static_cast<double>(column), static_cast<double>(row));
    }
};

/// The inside of a sketch in places of a lattice, in the order in which they were reached.
struct Filled {
    Lattice lattice;
    std::vector<std::size_t> cells;  ///< row * across + column
    std::vector<Vec2> points;        ///< one a cell
};

/// Fills the inside by the queue of paper 002, appendix A (algorithm 2): from a place that is checked out of the queue
/// along its row to the left and to the right, the places above and below put into the queue.
/// @param unit  > 0, across and up alike; made wider where the lattice would have more than 4,000,000 places.
/// @param boundary  points that stand already. @param clearance  places nearer than this to one of them are not inside:
/// the paper's PointInBound() with its distance.
/// Properties: (1) every place is inside and clear of the boundary points (2) all such places of the lattice are found
/// (3) deterministic. Cost: O(places of the lattice + points inside * edges in a row).
/// Where we differ: the paper has one starting point; here every place that no fill has reached yet starts one, row by
/// row from below, so that disjoint regions are filled one after another. Its starting point is not among its output,
/// and its line 16 steps from checkPoint again where it must step from `left`: both mended. The lattice is centred in
/// the sketch's box, so that symmetric sketches have symmetric templates.
[[nodiscard]] Filled flood_filled(const SketchRegion& region, const std::vector<Vec2>& boundary, double unit,
                                  double clearance);

}  // namespace aerogram::planner
