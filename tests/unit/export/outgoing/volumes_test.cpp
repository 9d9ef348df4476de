#include "export/outgoing/volumes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "export/outgoing/planned_show.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/large_show.hpp"

namespace aerogram::exporter {
namespace {

aerogram::Run threads(unsigned count) {
    aerogram::Run run;
    run.threads = count;
    return run;
}

/// Flights as a test wants them.
class Flown final : public OutgoingShow {
  public:
    explicit Flown(std::vector<Flight> flights) : flights_(std::move(flights)) {
        facts_.drones.resize(flights_.size());
        facts_.duration_ms = 10'000;
    }
    OutgoingFacts facts_;
    [[nodiscard]] const OutgoingFacts& facts() const override { return facts_; }
    [[nodiscard]] const Tracks& tracks(std::size_t) const override { return tracks_; }
    [[nodiscard]] Flight flight(std::size_t drone) const override { return flights_[drone]; }
    [[nodiscard]] Fitted fitted(std::size_t) const override { return {}; }

  private:
    std::vector<Flight> flights_;
    Tracks tracks_;
};

/// Pieces of every degree between wild controls; they need not even join.
Flight wild_flight(std::mt19937_64& random, double reach_m) {
    std::uniform_real_distribution<double> place(-reach_m, reach_m);
    Flight flight;
    for (int k = 0; k < 12; ++k) {
        const auto degree = static_cast<std::uint8_t>(random() % (kMaxDegree + 1));
        flight.pieces.push_back(
            {static_cast<double>(k), 1.0, static_cast<std::uint32_t>(flight.controls_m.size()), degree});
        for (int c = 0; c <= degree; ++c)
            flight.controls_m.emplace_back(place(random), 0.3 * place(random), 40.0 + place(random));
    }
    return flight;
}

std::vector<Vec3> places_of(const OutgoingShow& show, int samples) {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < show.drones(); ++i) {
        const Flight flight = show.flight(i);
        for (const Piece& piece : flight.pieces) {
            Bezier curve;
            curve.degree = piece.degree;
            std::copy_n(flight.controls_m.begin() + piece.first_control, curve.degree + 1, curve.control.begin());
            for (int k = 0; k <= samples; ++k) places.push_back(value(curve, 1.0 * k / samples));
        }
    }
    return places;
}

/// How far outside of any edge's line; negative inside.
double beyond(const geo::Polygon& convex, const Vec2& p) {
    double worst = -1e9;
    for (std::size_t k = 0; k < convex.size(); ++k) {
        const Vec2 a = convex[k], d = glm::normalize(convex[(k + 1) % convex.size()] - a);
        worst = std::max(worst, (p.x - a.x) * d.y - (p.y - a.y) * d.x);
    }
    return worst;
}

void expect_convex(const geo::Polygon& polygon) {
    ASSERT_GE(polygon.size(), 3u);
    ASSERT_TRUE(geo::is_simple(polygon));
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 a = polygon[(k + 1) % polygon.size()] - polygon[k];
        const Vec2 b = polygon[(k + 2) % polygon.size()] - polygon[(k + 1) % polygon.size()];
        EXPECT_GE(a.x * b.y - a.y * b.x, -1e-9) << k;
    }
}

/// The edge of `outer` is `width_m` to 1 % more away from every place on the edge of `inner`, in its direction.
void expect_wider(const geo::Polygon& outer, const geo::Polygon& inner, double width_m) {
    for (std::size_t k = 0; k < inner.size(); ++k)
        for (const double u : {0.0, 0.25, 0.5})
            EXPECT_GE(geo::signed_distance(outer, glm::mix(inner[k], inner[(k + 1) % inner.size()], u)),
                      width_m - 1e-6);
    for (std::size_t k = 0; k < outer.size(); ++k)
        for (const double u : {0.0, 0.25, 0.5}) {
            const double apart_m = -geo::signed_distance(inner, glm::mix(outer[k], outer[(k + 1) % outer.size()], u));
            EXPECT_LE(apart_m, 1.01 * width_m) << k;
            EXPECT_GE(apart_m, width_m - 1e-6) << k;
        }
}

TEST(FlightVolumes, Property1_NobodyIsEverOutsideAndEveryCornerWasFlown) {
    std::mt19937_64 random(11);
    for (int round = 0; round < 20; ++round) {
        std::vector<Flight> flights;
        for (int i = 0; i <= round % 5; ++i) flights.push_back(wild_flight(random, 3.0 + 10.0 * round));
        const Flown show(std::move(flights));
        const FlightVolumes volumes = flight_volumes(show, aerogram::Run{});
        const std::vector<Vec3> places = places_of(show, 400);
        double top_m = -1e9;
        for (const Vec3& p : places) {
            ASSERT_LE(beyond(volumes.flight_m, Vec2(p)), 0.001);
            ASSERT_LE(p.z, volumes.flight_height_m + 0.001);
            top_m = std::max(top_m, p.z);
        }
        EXPECT_LT(volumes.flight_height_m, top_m + 0.01) << "tight";
        for (const Vec2& corner : volumes.flight_m) {
            double nearest_m = 1e9;
            for (const Vec3& p : places) nearest_m = std::min(nearest_m, glm::length(Vec2(p) - corner));
            ASSERT_LT(nearest_m, 1.0 + round) << "a place that a drone was over";
        }
    }
}

