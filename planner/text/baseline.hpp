#pragma once
#include <vector>

#include "geo/result.hpp"
#include "geo/vec3.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// Where a letter stands: `at` is the middle of its foot, `right` and `up` are of length 1.
struct LetterFrame {
    Vec2 at{}, right{1.0, 0.0};

    /// A point of the letter, by its place in the straight text whose letter has its middle at (middle, 0).
    [[nodiscard]] Vec2 place(const Vec2& p, double middle) const {
        return at + (p.x - middle) * right + p.y * Vec2(-right.y, right.x);
    }
};

/// A drawn line that one line of text is written along. Letters stay as they are, their middle on the line, turned to
/// its direction there, their heads to the left of it; in sharp bends they may overlap.
class Baseline {
  public:
    /// @param width  of the straight text, > 0: the line is taken that long, whatever its own length.
    /// Errors: invalid_input when the line has no length or is not finite.
    static Result<Baseline> of(const DrawnLine& line, double width);

    /// @param middle  how far the letter's middle is from the start of the straight text; before and after the line
    /// its end goes on straight, or round a closed one.
    [[nodiscard]] LetterFrame at(double middle) const;

  private:
    std::vector<Vec2> points_;   ///< a closed line ends where it starts
    std::vector<double> along_;  ///< length up to each point
    bool closed_ = false;
};

}  // namespace aerogram::planner
