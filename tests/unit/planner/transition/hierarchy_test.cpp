#include "planner/transition/hierarchy.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;
const ::aerogram::Run kRun{};

std::vector<DroneId> ids(std::size_t first, std::size_t last) {
    std::vector<DroneId> out;
    for (std::size_t i = first; i < last; ++i) out.push_back(DroneId(i));
    return out;
}

GroupMotion group(std::vector<DroneId> drones, Method method, double blend = 1.0) {
    GroupMotion out;
    out.drones = std::move(drones);
    out.method = method;
    out.blend = blend;
    return out;
}

/// Consecutive groups of equal size, level by level.
GroupMotion split(std::size_t first, std::size_t last, std::vector<std::size_t> counts, Method method,
                  double blend = 1.0) {
    GroupMotion out = group(ids(first, last), method, blend);
    if (counts.empty()) return out;
    const std::size_t size = (last - first) / counts[0];
    const std::vector<std::size_t> rest(counts.begin() + 1, counts.end());
    for (std::size_t k = 0; k < counts[0]; ++k) {
        out.inside.push_back(split(first + k * size, first + (k + 1) * size, rest, method, blend));
    }
    return out;
}

Points at(const Interpolation& motion, std::size_t n, double t) {
    Points out(n);
    motion(t, out);
    return out;
}

Interpolation flown(const SpectralKeyframe& a, const SpectralKeyframe& b, const GroupMotion& fleet) {
    auto result = hierarchical_interpolation(a, b, fleet, kRun);
    return std::move(result).value();
}
Interpolation flat(Method method, const SpectralKeyframe& a, const SpectralKeyframe& b) {
    auto result = interpolation(method, a, b, {}, kRun);
    return std::move(result).value();
}

/// A random tree of groups over the drones.
GroupMotion random_tree(Random& random, std::vector<DroneId> drones, int depth) {
    constexpr Method kMethods[] = {Method::straight, Method::spectral, Method::rigid};
    GroupMotion out = group(drones, kMethods[random.below(3)]);
    out.blend = random.below(3) == 0 ? random.unit() : 1.0;
    std::map<std::uint64_t, std::vector<DroneId>> parts;
    for (const DroneId d : drones) parts[random.below(4)].push_back(d);
    for (auto& [label, members] : parts) {
        if (label == 0 || depth == 0) continue;  // loose
        out.inside.push_back(random_tree(random, members, depth - 1));
    }
    return out;
}

TEST(Hierarchy, Property1EndsAreMetWhateverTheTree) {
    const int count = tries(40);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 1 + random.below(40);
        const SpectralKeyframe a = keyframe(random_points(random, n)), b = keyframe(random_points(random, n));
        const Interpolation motion = flown(a, b, random_tree(random, ids(0, n), 3));
        EXPECT_LT(largest_distance(at(motion, n, 0.0), a.positions_m), 1e-9);
        EXPECT_LT(largest_distance(at(motion, n, 1.0), b.positions_m), 1e-9);
        const std::vector<double> shares{0.0, 0.3, 0.8};
        Points rows(shares.size() * n);
        motion.sample(shares, rows);
        for (std::size_t s = 0; s < shares.size(); ++s) {
            const Points one = at(motion, n, shares[s]);
            EXPECT_LT(largest_distance(one, std::span(rows).subspan(s * n, n)), 1e-9);
            for (const Vec3& p : one) EXPECT_TRUE(is_finite(p));
        }
    }
}

TEST(Hierarchy, Property2WithoutGroupsItIsTheMethodItself) {
    Random random(2);
    const SpectralKeyframe a = keyframe(random_points(random, 20)), b = keyframe(random_points(random, 20));
    for (const Method method : {Method::straight, Method::spectral, Method::rigid}) {
        const Interpolation motion = flown(a, b, group(ids(0, 20), method));
        for (const double t : {0.0, 0.4, 1.0}) EXPECT_EQ(at(motion, 20, t), at(flat(method, a, b), 20, t));
    }
}

