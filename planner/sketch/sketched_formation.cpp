#include "planner/sketch/sketched_formation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/contract.hpp"
#include "planner/sketch/correspondences.hpp"
#include "planner/sketch/formation_coordinates.hpp"
#include "planner/sketch/relaxation.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kLinesAtMost = 1'000, kPointsAtMost = 20'000;
constexpr std::size_t kMovesAtMost = 20'000'000;  ///< of all agents in all rounds

/// The places that agents took, ascending: those on the boundary first, as templates have them.
std::vector<std::uint32_t> taken_places(const std::vector<std::uint32_t>& candidate_of) {
    std::vector<std::uint32_t> taken(candidate_of);
    std::sort(taken.begin(), taken.end());
    return taken;
}

/// How far neighbours inside are to be apart so that they fill what the template fills.
std::function<double(const Vec2&)> spacing_by(const SketchTemplate& candidates, const SketchDensity& density,
                                              double spacing) {
    if (!density || candidates.mean_density <= 0.0) return {};
    const double mean = candidates.mean_density;
    return [density, mean, spacing](const Vec2& p) {
        const double d = std::clamp(density(p), mean / kDensityContrast, mean * kDensityContrast);
        return spacing * std::sqrt(mean / d);
    };
}

}  // namespace

Result<Sketch> make_sketch(const std::vector<SketchStroke>& strokes) {
    const auto wrong = [](const std::string& what) { return Error{ErrorCode::invalid_input, what}; };
    std::size_t points = 0;
    bool drawn = false;
    for (const SketchStroke& stroke : strokes) {
        points += stroke.points.size();
        drawn = drawn || !stroke.exclusive;
        for (const Vec2& p : stroke.points)
            if (!is_finite({p.x, p.y, 0.0})) return wrong("has a point that is not a finite number");
    }
    if (!drawn) return wrong("has no line that drones could stand on: needs one that is not exclusive");
    if (strokes.size() > kLinesAtMost || points > kPointsAtMost) {
        return wrong("has " + std::to_string(strokes.size()) + " lines with " + std::to_string(points) +
                     " points; at most 1000 lines and 20000 points");
    }
    Sketch sketch{SketchRegion(strokes), {}};
    sketch.paths = paths_of(sketch.region, strokes);
    const double size = glm::length(sketch.region.bounds().size());
    std::erase_if(sketch.paths, [&](const SketchPath& path) { return !(length_of(path) > 1e-9 * size); });
    if (!sketch.paths.empty()) return sketch;
    const bool taken = std::any_of(strokes.begin(), strokes.end(), [](const auto& s) { return s.exclusive; });
    return wrong(taken ? "encloses nothing: its exclusive lines take everything away"
                       : "encloses nothing: its lines have no area and no length");
}

SketchedFormation form(const Sketch& sketch, std::span<const Vec2> agents, const SketchOptions& options) {
    const std::size_t n = agents.size();
    AEROGRAM_REQUIRE(n >= 1);
    SketchedFormation out;
    out.candidates = make_template(sketch.region, sketch.paths, n, options.sampling);
    const std::size_t boundary = out.candidates.boundary;
    const auto of_agents = coordinates_in(plane_frame(agents, {}, options.agents_reference_rad), agents);
    const auto of_points = coordinates_in(plane_frame(out.candidates.points), out.candidates.points);
    out.candidate_of = find_correspondences(of_agents, of_points, boundary);

    const std::vector<std::uint32_t> taken = taken_places(out.candidate_of);
    std::vector<std::size_t> agent_at(n);
    for (std::size_t a = 0; a < n; ++a) {
        const auto place = std::lower_bound(taken.begin(), taken.end(), out.candidate_of[a]) - taken.begin();
        out.place.push_back(static_cast<std::size_t>(place));
        out.on_boundary.push_back(out.candidate_of[a] < boundary);
        agent_at[out.place[a]] = a;
    }
    std::vector<Vec2> places;
    std::vector<double> weights;
    for (std::size_t k = 0; k < n; ++k) {
        places.push_back(out.candidates.points[taken[k]]);
        if (options.weight) weights.push_back(options.weight(agent_at[k], k));
    }
    GaussianRelaxation how;
    how.rounds = std::min(options.relaxation_rounds, kMovesAtMost / n);
    how.beta = options.beta;
    how.speed = options.speed;
    how.weights = weights;
    const double inside = static_cast<double>(std::max<std::size_t>(n - boundary, 1));
    how.spacing = boundary < n ? std::sqrt(out.candidates.inside_area / inside) : out.candidates.unit;
    how.spacing_at = spacing_by(out.candidates, options.sampling.density, how.spacing);
    how.inside = [&sketch](const Vec2& p) { return sketch.region.contains(p); };
    places = relaxed(std::move(places), boundary, how);
    for (std::size_t a = 0; a < n; ++a) out.targets.push_back(places[out.place[a]]);
    return out;
}

}  // namespace aerogram::planner
