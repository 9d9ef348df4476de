#include "planner/formation/wave_figure.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "geo/units.hpp"
#include "planner/mesh/solid_sampling.hpp"
#include "planner/sampling/area_sampling.hpp"

namespace aerogram::planner {
namespace {

constexpr double kHeight = 0.2;       ///< natural, of a sheet one unit wide and deep
constexpr double kAspectStep = 0.01;  ///< of the logarithm of the unrolled sheet's aspect
constexpr std::size_t kStepsPerWave = 512, kStepsAtLeast = 4096;
constexpr std::size_t kChordsPerWave = 64, kRows = 8;  ///< of the mesh that measures the coverage

/// The sheet seen from the front: its height above the middle of its box, x in [-0.5, 0.5].
struct Profile {
    double waves = 1.0, low = -1.0, high = 1.0;

    explicit Profile(double crests) : waves(crests) {
        const double end = std::sin(2.0 * kPi * waves);
        high = waves >= 0.25 ? 1.0 : end;
        low = waves >= 0.75 ? -1.0 : std::min(0.0, end);
    }
    [[nodiscard]] double height(double x) const {
        return kHeight * ((std::sin(2.0 * kPi * waves * (x + 0.5)) - low) / (high - low) - 0.5);
    }
};

/// Along the stretched profile: the length up to each of equal steps of x.
std::vector<double> unrolled(const Profile& profile, const Vec3& scale) {
    const auto steps = kStepsAtLeast + static_cast<std::size_t>(std::ceil(profile.waves)) * kStepsPerWave;
    std::vector<double> along{0.0};
    for (std::size_t i = 1; i <= steps; ++i) {
        const double before = static_cast<double>(i - 1) / static_cast<double>(steps) - 0.5;
        const double x = static_cast<double>(i) / static_cast<double>(steps) - 0.5;
        along.push_back(along.back() +
                        std::hypot(scale.x * (x - before), scale.z * (profile.height(x) - profile.height(before))));
    }
    return along;
}

/// x of a place along the profile, in [-0.5, 0.5].
double x_at(const std::vector<double>& along, double distance) {
    const auto after = std::upper_bound(along.begin() + 1, along.end() - 1, distance);
    const auto i = static_cast<std::size_t>(after - along.begin()) - 1;
    const double share = std::clamp((distance - along[i]) / (along[i + 1] - along[i]), 0.0, 1.0);
    return (static_cast<double>(i) + share) / static_cast<double>(along.size() - 1) - 0.5;
}

Region rectangle(double width) {
    return {{{{0.0, -0.5}, {width, -0.5}, {width, 0.5}, {0.0, 0.5}}}};
}

/// The stretched sheet as triangles.
TriangleMesh sheet(const Profile& profile, const Vec3& scale) {
    const auto columns = static_cast<std::uint32_t>(static_cast<double>(kChordsPerWave) * std::ceil(profile.waves));
    const auto rows = static_cast<std::uint32_t>(kRows);
    TriangleMesh mesh;
    for (std::uint32_t c = 0; c <= columns; ++c) {
        const double x = static_cast<double>(c) / static_cast<double>(columns) - 0.5;
        for (std::uint32_t r = 0; r <= rows; ++r)
            mesh.vertices.push_back(scale * Vec3(x, static_cast<double>(r) / rows - 0.5, profile.height(x)));
    }
    for (std::uint32_t c = 0; c < columns; ++c) {
        for (std::uint32_t r = 0; r < rows; ++r) {
            const std::uint32_t a = c * (rows + 1) + r, b = a + rows + 1;
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
        }
    }
    return mesh;
}

}  // namespace

Figure wave_figure(std::size_t drones, double waves, const Run& run) {
    const Profile profile(waves);
    // Spread once for unrolled sheets whose aspects differ by less than one part in a hundred.
    const auto known = std::make_shared<std::map<int, std::vector<Vec2>>>();
    Figure figure;
    figure.extent = {1.0, 1.0, kHeight};
    figure.points = [profile, known, drones, run](const Vec3& scale) {
        const std::vector<double> along = unrolled(profile, scale);
        const int step = static_cast<int>(std::lround(std::log(along.back() / scale.y) / kAspectStep));
        const double aspect = std::exp(step * kAspectStep);
        auto found = known->find(step);
        if (found == known->end())
            found = known->emplace(step, sample_region(rectangle(aspect), drones, std::nullopt, run)).first;
        Points points;
        points.reserve(drones);
        for (const Vec2& p : found->second) {
            const double x = x_at(along, p.x / aspect * along.back());
            points.push_back(scale * Vec3(x, p.y, profile.height(x)));
        }
        return points;
    };
    figure.coverage = [profile](const Vec3& scale, const Points& points) {
        return mean_distance(sheet(profile, scale), points);
    };
    return figure;
}

}  // namespace aerogram::planner
