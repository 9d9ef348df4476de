// Words formed by sketches (paper 002, figure 3): formation coordinates beside the shortest matching, and what a live
// canvas takes: the tables of docs/formation-sketching.md. Measures: DESIGN.md section 12.
#include <algorithm>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "geo/random.hpp"
#include "planner/assignment/assignment.hpp"
#include "planner/formation_match.hpp"
#include "planner/sketch/sketched_formation.hpp"
#include "planner/text/outline_text.hpp"
#include "tests/bench/study/study.hpp"

namespace aerogram::study {
namespace {

using namespace planner;

constexpr std::size_t kNeighbours = 6;
constexpr double kWidth_m = 60.0;  ///< of a word
const std::vector<std::string> kWords{"CROWD", "GROUP", "SKETCH", "DRONE", "SHOW", "HELLO"};

/// The boundaries of a word's letters, as a designer would trace them: outlines inclusive, what they leave open
/// exclusive.
std::vector<SketchStroke> traced(const std::string& word) {
    TextSource text;
    text.text = word;
    text.font = "DejaVu Sans Bold";
    text.style = TextStyle::fill;
    const Region letters = outline_text(text).value();
    const Bounds box = bounds_of(letters);
    double largest = 0.0;
    for (const Contour& contour : letters.contours) {
        const double area = ClosedCurve(contour).area();
        if (std::abs(area) > std::abs(largest)) largest = area;
    }
    std::vector<SketchStroke> out;
    for (const Contour& contour : letters.contours) {
        SketchStroke stroke{{}, true, ClosedCurve(contour).area() * largest < 0.0};
        for (const Vec2& p : contour)
            stroke.points.push_back(kWidth_m / box.size().x * (p - 0.5 * (box.low + box.high)));
        out.push_back(std::move(stroke));
    }
    return out;
}

std::vector<Vec2> random_agents(std::size_t n, std::uint64_t seed) {
    Random random(seed);
    std::vector<Vec2> out;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = random.between(-0.5, 0.5) * kWidth_m;
        out.emplace_back(x, random.between(-0.5, 0.5) * kWidth_m);
    }
    return out;
}

Points upright(const std::vector<Vec2>& points) {
    Points out;
    for (const Vec2& p : points) out.emplace_back(p.x, 0.0, p.y + 50.0);
    return out;
}

/// For each point its nearest others.
std::vector<std::vector<std::size_t>> nearest_others(const Points& points) {
    std::vector<std::vector<std::size_t>> out;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::vector<std::size_t> order;
        for (std::size_t j = 0; j < points.size(); ++j)
            if (j != i) order.push_back(j);
        const auto closer = [&](std::size_t a, std::size_t b) {
            const double da = glm::distance(points[a], points[i]), db = glm::distance(points[b], points[i]);
            return da != db ? da < db : a < b;
        };
        std::partial_sort(order.begin(), order.begin() + kNeighbours, order.end(), closer);
        order.resize(kNeighbours);
        std::sort(order.begin(), order.end());
        out.push_back(std::move(order));
    }
    return out;
}

struct Measures {
    double path_m = 0.0, longest_m = 0.0, kept = 0.0, cpu_ms = 0.0;
    Measures& operator+=(const Measures& more) {
        path_m += more.path_m;
        longest_m += more.longest_m;
        kept += more.kept;
        cpu_ms += more.cpu_ms;
        return *this;
    }
};

/// @param to_m  by drone.
Measures measured(const Points& from_m, const Points& to_m, double cpu_seconds) {
    Measures out;
    const auto before = nearest_others(from_m), after = nearest_others(to_m);
    const auto n = static_cast<double>(from_m.size());
    for (std::size_t d = 0; d < from_m.size(); ++d) {
        const double way_m = glm::distance(from_m[d], to_m[d]);
        out.path_m += way_m / n;
        out.longest_m = std::max(out.longest_m, way_m);
        std::vector<std::size_t> both;
        std::set_intersection(before[d].begin(), before[d].end(), after[d].begin(), after[d].end(),
                              std::back_inserter(both));
        out.kept += static_cast<double>(both.size()) / static_cast<double>(kNeighbours) / n;
    }
    out.cpu_ms = 1e3 * cpu_seconds;
    return out;
}

Points by_drone(const Points& slots_m, const Assignment& assignment) {
    Points out;
    for (const SlotId slot : assignment.slot_of) out.push_back(slots_m[slot.value]);
    return out;
}

