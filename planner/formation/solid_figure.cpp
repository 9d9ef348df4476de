#include "planner/formation/solid_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "planner/formation/part_density.hpp"
#include "planner/mesh/solid_sampling.hpp"
#include "planner/mesh/solids.hpp"

namespace aerogram::planner {
namespace {

constexpr double kAspectStep = 0.01;  ///< of its logarithm

struct Box {
    Vec3 low{}, high{};
};

/// Of the vertices that triangles use.
Box box_of(const TriangleMesh& mesh) {
    Box box{Vec3(1e300), Vec3(-1e300)};
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t v : triangle) {
            box.low = glm::min(box.low, mesh.vertices[v]);
            box.high = glm::max(box.high, mesh.vertices[v]);
        }
    }
    return box;
}

TriangleMesh stretched(TriangleMesh mesh, const Vec3& stretch) {
    for (Vec3& p : mesh.vertices) p *= stretch;
    return mesh;
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

Result<Figure> solid_figure(const PartRef& ref, TriangleMesh mesh, SolidStyle style, const Run& run) {
    if (style != SolidStyle::surface) return ref.error(".style: not in this version");
    const Box box = box_of(mesh);
    const Vec3 middle = 0.5 * (box.low + box.high), extent = box.high - box.low;
    for (Vec3& p : mesh.vertices) p -= middle;
    auto density = density_of(ref, extent);
    if (!density) return density.error();
    const auto stretched_density = [field = std::move(*density)](const Vec3& stretch) {
        if (!field) return DensityField{};
        return DensityField([field, stretch](const Vec3& p) { return field(p / stretch); });
    };
    const auto skin = std::make_shared<const TriangleMesh>(std::move(mesh));
    return stretchable_figure(extent, [skin, stretched_density, run, count = ref.part.drones](const Vec3& stretch) {
        return sample_surface(stretched(*skin, stretch), count, stretched_density(stretch), run);
    });
}

Result<Figure> extruded_figure(const PartRef& ref, const Region& region, const Run& run) {
    const Size& size = ref.part.size;
    const Vec2 extent = bounds_of(region).size();
    // As sizing will stretch it: of two sides given the smaller scale rules.
    std::optional<double> scale;
    if (size.width_m && extent.x > 0.0) scale = *size.width_m / extent.x;
    if (size.height_m && extent.y > 0.0) scale = std::min(scale.value_or(1e300), *size.height_m / extent.y);
    if (!size.depth_m || !scale) return ref.error(".size_m: style = \"solid\" needs a depth and a width or height");
    return solid_figure(ref, extruded(region, *size.depth_m / *scale), SolidStyle::surface, run);
}

}  // namespace aerogram::planner
