#pragma once
#include <functional>
#include <string>
#include <vector>

#include "geo/color.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "geo/vec3.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// A part, and how messages name it.
struct PartRef {
    const Mission& mission;
    const Part& part;
    std::string key;  ///< "keyframe[2]", or "keyframe[2].part[1]" where a keyframe has several

    /// invalid_input at the part's line: "file:line: key" followed by `what`, e.g. ".text = ...".
    [[nodiscard]] Error error(const std::string& what) const;
};

/// A source that can be drawn at any size, before it is turned and placed.
struct Figure {
    Vec3 extent{};  ///< natural width (x), depth (y), height (z); 0 along axes where it is flat
    /// Exactly part.drones points (a csv may have fewer), in a stable order, after stretching the natural figure by
    /// `scale` (> 0) along its axes; the middle of its box is at (0, 0, 0), a csv keeps its own origin there.
    /// Stretching by s * scale gives s times these.
    std::function<Points(const Vec3& scale)> points;
    std::vector<Rgb> colors{};  ///< one a point; empty: the source has none
    /// Or the colours of points given before they are stretched; absent: the source has none.
    std::function<std::vector<Rgb>(const Points& natural)> colors_at{};
    /// How far a place of the area, surface or volume that is shown is from the nearest of points(scale), on average:
    /// paper 003, equation 4, divided by the number of places; metres; places count by the part's density. Empty: the
    /// source is no such thing.
    std::function<double(const Vec3& scale, const Points& points)> coverage{};
    std::string note{};      ///< what people should know: "resampled from 12000 points"
    bool in_metres = false;  ///< its natural unit is the metre: without a size it is used as it is
};

/// The figure of a part's source, for part.drones >= 1 drones.
/// Errors: invalid_input when the source is unusable (a csv's message names its own line); io when a file cannot be
/// read.
Result<Figure> figure_of(const PartRef& ref, const Run& run);

Result<Figure> text_figure(const PartRef& ref, const TextSource& source, const Run& run);
Result<Figure> image_figure(const PartRef& ref, const ImageSource& source, const Run& run);
Result<Figure> svg_figure(const PartRef& ref, const SvgSource& source, const Run& run);
Result<Figure> mesh_figure(const PartRef& ref, const MeshSource& source, const Run& run);
Result<Figure> sketch_figure(const PartRef& ref, const SketchSource& source, const Run& run);
Result<Figure> csv_figure(const PartRef& ref, const CsvSource& source);
Result<Figure> shape_figure(const PartRef& ref, const ShapeSource& source, const Run& run);
/// The shapes with three dimensions and a skin: sphere, dome, cube, torus, cylinder, cone. The skin of a dome has no
/// floor; round ones are within 4e-4 of their width.
Result<Figure> solid_shape_figure(const PartRef& ref, const ShapeSource& source, const Run& run);

}  // namespace aerogram::planner
