// The paper's crowd: 1,260 individuals as 35 x 6 x 6 (or all as one) through circle, star, runner and five circles in
// 991 frames, by the spectral method at every level. CPU seconds to prepare and to evaluate;
// tests/bench/peers/spectral.py reads the instance written here, does the same in numpy and compares the frames.
#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>

#include "geo/random.hpp"
#include "planner/adjacency/adjacency.hpp"
#include "planner/transition/hierarchy.hpp"
#include "tests/bench/study/study.hpp"

namespace aerogram::study {
namespace {

using namespace planner;

constexpr std::array kFormations{"circle", "star", "runner", "five-circles"};
/// As much off the lattice that no two eigenvalues are equal: then the two programs have to agree.
constexpr double kOff_m = 0.05;

/// Formation f, one drone in `stride`: keyframes small enough for a smoke run.
Points formation(std::size_t f, std::size_t stride) {
    std::ifstream file(std::string(AEROGRAM_SOURCE_DIR "/missions/assets/figures/") + kFormations[f] + ".csv");
    if (!file) throw std::runtime_error(std::string("cannot read the formation ") + kFormations[f]);
    Random random(f + 1);
    Points out;
    std::string line, cell;
    std::getline(file, line);
    for (std::size_t row = 0; std::getline(file, line); ++row) {
        std::istringstream cells(line);
        Vec3 p{};
        std::getline(cells, cell, ',');
        for (int c = 0; c < 3; ++c) {
            std::getline(cells, cell, ',');
            p[c] = std::stod(cell) + random.between(-kOff_m, kOff_m);
        }
        if (row % stride == 0) out.push_back(p);
    }
    return out;
}

GroupMotion split(std::size_t first, std::size_t last, std::span<const std::size_t> counts) {
    GroupMotion out;
    out.method = Method::spectral;
    out.spectral = {Align::pca, Reorder::greedy, false};
    for (std::size_t i = first; i < last; ++i) out.drones.push_back(DroneId(i));
    if (counts.empty()) return out;
    const std::size_t size = (last - first) / counts[0];
    for (std::size_t k = 0; k < counts[0]; ++k) {
        out.inside.push_back(split(first + k * size, first + (k + 1) * size, counts.subspan(1)));
    }
    return out;
}

void put(std::ofstream& file, double number) {
    file.write(reinterpret_cast<const char*>(&number), sizeof number);
}
void put(std::ofstream& file, const Points& points) {
    for (const Vec3& p : points) {
        for (int c = 0; c < 3; ++c) put(file, p[c]);
    }
}

/// n, keyframes, levels, the counts of the levels; per keyframe positions, edge count, edges (a, b, weight).
void write_instance(std::ofstream& file, std::span<const SpectralKeyframe> keyframes,
                    std::span<const std::size_t> counts) {
    put(file, static_cast<double>(keyframes[0].positions_m.size()));
    put(file, static_cast<double>(keyframes.size()));
    put(file, static_cast<double>(counts.size()));
    for (const std::size_t c : counts) put(file, static_cast<double>(c));
    for (const SpectralKeyframe& k : keyframes) {
        put(file, k.positions_m);
        put(file, static_cast<double>(k.graph.edges.size()));
        for (const Edge& e : k.graph.edges) {
            put(file, static_cast<double>(e.a));
            put(file, static_cast<double>(e.b));
            put(file, e.weight);
        }
    }
}

Json hierarchy(const Arguments& arguments) {
    const bool flat = arguments.word(0) == "flat";
    if (!flat && arguments.word(0) != "groups") throw std::invalid_argument("groups or flat");
    const std::size_t stride = static_cast<std::size_t>(arguments.number("stride", 1));
    const std::size_t frames = static_cast<std::size_t>(arguments.number("frames", 991));
    const std::array<std::size_t, 2> groups{35, stride == 1 ? 6U : 1U};
    const std::span<const std::size_t> counts = flat ? std::span<const std::size_t>{} : std::span(groups);
    std::vector<SpectralKeyframe> keyframes;
    for (std::size_t f = 0; f < kFormations.size(); ++f) {
        Points points = formation(f, stride);
        AdjacencyGraph graph = delaunay_adjacency(points);
        keyframes.push_back({std::move(points), std::move(graph)});
    }
    const std::size_t n = keyframes[0].positions_m.size(), legs = keyframes.size() - 1;
    const GroupMotion fleet = split(0, n, counts);

    const std::string path = arguments.option("out", "");
    std::ofstream file(path.empty() ? "/dev/null" : path, std::ios::binary);
    write_instance(file, keyframes, counts);
    double prepare_s = 0.0, frames_s = 0.0, farthest_m = 0.0;
    for (std::size_t leg = 0; leg < legs; ++leg) {
        const std::size_t here = frames / legs + (leg < frames % legs ? 1 : 0);
        std::vector<double> shares(here);
        for (std::size_t s = 0; s < here; ++s) shares[s] = static_cast<double>(s) / static_cast<double>(here - 1);
        Points rows(here * n);
        double start_s = cpu_s();
        const Interpolation motion =
            hierarchical_interpolation(keyframes[leg], keyframes[leg + 1], fleet, Run{}).value();
        prepare_s += cpu_s() - start_s;
        start_s = cpu_s();
        motion.sample(shares, rows);
        frames_s += cpu_s() - start_s;
        for (std::size_t i = 0; i < n; ++i) {
            farthest_m = std::max({farthest_m, glm::distance(rows[i], keyframes[leg].positions_m[i]),
                                   glm::distance(rows[(here - 1) * n + i], keyframes[leg + 1].positions_m[i])});
        }
        put(file, static_cast<double>(here));
        put(file, rows);
    }
    if (!(farthest_m < 1e-9)) throw std::runtime_error("a keyframe was missed");
    return Json{}
        .add("way", flat ? "flat" : "groups")
        .add("n", static_cast<double>(n))
        .add("frames", static_cast<double>(frames))
        .add("prepare_s", prepare_s)
        .add("frames_s", frames_s)
        .add("cpu_s", prepare_s + frames_s);
}

const Study kHierarchy{"hierarchy", "groups|flat [--frames 991] [--stride 1] [--out FILE]",
                       "groups --frames 12 --stride 6", hierarchy};

}  // namespace
}  // namespace aerogram::study
