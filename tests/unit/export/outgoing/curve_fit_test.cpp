#include "export/outgoing/curve_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/units.hpp"
#include "planner/motion/profile.hpp"
#include "planner/motion/timing.hpp"
#include "tests/unit/export/fixed_show.hpp"

namespace aerogram::exporter {
namespace {

using planner::Act;

/// Bernstein's polynomials, written out.
Vec3 value(const std::array<Vec3, 4>& c, double u) {
    const double v = 1.0 - u;
    return v * v * v * c[0] + 3.0 * u * v * v * c[1] + 3.0 * u * u * v * c[2] + u * u * u * c[3];
}
Vec3 slope(const std::array<Vec3, 4>& c, double u) {
    const double v = 1.0 - u;
    return 3.0 * v * v * (c[1] - c[0]) + 6.0 * u * v * (c[2] - c[1]) + 3.0 * u * u * (c[3] - c[2]);
}
Vec3 bend(const std::array<Vec3, 4>& c, double u) {
    return 6.0 * (1.0 - u) * (c[0] - 2.0 * c[1] + c[2]) + 6.0 * u * (c[1] - 2.0 * c[2] + c[3]);
}

/// What dense sampling finds.
FitError sampled_error(const Act& act, DroneId drone, const Fitted& fitted) {
    FitError worst;
    double exact_peak = 0.0, fit_peak = 0.0;
    for (const FittedPiece& piece : fitted.pieces) {
        const double length_s = seconds_from_ms(piece.duration_ms);
        for (int k = 0; k <= 200; ++k) {
            const double u = k / 200.0;
            const auto exact =
                planner::kinematics(act, drone, seconds_from_ms(piece.start_ms - act.start_ms) + u * length_s);
            const auto& c = piece.controls_m;
            worst.position_m = std::max(worst.position_m, glm::length(value(c, u) - exact.position_m));
            worst.speed_mps = std::max(worst.speed_mps, glm::length(slope(c, u) / length_s - exact.velocity_mps));
            fit_peak = std::max(fit_peak, glm::length(bend(c, u)) / (length_s * length_s));
        }
    }
    const std::size_t knots = planner::interval_count(act.motion);  // acceleration peaks there
    for (std::size_t m = 0; m <= knots; ++m) {
        const double t_s = static_cast<double>(m) * planner::knot_step_s(act);
        exact_peak = std::max(exact_peak, glm::length(planner::kinematics(act, drone, t_s).acceleration_mps2));
    }
    worst.acceleration_mps2 = std::max(0.0, fit_peak - std::max(exact_peak, Limits{}.acceleration_mps2));
    return worst;
}

/// A lively act: 60 control points of three drones on smooth random walks.
Act lively_act(Millis duration_ms, double stride_m) {
    planner::Lattice lattice{3, {}};
    std::uint64_t state = 42;
    std::vector<Vec3> at{{0, 0, 20}, {5, 0, 20}, {0, 5, 25}}, step(3);
    for (int k = 0; k < 60; ++k) {
        const bool rest = k < 3 || k > 56;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto random = [&] {
                state = state * 6364136223846793005u + 1442695040888963407u;
                return static_cast<double>(state >> 40) / 8388608.0 - 1.0;
            };
            step[i] = 0.8 * step[i] + stride_m * Vec3{random(), random(), random()};
            if (!rest) at[i] += step[i];
            lattice.points_m.push_back(at[i]);
        }
    }
    return {"lively", planner::ActRole::transit, planner::Timing::fixed, 5'000, duration_ms, lattice};
}

void expect_seamless(const Act& act, DroneId drone, const Fitted& fitted) {
    Millis at_ms = act.start_ms;
    for (std::size_t j = 0; j < fitted.pieces.size(); ++j) {
        const FittedPiece& piece = fitted.pieces[j];
        EXPECT_EQ(piece.start_ms, at_ms);
        if (act.duration_ms >= kShortestPieceMs) {
            EXPECT_GE(piece.duration_ms, kShortestPieceMs);
        }
        at_ms += piece.duration_ms;
        const auto exact = planner::kinematics(act, drone, seconds_from_ms(at_ms - act.start_ms));
        EXPECT_LT(glm::length(piece.controls_m[3] - exact.position_m), 1e-9);
        const Vec3 velocity = slope(piece.controls_m, 1.0) / seconds_from_ms(piece.duration_ms);
        EXPECT_LT(glm::length(velocity - exact.velocity_mps), 1e-9);
        if (j > 0) {
            EXPECT_EQ(fitted.pieces[j - 1].controls_m[3], piece.controls_m[0]);
        }
    }
    EXPECT_EQ(at_ms, act.end_ms());
}

std::vector<Act> all_acts() {
    std::vector<Act> acts = fixed::acts();
    acts.push_back(lively_act(40'000, 0.05));
    acts.push_back(lively_act(9'001, 0.02));
    acts.push_back(lively_act(3'333, 0.01));
    acts.push_back(lively_act(450, 0.001));
    return acts;
}

TEST(CurveFit, Property1MeetsPositionAndVelocityWherePiecesMeet) {
    for (const Act& act : all_acts())
        for (std::size_t i = 0; i < 3; ++i) expect_seamless(act, DroneId(i), ActFitter(act, Limits{}).fit(DroneId(i)));
}

TEST(CurveFit, Property2StatedErrorIsAnUpperBoundAndNotMuchMore) {
    for (const Act& act : all_acts()) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Fitted fitted = ActFitter(act, Limits{}).fit(DroneId(i));
            const FitError found = sampled_error(act, DroneId(i), fitted);
            EXPECT_LE(found.position_m, fitted.error.position_m + 1e-9) << act.name;
            EXPECT_LE(found.speed_mps, fitted.error.speed_mps + 1e-9) << act.name;
            EXPECT_LE(found.acceleration_mps2, fitted.error.acceleration_mps2 + 1e-9) << act.name;
            EXPECT_LE(fitted.error.position_m, 2.0 * found.position_m + 1e-9) << act.name;
        }
    }
}

TEST(CurveFit, Property3WhoStandsGetsOnePiece) {
    const Fitted hold = ActFitter(fixed::acts()[2], Limits{}).fit(DroneId(1));
    ASSERT_EQ(hold.pieces.size(), 1u);
    EXPECT_TRUE(hold.pieces[0].stands);
    Act still = fixed::acts()[1];
    auto& straight = std::get<planner::Straight>(still.motion);
    straight.to_m[1] = straight.from_m[1];
    EXPECT_TRUE(ActFitter(still, Limits{}).fit(DroneId(1)).pieces[0].stands);
    EXPECT_FALSE(ActFitter(still, Limits{}).fit(DroneId(0)).pieces[0].stands);
}

TEST(CurveFit, Property4VerticalMotionStaysVertical) {
    for (const FittedPiece& piece : ActFitter(fixed::acts()[0], Limits{}).fit(DroneId(2)).pieces) {
        for (const Vec3& p : piece.controls_m) {
            EXPECT_DOUBLE_EQ(p.x, fixed::pads()[2].x);
            EXPECT_DOUBLE_EQ(p.y, fixed::pads()[2].y);
        }
    }
}

TEST(CurveFit, TakesAsFewPiecesAsTheAimAllows) {
    Act act = fixed::acts()[1];
    const std::size_t pieces = ActFitter(act, Limits{}).fit(DroneId(0)).pieces.size();
    EXPECT_TRUE(ActFitter(act, Limits{}).fit(DroneId(0)).error.within(fit_aim(Limits{})));
    EXPECT_LE(pieces, 16u);
    auto& straight = std::get<planner::Straight>(act.motion);
    straight.to_m[0] = straight.from_m[0] + Vec3{0.05, 0.0, 0.0};
    EXPECT_LT(ActFitter(act, Limits{}).fit(DroneId(0)).pieces.size(), pieces);
}

/// The sharpest flights the limits allow must not be refused.
TEST(CurveFit, HoldsItsBoundOnTheShortestLegalFlights) {
    for (const auto profile :
         {planner::ProfileKind::minimum_jerk, planner::ProfileKind::trapezoid, planner::ProfileKind::s_curve}) {
        for (double length_m = 0.2; length_m < 120.0; length_m *= 1.2) {
            const planner::Straight flight{{Vec3{}}, {Vec3{0.0, 0.0, length_m}}, planner::profile_rows(profile, 63)};
            const Millis shortest_ms = planner::shortest_duration(flight, Limits{}).duration_ms;
            const Act act{"up", planner::ActRole::transit, planner::Timing::free, 0, shortest_ms, flight};
            const FitError error = ActFitter(act, Limits{}).fit(DroneId(0)).error;
            EXPECT_TRUE(error.within(fit_bound(Limits{}))) << length_m << " m: " << error.position_m << " m, "
                                                           << error.speed_mps << " m/s, " << error.acceleration_mps2;
        }
    }
}

/// What a pair's fits and millimetres cost is certified in the export margin.
TEST(CurveFit, BoundLeavesRoomForAPairWithinTheMargin) {
    Limits limits;
    EXPECT_LE(2.0 * fit_bound(limits).position_m + std::sqrt(3.0) * 0.001, limits.export_margin_m);
    limits.export_margin_m = 0.01;
    EXPECT_NEAR(2.0 * fit_bound(limits).position_m + std::sqrt(3.0) * 0.001, 0.01, 1e-12);
    EXPECT_LE(fit_aim(limits).position_m, fit_bound(limits).position_m);
}

TEST(CurveFit, Property5OnKnotIntervalsIsExact) {
    Act act = lively_act(57'000, 0.3);  // knots every second, so rough that fewer pieces miss the aim
    const Fitted fitted = ActFitter(act, Limits{}).fit(DroneId(0));
    EXPECT_EQ(fitted.pieces.size(), 57u);
    EXPECT_LT(fitted.error.position_m, 1e-9);
}

}  // namespace
}  // namespace aerogram::exporter
