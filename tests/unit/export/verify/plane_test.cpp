#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "export/verify/judge.hpp"
#include "export/verify/rules_plane.hpp"
#include "geo/units.hpp"
#include "shows.hpp"

namespace aerogram::exporter {
namespace {

using testing::add_piece, testing::show_of;

Rules plane_rules(const RecordedShow& show) {
    Rules rules;
    rules.limits.plane.emplace();
    rules.rounding = show.rounding;
    return rules;
}

const Finding& finding(const std::vector<Finding>& all, const std::string& rule) {
    return *std::ranges::find(all, rule, &Finding::rule);
}

/// Smooth enough to be a plane's: degree 5, mostly along x at 18 m/s.
RecordedShow random_flights(std::uint64_t seed, std::size_t drones) {
    testing::Random random(seed);
    std::vector<RecordedDrone> fleet;
    for (std::size_t d = 0; d < drones; ++d) {
        RecordedDrone drone;
        for (int piece = 0; piece < 3; ++piece) {
            std::vector<Vec3> controls;
            for (int c = 0; c <= 5; ++c) {
                const Vec3 noise = random.in_box({-2, -4, -2}, {2, 4, 2});
                controls.push_back(Vec3{18.0 * (3 * piece + 0.6 * c), 20.0 * static_cast<double>(d), 80} + noise);
            }
            add_piece(drone, 3.0, controls);
        }
        fleet.push_back(drone);
    }
    return show_of(fleet);
}

struct Sampled {
    double slowest = 1e9, fastest = 0, climb = -1e9, sink = -1e9, turn_dps = 0;
};
Sampled sampled(const RecordedShow& show) {
    Sampled s;
    for (const RecordedDrone& drone : show.drones) {
        for (const Piece& piece : drone.pieces) {
            const Bezier p = curve_of(drone, piece), v = derivative(p), a = derivative(v);
            for (int step = 0; step <= 4000; ++step) {
                const double u = step / 4000.0;
                const Vec3 speed = value(v, u) / piece.duration_s,
                           change = value(a, u) / (piece.duration_s * piece.duration_s);
                s.slowest = std::min(s.slowest, glm::length(speed));
                s.fastest = std::max(s.fastest, glm::length(speed));
                s.climb = std::max(s.climb, speed.z);
                s.sink = std::max(s.sink, -speed.z);
                const double turning = std::abs(speed.x * change.y - speed.y * change.x);
                s.turn_dps = std::max(s.turn_dps, degrees(turning / (speed.x * speed.x + speed.y * speed.y)));
            }
        }
    }
    return s;
}

TEST(PlaneRules, FindWhatADenseSamplingFindsAndAreNeverLenient) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(seed);
        const RecordedShow show = random_flights(seed, 4);
        const Sampled s = sampled(show);
        const auto found = plane_findings(show, plane_rules(show), aerogram::Run{});
        ASSERT_EQ(found.size(), 5U);
        const auto close = [&](const char* rule, double truth, double sign, double within) {
            const double off = sign * (finding(found, rule).worst - truth);
            EXPECT_GE(off, -1e-9) << rule;
            EXPECT_LE(off, within) << rule;
        };
        close("airspeed_min", s.slowest, -1.0, 1e-4);
        close("airspeed_max", s.fastest, 1.0, 1e-4);
        close("climb", s.climb, 1.0, 1e-4);
        close("sink", s.sink, 1.0, 1e-4);
        close("turn_rate_dps", s.turn_dps, 1.0, 1e-2);
    }
}

TEST(PlaneRules, AHoverBreaksTheLeastAirspeedAndTheTurnRate) {
    RecordedDrone drone;
    add_piece(drone, 4.0, {{0, 0, 80}});
    const RecordedShow show = show_of({drone});
    const auto found = plane_findings(show, plane_rules(show), aerogram::Run{});
    EXPECT_FALSE(finding(found, "airspeed_min").held);
    EXPECT_EQ(finding(found, "airspeed_min").worst, 0.0);
    EXPECT_TRUE(finding(found, "climb").held);
}

TEST(PlaneRules, CoptersHaveNone) {
    const RecordedShow show = random_flights(3, 2);
    Rules rules = plane_rules(show);
    rules.limits.plane.reset();
    EXPECT_TRUE(plane_findings(show, rules, aerogram::Run{}).empty());
}

TEST(PlaneRules, AShowOfPlanesMayBeginAndEndInFlightAwayFromItsPads) {
    RecordedDrone drone;
    add_piece(drone, 10.0, {{0, 0, 80}, {180, 0, 80}});
    drone.home_m = drone.land_m = Vec3{0, 60, 0};
    const RecordedShow show = show_of({drone});
    JudgeAgainst against;
    against.limits.emplace();
    EXPECT_FALSE(judge(show, against, aerogram::Run{})->held());
    against.limits->plane.emplace();
    const auto judged = judge(show, against, aerogram::Run{});
    EXPECT_TRUE(judged->held());
    for (const Finding& f : judged->findings) EXPECT_NE(f.rule, "speed_horizontal");
}

TEST(PlaneClaims, TrueOnesHoldAndWrongOnesAreNamed) {
    const RecordedShow show = random_flights(5, 3);
    const Sampled s = sampled(show);
    const Rules rules = plane_rules(show);
    Claims claims;
    claims.end_s = show.duration_s;
    claims.plane = {s.slowest, s.fastest + 1e-5, s.turn_dps + 1e-3};
    EXPECT_TRUE(broken_plane_claims(show, rules, claims, aerogram::Run{}).empty());
    claims.plane = {s.slowest + 0.1, s.fastest - 0.1, s.turn_dps - 0.1};
    const auto broken = broken_plane_claims(show, rules, claims, aerogram::Run{});
    ASSERT_EQ(broken.size(), 3U);
    EXPECT_EQ(broken[0].what, "min_airspeed_mps");
    EXPECT_NEAR(broken[0].found, s.slowest, 1e-4);
    EXPECT_EQ(broken[1].what, "max_airspeed_mps");
    EXPECT_EQ(broken[2].what, "max_turn_rate_dps");
    EXPECT_NEAR(broken[2].found, s.turn_dps, 1e-2);
}

}  // namespace
}  // namespace aerogram::exporter
