/// Planes in the formats: their limits travel, and formats that cannot hold them say so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/certificate_json.hpp"
#include "export/exact/show_hash.hpp"
#include "export/exact/trajectories_bin.hpp"
#include "export/formats.hpp"
#include "export/outgoing/planned_show.hpp"
#include "tests/unit/export/fixed_show.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

planner::FlightPlan plane_show() {
    planner::FlightPlan plan = fixed::show();
    plan.limits.plane = PlaneLimits{11.0, 27.5, 33.0, 4.25, 3.5};
    for (planner::ActCertificate& act : plan.certificate.acts) {
        act.plane.emplace();
        act.plane->airspeed_min_mps.value = 12.5;
        act.plane->airspeed_max_mps.value = 21.25;
        act.plane->turn_rate_dps.value = 17.5;
    }
    return plan;
}

TEST(Planes, TrajectoriesHoldTheirLimitsInBothWidths) {
    const planner::FlightPlan plan = plane_show();
    for (const int width : {8, 4}) {
        const auto show = read_trajectories(trajectories_bytes(plan, {show_hash(plan), true}, width));
        ASSERT_TRUE(show.ok()) << show.error().message;
        EXPECT_EQ(show->limits->plane, plan.limits.plane);
        EXPECT_EQ(show->certified, true);
    }
    planner::FlightPlan faster = plan;
    faster.limits.plane->sink_mps += 0.5;
    EXPECT_NE(show_hash(faster), show_hash(plan));
}

TEST(Planes, CopterFilesAreAsTheyWere) {
    planner::FlightPlan plan = plane_show();
    const std::size_t bytes = trajectories_payload(plan, 8).size();
    plan.limits.plane.reset();
    EXPECT_EQ(trajectories_payload(plan, 8).size(), bytes - 5 * 8);
    const auto show = read_trajectories(trajectories_bytes(plan, {show_hash(plan), true}, 8));
    ASSERT_TRUE(show.ok());
    EXPECT_FALSE(show->limits->plane);
}

TEST(Planes, CertificateTellsAirspeedsAndTurnRate) {
    const planner::FlightPlan plan = plane_show();
    const auto record = read_certificate(certificate_json(plan, show_hash(plan), true));
    ASSERT_TRUE(record.ok()) << record.error().message;
    for (const CertifiedAct& act : record->acts) {
        ASSERT_TRUE(act.plane);
        EXPECT_EQ(act.plane->airspeed_min_mps, 12.5);
        EXPECT_EQ(act.plane->airspeed_max_mps, 21.25);
        EXPECT_EQ(act.plane->turn_rate_dps, 17.5);
    }
    const planner::FlightPlan copters = fixed::show();
    EXPECT_FALSE(read_certificate(certificate_json(copters, show_hash(copters), true))->acts[0].plane);
}

TEST(Planes, FormatsForCoptersAreLeftOutWithTheReason) {
    const planner::FlightPlan plan = plane_show();
    for (const char* name : {"skyc", "qgc", "waypoints"})
        EXPECT_THAT(find_format(name)->unsuited(PlannedShow(plan)), HasSubstr("planes: ")) << name;
    for (const char* name : {"trajectories", "csv", "preview"})
        EXPECT_EQ(find_format(name)->unsuited(PlannedShow(plan)), "") << name;
}

TEST(Rides, WaypointsCannotTellFormationsThatMove) {
    planner::FlightPlan plan = fixed::show();
    EXPECT_EQ(find_format("qgc")->unsuited(PlannedShow(plan)), "");
    auto& lattice = std::get<planner::Lattice>(plan.acts[3].motion);
    lattice.at(2, 1).x += 0.5;  // no longer at rest where the act begins
    EXPECT_THAT(find_format("qgc")->unsuited(PlannedShow(plan)), HasSubstr("rides along a route"));
}

}  // namespace
}  // namespace aerogram::exporter
