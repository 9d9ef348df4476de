#include "planner/transition/spectral.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stop_token>
#include <thread>

#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

struct Pair {
    std::string name;
    SpectralKeyframe source, target;
};

/// Generic, symmetric and degenerate pairs.
std::vector<Pair> pairs() {
    Random random(41);
    std::vector<Pair> out;
    const auto add = [&](std::string name, SpectralKeyframe a, SpectralKeyframe b) {
        out.push_back({std::move(name), std::move(a), std::move(b)});
    };
    add("generic", keyframe(random_points(random, 30)), keyframe(random_points(random, 30)));
    add("letters T H", keyframe(letter_t(24)), keyframe(letter_h(24)));
    add("letters H E", keyframe(letter_h(40)), keyframe(letter_e(40)));
    add("ring to turned ring", keyframe(ring(12, 5.0), 2), keyframe(ring(12, 8.0, 1.0), 2));
    add("ring to letter", keyframe(ring(16, 5.0), 2), keyframe(letter_t(16)));
    add("complete graphs", {random_points(random, 8), complete_graph(8)},
        {random_points(random, 8), complete_graph(8)});
    add("complete to generic", {ring(9, 4.0), complete_graph(9)}, keyframe(random_points(random, 9)));
    add("disconnected", {random_points(random, 7), {7, {{0, 1, 1.0}, {2, 3, 0.5}, {3, 4, 1.0}}}},
        {random_points(random, 7), {7, {{0, 6, 1.0}, {1, 5, 0.5}}}});
    add("no edges", {random_points(random, 6), {6, {}}}, {random_points(random, 6), {6, {}}});
    Points line, crossed;
    for (int i = 0; i < 9; ++i) {
        line.push_back({2.0 * i, 0, 20});
        crossed.push_back({0, 3, 30 - 2.0 * i});
    }
    add("collinear", keyframe(line, 2), keyframe(crossed, 2));
    add("collinear reversed", keyframe(line, 2), keyframe(Points(line.rbegin(), line.rend()), 2));
    Points mirrored = letter_e(20);
    for (Vec3& p : mirrored) p.x = -p.x;
    add("mirrored letter", keyframe(letter_e(20)), keyframe(mirrored));
    Points shrunk(10, Vec3{1, 2, 3});
    add("to one point", keyframe(random_points(random, 10)), {shrunk, complete_graph(10)});
    add("one drone", keyframe({{1, 2, 3}}), keyframe({{4, 5, 6}}));
    add("two drones", keyframe({{0, 0, 0}, {2, 0, 0}}), keyframe({{1, 1, 5}, {1, 1, 1}}));
    add("two drones swap", keyframe({{0, 0, 9}, {2, 0, 9}}), keyframe({{2, 0, 9}, {0, 0, 9}}));
    add("three drones", keyframe({{0, 0, 0}, {2, 0, 0}, {0, 0, 2}}), keyframe({{0, 0, 0}, {0, 3, 0}, {0, 3, 3}}));
    return out;
}

std::vector<SpectralOptions> all_options() {
    std::vector<SpectralOptions> out;
    for (const Align align : {Align::pca, Align::kabsch, Align::none}) {
        for (const Reorder reorder : {Reorder::greedy, Reorder::max_min, Reorder::optimal, Reorder::none}) {
            for (const bool inflate : {false, true}) out.push_back({align, reorder, inflate});
        }
    }
    return out;
}

double size2(const Points& points) {
    Vec3 middle{};
    for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
    double sum = 0.0;
    for (const Vec3& p : points) sum += glm::dot(p - middle, p - middle);
    return sum;
}

double path_length(const SpectralTransition& transition, std::size_t n) {
    double sum = 0.0;
    Points last = positions(transition, n, 0.0);
    for (int i = 1; i <= 100; ++i) {
        const Points next = positions(transition, n, i / 100.0);
        for (std::size_t k = 0; k < n; ++k) sum += glm::distance(last[k], next[k]);
        last = next;
    }
    return sum;
}

