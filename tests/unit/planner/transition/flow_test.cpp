#include "planner/transition/flow.hpp"

#include <gtest/gtest.h>

#include <stop_token>

#include "planner/transition/catmull_rom.hpp"
#include "planner/transition/flow_spectral.hpp"
#include "tests/unit/planner/transition/shapes.hpp"

namespace aerogram::planner {
namespace {

using namespace testing;

std::vector<FlowLeg> legs_of(FlowOf of, std::size_t count, double tension = 0.5) {
    std::vector<FlowLeg> legs(count);
    for (FlowLeg& leg : legs) leg.options = {tension, false, of};
    return legs;
}
Points at_knot(const Flow& flow, std::size_t knot) {
    Points out(flow.lattice.drones);
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = knot_value(flow.lattice.at(knot, i), flow.lattice.at(knot + 1, i), flow.lattice.at(knot + 2, i));
    }
    return out;
}
Flow flown(std::span<const SpectralKeyframe> keyframes, std::span<const FlowLeg> legs, std::size_t rows = 24,
           const SpectralOptions& options = {}) {
    return std::move(flow_transition(keyframes, legs, options, rows, ::aerogram::Run{})).value();
}
std::vector<SpectralKeyframe> letters(std::size_t n) {
    std::vector<SpectralKeyframe> out{keyframe(letter_t(n)), keyframe(letter_h(n)), keyframe(letter_e(n)),
                                      keyframe(ring(n, 7.0)), keyframe(letter_t(n))};
    for (std::size_t j = 0; j < out.size(); ++j) {
        for (Vec3& p : out[j].positions_m) p += Vec3{15.0 * static_cast<double>(j), 0, 40};
    }
    return out;
}
SpectralFlow spectral_flow(std::span<const SpectralKeyframe> keyframes, std::span<const FlowLeg> legs,
                           const SpectralOptions& options = {}) {
    std::vector<FlowOptions> wishes;
    for (const FlowLeg& leg : legs) wishes.push_back(leg.options);
    return std::move(SpectralFlow::through(keyframes, catmull_rom_legs(wishes), options, ::aerogram::Run{})).value();
}

TEST(CatmullRom, WeightsAreEquation5) {
    const CatmullRomLeg leg{0, 1, 2, 3, 0.5, 0.5};
    const double tau = 0.5;
    for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        const CatmullRomWeights c = catmull_rom_weights(leg, t);
        EXPECT_NEAR(c.before, tau * (-t + 2 * t * t - t * t * t), 1e-15);
        EXPECT_NEAR(c.from, (1 - 3 * t * t + 2 * t * t * t) + tau * (t * t - t * t * t), 1e-15);
        EXPECT_NEAR(c.to, (3 * t * t - 2 * t * t * t) + tau * (t - 2 * t * t + t * t * t), 1e-15);
        EXPECT_NEAR(c.after, tau * (-t * t + t * t * t), 1e-15);
    }
}

TEST(CatmullRom, EndsAndCornersStandInForTheirNeighboursAndTensionsMeetInTheMiddle) {
    const std::vector<FlowOptions> options{{0.2, false, {}}, {0.6, true, {}}, {1.0, false, {}}};
    const std::vector<CatmullRomLeg> legs = catmull_rom_legs(options);
    EXPECT_EQ(legs[0].before, 0U);
    EXPECT_EQ(legs[0].after, 2U);
    EXPECT_DOUBLE_EQ(legs[0].tension_to, 0.4);
    EXPECT_DOUBLE_EQ(legs[1].tension_from, 0.4);
    EXPECT_EQ(legs[1].after, 2U);  // the corner
    EXPECT_EQ(legs[2].before, 2U);
    EXPECT_DOUBLE_EQ(legs[2].tension_from, 1.0);
    EXPECT_EQ(legs[2].after, 3U);
}

TEST(Flow, Property1KeyframesAreMetAtTheirKnots) {
    for (const FlowOf of : {FlowOf::positions, FlowOf::spectral}) {
        for (const Align align : {Align::kabsch, Align::pca, Align::none}) {
            const auto keyframes = letters(20);
            std::vector<FlowLeg> legs = legs_of(of, 4);
            legs[1].options.corner = true;
            const Flow flow = flown(keyframes, legs, 24, {align, Reorder::optimal, false});
            EXPECT_EQ(flow.keyframe_knots.front(), 0U);
            EXPECT_EQ(flow.keyframe_knots.back(), flow.lattice.rows() - 3);
            for (std::size_t j = 0; j < keyframes.size(); ++j) {
                EXPECT_LT(largest_distance(at_knot(flow, flow.keyframe_knots[j]), keyframes[j].positions_m), 1e-9);
            }
        }
    }
}

