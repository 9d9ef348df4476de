#include <gtest/gtest.h>

#include <cmath>

#include "export/record/recorded_show.hpp"
#include "tests/unit/export/verify/shows.hpp"

namespace aerogram::exporter {
namespace {

using testing::add_piece;
using testing::polyline;
using testing::Random;

/// Sum of Bernstein polynomials, by the binomial formula.
Vec3 bernstein_sum(const Bezier& curve, double u) {
    Vec3 sum{};
    double binomial = 1.0;
    const auto n = static_cast<double>(curve.degree);
    for (std::size_t i = 0; i <= curve.degree; ++i) {
        const auto k = static_cast<double>(i);
        sum += binomial * std::pow(u, k) * std::pow(1.0 - u, n - k) * curve.control[i];
        binomial *= (n - k) / (k + 1.0);
    }
    return sum;
}

Bezier random_curve(Random& random, std::size_t degree) {
    Bezier curve;
    curve.degree = degree;
    for (std::size_t i = 0; i <= degree; ++i) curve.control[i] = random.in_box(Vec3(-5.0), Vec3(5.0));
    return curve;
}

class BezierOfDegree : public ::testing::TestWithParam<std::size_t> {};

TEST_P(BezierOfDegree, AgreesWithTheBinomialFormulaHoweverItIsRewritten) {
    Random random(41 + GetParam());
    for (int i = 0; i < 200; ++i) {
        const Bezier curve = random_curve(random, GetParam());
        const double u = random.in(0.0, 1.0), from = random.in(0.0, 0.5), to = random.in(0.5, 1.0);
        const Vec3 expected = bernstein_sum(curve, u);
        EXPECT_LT(glm::length(value(curve, u) - expected), 1e-13);
        EXPECT_LT(glm::length(value(elevated(curve, kMaxDegree), u) - expected), 1e-12);
        const auto [left, right] = split(curve, from);
        EXPECT_LT(glm::length(value(left, u) - bernstein_sum(curve, from * u)), 1e-12);
        EXPECT_LT(glm::length(value(right, u) - bernstein_sum(curve, from + (1.0 - from) * u)), 1e-12);
        EXPECT_LT(glm::length(value(restricted(curve, from, to), u) - bernstein_sum(curve, from + (to - from) * u)),
                  1e-12);
        const Vec3 slope = (bernstein_sum(curve, u + 1e-6) - bernstein_sum(curve, u - 1e-6)) / 2e-6;
        EXPECT_LT(glm::length(value(derivative(curve), u) - slope), 1e-6);
    }
}
INSTANTIATE_TEST_SUITE_P(All, BezierOfDegree, ::testing::Values(0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U));

TEST(RecordedDrone, IsInterpolatedPieceByPieceAndHeldOutside) {
    RecordedDrone drone = polyline(2.0, {{0, 0, 0}, {4, 0, 0}, {4, 6, 0}});
    EXPECT_EQ(position_at(drone, -1.0), (Vec3{0, 0, 0}));
    EXPECT_EQ(position_at(drone, 1.0), (Vec3{2, 0, 0}));
    EXPECT_EQ(position_at(drone, 2.0), (Vec3{4, 0, 0}));
    EXPECT_EQ(position_at(drone, 3.0), (Vec3{4, 3, 0}));
    EXPECT_EQ(position_at(drone, 99.0), (Vec3{4, 6, 0}));
    EXPECT_EQ(velocity_at(drone, 1.0), (Vec3{2, 0, 0}));
    EXPECT_EQ(velocity_at(drone, 2.0), (Vec3{0, 3, 0}));
    EXPECT_EQ(velocity_at(drone, -1.0), (Vec3{0, 0, 0}));
    EXPECT_EQ(velocity_at(drone, 99.0), (Vec3{0, 0, 0}));
    EXPECT_EQ(piece_at(drone, 2.0), 1U);
    EXPECT_EQ(end_s(drone), 4.0);
}

TEST(RecordedDrone, StandsThroughPiecesOfDegreeZero) {
    RecordedDrone drone;
    add_piece(drone, 3.0, {{1, 2, 3}});
    add_piece(drone, 1.0, {{1, 2, 3}, {2, 2, 3}});
    EXPECT_EQ(position_at(drone, 2.9), (Vec3{1, 2, 3}));
    EXPECT_EQ(velocity_at(drone, 1.0), (Vec3{0, 0, 0}));
    EXPECT_EQ(position_at(drone, 3.5), (Vec3{1.5, 2, 3}));
}

TEST(WellFormed, NamesWhatIsWrong) {
    const auto complaint = [](auto damage) {
        RecordedShow show = testing::show_of({polyline(1.0, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}})});
        damage(show.drones[0]);
        const Status status = well_formed(show);
        return status.ok() ? std::string() : status.error().message;
    };
    EXPECT_EQ(complaint([](RecordedDrone&) {}), "");
    EXPECT_EQ(complaint([](RecordedDrone& d) { d.pieces.clear(); }), "drone 1: has no trajectory");
    EXPECT_EQ(complaint([](RecordedDrone& d) { d.pieces[1].degree = 8; }), "drone 1, piece 2: degree 8 is above 7");
    EXPECT_EQ(complaint([](RecordedDrone& d) { d.pieces[1].degree = 3; }),
              "drone 1, piece 2: its control points are missing");
    EXPECT_EQ(complaint([](RecordedDrone& d) { d.pieces[0].duration_s = 0.0; }),
              "drone 1, piece 1: start 0.000000 s, duration 0.000000 s: must be finite and the duration > 0");
    EXPECT_EQ(complaint([](RecordedDrone& d) { d.controls_m[0].x = 2e8; }),
              "drone 1, piece 1: a control point is not finite or beyond 1e8 m");
    EXPECT_EQ(complaint([](RecordedDrone& d) { d.pieces[1].start_s = 0.9; }),
              "drone 1, piece 2: starts -0.100000 s after the piece before ends");
}

}  // namespace
}  // namespace aerogram::exporter