dense::Matrix power(const SpectralTransition& transition, std::size_t n, double t) {
    dense::Matrix out(n, n);
    out.values = transition.rotation_power(t);
    return out;
}

TEST(SpectralTransition, Property1And5EndsAreMetForEveryOptionAndDegeneracy) {
    for (const Pair& pair : pairs()) {
        const std::size_t n = pair.source.positions_m.size();
        for (const SpectralOptions& options : all_options()) {
            const SpectralTransition transition = built(pair.source, pair.target, options);
            EXPECT_LT(largest_distance(positions(transition, n, 0.0), pair.source.positions_m), 1e-9) << pair.name;
            EXPECT_LT(largest_distance(positions(transition, n, 1.0), pair.target.positions_m), 1e-9) << pair.name;
            for (const Vec3& p : positions(transition, n, 0.37)) EXPECT_TRUE(is_finite(p)) << pair.name;
        }
    }
}

TEST(SpectralTransition, Property2PowersComposeAndKeepTheConstantVector) {
    for (const Pair& pair : pairs()) {
        const std::size_t n = pair.source.positions_m.size();
        const SpectralTransition transition = built(pair.source, pair.target);
        const dense::Matrix whole = power(transition, n, 1.0), half = power(transition, n, 0.5);
        EXPECT_LT(largest_difference(times(half, half), whole), 1e-11) << pair.name;
        EXPECT_LT(largest_difference(power(transition, n, 0.0), identity(n)), 1e-12) << pair.name;
        EXPECT_LT(largest_difference(times(half, transposed(half)), identity(n)), 1e-12) << pair.name;
        EXPECT_EQ(dense::determinant_sign(whole), 1.0) << pair.name;
        for (std::size_t i = 0; i < n; ++i) {
            double row = 0.0;
            for (std::size_t j = 0; j < n; ++j) row += half(i, j);
            EXPECT_NEAR(row, 1.0, 1e-12) << pair.name;
        }
    }
}

/// R = T Sᵀ takes the source's Laplacian eigenvectors to the target's: R L_S Rᵀ has the target's eigenvectors. With
/// simple spectra and reordering that means R L_S Rᵀ and L_T commute, which needs no eigensolver to check.
TEST(SpectralTransition, Property2RotationTakesEigenvectorsToEigenvectors) {
    const int count = tries(20);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 4 + random.below(20);
        const SpectralKeyframe source = keyframe(random_points(random, n)), target = keyframe(random_points(random, n));
        const auto laplacian = [n](const AdjacencyGraph& graph) {
            dense::Matrix l(n, n);
            for (const Edge& e : graph.edges) {
                l(e.a, e.a) += e.weight;
                l(e.b, e.b) += e.weight;
                l(e.a, e.b) = l(e.b, e.a) = -e.weight;
            }
            return l;
        };
        for (const Reorder reorder : {Reorder::greedy, Reorder::optimal, Reorder::none}) {
            const dense::Matrix r = power(built(source, target, {Align::kabsch, reorder, false}), n, 1.0);
            const dense::Matrix carried = times(times(r, laplacian(source.graph)), transposed(r));
            const dense::Matrix l = laplacian(target.graph);
            EXPECT_LT(largest_difference(times(carried, l), times(l, carried)), 1e-10);
        }
    }
}

TEST(SpectralTransition, Property3RigidMotionOfTheInputMovesTheOutput) {
    Random random(42);
    for (const Pair& pair : pairs()) {
        // Half turns of lines go about show axes.
        if (pair.name == "collinear reversed" || pair.name == "two drones swap") continue;
        const std::size_t n = pair.source.positions_m.size();
        for (const Align align : {Align::pca, Align::kabsch, Align::none}) {
            const RigidMotion motion = random_motion(random);
            SpectralKeyframe source = pair.source, target = pair.target;
            source.positions_m = motion(source.positions_m);
            target.positions_m = motion(target.positions_m);
            // The graphs come from the moved points again, so that weights differ by rounding.
            for (auto* k : {&source, &target}) {
                for (Edge& e : k->graph.edges) {
                    const double shaken = random.between(-1e-15, 1e-15);
                    e.weight *= 1.0 + shaken;
                }
            }
            const SpectralOptions options{align, Reorder::optimal, false};
            const SpectralTransition here = built(pair.source, pair.target, options),
                                     there = built(source, target, options);
            for (const double t : {0.2, 0.5, 0.9}) {
                EXPECT_LT(largest_distance(positions(there, n, t), motion(positions(here, n, t))), 1e-6) << pair.name;
            }
        }
    }
}