TEST(Flow, BeginsAndEndsAtRest) {
    const auto keyframes = letters(12);
    for (const FlowOf of : {FlowOf::positions, FlowOf::spectral}) {
        const Flow flow = flown(keyframes, legs_of(of, 4));
        const std::size_t last = flow.lattice.rows() - 1;
        for (std::size_t i = 0; i < 12; ++i) {
            for (const std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
                EXPECT_EQ(flow.lattice.at(k, i), keyframes.front().positions_m[i]);
                EXPECT_EQ(flow.lattice.at(last - k, i), keyframes.back().positions_m[i]);
            }
        }
    }
}

TEST(SpectralFlow, FormulaItselfMeetsKeyframesFromBothSides) {
    Random random(51);
    for (const std::size_t n : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{18}}) {
        std::vector<SpectralKeyframe> keyframes;
        for (int j = 0; j < 5; ++j) keyframes.push_back(keyframe(random_points(random, n)));
        for (const bool inflate : {false, true}) {
            std::vector<FlowLeg> legs = legs_of(FlowOf::spectral, 4, 0.8);
            legs[2].options.corner = true;
            const SpectralFlow flow = spectral_flow(keyframes, legs, {Align::kabsch, Reorder::greedy, inflate});
            Points at(n);
            for (std::size_t leg = 0; leg < 4; ++leg) {
                flow.at(leg, 0.0, at);
                EXPECT_LT(largest_distance(at, keyframes[leg].positions_m), 1e-10);
                flow.at(leg, 1.0, at);
                EXPECT_LT(largest_distance(at, keyframes[leg + 1].positions_m), 1e-10);
            }
        }
    }
}

TEST(SpectralFlow, Property2VelocityIsContinuousWhereKeyframesArePassed) {
    const int count = tries(10);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        Random random(static_cast<std::uint64_t>(seed));
        const std::size_t n = 2 + random.below(20);
        std::vector<SpectralKeyframe> keyframes;
        for (int j = 0; j < 5; ++j) keyframes.push_back(keyframe(random_points(random, n)));
        std::vector<FlowLeg> legs = legs_of(FlowOf::spectral, 4);
        for (FlowLeg& leg : legs) leg.options.tension = random.between(0.2, 1.0);
        const SpectralFlow flow = spectral_flow(keyframes, legs, {Align::kabsch, Reorder::optimal, seed % 2 == 0});
        // One-sided second-order differences at each passed keyframe.
        constexpr double kStep = 1e-5;
        for (std::size_t j = 1; j < 4; ++j) {
            Points before2(n), before(n), here(n), after(n), after2(n);
            flow.at(j - 1, 1.0 - 2 * kStep, before2);
            flow.at(j - 1, 1.0 - kStep, before);
            flow.at(j, 0.0, here);
            flow.at(j, kStep, after);
            flow.at(j, 2 * kStep, after2);
            double fastest = 0.0;
            for (std::size_t i = 0; i < n; ++i) {
                const Vec3 left = (3.0 * here[i] - 4.0 * before[i] + before2[i]) / (2 * kStep);
                const Vec3 right = (-3.0 * here[i] + 4.0 * after[i] - after2[i]) / (2 * kStep);
                EXPECT_LT(glm::distance(left, right), 1e-4);
                fastest = std::max(fastest, glm::length(left));
            }
            EXPECT_GT(fastest, 1.0);
        }
    }
}

TEST(Flow, Property2SplineStaysCloseToTheCurveBetweenKnots) {
    const auto keyframes = letters(15);
    for (const FlowOf of : {FlowOf::positions, FlowOf::spectral}) {
        const Flow coarse = flown(keyframes, legs_of(of, 4), 24), fine = flown(keyframes, legs_of(of, 4), 96);
        // The keyframes' knots differ by rounding, so compare the paths: every coarse knot is near the fine path.
        double worst = 0.0;
        for (std::size_t knot = 0; knot + 2 < coarse.lattice.rows(); ++knot) {
            const Points here = at_knot(coarse, knot);
            double nearest = 1e9;
            for (std::size_t other = 0; other + 2 < fine.lattice.rows(); ++other) {
                nearest = std::min(nearest, largest_distance(here, at_knot(fine, other)));
            }
            worst = std::max(worst, nearest);
        }
        EXPECT_LT(worst, 1.0);
    }
}

TEST(Flow, CornerIsReachedNearlyAtRestAndPassingIsNot) {
    const std::vector<SpectralKeyframe> keyframes{
        keyframe({{0, 0, 10}, {0, 3, 10}}), keyframe({{20, 0, 10}, {20, 3, 10}}), keyframe({{20, 0, 30}, {20, 3, 30}})};
    for (const FlowOf of : {FlowOf::positions, FlowOf::spectral}) {
        std::vector<FlowLeg> legs = legs_of(of, 2);
        const auto speed = [&](bool corner) {
            legs[0].options.corner = corner;
            const Flow flow = flown(keyframes, legs);
            const std::size_t knot = flow.keyframe_knots[1];
            double fastest = 0.0;
            for (std::size_t k = 0; k + 1 < flow.lattice.rows(); ++k) {
                fastest = std::max(fastest, glm::distance(flow.lattice.at(k, 0), flow.lattice.at(k + 1, 0)));
            }
            return 0.5 * glm::distance(flow.lattice.at(knot + 2, 0), flow.lattice.at(knot, 0)) / fastest;
        };
        EXPECT_LT(speed(true), 0.01);
        EXPECT_GT(speed(false), 0.4);
    }
}