TEST(FlightVolumes, Property1_CurvesThatBulgeBeyondTheirEndsAreHeld) {
    Flight arch;  // from (0,0) to (4,0): its highest y and z, 3/4 of the controls', are in the middle
    arch.controls_m = {{0, 0, 1}, {0, 8, 9}, {4, 8, 9}, {4, 0, 1}};
    arch.pieces = {{0.0, 5.0, 0, 3}};
    const FlightVolumes volumes = flight_volumes(Flown({arch}), aerogram::Run{});
    EXPECT_NEAR(volumes.flight_height_m, 7.0, 0.001);
    double farthest_m = 0.0;
    for (const Vec2& corner : volumes.flight_m) farthest_m = std::max(farthest_m, corner.y);
    EXPECT_NEAR(farthest_m, 6.0, 0.001);
}

TEST(FlightVolumes, Property2And3_EachHoldsTheOneBeforeByItsWidthCounterClockwise) {
    std::mt19937_64 random(12);
    for (int round = 0; round < 20; ++round) {
        const Flown show({wild_flight(random, 2.0 + 7.0 * round), wild_flight(random, 5.0)});
        const FlightVolumes volumes = flight_volumes(show, aerogram::Run{});
        for (const auto* polygon : {&volumes.flight_m, &volumes.contingency_m, &volumes.ground_risk_m})
            expect_convex(*polygon);
        expect_wider(volumes.contingency_m, volumes.flight_m, volumes.contingency_m_wide);
        expect_wider(volumes.ground_risk_m, volumes.contingency_m, volumes.ground_risk_m_wide);
        EXPECT_EQ(volumes.ground_risk_m_wide, volumes.contingency_height_m) << "1:1";
    }
}

TEST(FlightVolumes, WidthsAreTheFormulasOfSora) {
    const planner::FlightPlan plan = fixed::show();
    const PlannedShow show(plan);
    const FlightVolumes volumes = flight_volumes(show, aerogram::Run{});
    EXPECT_EQ(volumes.speed_mps, 5.0);
    EXPECT_NEAR(volumes.contingency_m_wide, 3.0 + 3.0 + 1.0 + 5.0 + 25.0 / 19.6133, 1e-9);  // tan 45° = 1
    EXPECT_NEAR(volumes.flight_height_m, 21.0, 1e-9) << "formation B's third drone";
    EXPECT_NEAR(volumes.contingency_height_m, 21.0 + volumes.contingency_m_wide, 1e-9);

    Flown other({show.flight(0)});
    planner::ReportWishes& wishes = other.facts_.reporting;
    wishes.volume_gps_m = 1.0, wishes.volume_path_m = 2.0, wishes.volume_map_m = 4.0;
    wishes.volume_reaction_s = 2.0, wishes.volume_bank_deg = 30.0;
    other.facts_.limits.speed_horizontal_mps = 10.0;
    EXPECT_NEAR(flight_volumes(other, aerogram::Run{}).contingency_m_wide,
                7.0 + 20.0 + 100.0 * std::sqrt(3.0) / 19.6133, 1e-9);
    other.facts_.limits.plane = PlaneLimits{};
    EXPECT_EQ(flight_volumes(other, aerogram::Run{}).speed_mps, 28.0) << "of planes the airspeed";
}

TEST(FlightVolumes, FleetsAboveOnePointOrOneLineHaveAThinVolume) {
    Flight rise, along;
    rise.controls_m = {{3, 4, 0}, {3, 4, 30}};
    along.controls_m = {{3, 4, 0}, {13, 4, 30}};
    rise.pieces = along.pieces = {{0.0, 10.0, 0, 1}};
    for (const auto& flights : {std::vector{rise}, std::vector{rise, along}, std::vector{along}}) {
        const FlightVolumes volumes = flight_volumes(Flown(flights), aerogram::Run{});
        for (const auto* polygon : {&volumes.flight_m, &volumes.contingency_m, &volumes.ground_risk_m})
            expect_convex(*polygon);
        EXPECT_LT(beyond(volumes.flight_m, {3.0, 4.0}), 0.0);
        expect_wider(volumes.contingency_m, volumes.flight_m, volumes.contingency_m_wide);
        EXPECT_EQ(volumes.flight_height_m, 30.0);
    }
}

TEST(FlightVolumes, ThreadsChangeNothing) {
    const planner::FlightPlan plan = large::show(400);
    const PlannedShow show(plan);
    const FlightVolumes one = flight_volumes(show, threads(1));
    const FlightVolumes three = flight_volumes(show, threads(3));
    EXPECT_EQ(one.flight_m, three.flight_m);
    EXPECT_EQ(one.ground_risk_m, three.ground_risk_m);
    for (const Vec3& p : places_of(show, 7)) {
        ASSERT_LE(beyond(one.flight_m, Vec2(p)), 0.001);
        ASSERT_LE(p.z, one.flight_height_m + 0.001);
    }
}

}  // namespace
}  // namespace aerogram::exporter