/// The same move three ways. Every way has the same places; who takes which differs.
struct Comparison {
    Measures live, coordinates, shortest;
};
Comparison compared(const std::vector<Vec2>& agents, const Sketch& sketch) {
    SketchedFormation formed;
    const double live_s = median_cpu_s(3, [&] { formed = form(sketch, agents); });
    const Points from_m = upright(agents), targets_m = upright(formed.targets);
    Points slots_m(agents.size());
    for (std::size_t a = 0; a < agents.size(); ++a) slots_m[formed.place[a]] = targets_m[a];
    Assignment coordinates, shortest;
    const double coordinates_s = median_cpu_s(3, [&] {
        coordinates = assign_formation_coordinates(from_m, slots_m, {}, {}, SeparationMetric{}, Run{}).value();
    });
    const double shortest_s =
        median_cpu_s(3, [&] { shortest = assign_shortest(from_m, slots_m, {}, SeparationMetric{}, Run{}).value(); });
    Comparison out{measured(from_m, targets_m, live_s), measured(from_m, by_drone(slots_m, coordinates), coordinates_s),
                   measured(from_m, by_drone(slots_m, shortest), shortest_s)};
    double live_m2 = 0.0;
    for (std::size_t a = 0; a < agents.size(); ++a) live_m2 += std::pow(glm::distance(from_m[a], targets_m[a]), 2);
    const double least_m2 = shortest.cost_m2 * (1.0 - 1e-9);
    if (coordinates.cost_m2 < least_m2 || live_m2 < least_m2)
        throw std::runtime_error("formation coordinates cannot be shorter than the shortest");
    return out;
}

Json sketch_words(const Arguments& arguments) {
    const auto n = static_cast<std::size_t>(arguments.number("drones", 100.0));
    const auto seeds = static_cast<std::uint64_t>(arguments.number("seeds", 5.0));
    Comparison random_start, word_start;
    double random_moves = 0.0, word_moves = 0.0;
    std::vector<Sketch> words;
    for (const std::string& word : kWords) words.push_back(make_sketch(traced(word)).value());
    const auto add = [](Comparison& sum, const Comparison& one) {
        sum.live += one.live;
        sum.coordinates += one.coordinates;
        sum.shortest += one.shortest;
    };
    for (std::size_t w = 0; w < words.size(); ++w) {
        for (std::uint64_t seed = 1; seed <= seeds; ++seed, ++random_moves)
            add(random_start, compared(random_agents(n, seed), words[w]));
        const auto before = form(words[(w + words.size() - 1) % words.size()], random_agents(n, 1)).targets;
        add(word_start, compared(before, words[w]));
        ++word_moves;
    }
    Json json;
    std::ostringstream table;
    const auto row = [&](const char* start, const char* key, const char* way, const Measures& m, double moves) {
        table << std::fixed << "| " << n << " | " << start << " | " << way << " | " << std::setprecision(1)
              << m.path_m / moves << " m | " << m.longest_m / moves << " m | " << 100.0 * m.kept / moves << " % | "
              << std::setprecision(2) << m.cpu_ms / moves << " ms |\n";
        json.add(std::string(key) + "_path_m", m.path_m / moves).add(std::string(key) + "_kept", m.kept / moves);
        json.add(std::string(key) + "_cpu_ms", m.cpu_ms / moves);
    };
    row("random", "random_live", "live sketch, whole pipeline", random_start.live, random_moves);
    row("random", "random_coordinates", "`formation_coordinates`", random_start.coordinates, random_moves);
    row("random", "random_shortest", "`shortest`", random_start.shortest, random_moves);
    row("the word before", "word_live", "live sketch, whole pipeline", word_start.live, word_moves);
    row("the word before", "word_coordinates", "`formation_coordinates`", word_start.coordinates, word_moves);
    row("the word before", "word_shortest", "`shortest`", word_start.shortest, word_moves);
    const std::string file = arguments.option("markdown", "");
    if (!file.empty() && !(std::ofstream(file) << table.str())) throw std::runtime_error("cannot write " + file);
    return json.add("drones", static_cast<double>(n));
}

const Study kSketch{"sketch", "[--drones N] [--seeds N] [--markdown FILE]", "--drones 30 --seeds 1", sketch_words};

}  // namespace
}  // namespace aerogram::study
