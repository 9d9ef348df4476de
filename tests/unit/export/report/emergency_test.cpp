#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "export/report/chord_index.hpp"
#include "export/report/emergency.hpp"
#include "export/report/parts.hpp"
#include "tests/unit/export/report/hand_made.hpp"

namespace aerogram::exporter {
namespace {

using hand_made::Show;
using hand_made::Way;

constexpr double kFar = 1e9;

Report emergencies(const OutgoingShow& show) {
    Report report;
    const Survey all = survey(show, {0.0, static_cast<double>(show.facts().duration_ms) / 1000.0}, {});
    report_emergencies(show, all, {}, report);
    return report;
}

/// Head-on at 4 m/s, 40 m apart, 3 m beside each other; brakes of 2 m/s² take 2 s and 4 m.
Show head_on() {
    Show show;
    show.set().limits.downwash = 1.0;
    show.add(Way({-20.0, 0.0, 20.0}).straight(10.0, {20.0, 0.0, 20.0}), Vec3{-20.0, -50.0, 0.0});
    show.add(Way({20.0, 3.0, 20.0}).straight(10.0, {-20.0, 3.0, 20.0}), Vec3{20.0, -50.0, 0.0});
    return show;
}

TEST(Emergencies, HoldingInPlaceStopsAfterTheBrakingDistance) {
    const Report report = emergencies(head_on());
    EXPECT_LE(report.emergency_resolution_m, 0.1);
    // At 2 s they are 24 m apart along x and stop 16 m apart.
    const double slack = report.emergency_resolution_m + 1e-6;
    EXPECT_NEAR(*report.emergencies[2].all_hold.distance_m, std::hypot(16.0, 3.0), slack);
    EXPECT_NEAR(report.emergencies[2].all_hold.time_s, 4.0, 0.01);
    // One stops at x = -12 + 4 and the other passes it at 3 m.
    EXPECT_NEAR(*report.emergencies[2].one_holds.distance_m, 3.0, slack);
    EXPECT_NEAR(report.emergencies[2].one_holds.time_s, 7.0, 0.05);
    EXPECT_LE(*report.emergencies[2].one_holds.distance_m, 3.0);  // a lower bound
    // At 6 s they have passed each other and part.
    EXPECT_NEAR(*report.emergencies[6].one_holds.distance_m, std::hypot(8.0, 3.0), slack);
}

TEST(Emergencies, LandingGoesStraightDownAndStaysThere) {
    Show show;
    show.set().limits.speed_down_mps = 2.0;
    show.add(Way({0.0, 0.0, 20.0}).stand(30.0), Vec3{50.0, 0.0, 0.0});
    // At rest 3 m beside and 10 m below.
    show.add(Way({3.0, 0.0, 10.0}).stand(30.0), Vec3{60.0, 0.0, 0.0});
    const Report report = emergencies(show);
    const double slack = report.emergency_resolution_m + 1e-6;
    const ReportEmergency& at = report.emergencies[4];
    EXPECT_NEAR(*at.one_holds.distance_m, std::hypot(3.0, 10.0), slack);
    EXPECT_NEAR(*at.one_lands.distance_m, 3.0, slack);
    EXPECT_EQ(at.one_lands.first, 1U);
    EXPECT_NEAR(at.one_lands.time_s, 4.0 + 5.0, 0.01);  // nobody moves: no waiting
    EXPECT_NEAR(*at.all_land.distance_m, 3.0, slack);
    EXPECT_NEAR(at.all_land.time_s, 4.0 + 10.0, 0.01);  // when the upper one touches down beside the lower
}

TEST(Emergencies, ReturningRisesCrossesAndSinks) {
    Show show;
    OutgoingFacts& facts = show.set();
    facts.reporting.return_altitude_m = 30.0;
    facts.reporting.return_layer_m = 5.0;
    facts.limits.ceiling_m = 60.0;
    facts.limits.speed_up_mps = 2.5;
    facts.limits.speed_horizontal_mps = 5.0;
    show.add(Way({0.0, 0.0, 20.0}).stand(60.0), Vec3{50.0, 0.0, 0.0});
    show.add(Way({25.0, 4.0, 28.0}).stand(60.0), Vec3{25.0, 60.0, 0.0});
    const Survey all = survey(show, {0.0, 60.0}, {});
    const EmergencyModel model = emergency_model(facts, all);
    EXPECT_EQ(model.layers, 2U);
    Report report;
    report_emergencies(show, all, {}, report);
    const double slack = report.emergency_resolution_m + 1e-6;
    const ReportApproach one = report.emergencies[1].one_returns;
    // The first rises to 30 m in 4 s, passes the second after 5 s more, 4 m beside and 2 m above.
    EXPECT_NEAR(*one.distance_m, std::hypot(4.0, 2.0), slack);
    EXPECT_EQ(one.first, 1U);
    EXPECT_NEAR(one.time_s, 1.0 + 4.0 + 5.0, 0.05);
    // Together the second is in the layer above by then, 35 m, and on its way.
    EXPECT_GT(*report.emergencies[1].all_return.distance_m, std::hypot(4.0, 2.0));
}

TEST(Emergencies, DronesOnTheirPadsAreExcusedFromThoseAboveTheirs) {
    Show show;
    show.add(Way({0.0, 0.0, 0.0}).stand(20.0));
    show.add(Way({1.0, 0.0, 0.0})
                 .stand(2.0)
                 .smooth(6.0, {1.0, 0.0, 8.0})
                 .stand(4.0)
                 .smooth(6.0, {1.0, 0.0, 0.0})
                 .stand(2.0));
    const Report report = emergencies(show);
    for (const ReportEmergency& at : report.emergencies) {
        for (const ReportApproach& a :
             {at.one_holds, at.one_lands, at.one_returns, at.all_hold, at.all_land, at.all_return})
            EXPECT_FALSE(a.distance_m) << at.time_s;
    }
}

TEST(Emergencies, PlanesHaveNone) {
    Show show = head_on();
    show.set().limits.plane.emplace();
    const Report report = emergencies(show);
    EXPECT_TRUE(report.emergencies.empty());
    EXPECT_FALSE(report.emergency_model.empty());
}

/// All of it again, by time steps, from the words of the model and the exact flights.
class Oracle {
  public:
    Oracle(const OutgoingShow& show, const EmergencyModel& model, double wait_s)
        : show_(show), limits_(show.facts().limits), model_(model), wait_s_(wait_s) {
        for (std::size_t d = 0; d < show.drones(); ++d) flights_.push_back(show.flight(d));
        duration_s_ = static_cast<double>(show.facts().duration_ms) / 1000.0;
    }