TEST(SpectralTransition, Property4SizeIsTheOneOfTheCoefficientNorms) {
    // Σ((1-t) r_S + t r_T)² is a parabola in t: three values give all others.
    for (const Pair& pair : pairs()) {
        const std::size_t n = pair.source.positions_m.size();
        const SpectralTransition transition = built(pair.source, pair.target);
        const auto size = [&](double t) { return size2(positions(transition, n, t)) / static_cast<double>(n); };
        const double a = size(0.0), b = size(0.5), c = size(1.0);
        for (const double t : {0.13, 0.4, 0.71, 0.95}) {
            const double parabola = a * (1 - t) * (1 - 2 * t) + b * 4 * t * (1 - t) + c * t * (2 * t - 1);
            EXPECT_NEAR(size(t), parabola, 1e-9 * std::max(1.0, a)) << pair.name;
        }
        EXPECT_LE(std::sqrt(b), 0.5 * (std::sqrt(a) + std::sqrt(c)) + 1e-9) << pair.name;
    }
}

TEST(SpectralTransition, InflateKeepsTheInterpolatedSize) {
    for (const Pair& pair : pairs()) {
        const std::size_t n = pair.source.positions_m.size();
        const SpectralTransition transition = built(pair.source, pair.target, {Align::kabsch, Reorder::optimal, true});
        const double from = std::sqrt(size2(pair.source.positions_m)), to = std::sqrt(size2(pair.target.positions_m));
        for (const double t : {0.25, 0.5, 0.8}) {
            EXPECT_NEAR(std::sqrt(size2(positions(transition, n, t))), (1 - t) * from + t * to, 1e-9) << pair.name;
        }
    }
}

TEST(SpectralTransition, SameFormationMovedRigidlyFliesAsOneBody) {
    for (const Points& shape : {letter_h(20), ring(15, 6.0), letter_e(31)}) {
        const RigidMotion motion{{glm::normalize(Vec3{1, 2, 0.5}), 1.3}, {10, -3, 4}};
        const SpectralKeyframe source = keyframe(shape), target{motion(shape), source.graph};
        const SpectralTransition transition = built(source, target);
        for (const double t : {0.3, 0.5, 0.8}) {
            const Points now = positions(transition, shape.size(), t);
            for (std::size_t i = 0; i < shape.size(); ++i) {
                EXPECT_NEAR(glm::distance(now[0], now[i]), glm::distance(shape[0], shape[i]), 1e-9);
            }
        }
    }
}

TEST(SpectralTransition, PermutedDronesFlyThePermutedPaths) {
    const int count = tries(15);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 3 + random.below(25);
        std::vector<std::size_t> to(n);
        std::iota(to.begin(), to.end(), std::size_t{0});
        for (std::size_t i = n; i > 1; --i) std::swap(to[i - 1], to[random.below(i)]);
        const auto permuted = [&](const Points& points) {
            Points out(n);
            for (std::size_t i = 0; i < n; ++i) out[to[i]] = points[i];
            return out;
        };
        const Points a = random_points(random, n), b = random_points(random, n);
        const SpectralTransition plain = built(keyframe(a), keyframe(b));
        const SpectralTransition other = built(keyframe(permuted(a)), keyframe(permuted(b)));
        for (const double t : {0.3, 0.6}) {
            EXPECT_LT(largest_distance(positions(other, n, t), permuted(positions(plain, n, t))), 1e-7);
        }
    }
}

