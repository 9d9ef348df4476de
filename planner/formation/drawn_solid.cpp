#include "planner/formation/drawn_solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "planner/formation/part_density.hpp"
#include "planner/mesh/nearest_on_mesh.hpp"
#include "planner/mesh/solid_sampling.hpp"
#include "planner/mesh/tetrahedra.hpp"

namespace aerogram::planner {
namespace {

constexpr double kAspectStep = 0.01;  ///< of its logarithm

TetrahedralMesh stretched(TetrahedralMesh mesh, const Vec3& stretch) {
    for (Vec3& p : mesh.vertices) p *= stretch;
    return mesh;
}

DensityField stretched(const DensityField& field, const Vec3& stretch) {
    if (!field) return {};
    return [field, stretch](const Vec3& p) { return field(p / stretch); };
}

/// Points and coverage of a surface's or a volume's mesh.
template <class Mesh, class Sample>
DrawnSolid drawn(const std::shared_ptr<const Mesh>& mesh, const DensityField& density, const Sample& sample) {
    return {[=](const Vec3& stretch) { return sample(stretched(*mesh, stretch), stretched(density, stretch)); },
            [=](const Vec3& stretch, const Points& points) {
                return mean_distance(stretched(*mesh, stretch), points, stretched(density, stretch));
            }};
}

}  // namespace

Figure stretchable_figure(const Vec3& extent, std::function<Points(const Vec3& stretch)> sample) {
    using Steps = std::array<int, 2>;
    const auto known = std::make_shared<std::map<Steps, Points>>();  // by rounded logarithms of the proportions
    Figure figure;
    figure.extent = extent;
    figure.points = [known, sample = std::move(sample)](const Vec3& scale) {
        const auto step = [](double ratio) { return static_cast<int>(std::lround(std::log(ratio) / kAspectStep)); };
        const Steps steps{step(scale.x / scale.z), step(scale.y / scale.z)};
        const Vec3 stretch(std::exp(steps[0] * kAspectStep), std::exp(steps[1] * kAspectStep), 1.0);
        auto found = known->find(steps);
        if (found == known->end()) found = known->emplace(steps, sample(stretch)).first;
        Points points = found->second;
        for (Vec3& p : points) p = p / stretch * scale;
        return points;
    };
    return figure;
}

Result<DrawnSolid> drawn_solid(const PartRef& ref, const std::shared_ptr<const TriangleMesh>& mesh, SolidStyle style,
                               const Vec3& extent, const Run& run) {
    const auto density = density_of(ref, extent);
    if (!density) return density.error();
    const std::size_t count = ref.part.drones;
    if (style == SolidStyle::volume) {
        const double longest = std::max({extent.x, extent.y, extent.z});
        auto inside = tetrahedralise(*mesh, longest * longest * longest, run);
        if (!inside && inside.error().code != ErrorCode::invalid_input) return inside.error();
        if (!inside) return ref.error(".style = \"volume\": " + inside.error().message);
        return drawn(std::make_shared<const TetrahedralMesh>(std::move(*inside)), *density,
                     [=](const TetrahedralMesh& volume, const DensityField& field) {
                         return sample_volume(volume, count, field, run);
                     });
    }
    if (style == SolidStyle::edges) {
        if (!has_sharp_edges(*mesh)) return ref.error(".style = \"edges\": it has no edges, it is round everywhere");
        DrawnSolid out =
            drawn(mesh, {}, [=](const TriangleMesh& skin, const DensityField&) { return sample_edges(skin, count); });
        out.coverage = nullptr;
        return out;
    }
    return drawn(mesh, *density, [=](const TriangleMesh& skin, const DensityField& field) {
        return sample_surface(skin, count, field, run);
    });
}

MeshBox box_of(const TriangleMesh& mesh) {
    MeshBox box{Vec3(1e300), Vec3(-1e300)};
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t v : triangle) {
            box.low = glm::min(box.low, mesh.vertices[v]);
            box.high = glm::max(box.high, mesh.vertices[v]);
        }
    }
    return box;
}

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.vertices) p += by;
    return mesh;
}

TriangleMesh stretched(TriangleMesh mesh, const Vec3& stretch) {
    for (Vec3& p : mesh.vertices) p *= stretch;
    return mesh;
}

std::function<std::vector<Rgb>(const Points& natural)> colors_of(const std::shared_ptr<const TriangleMesh>& mesh) {
    if (mesh->colors.empty()) return {};
    return [mesh](const Points& natural) {
        const NearestOnMesh search(*mesh);
        std::vector<Rgb> out;
        for (const Vec3& p : natural) out.push_back(color_of(search.nearest(p), *mesh));
        return out;
    };
}

}  // namespace aerogram::planner