    enum Kind { hold, land, back };
    static constexpr double kStep_s = 0.004;

    [[nodiscard]] double worst(Kind kind, double alarm_s, bool together) const {
        double worst = kFar;
        const double end_s = (together ? alarm_s : duration_s_) + 70.0;
        for (std::size_t i = 0; i < flights_.size(); ++i) {
            if (on_pad(i, at(i, alarm_s))) continue;
            for (std::size_t j = 0; j < flights_.size(); ++j) {
                if (j == i || (together && j < i && !on_pad(j, at(j, alarm_s)))) continue;
                FlightCursor flying(flights_[j]);
                const auto mine = manoeuvre(i, kind, alarm_s), other = manoeuvre(j, kind, alarm_s);
                for (double t_s = alarm_s; t_s < end_s; t_s += kStep_s) {
                    const Vec3 p = mine(t_s), q = together ? other(t_s) : flying.position_at(t_s);
                    const Vec3 d = (p - q) / Vec3{1.0, 1.0, limits_.downwash};
                    const double distance = glm::length(d);
                    if (distance < worst && !excused(i, p, j, q)) worst = distance;
                }
            }
        }
        return worst;
    }

  private:
    [[nodiscard]] Vec3 at(std::size_t d, double t_s) const { return FlightCursor(flights_[d]).position_at(t_s); }
    [[nodiscard]] const Vec3& home(std::size_t d) const { return show_.facts().drones[d].home_m; }
    [[nodiscard]] bool above(std::size_t d, const Vec3& p) const {
        return std::hypot(p.x - home(d).x, p.y - home(d).y) <= 0.0105 && p.z >= home(d).z - 0.05;
    }
    [[nodiscard]] bool on_pad(std::size_t d, const Vec3& p) const {
        return std::hypot(p.x - home(d).x, p.y - home(d).y) <= 0.05 && std::abs(p.z - home(d).z) <= 0.05;
    }
    [[nodiscard]] bool excused(std::size_t i, const Vec3& p, std::size_t j, const Vec3& q) const {
        const bool a = on_pad(i, p), b = on_pad(j, q);
        return (a && (b || above(j, q))) || (b && (a || above(i, p)));
    }