TEST(SpectralTransition, PathsAreContinuousAndEnd) {
    for (const Pair& pair : pairs()) {
        const std::size_t n = pair.source.positions_m.size();
        const SpectralTransition transition = built(pair.source, pair.target);
        const double far = std::sqrt(size2(pair.source.positions_m) + size2(pair.target.positions_m)) +
                           largest_distance(pair.source.positions_m, pair.target.positions_m);
        Points last = positions(transition, n, 0.0);
        for (int i = 1; i <= 500; ++i) {
            const Points next = positions(transition, n, i / 500.0);
            EXPECT_LT(largest_distance(last, next), 0.03 * far) << pair.name << " at " << i;
            last = next;
        }
    }
}

TEST(SpectralTransition, ReorderingShortensPathsOnTheWhole) {
    const int count = tries(20);
    double none = 0.0, greedy = 0.0, optimal = 0.0;
    for (int seed = 1; seed <= count; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const Points a = random_points(random, 20);
        Points b = a;  // a deformed copy: neighbours stay neighbours, the spectrum changes
        for (Vec3& p : b) p = Vec3{1.6 * p.x, 0.7 * p.y, p.z} + random.in_cube(2.0);
        const auto length = [&](Reorder r) {
            return path_length(built(keyframe(a), keyframe(b), {Align::kabsch, r, false}), 20);
        };
        none += length(Reorder::none);
        greedy += length(Reorder::greedy);
        optimal += length(Reorder::optimal);
    }
    EXPECT_LT(optimal, greedy);
    EXPECT_LT(greedy, none);
}

TEST(SpectralTransition, Property6SameBytesAgainAndOnManyThreads) {
    const SpectralKeyframe source = keyframe(letter_t(30)), target = keyframe(ring(30, 7.0));
    const Points expected = positions(built(source, target), 30, 0.4);
    std::vector<Points> found(3);
    std::vector<std::thread> threads;
    for (Points& mine : found) threads.emplace_back([&] { mine = positions(built(source, target), 30, 0.4); });
    for (std::thread& t : threads) t.join();
    for (const Points& mine : found) EXPECT_EQ(mine, expected);
}

TEST(SpectralTransition, ManyInstantsAtOnceAreTheSameFrames) {
    for (const Pair& pair : pairs()) {
        const std::size_t n = pair.source.positions_m.size();
        const SpectralTransition transition = built(pair.source, pair.target);
        std::vector<double> shares;
        for (int i = 0; i <= 130; ++i) shares.push_back(i / 130.0);  // more than are done together
        Points rows(shares.size() * n);
        transition.sample(shares, rows);
        for (const std::size_t s : {0U, 1U, 63U, 64U, 100U, 130U}) {
            EXPECT_LT(largest_distance(positions(transition, n, shares[s]), std::span(rows).subspan(s * n, n)), 1e-10)
                << pair.name;
        }
    }
}

SpectralTransition with_modes(const Pair& pair, std::size_t modes, const SpectralOptions& options = {}) {
    auto result = SpectralTransition::with_modes(pair.source, pair.target, options, modes, ::aerogram::Run{});
    return std::move(result).value();
}

TEST(SpectralTransition, Property1And7FewModesMeetTheEndsAndAllModesAreTheFullTransition) {
    for (const Pair& pair : pairs()) {
        const std::size_t n = pair.source.positions_m.size();
        const Points expected = positions(built(pair.source, pair.target), n, 0.5);
        EXPECT_LT(largest_distance(positions(with_modes(pair, n - 1), n, 0.5), expected), 1e-9) << pair.name;
        for (std::size_t modes = 0; modes < n; ++modes) {
            for (const bool inflate : {false, true}) {
                const SpectralTransition few = with_modes(pair, modes, {Align::kabsch, Reorder::optimal, inflate});
                EXPECT_LT(largest_distance(positions(few, n, 0.0), pair.source.positions_m), 1e-9) << pair.name;
                EXPECT_LT(largest_distance(positions(few, n, 1.0), pair.target.positions_m), 1e-9) << pair.name;
                for (const Vec3& p : positions(few, n, 0.37)) EXPECT_TRUE(is_finite(p)) << pair.name;
            }
        }
    }
}

