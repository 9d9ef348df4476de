#include "export/outgoing/flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "export/outgoing/planned_show.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"

namespace aerogram::exporter {
namespace {

/// One piece of every degree 0 to 7 behind each other, of uneven lengths, beginning at 1.5 s.
Flight every_degree(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-10.0, 10.0);
    Flight flight;
    double start_s = 1.5;
    for (std::uint8_t degree = 0; degree <= kMaxDegree; ++degree) {
        const double duration_s = 0.4 + 0.3 * degree;
        flight.pieces.push_back({start_s, duration_s, static_cast<std::uint32_t>(flight.controls_m.size()), degree});
        for (std::size_t c = 0; c <= degree; ++c)
            flight.controls_m.emplace_back(unit(random), unit(random), unit(random));
        start_s += duration_s;
    }
    return flight;
}

double binomial(int n, int k) {
    double result = 1.0;
    for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
    return result;
}

/// Bernstein's sum, and its derivatives by forward differences of the control points.
Vec3 bernstein(const Flight& flight, const Piece& piece, double u, int derivative) {
    std::vector<Vec3> c(flight.controls_m.begin() + piece.first_control,
                        flight.controls_m.begin() + piece.first_control + piece.degree + 1);
    double factor = 1.0;
    for (int d = 0; d < derivative; ++d) {
        const double n = static_cast<double>(c.size()) - 1.0;
        if (c.size() == 1) return {};
        factor *= n / piece.duration_s;
        for (std::size_t i = 0; i + 1 < c.size(); ++i) c[i] = c[i + 1] - c[i];
        c.pop_back();
    }
    const int n = static_cast<int>(c.size()) - 1;
    Vec3 sum{};
    for (int i = 0; i <= n; ++i)
        sum += binomial(n, i) * std::pow(u, i) * std::pow(1.0 - u, n - i) * c[static_cast<std::size_t>(i)];
    return factor * sum;
}

TEST(Flight, CursorGivesPlaceSpeedAndAccelerationOfEveryDegree) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Flight flight = every_degree(seed);
        FlightCursor cursor(flight);
        for (const Piece& piece : flight.pieces) {
            for (int k = 0; k < 16; ++k) {
                const double u = k / 16.0, t_s = piece.start_s + u * piece.duration_s;
                const FlightState state = cursor.state_at(t_s);
                EXPECT_EQ(state.position_m, cursor.position_at(t_s));
                EXPECT_LE(glm::length(state.position_m - bernstein(flight, piece, u, 0)), 1e-9) << t_s;
                EXPECT_LE(glm::length(state.velocity_mps - bernstein(flight, piece, u, 1)), 1e-7) << t_s;
                EXPECT_LE(glm::length(state.acceleration_mps2 - bernstein(flight, piece, u, 2)), 1e-6) << t_s;
            }
        }
    }
}

TEST(Flight, CursorGoesBackAsWell) {
    const Flight flight = every_degree(3);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> time(0.0, 16.0);
    FlightCursor wandering(flight);
    for (int k = 0; k < 500; ++k) {
        const double t_s = time(random);
        FlightCursor fresh(flight);
        EXPECT_EQ(wandering.position_at(t_s), fresh.position_at(t_s)) << t_s;
    }
}

TEST(Flight, EndsHoldOutsideAndNothingMovesThere) {
    const Flight flight = every_degree(5);
    FlightCursor cursor(flight);
    const Piece& last = flight.pieces.back();
    const double end_s = last.start_s + last.duration_s;
    EXPECT_EQ(cursor.position_at(-4.0), flight.controls_m.front());
    EXPECT_EQ(cursor.position_at(end_s + 9.0), flight.controls_m.back());
    for (const double t_s : {-1.0, 1.0, end_s + 0.25}) {
        EXPECT_EQ(cursor.state_at(t_s).velocity_mps, Vec3(0.0)) << t_s;
        EXPECT_EQ(cursor.state_at(t_s).acceleration_mps2, Vec3(0.0)) << t_s;
    }
}

TEST(Flight, WherePiecesMeetTheLaterCounts) {
    Flight flight;
    flight.controls_m = {{0, 0, 0}, {1, 0, 0}, {5, 0, 0}, {7, 0, 0}};
    flight.pieces = {{0.0, 1.0, 0, 1}, {1.0, 1.0, 2, 1}};
    FlightCursor cursor(flight);
    EXPECT_EQ(cursor.position_at(1.0).x, 5.0);
    EXPECT_EQ(cursor.state_at(1.0).velocity_mps.x, 2.0);
}

/// The bound is never below a dense sampling, and for cubics it is what the sampling finds.
TEST(Flight, LargestAccelerationBoundsASampling) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Flight whole = every_degree(seed);
        for (std::size_t degree = 0; degree <= kMaxDegree; ++degree) {
            Flight flight{{whole.pieces[degree]}, whole.controls_m};
            double sampled = 0.0;
            FlightCursor cursor(flight);
            const Piece& piece = flight.pieces[0];
            for (int k = 0; k <= 1'000; ++k)
                sampled = std::max(
                    sampled,
                    glm::length(cursor.state_at(piece.start_s + piece.duration_s * k / 1'000.0).acceleration_mps2));
            const double bound = largest_acceleration_mps2(flight);
            EXPECT_GE(bound, sampled * (1.0 - 1e-9)) << degree;
            if (degree <= 3) {
                EXPECT_NEAR(bound, sampled, 1e-6 * (1.0 + bound)) << degree;
            }
        }
    }
}

/// The flight of a planned show is the plan, at every instant.
TEST(Flight, OfAPlannedShowIsThePlan) {
    const planner::FlightPlan plan = fixed::show();
    const PlannedShow show(plan);
    for (std::size_t i = 0; i < plan.drones(); ++i) {
        const Flight flight = show.flight(i);
        EXPECT_EQ(flight.pieces.front().start_s, 0.0);
        for (std::size_t k = 1; k < flight.pieces.size(); ++k) {
            const Piece& before = flight.pieces[k - 1];
            EXPECT_NEAR(flight.pieces[k].start_s, before.start_s + before.duration_s, 1e-9);
        }
        const Piece& last = flight.pieces.back();
        EXPECT_NEAR(last.start_s + last.duration_s, seconds_from_ms(plan.duration_ms()), 1e-9);
        FlightCursor cursor(flight);
        for (Millis t = 0; t <= plan.duration_ms(); t += 13) {
            const auto exact = planner::sample(plan, DroneId(i), seconds_from_ms(t)).motion;
            const FlightState state = cursor.state_at(seconds_from_ms(t));
            ASSERT_LE(glm::length(state.position_m - exact.position_m), 1e-9) << i << " at " << t;
            ASSERT_LE(glm::length(state.velocity_mps - exact.velocity_mps), 1e-9) << i << " at " << t;
            ASSERT_LE(glm::length(state.acceleration_mps2 - exact.acceleration_mps2), 1e-7) << i << " at " << t;
        }
        double peak = 0.0;
        for (Millis t = 0; t <= plan.duration_ms(); ++t)
            peak = std::max(peak, glm::length(cursor.state_at(seconds_from_ms(t)).acceleration_mps2));
        EXPECT_GE(largest_acceleration_mps2(flight), peak - 1e-9);
        EXPECT_LE(largest_acceleration_mps2(flight), plan.limits.acceleration_mps2 + 1e-9);
    }
}

}  // namespace
}  // namespace aerogram::exporter