    [[nodiscard]] std::function<Vec3(double)> manoeuvre(std::size_t d, Kind kind, double alarm_s) const {
        const FlightState state = FlightCursor(flights_[d]).state_at(alarm_s);
        if (on_pad(d, state.position_m)) return [p = state.position_m](double) { return p; };
        const Vec3 v = state.velocity_mps, from = state.position_m;
        const double speed = glm::length(v), a = limits_.acceleration_mps2, brake_s = speed / a;
        const Vec3 hold_m = from + (speed > 0.0 ? (0.5 * brake_s) * v : Vec3{});
        const double up = limits_.speed_up_mps, down = limits_.speed_down_mps, across = limits_.speed_horizontal_mps;
        const double wait_s = wait_s_, layer_z = layer_m(d), ground_z = home(d).z;
        const Vec3 home_m = home(d);
        return [=](double t_s) {
            const double s = t_s - alarm_s;
            if (s < brake_s) return from + s * v - 0.5 * a * s * s / speed * v;
            if (kind == hold || s < wait_s) return hold_m;
            if (kind == land)
                return Vec3{hold_m.x, hold_m.y, std::max(std::min(hold_m.z, ground_z), hold_m.z - down * (s - wait_s))};
            const double high = std::max(hold_m.z, layer_z), rise_s = (high - hold_m.z) / up;
            if (s < wait_s + rise_s) return Vec3{hold_m.x, hold_m.y, hold_m.z + up * (s - wait_s)};
            const double way_m = std::hypot(home_m.x - hold_m.x, home_m.y - hold_m.y), cross_s = way_m / across;
            const double c = s - wait_s - rise_s;
            if (c < cross_s) {
                const double u = c / cross_s;
                return Vec3{hold_m.x + u * (home_m.x - hold_m.x), hold_m.y + u * (home_m.y - hold_m.y), high};
            }
            return Vec3{home_m.x, home_m.y, std::max(home_m.z, high - down * (c - cross_s))};
        };
    }
    [[nodiscard]] double layer_m(std::size_t d) const {
        const auto& r = show_.facts().reporting;
        return *r.return_altitude_m + *r.return_layer_m * static_cast<double>(d % model_.layers);
    }

    const OutgoingShow& show_;
    Limits limits_;
    const EmergencyModel& model_;
    double wait_s_, duration_s_ = 0.0;
    std::vector<Flight> flights_;
};

/// The report is never above the truth, and below it by no more than it says.
void expect_as_oracle(Show& show, std::uint64_t seed) {
    show.set().reporting.return_altitude_m = 18.0;
    show.set().reporting.return_layer_m = 2.0;
    show.set().limits.ceiling_m = 22.0;
    show.set().limits.speed_horizontal_mps = 6.0;
    const Survey all = survey(show, {0.0, static_cast<double>(show.facts().duration_ms) / 1000.0}, {});
    const EmergencyModel model = emergency_model(show.facts(), all);
    ASSERT_EQ(model.layers, 3U);
    Report report;
    report_emergencies(show, all, {}, report);
    EXPECT_LE(report.emergency_resolution_m, 0.012);
    const Oracle oracle(show, model, model.wait_s);
    const double sampled = 12.0 * 0.5 * Oracle::kStep_s;  // what two drones may fly between the oracle's looks
    for (std::size_t s = 2; s < report.emergencies.size(); s += 7) {
        const ReportEmergency& e = report.emergencies[s];
        const std::array found{e.one_holds, e.one_lands, e.one_returns, e.all_hold, e.all_land, e.all_return};
        for (std::size_t k = 0; k < found.size(); ++k) {
            const double truth = oracle.worst(static_cast<Oracle::Kind>(k % 3), e.time_s, k >= 3);
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", second " << s << ", column " << k);
            ASSERT_EQ(found[k].distance_m.has_value(), truth < kFar);
            if (!found[k].distance_m) continue;
            EXPECT_LE(*found[k].distance_m, truth + 1e-4);
            EXPECT_GE(*found[k].distance_m, truth - report.emergency_resolution_m - sampled - 1e-4);
        }
    }
}

TEST(Emergencies, AreThoseOfBruteForce) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        Show show = hand_made::random_show(4, 2, 8.0, seed);
        expect_as_oracle(show, seed);
    }
}

TEST(Emergencies, AreThoseOfBruteForceWithDownwash) {
    Show show = hand_made::random_show(5, 2, 8.0, 11);
    show.set().limits.downwash = 2.0;
    expect_as_oracle(show, 11);
}

TEST(PairGrid, FindsEveryPairWithinReach) {
    Random random(7);
    for (std::size_t round = 0; round < 20; ++round) {
        std::vector<Mover> movers;
        for (std::uint32_t d = 0; d < 120; ++d) {
            const Vec3 from{random.between(-9.0, 9.0), random.between(-9.0, 9.0), random.between(-9.0, 9.0)};
            const Vec3 way{random.between(-2.0, 2.0), random.between(-2.0, 2.0), random.between(-2.0, 2.0)};
            movers.push_back({from, from + way, 0.0, 1.0, d});
        }
        std::vector<std::pair<std::size_t, std::size_t>> seen, there;
        const double reach_m = 0.1 + 0.1 * static_cast<double>(round);
        PairGrid grid;
        grid.search(movers, reach_m, [&](std::size_t i, std::size_t j) {
            if (closest_approach(movers[i], movers[j]).distance_m <= reach_m) seen.emplace_back(i, j);
            return reach_m;
        });
        for (std::size_t i = 0; i < movers.size(); ++i) {
            for (std::size_t j = i + 1; j < movers.size(); ++j)
                if (closest_approach(movers[i], movers[j]).distance_m <= reach_m) there.emplace_back(i, j);
        }
        std::ranges::sort(seen);
        EXPECT_EQ(seen, there);
    }
}

}  // namespace
}  // namespace aerogram::exporter
