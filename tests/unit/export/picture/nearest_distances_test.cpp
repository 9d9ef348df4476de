#include "export/picture/nearest_distances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace aerogram::exporter {
namespace {

std::vector<double> by_brute_force(const Points& points_m, const SeparationMetric& metric) {
    std::vector<double> out;
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < points_m.size(); ++j) {
            if (i != j) best = std::min(best, metric.distance(points_m[i], points_m[j]));
        }
        out.push_back(best);
    }
    return out;
}

TEST(NearestDistances, AgreeWithBruteForceForAnyShape) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> coordinate(-20.0, 20.0);
    for (int round = 0; round < 120; ++round) {
        const auto count = static_cast<std::size_t>(2 + random() % 150);
        const int flat = round % 4;  // in space, on a plane, on a line, on a coarse grid with coincident points
        Points points_m;
        for (std::size_t i = 0; i < count; ++i) {
            Vec3 p(coordinate(random), coordinate(random), coordinate(random));
            if (flat >= 1) p.y = 3.0;
            if (flat == 2) p.z = -1.0;
            if (flat == 3) p = glm::floor(p / 10.0);
            points_m.push_back(p);
        }
        const SeparationMetric metric{round % 2 == 0 ? 1.0 : 2.5};
        const auto fast = nearest_distances(points_m, metric), slow = by_brute_force(points_m, metric);
        ASSERT_EQ(fast.size(), slow.size());
        for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(fast[i], slow[i], 1e-12) << "seed 11, round " << round;
    }
}

TEST(NearestDistances, OneDroneHasNone) {
    EXPECT_TRUE(nearest_distances({Vec3{1.0, 2.0, 3.0}}, {}).empty());
    EXPECT_TRUE(nearest_distances({}, {}).empty());
}

TEST(NearestDistances, TwentyThousandInOnePlaceAreDone) {
    const auto distances = nearest_distances(Points(20'000, Vec3{4.0, 5.0, 6.0}), {});
    EXPECT_EQ(std::ranges::count(distances, 0.0), 20'000);
}

}  // namespace
}  // namespace aerogram::exporter