TEST(SpectralTransition, Property7TheSparseWayWithAllButFewModesIsCloseToTheFullOne) {
    Random random(43);  // a smooth deformation: detail is small, so few modes tell nearly all
    Points a, b;
    for (int i = 0; i < 160; ++i) {
        const Vec3 p{2.5 * (i % 16) + random.between(-0.1, 0.1), 0.0, 2.5 * (i / 16) + random.between(-0.1, 0.1)};
        a.push_back(p);
        b.push_back({1.3 * p.x + 0.02 * p.z * p.z, 4.0 * std::sin(0.1 * p.x), 0.9 * p.z});
    }
    const Pair pair{"deformed", {a, delaunay_adjacency(a)}, {b, delaunay_adjacency(b)}};
    const Points full = positions(built(pair.source, pair.target), 160, 0.5);
    const double coarse = largest_distance(positions(with_modes(pair, 10), 160, 0.5), full),
                 fine = largest_distance(positions(with_modes(pair, 60), 160, 0.5), full);
    EXPECT_LT(coarse, 6.0);
    EXPECT_LT(fine, 2.0);
}

TEST(SpectralTransition, FewModesFlyARigidMotionRigidly) {
    Random random(44);
    const Points shape = random_points(random, 60);
    const RigidMotion motion = random_motion(random);
    const Pair pair{"moved", keyframe(shape), {motion(shape), keyframe(shape).graph}};
    const Points now = positions(with_modes(pair, 12), 60, 0.4);
    for (std::size_t i = 0; i < 60; ++i) {
        EXPECT_NEAR(glm::distance(now[0], now[i]), glm::distance(shape[0], shape[i]), 1e-8);
    }
}

TEST(SpectralTransition, MoreThanTheFullBasisStillMeetsTheEnds) {
    Points a, b;
    for (std::size_t i = 0; i < kFullBasis + 100; ++i) {
        const double u = static_cast<double>(i);
        a.push_back({2.2 * std::fmod(u, 52.0), 0.0, 2.2 * std::floor(u / 52.0)});
        b.push_back({0.02 * u * std::cos(0.1 * u), 0.02 * u * std::sin(0.1 * u), 0.03 * u});
    }
    const auto chain = [](const Points& points) {  // four neighbours on, so that graphs cost nothing
        AdjacencyGraph g{points.size(), {}};
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            for (const std::uint32_t step : {1U, 52U}) {
                if (i + step < points.size()) g.edges.push_back({i, i + step, 1.0});
            }
        }
        return SpectralKeyframe{points, g};
    };
    const SpectralTransition transition = built(chain(a), chain(b));
    EXPECT_LT(largest_distance(positions(transition, a.size(), 0.0), a), 1e-9);
    EXPECT_LT(largest_distance(positions(transition, a.size(), 1.0), b), 1e-9);
}

TEST(SpectralTransition, StopsWhenAsked) {
    std::stop_source stop;
    stop.request_stop();
    const auto result = SpectralTransition::between(keyframe(letter_t(9)), keyframe(letter_h(9)), {},
                                                    ::aerogram::Run{stop.get_token(), {}, 1});
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::stopped);
}

TEST(SpectralTransition, RefusesFleetsThatDoNotFit) {
    EXPECT_THROW((void)built(keyframe(letter_t(9)), keyframe(letter_t(10))), ContractViolation);
    EXPECT_THROW((void)built({letter_t(9), complete_graph(8)}, keyframe(letter_t(9))), ContractViolation);
    Points broken = letter_t(9);
    broken[3].y = std::nan("");
    EXPECT_THROW((void)built({broken, complete_graph(9)}, keyframe(letter_t(9))), ContractViolation);
}

}  // namespace
}  // namespace aerogram::planner
