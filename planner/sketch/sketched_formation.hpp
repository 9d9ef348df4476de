#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geo/result.hpp"
#include "geo/vec3.hpp"
#include "planner/sketch/sketch_region.hpp"
#include "planner/sketch/sketch_template.hpp"

namespace aerogram::planner {

/// A drawing that is fit to become a formation.
struct Sketch {
    SketchRegion region;
    std::vector<SketchPath> paths;
};

/// Errors: invalid_input when nothing is drawn that drones could stand on, when exclusive lines take everything away,
/// or when there are more than 1,000 lines or 20,000 points; messages without place, to follow the key's name.
Result<Sketch> make_sketch(const std::vector<SketchStroke>& strokes);

struct SketchOptions {
    TemplateOptions sampling{};
    std::size_t relaxation_rounds = 60;  ///< never more than 20 million over the number of agents
    double beta = 3.0;                   ///< algorithm 1, in 1 / spacing²
    double speed = 8.0;                  ///< algorithm 1
    /// The relaxation weight w of an agent that takes the place-th of the formation's places; empty: 1.
    std::function<double(std::size_t agent, std::size_t place)> weight{};
    /// How far the direction from which the agents' orientations are told is turned, counter-clockwise: where the group
    /// faces while it moves (section 3.3, feature 1). The sketch stays as drawn.
    double agents_reference_rad = 0.0;
};

/// Where a group of agents goes to form a sketch. Vectors have one entry an agent.
struct SketchedFormation {
    std::vector<Vec2> targets;
    std::vector<std::size_t> place;  ///< 0 .. n - 1: boundary places first, then inside, in the template's order
    std::vector<bool> on_boundary;
    SketchTemplate candidates;
    std::vector<std::uint32_t> candidate_of;  ///< index into candidates.points that the agent took before relaxation
};

/// The whole of paper 002, sections 3.2 to 3.6, for a live canvas: template, formation coordinates, correspondences,
/// relaxation.
/// @param agents  n >= 1 finite positions in the sketch's plane, any unit (coordinates are relative).
/// Properties: (1) one target an agent, as many as agents, whatever their number (2) targets are on the sketch's paths
/// or inside it (3) every boundary point of the template has an agent (4) moving or enlarging the agents changes
/// nothing (5) same input, same result. Cost: 100 agents about 2 ms, 400 about 8 ms, 20,000 about 1 s.
[[nodiscard]] SketchedFormation form(const Sketch& sketch, std::span<const Vec2> agents,
                                     const SketchOptions& options = {});

}  // namespace aerogram::planner
