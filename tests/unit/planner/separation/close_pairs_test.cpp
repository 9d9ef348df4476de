#include "planner/separation/close_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geo/random.hpp"
#include "planner/motion/profile.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kDrones = 120, kRows = 33;

Lattice random_map(std::uint64_t seed) {
    Random random(seed);
    const auto place = [&] { return Vec3{random.between(0, 40), random.between(0, 40), random.between(0, 10)}; };
    const auto share = profile_rows(ProfileKind::minimum_jerk, kRows);
    Lattice lattice{kDrones, Points(kRows * kDrones)};
    for (std::size_t i = 0; i < kDrones; ++i) {
        const Vec3 from = place(), to = place(), bow = 0.3 * place();
        for (std::size_t k = 0; k < kRows; ++k) {
            lattice.at(k, i) = (1.0 - share[k]) * from + share[k] * to + std::sin(3.14159 * share[k]) * bow;
        }
    }
    return lattice;
}

/// A fleet's samples in the lattice's own order.
struct Fleet {
    Sampling sampling;
    SampledCurves samples;

    Fleet(const Lattice& lattice, std::size_t per) : sampling(lattice.rows(), per) {
        std::vector<std::uint32_t> order(lattice.drones);
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        const ControlCurves curves = curves_of(lattice, order);
        samples.drone_stride = sampling.drone_stride();
        samples.values.assign(lattice.drones * samples.drone_stride + 4, 0.0);
        for (std::size_t i = 0; i < lattice.drones; ++i) {
            for (std::size_t a = 0; a < 3; ++a) {
                sampling.evaluate(curves.axis(i, a), 1.0, samples.of(i) + a * sampling.axis_stride());
            }
        }
    }
    /// Instant q of knot interval m.
    [[nodiscard]] Vec3 at(std::size_t i, std::size_t place) const {
        const double* own = samples.of(i) + place;
        return {own[0], own[sampling.axis_stride()], own[2 * sampling.axis_stride()]};
    }
    /// The distance of two drones on a chord, by many points.
    [[nodiscard]] double chord_distance_m(std::size_t i, std::size_t j, std::size_t m, std::size_t q) const {
        const std::size_t before = sampling.before(q) + m, after = sampling.after(q) + m;
        double least = 1e300;
        for (int s = 0; s <= 50; ++s) {
            const double w = s / 50.0;
            const Vec3 d = (1.0 - w) * (at(j, before) - at(i, before)) + w * (at(j, after) - at(i, after));
            least = std::min(least, glm::length(d));
        }
        return least;
    }
};

void expect_all_close_listed(const ClosePairs& pairs, const Fleet& fleet, double needed_m) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, ClosePair> listed;
    for (const ClosePair& p : pairs.pairs()) {
        EXPECT_LT(p.i, p.j);
        EXPECT_TRUE(listed.emplace(std::pair(p.i, p.j), p).second) << "twice";
    }
    int close = 0;
    for (std::uint32_t i = 0; i < kDrones; ++i) {
        for (std::uint32_t j = i + 1; j < kDrones; ++j) {
            for (std::size_t m = 0; m < fleet.sampling.intervals(); ++m) {
                for (std::size_t q = 0; q < fleet.sampling.per_interval(); ++q) {
                    if (fleet.chord_distance_m(i, j, m, q) >= needed_m) continue;
                    ++close;
                    const auto found = listed.find({i, j});
                    ASSERT_TRUE(found != listed.end()) << i << " " << j << " interval " << m;
                    EXPECT_TRUE(found->second.first <= m && m < found->second.last)
                        << i << " " << j << " interval " << m;
                }
            }
        }
    }
    EXPECT_GT(close, 50);
}

TEST(ClosePairs, HoldsEveryCloseChordAtFirstAndWhileDronesMove) {
    for (const std::size_t per : {1u, 2u}) {
        Lattice lattice = random_map(7);
        Fleet fleet(lattice, per);
        const double needed_m = 2.0, slack_m = 0.5;
        ClosePairs pairs(fleet.sampling, kDrones, needed_m, slack_m);
        ASSERT_TRUE(pairs.refresh(fleet.samples, {}));
        expect_all_close_listed(pairs, fleet, needed_m);
        Random random(3);
        for (int round = 0; round < 12; ++round) {  // everybody drifts, some farther than others
            for (std::size_t i = 0; i < kDrones; ++i) {
                const double far_m = i % 7 == 0 ? 0.9 : 0.08;
                const Vec3 step{random.between(-far_m, far_m), random.between(-far_m, far_m), 0.0};
                for (std::size_t k = 3; k + 3 < kRows; ++k) lattice.at(k, i) += step;
                const std::vector<double> moved(fleet.sampling.intervals(), glm::length(step));
                pairs.moved(i, moved);
            }
            fleet = Fleet(lattice, per);
            ASSERT_TRUE(pairs.refresh(fleet.samples, {}));
        }
        expect_all_close_listed(pairs, fleet, needed_m);
    }
}

TEST(ClosePairs, SaysWhenThereAreTooMany) {
    Lattice lattice{3000, Points(3000 * kRows)};  // everybody at one place
    const Fleet fleet(lattice, 1);
    ClosePairs pairs(fleet.sampling, 3000, 2.0, 0.5);
    EXPECT_FALSE(pairs.refresh(fleet.samples, {}));
    EXPECT_TRUE(pairs.crowded());
    EXPECT_LT(pairs.pairs().size(), 1'000'000u);
}

TEST(ClosestApproaches, AgreeWithTheClosedForm) {
    const Fleet fleet(random_map(2), 2);
    std::vector<double> squared(kRows + 4), share(kRows + 4);
    for (std::size_t i = 0; i + 1 < kDrones; ++i) {
        for (std::size_t q = 0; q < 2; ++q) {
            const std::size_t before = fleet.sampling.before(q), after = fleet.sampling.after(q);
            closest_approaches(fleet.samples.of(i), fleet.samples.of(i + 1), fleet.sampling.axis_stride(), before,
                               after, kRows - 3, squared.data(), share.data());
            double least = 1e300;
            for (std::size_t m = 0; m < kRows - 3; ++m) {
                const Vec3 b = fleet.at(i + 1, before + m) - fleet.at(i, before + m);
                const Vec3 way = fleet.at(i + 1, after + m) - fleet.at(i, after + m) - b;
                const double w = std::clamp(-glm::dot(b, way) / std::max(1e-300, glm::dot(way, way)), 0.0, 1.0);
                EXPECT_NEAR(std::sqrt(squared[m]), glm::length(b + w * way), 1e-9);
                EXPECT_NEAR(share[m], w, 1e-9);
                least = std::min(least, squared[m]);
            }
            EXPECT_EQ(smallest(squared.data(), kRows - 3), least);
        }
    }
}

}  // namespace
}  // namespace aerogram::planner
