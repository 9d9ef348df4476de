#include "planner/sketch/flood_fill.hpp"

#include <cmath>
#include <cstdint>
#include <deque>

#include "geo/contract.hpp"
#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

constexpr double kPlacesAtMost = 4e6;

/// Places at the box's middle and in whole units from it.
Lattice lattice_over(const Bounds& box, double unit) {
    const Vec2 size = box.size();
    while ((size.x / unit + 1.0) * (size.y / unit + 1.0) > kPlacesAtMost) unit *= 1.05;
    const Vec2 steps = glm::floor(0.5 * size / unit);
    return {0.5 * (box.low + box.high) - unit * steps, unit, static_cast<std::size_t>(2.0 * steps.x) + 1,
            static_cast<std::size_t>(2.0 * steps.y) + 1};
}

class FloodFill {
  public:
    FloodFill(const SketchRegion& region, const std::vector<Vec2>& boundary, double unit, double clearance)
        : region_(region), clearance_(clearance), grid_(boundary, clearance) {
        out_.lattice = lattice_over(region.bounds(), unit);
        state_.assign(out_.lattice.across * out_.lattice.up, kUnknown);
    }

    Filled run() {
        for (std::size_t row = 0; row < out_.lattice.up; ++row) {
            for (std::size_t column = 0; column < out_.lattice.across; ++column) {
                if (!is_new(column, row)) continue;
                take(column, row);
                queue_.push_back({column, row});
                while (!queue_.empty()) {
                    const Place from = queue_.front();
                    queue_.pop_front();
                    sweep(from);
                }
            }
        }
        return std::move(out_);
    }

  private:
    struct Place {
        std::size_t column = 0, row = 0;
    };
    static constexpr std::uint8_t kUnknown = 0, kOutside = 1, kInside = 2, kTaken = 3;

    /// PointInBound && notChecked.
    bool is_new(std::size_t column, std::size_t row) {
        std::uint8_t& state = state_[row * out_.lattice.across + column];
        if (state == kUnknown) state = point_in_bound(out_.lattice.at(column, row)) ? kInside : kOutside;
        return state == kInside;
    }

    bool point_in_bound(const Vec2& p) const {
        bool clear = true;
        grid_.near(p, 1, [&](std::size_t, const Vec2& b) { clear = clear && glm::distance(b, p) >= clearance_; });
        return clear && region_.contains(p);
    }

    void take(std::size_t column, std::size_t row) {
        const std::size_t cell = row * out_.lattice.across + column;
        state_[cell] = kTaken;
        out_.cells.push_back(cell);
        out_.points.push_back(out_.lattice.at(column, row));
    }

    void sweep(const Place& from) {
        check_above_and_below(from.column, from.row);
        for (std::size_t c = from.column; c-- > 0 && is_new(c, from.row);) step(c, from.row);
        for (std::size_t c = from.column + 1; c < out_.lattice.across && is_new(c, from.row); ++c) step(c, from.row);
    }
    void step(std::size_t column, std::size_t row) {
        take(column, row);
        check_above_and_below(column, row);
    }
    void check_above_and_below(std::size_t column, std::size_t row) {
        if (row + 1 < out_.lattice.up) enqueue(column, row + 1);
        if (row > 0) enqueue(column, row - 1);
    }
    void enqueue(std::size_t column, std::size_t row) {
        if (!is_new(column, row)) return;
        take(column, row);
        queue_.push_back({column, row});
    }

    const SketchRegion& region_;
    double clearance_;
    SiteGrid grid_;
    Filled out_;
    std::vector<std::uint8_t> state_;
    std::deque<Place> queue_;
};

}  // namespace

Filled flood_filled(const SketchRegion& region, const std::vector<Vec2>& boundary, double unit, double clearance) {
    AEROGRAM_REQUIRE(unit > 0.0 && clearance > 0.0, unit, clearance);
    return FloodFill(region, boundary, unit, clearance).run();
}

}  // namespace aerogram::planner
