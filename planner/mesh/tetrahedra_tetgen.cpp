#include <tetgen.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "geo/contract.hpp"
#include "planner/mesh/child_process.hpp"
#include "planner/mesh/tetgen_input.hpp"
#include "planner/mesh/wire.hpp"

namespace aerogram::planner {
namespace {

/// TetGen's arrays, filled; it frees them.
void fill(tetgenio& in, const TetgenInput& input) {
    in.firstnumber = 0;
    in.numberofpoints = static_cast<int>(input.vertices.size());
    in.pointlist = new REAL[3 * input.vertices.size()];
    for (std::size_t i = 0; i < input.vertices.size(); ++i)
        for (int k = 0; k < 3; ++k) in.pointlist[3 * i + static_cast<std::size_t>(k)] = input.vertices[i][k];
    if (input.facets.empty()) return;
    in.numberoffacets = static_cast<int>(input.facets.size());
    in.facetlist = new tetgenio::facet[input.facets.size()];
    for (std::size_t f = 0; f < input.facets.size(); ++f) {
        tetgenio::facet& facet = in.facetlist[f];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        tetgenio::polygon& polygon = facet.polygonlist[0];
        polygon.numberofvertices = 3;
        polygon.vertexlist = new int[3];
        for (std::size_t k = 0; k < 3; ++k) polygon.vertexlist[k] = static_cast<int>(input.facets[f][k]);
    }
}

/// TetGen's own reading of its letters sets more than the fields they name: quiet, vertices keep their numbers (J),
/// facets (p), hull (c), shape (q), volume (a), regions (A).
tetgenbehavior switches(const TetgenInput& input) {
    std::string letters = "QJ";
    if (!input.facets.empty()) letters += "p";
    if (input.fill_hull) letters += "c";
    if (input.most_volume > 0.0) letters += "qa1A";
    tetgenbehavior b;
    if (!b.parse_commandline(letters.data())) throw std::runtime_error("does not know \"" + letters + "\"");
    if (input.most_volume > 0.0) {
        b.minratio = kRadiusEdgeRatio;
        b.maxvolume = input.most_volume;
    }
    // Facets are joined only where they are in one plane: else a finely bent surface would be flattened.
    b.facet_ang_tol = 179.999'999;
    return b;
}

std::string reason(int thrown) {
    switch (thrown) {
        case 1:
            return "ran out of memory";
        case 3:
            return "finds that the surface passes through itself";
        case 4:
            return "finds details too small beside the whole";
        case 5:
            return "finds two facets that almost touch";
        default:
            return "gave up (its error " + std::to_string(thrown) + ")";
    }
}

std::string packed(const tetgenio& out) {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;
    std::vector<std::int32_t> regions;
    for (std::size_t i = 0; i < static_cast<std::size_t>(out.numberofpoints); ++i)
        vertices.emplace_back(out.pointlist[3 * i], out.pointlist[3 * i + 1], out.pointlist[3 * i + 2]);
    const auto corners = static_cast<std::size_t>(out.numberofcorners);
    for (std::size_t t = 0; t < static_cast<std::size_t>(out.numberoftetrahedra); ++t) {
        std::array<std::uint32_t, 4> one{};
        for (std::size_t k = 0; k < 4; ++k) one[k] = static_cast<std::uint32_t>(out.tetrahedronlist[corners * t + k]);
        tetrahedra.push_back(one);
        const auto attributes = static_cast<std::size_t>(out.numberoftetrahedronattributes);
        regions.push_back(
            attributes == 0 ? 0 : static_cast<std::int32_t>(std::lround(out.tetrahedronattributelist[attributes * t])));
    }
    WireWriter writer;
    writer.add(vertices);
    writer.add(tetrahedra);
    writer.add(regions);
    return writer.take();
}

Result<std::string> in_the_child(const TetgenInput& input) {
    tetgenio in, out;
    fill(in, input);
    tetgenbehavior behaviour = switches(input);
    try {
        tetrahedralize(&behaviour, &in, &out);
    } catch (int thrown) {
        return Error{ErrorCode::invalid_input, "TetGen " + reason(thrown)};
    }
    if (out.numberoftetrahedra <= 0) return Error{ErrorCode::invalid_input, "TetGen finds no tetrahedron"};
    return packed(out);
}

}  // namespace

Result<TetgenOutput> run_tetgen(const TetgenInput& input, const Run& run) {
    constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<int>::max() / 16);
    AEROGRAM_REQUIRE(input.vertices.size() < kMost && input.facets.size() < kMost, input.vertices.size());
    const auto bytes = run_in_child(
        "TetGen", [&] { return in_the_child(input); }, ChildLimits{}, run);
    if (!bytes) return bytes.error();
    TetgenOutput out;
    WireReader reader(*bytes);
    bool sound = reader.take(out.vertices) && reader.take(out.tetrahedra) && reader.take(out.regions) &&
                 reader.at_end() && out.regions.size() == out.tetrahedra.size() &&
                 out.vertices.size() >= input.vertices.size();
    for (const Vec3& v : out.vertices) sound = sound && is_finite(v);
    for (const auto& tetrahedron : out.tetrahedra)
        for (const std::uint32_t corner : tetrahedron) sound = sound && corner < out.vertices.size();
    if (!sound) return Error{ErrorCode::invalid_input, "TetGen gave no sound mesh"};
    std::copy(input.vertices.begin(), input.vertices.end(), out.vertices.begin());
    return out;
}

}  // namespace aerogram::planner