TEST(Hierarchy, Property3BarycentresMoveAsIndividualsOfTheParent) {
    const int count = tries(15);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const SpectralKeyframe a = keyframe(random_points(random, 24)), b = keyframe(random_points(random, 24));
        GroupMotion fleet = split(0, 24, {4, 2}, Method::spectral);
        for (GroupMotion& g : fleet.inside) g.method = random.below(2) == 0 ? Method::straight : Method::spectral;
        // The four barycentres as a fleet of four; the graph added up by hand.
        SpectralKeyframe wholes[2];
        const SpectralKeyframe* drones[2] = {&a, &b};
        for (int e = 0; e < 2; ++e) {
            wholes[e].positions_m.assign(4, Vec3{});
            double weight[4][4] = {};
            for (std::size_t i = 0; i < 24; ++i) wholes[e].positions_m[i / 6] += drones[e]->positions_m[i] / 6.0;
            for (const Edge& edge : drones[e]->graph.edges) weight[edge.a / 6][edge.b / 6] += edge.weight;
            wholes[e].graph.n = 4;
            for (std::uint32_t p = 0; p < 4; ++p) {
                for (std::uint32_t q = p + 1; q < 4; ++q) {
                    const double sum = weight[p][q] + weight[q][p];
                    if (sum > 0.0) wholes[e].graph.edges.push_back({p, q, sum});
                }
            }
        }
        const Interpolation motion = flown(a, b, fleet), expected = flat(Method::spectral, wholes[0], wholes[1]);
        for (const double t : {0.2, 0.5, 0.9}) {
            Points middles(4);
            const Points now = at(motion, 24, t);
            for (std::size_t i = 0; i < 24; ++i) middles[i / 6] += now[i] / 6.0;
            EXPECT_LT(largest_distance(middles, at(expected, 4, t)), 1e-9);
        }
    }
}

TEST(Hierarchy, Property4BlendZeroIsTheFlatMotionAndBlendsAreLinear) {
    Random random(4);
    const SpectralKeyframe a = keyframe(random_points(random, 18)), b = keyframe(random_points(random, 18));
    const Interpolation none = flown(a, b, split(0, 18, {3}, Method::spectral, 0.0)),
                        half = flown(a, b, split(0, 18, {3}, Method::spectral, 0.5)),
                        full = flown(a, b, split(0, 18, {3}, Method::spectral, 1.0)),
                        alone = flat(Method::spectral, a, b);
    for (const double t : {0.25, 0.6}) {
        EXPECT_LT(largest_distance(at(none, 18, t), at(alone, 18, t)), 1e-9);
        Points mean = at(full, 18, t);
        const Points other = at(alone, 18, t);
        for (std::size_t i = 0; i < 18; ++i) mean[i] = 0.5 * (mean[i] + other[i]);
        EXPECT_LT(largest_distance(at(half, 18, t), mean), 1e-9);
        EXPECT_GT(largest_distance(at(full, 18, t), other), 0.1) << "the groups make no difference";
    }
}

TEST(Hierarchy, Property5RigidMotionsAreFlownRigidlyHalfTurnsIncluded) {
    const int count = tries(30);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const Points shape = random_points(random, 64);
        RigidMotion motion = random_motion(random);
        if (seed % 2 == 0) motion.turn.angle_rad = std::numbers::pi - (seed % 4 == 0 ? 0.0 : 1e-3);
        const SpectralKeyframe a = keyframe(shape), b = keyframe(motion(shape));
        const Interpolation flight = flown(a, b, split(0, 64, {4, 4}, Method::spectral));
        for (const double t : {0.3, 0.5, 0.8}) {
            const Points now = at(flight, 64, t);
            double worst = 0.0;
            for (std::size_t i = 0; i < 64; ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    const double then = glm::distance(shape[i], shape[j]);
                    worst = std::max(worst, std::abs(glm::distance(now[i], now[j]) - then));
                }
            }
            EXPECT_LT(worst, 1e-6) << t;
        }
    }
}

TEST(Hierarchy, Property1EndsAreMetBesideObstacleVerticesThatTheFleetKeepsItsPlaceTo) {
    Random random(7);
    const Points fixed = random_points(random, 2);
    const auto beside = [&](Points drones) {
        Points all = drones;
        all.insert(all.end(), fixed.begin(), fixed.end());
        return SpectralKeyframe{std::move(drones), nearest_graph(all, 6), fixed};
    };
    const SpectralKeyframe a = beside(random_points(random, 18)), b = beside(random_points(random, 18));
    for (const Method method : {Method::straight, Method::spectral, Method::rigid}) {
        for (const double blend : {1.0, 0.4}) {
            const Interpolation motion = flown(a, b, split(0, 18, {3}, method, blend));
            EXPECT_LT(largest_distance(at(motion, 18, 0.0), a.positions_m), 1e-9);
            EXPECT_LT(largest_distance(at(motion, 18, 1.0), b.positions_m), 1e-9);
        }
    }
    // Groups of one are their drones: the same flight, obstacles and all.
    const Interpolation ones = flown(a, b, split(0, 18, {18}, Method::spectral)), alone = flat(Method::spectral, a, b);
    EXPECT_LT(largest_distance(at(ones, 18, 0.4), at(alone, 18, 0.4)), 1e-9);
}

