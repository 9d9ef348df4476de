#include "planner/takeoff.hpp"

#include <gtest/gtest.h>

#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

Points grid(std::size_t rows, std::size_t columns, double spacing_m) {
    Points out;
    for (std::size_t i = 0; i < rows * columns; ++i)
        out.emplace_back(spacing_m * static_cast<double>(i % columns), spacing_m * static_cast<double>(i / columns),
                         0.0);
    return out;
}

double closest_m(const Points& points_m, const SeparationMetric& metric) {
    double least = 1e300;
    for (std::size_t i = 0; i < points_m.size(); ++i)
        for (std::size_t j = i + 1; j < points_m.size(); ++j)
            least = std::min(least, metric.distance(points_m[i], points_m[j]));
    return least;
}

TEST(PadLayers, Property2_PadsFarEnoughApartMakeOneLayerAboveEachPad) {
    Limits limits;
    Points pads_m = grid(5, 7, planned_separation_m(limits));  // exactly far enough
    for (std::size_t i = 0; i < pads_m.size(); ++i) pads_m[i].z = 0.1 * static_cast<double>(i % 3);
    const PadLayers layers = pad_layers(pads_m, limits);
    EXPECT_EQ(layers.count, 1u);
    for (std::size_t i = 0; i < pads_m.size(); ++i)
        EXPECT_DOUBLE_EQ(layers.lifted_m[i].z, pads_m[i].z + limits.min_navigation_altitude_m + 0.1);
}

TEST(PadLayers, AGridTighterThanTheSeparationTakesFourLayers) {
    const PadLayers layers = pad_layers(grid(20, 20, 1.0), Limits{});
    EXPECT_EQ(layers.count, 4u);
}

TEST(PadLayers, Property1_LiftedPlacesKeepThePlannedSeparation) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        Random random(seed);
        Limits limits;
        limits.downwash = random.between(1.0, 3.0);
        Points pads_m;
        while (pads_m.size() < 60) {
            const Vec3 p{random.between(0, 12), random.between(0, 12), random.between(0, 0.8)};
            bool free = true;
            for (const Vec3& q : pads_m) free = free && glm::distance(p, q) > 0.4;
            if (free) pads_m.push_back(p);
        }
        const PadLayers layers = pad_layers(pads_m, limits);
        EXPECT_GE(closest_m(layers.lifted_m, {limits.downwash}), planned_separation_m(limits) - 1e-9) << seed;
        for (std::size_t i = 0; i < pads_m.size(); ++i) {
            EXPECT_EQ(Vec2(layers.lifted_m[i]), Vec2(pads_m[i]));
            EXPECT_GE(layers.lifted_m[i].z, pads_m[i].z + limits.min_navigation_altitude_m);
            EXPECT_LT(layers.layer_of[i], layers.count);
        }
    }
}

TEST(PadLayers, Property3_APadsLayerDependsOnThePadsBeforeIt) {
    const Points all_m = grid(6, 6, 0.9);
    const PadLayers whole = pad_layers(all_m, Limits{});
    const PadLayers first = pad_layers(Points(all_m.begin(), all_m.begin() + 15), Limits{});
    for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(first.layer_of[i], whole.layer_of[i]);
}

}  // namespace
}  // namespace aerogram::planner
