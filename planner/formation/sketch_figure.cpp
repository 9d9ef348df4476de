#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

#include "planner/formation/area_figure.hpp"
#include "planner/formation/figure.hpp"
#include "planner/formation/part_density.hpp"
#include "planner/formation/solid_figure.hpp"
#include "planner/sampling/bezier_line.hpp"
#include "planner/sketch/sketched_formation.hpp"

namespace aerogram::planner {
namespace {

constexpr double kChordTolerance = 2e-4;  ///< of the lines' size
constexpr double kShortest_m = 1e-6;      ///< a sketch smaller than this is none

/// What one sketch needs at any stretch.
struct SketchJob {
    std::vector<SketchStroke> strokes;  ///< metres, the box's middle at (0, 0)
    SketchSource source;
    DensityField density;  ///< over the natural figure
    std::size_t drones = 0;
    std::vector<Vec2> natural;  ///< the points without stretch
};

std::vector<SketchStroke> strokes_of(const SketchSource& source) {
    Vec2 low(1e300), high(-1e300);
    for (const SketchLine& line : source.lines) {
        for (const Vec2& p : line.line.points) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    const double tolerance = std::max(kChordTolerance * glm::length(high - low), 1e-9);
    std::vector<SketchStroke> strokes;
    for (const SketchLine& line : source.lines) {
        const DrawnLine& drawn = line.line;
        auto points = drawn.bezier ? flattened(drawn.points, drawn.closed, tolerance) : drawn.points;
        if (drawn.closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
        strokes.push_back({std::move(points), drawn.closed, line.exclude});
    }
    return strokes;
}

/// `count` places spread evenly over a box: the additive sequence of the plastic number (Roberts 2018), so that any
/// number of them is even.
std::vector<Vec2> spread_over(const Bounds& box, std::size_t count) {
    constexpr double kPlastic = 1.32471795724474602596;
    std::vector<Vec2> out;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec2 at = 0.5 + static_cast<double>(k + 1) * Vec2(1.0 / kPlastic, 1.0 / (kPlastic * kPlastic));
        out.push_back(box.low + (at - glm::floor(at)) * box.size());
    }
    return out;
}

/// The whole pipeline of paper 002 with agents spread evenly over the sketch's box, so that a keyframe's formation is
/// the same whatever came before it and who flies there. (The live canvas passes the real agents.)
std::vector<Vec2> placed(const SketchJob& job, const Vec2& stretch, bool& unit_changed) {
    std::vector<SketchStroke> strokes = job.strokes;
    for (SketchStroke& stroke : strokes)
        for (Vec2& p : stroke.points) p *= stretch;
    const Sketch sketch = make_sketch(strokes).value();  // it was sound without stretch
    SketchOptions options;
    options.relaxation_rounds = job.source.relaxation_rounds;
    options.sampling.unit = job.source.sampling_unit_m;
    if (job.density) {
        options.sampling.density = [&job, stretch](const Vec2& p) {
            return job.density({p.x / stretch.x, 0.0, p.y / stretch.y});
        };
    }
    const auto& weights = job.source.relaxation_weight;
    if (!weights.empty()) {
        options.weight = [&weights](std::size_t, std::size_t place) {
            const auto found = weights.find(SlotId(place));
            return found != weights.end() ? found->second : 1.0;
        };
    }
    const SketchedFormation formed = form(sketch, spread_over(sketch.region.bounds(), job.drones), options);
    unit_changed = formed.candidates.unit_changed;
    std::vector<Vec2> out(job.drones);
    for (std::size_t a = 0; a < job.drones; ++a) out[formed.place[a]] = formed.targets[a];
    return out;
}

/// The sketch's area, `middle` at (0, 0).
Region region_of(const Sketch& sketch, const Vec2& middle) {
    Region region;
    for (const SketchPath& path : outlines_of(sketch.region)) {
        if (!path.closed) continue;
        region.contours.push_back(path.points);
        for (Vec2& p : region.contours.back()) p -= middle;
    }
    return region;
}

/// The part with the sketch's own size where the mission gives none: brushes are in metres, and so are sketches.
Part with_size(Part part, const Vec3& extent) {
    if (part.size.width_m || part.size.height_m) return part;
    if (extent.x > 0.0) part.size.width_m = extent.x;
    if (extent.z > 0.0) part.size.height_m = extent.z;
    return part;
}

}  // namespace

Result<Figure> sketch_figure(const PartRef& ref, const SketchSource& source, const Run& run) {
    for (const SketchLine& line : source.lines) {
        if (line.exclude && !line.line.closed)
            return ref.error(".sketch: an open line encloses nothing that it could exclude");
    }
    auto job = std::make_shared<SketchJob>();
    job->strokes = strokes_of(source);
    job->source = source;
    job->drones = ref.part.drones;
    auto sketch = make_sketch(job->strokes);
    if (!sketch) return ref.error(".sketch " + sketch.error().message);
    const Bounds box = sketch->region.bounds();
    if (!(glm::length(box.size()) > kShortest_m)) return ref.error(".sketch is smaller than a micrometre");
    if (ref.part.size.depth_m) {
        const Region region = region_of(*sketch, Vec2{});
        if (region.contours.empty()) return ref.error(".sketch: depth needs a closed line that encloses an area");
        const Part sized = with_size(ref.part, {box.size().x, 0.0, box.size().y});
        auto solid = extruded_figure({ref.mission, sized, ref.key}, region, run);
        if (solid) solid->in_metres = true;
        return solid;
    }
    const Vec2 middle = 0.5 * (box.low + box.high);
    for (SketchStroke& stroke : job->strokes)
        for (Vec2& p : stroke.points) p -= middle;
    const Vec3 extent(box.size().x, 0.0, box.size().y);
    if (!ref.part.density.even()) {
        const Part sized = with_size(ref.part, extent);
        auto density = density_of({ref.mission, sized, ref.key}, extent);
        if (!density) return density.error();
        job->density = std::move(*density);
    }
    bool unit_changed = false;
    job->natural = placed(*job, Vec2(1.0), unit_changed);
    Figure figure = flat_figure(box.size(), [job](const Vec2& stretch) {
        bool ignored = false;
        return stretch == Vec2(1.0) ? job->natural : placed(*job, stretch, ignored);
    });
    figure.in_metres = true;
    auto region = std::make_shared<const Region>(region_of(*sketch, middle));
    if (!region->contours.empty()) figure.coverage = area_coverage(std::move(region), job->density);
    if (unit_changed) {
        std::ostringstream text;
        text << "sampling unit " << *source.sampling_unit_m << " m does not suit " << job->drones
             << " drones, another was taken";
        figure.note = text.str();
    }
    return figure;
}

}  // namespace aerogram::planner