TEST(Hierarchy, GroupsThatSwapPlacesAreNotSpunRound) {
    // Two groups of four swap along a half circle, each keeping its orientation.
    Points from, to;
    for (int g = 0; g < 2; ++g) {
        for (int i = 0; i < 4; ++i) {
            const Vec3 inner{2.5 * (i % 2), 0.5 * i, 2.5 * (i / 2)};
            from.push_back(Vec3{g == 0 ? -20.0 : 20.0, 0, 30} + inner);
            to.push_back(Vec3{g == 0 ? 20.0 : -20.0, 0, 30} + inner);
        }
    }
    const Interpolation motion = flown(keyframe(from), keyframe(to), split(0, 8, {2}, Method::spectral));
    const Points half = at(motion, 8, 0.5);
    for (std::size_t i : {1U, 2U, 3U}) {
        EXPECT_NEAR(glm::distance(half[i] - half[0], from[i] - from[0]), 0.0, 1e-6);
        EXPECT_NEAR(glm::distance(half[4 + i] - half[4], from[4 + i] - from[4]), 0.0, 1e-6);
    }
    EXPECT_GT(glm::distance(half[0], half[4]), 30.0) << "they meet instead of turning about one another";
}

TEST(Hierarchy, StopsAndRefusesTreesThatDoNotFit) {
    Random random(6);
    const SpectralKeyframe a = keyframe(random_points(random, 8)), b = keyframe(random_points(random, 8));
    std::stop_source stop;
    stop.request_stop();
    const auto stopped =
        hierarchical_interpolation(a, b, split(0, 8, {2}, Method::spectral), ::aerogram::Run{stop.get_token(), {}, 1});
    ASSERT_FALSE(stopped.ok());
    EXPECT_EQ(stopped.error().code, ErrorCode::stopped);
    GroupMotion twice = split(0, 8, {2}, Method::straight);
    twice.inside[1].drones = ids(3, 8);
    EXPECT_THROW((void)flown(a, b, twice), ContractViolation);
    EXPECT_THROW((void)flown(a, b, group(ids(0, 7), Method::straight)), ContractViolation);
    EXPECT_THROW((void)flown(a, b, group(ids(0, 8), Method::flow)), ContractViolation);
}

TEST(SpectralClusters, FindsTheBlobsThatAreThere) {
    const int count = tries(10);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t blobs = 2 + random.below(5), size = 12;
        Points points;
        std::vector<std::size_t> blob;
        for (std::size_t i = 0; i < blobs * size; ++i) {
            blob.push_back(i % blobs);  // interleaved, so that order tells nothing
            points.push_back(Vec3{40.0 * static_cast<double>(i % blobs), 0, 20} + random.in_cube(4.0));
        }
        SpectralKeyframe k{points, delaunay_adjacency(points)};
        const auto clusters = spectral_clusters(k, blobs, static_cast<std::uint64_t>(seed), kRun);
        ASSERT_TRUE(clusters.ok());
        ASSERT_EQ(clusters->size(), blobs);
        for (std::size_t c = 0; c < blobs; ++c) {
            EXPECT_EQ((*clusters)[c].size(), size);
            for (const DroneId d : (*clusters)[c]) EXPECT_EQ(blob[d.value], c);  // ordered by the first drone
        }
    }
}

TEST(SpectralClusters, EveryCountGivesThatManyGroupsOfEverybodyOnce) {
    Random random(8);
    std::vector<SpectralKeyframe> keyframes{keyframe(random_points(random, 13)),
                                            {Points(6, Vec3{1, 2, 3}), {6, {}}},
                                            {ring(12, 5.0), cycle_graph(12)},
                                            keyframe({{1, 2, 3}})};
    for (const SpectralKeyframe& k : keyframes) {
        const std::size_t n = k.positions_m.size();
        for (std::size_t count = 1; count <= n; ++count) {
            const auto clusters = spectral_clusters(k, count, 3, kRun);
            ASSERT_TRUE(clusters.ok());
            EXPECT_EQ(clusters->size(), count);
            std::vector<DroneId> everybody;
            for (const auto& c : *clusters) {
                EXPECT_FALSE(c.empty());
                EXPECT_TRUE(std::ranges::is_sorted(c));
                everybody.insert(everybody.end(), c.begin(), c.end());
            }
            std::ranges::sort(everybody);
            EXPECT_EQ(everybody, ids(0, n));
            EXPECT_EQ(*spectral_clusters(k, count, 3, kRun), *clusters);
        }
    }
}

}  // namespace
}  // namespace aerogram::planner
