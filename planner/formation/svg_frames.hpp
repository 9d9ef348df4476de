#pragma once
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/formation/figure.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// One frame of an animation by numbered drawings (paper 003, section 3.3): every shape keeps its drones. Shapes
/// correspond by id, those of one id and those without in their order. How many drones a shape has is settled by the
/// first frame; slots are ordered shape by shape; inside a shape each drone goes on to the place of the next frame that
/// the shortest matching of places around the shape's middle gives it.
/// The figure's box is the page, its middle the page's: the same for all frames.
/// @param source  with a frame. Errors: invalid_input at the part's line when no size is given, a file is unusable,
/// pages differ, or a shape is missing in a frame (named); io.
Result<Figure> svg_frame_figure(const PartRef& ref, const SvgSource& source, const Run& run);

}  // namespace aerogram::planner