TEST(Flow, CornerKeepsTheLegsOnTheirChords) {
    const std::vector<SpectralKeyframe> keyframes{keyframe({{0, 0, 10}}), keyframe({{20, 0, 10}}),
                                                  keyframe({{20, 0, 30}})};
    std::vector<FlowLeg> legs = legs_of(FlowOf::positions, 2);
    legs[0].options.corner = true;
    const Flow flow = flown(keyframes, legs);
    for (std::size_t knot = 0; knot + 2 < flow.lattice.rows(); ++knot) {
        const Vec3 p = at_knot(flow, knot)[0];
        EXPECT_LT(std::min(std::abs(p.x - 20.0), std::abs(p.z - 10.0)), 1e-3);
    }
}

TEST(Flow, TwoKeyframesOnPositionsAreAStraightMinimumJerkFlight) {
    const std::vector<SpectralKeyframe> keyframes{keyframe({{0, 0, 10}}), keyframe({{30, 0, 10}})};
    const Flow flow = flown(keyframes, legs_of(FlowOf::positions, 1, 0.0), 40);
    for (std::size_t knot = 2; knot < 39; ++knot) {
        const double x = static_cast<double>(knot) / 40.0;
        const double u = x * x * x * (10 - 15 * x + 6 * x * x);
        // Tension 0 eases every leg by itself: 3u² - 2u³.
        EXPECT_NEAR(at_knot(flow, knot)[0].x, 30.0 * u * u * (3 - 2 * u), 1e-9);
    }
}

TEST(Flow, Property3RigidMotionCommutes) {
    Random random(52);
    for (const FlowOf of : {FlowOf::positions, FlowOf::spectral}) {
        std::vector<SpectralKeyframe> keyframes, moved;
        const RigidMotion motion = random_motion(random);
        for (int j = 0; j < 4; ++j) {
            keyframes.push_back(keyframe(random_points(random, 14)));
            moved.push_back(keyframe(motion(keyframes.back().positions_m)));
        }
        const Flow here = flown(keyframes, legs_of(of, 3)), there = flown(moved, legs_of(of, 3));
        ASSERT_EQ(here.keyframe_knots, there.keyframe_knots);
        EXPECT_LT(largest_distance(there.lattice.points_m, motion(here.lattice.points_m)), 1e-7);
    }
}

TEST(SpectralFlow, OneLegEqualsTheTransitionWhereOnlyTheBasisTurns) {
    // Coefficients of equal direction and length: blending vectors and slerp agree, and tension 1/2 eases both alike.
    Random random(53);
    const Points shape = letter_h(16);
    SpectralKeyframe source = keyframe(shape), target = source;
    const RigidMotion motion{{random.direction(), 1.1}, {5, 6, 7}};
    target.positions_m = motion(shape);
    const std::vector<SpectralKeyframe> keyframes{source, target};
    const SpectralFlow flow = spectral_flow(keyframes, legs_of(FlowOf::spectral, 1));
    const SpectralTransition transition = built(source, target);
    for (const double t : {0.2, 0.5, 0.8}) {
        Points at(16);
        flow.at(0, t, at);
        const CatmullRomWeights c = catmull_rom_weights({0, 0, 1, 1, 0.5, 0.5}, t);
        EXPECT_LT(largest_distance(at, positions(transition, 16, c.to + c.after)), 1e-9);
    }
}

TEST(Flow, Property4SameBytesWithOneAndTwoThreads) {
    const auto keyframes = letters(16);
    for (const FlowOf of : {FlowOf::positions, FlowOf::spectral}) {
        const auto legs = legs_of(of, 4);
        ::aerogram::Run two;
        two.threads = 2;
        const Flow a = flown(keyframes, legs);
        const Flow b = std::move(flow_transition(keyframes, legs, {}, 24, two)).value();
        EXPECT_EQ(a.lattice.points_m, b.lattice.points_m);
    }
}

TEST(Flow, StopsWhenAsked) {
    std::stop_source stop;
    stop.request_stop();
    for (const FlowOf of : {FlowOf::positions, FlowOf::spectral}) {
        const auto result =
            flow_transition(letters(8), legs_of(of, 4), {}, 24, ::aerogram::Run{stop.get_token(), {}, 1});
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().code, ErrorCode::stopped);
    }
}

TEST(Flow, RefusesLegsThatDoNotFitTheKeyframes) {
    EXPECT_THROW((void)flown(letters(5), legs_of(FlowOf::positions, 3)), ContractViolation);
    auto keyframes = letters(5);
    keyframes[2].positions_m.pop_back();
    EXPECT_THROW((void)flown(keyframes, legs_of(FlowOf::positions, 4)), ContractViolation);
}

}  // namespace
}  // namespace aerogram::planner
