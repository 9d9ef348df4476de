#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "export/bytes/sha256.hpp"
#include "export/certificate_json.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/golden_bytes.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

std::string text_of(const planner::FlightPlan& plan) {
    return certificate_json(plan, sha256_hex("show"), plan.certificate.certified());
}

std::string problem_of(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    const auto certificate = read_certificate(text.replace(at, what.size(), by));
    return certificate.ok() ? "none" : certificate.error().message;
}

TEST(CertificateFile, BytesAreGolden) {
    fixed::expect_golden("certificate.json", text_of(fixed::show()));
}

TEST(CertificateFile, GivesBackEveryAct) {
    const planner::FlightPlan plan = fixed::show();
    const auto record = read_certificate(text_of(plan));
    ASSERT_TRUE(record.ok()) << record.error().message;
    EXPECT_EQ(record->show_name, plan.name);
    EXPECT_EQ(record->show_hash, sha256_hex("show"));
    EXPECT_TRUE(record->certified);
    EXPECT_EQ(record->min_separation_m, 2.0);
    ASSERT_EQ(record->acts.size(), 7U);
    const CertifiedAct& act = record->acts[3];
    EXPECT_EQ(act.name, "to B");
    EXPECT_EQ(act.role, "transit");
    EXPECT_EQ(act.start_s, 27.0);
    EXPECT_EQ(act.duration_s, 9.6);
    EXPECT_EQ(act.required_separation_m, 1.55);
    EXPECT_EQ(act.min_separation_m, 2.375);
    EXPECT_EQ(act.closest_m, 2.40625);
    EXPECT_EQ(act.pair, (std::pair<std::size_t, std::size_t>{1, 2})) << "drones count from 1 in files";
    EXPECT_EQ(act.time_s, 28.5) << "show time: 27 s and 1.5 s into the act";
    EXPECT_EQ(act.speed_horizontal_mps, 4.0);
    EXPECT_EQ(act.speed_up_mps, 0.5);
    EXPECT_EQ(act.speed_down_mps, 0.25);
    EXPECT_EQ(act.acceleration_mps2, 0.75);
    EXPECT_EQ(act.jerk_mps3, 1.5);
    EXPECT_EQ(act.altitude_max_m, 8.0);
    EXPECT_EQ(act.geofence_margin_m, 12.5);
    EXPECT_EQ(act.audience_margin_m, std::nullopt);
    EXPECT_EQ(act.obstacle_margin_m, 8.25);
    EXPECT_EQ(act.method, "straight");
    EXPECT_EQ(act.assignment, "shortest, gap 0, pairwise");
    EXPECT_TRUE(act.certified);
}

TEST(CertificateFile, ViolationsAreTold) {
    planner::FlightPlan plan = fixed::show();
    plan.certificate.acts[1].violations = {"separation 1.2 m below 1.55 m: drones 1 and 2 at 9.1 s"};
    plan.certificate.violations = {"endurance"};
    const auto record = read_certificate(text_of(plan));
    ASSERT_TRUE(record.ok()) << record.error().message;
    EXPECT_FALSE(record->certified);
    EXPECT_TRUE(record->acts[0].certified);
    EXPECT_FALSE(record->acts[1].certified);
    EXPECT_EQ(record->acts[1].violations, plan.certificate.acts[1].violations);
    EXPECT_EQ(record->violations, plan.certificate.violations);
}

TEST(CertificateFile, OneDroneHasNoSeparation) {
    planner::FlightPlan plan = fixed::show();
    for (auto& act : plan.certificate.acts) act.separation = {std::numeric_limits<double>::infinity(), std::nullopt};
    const auto record = read_certificate(text_of(plan));
    ASSERT_TRUE(record.ok()) << record.error().message;
    EXPECT_EQ(record->min_separation_m, std::nullopt);
    EXPECT_EQ(record->acts[0].min_separation_m, std::nullopt);
    EXPECT_EQ(record->acts[0].pair, std::nullopt);
}

TEST(CertificateFile, TellsWhichFieldIsWrong) {
    const std::string text = text_of(fixed::show());
    EXPECT_EQ(problem_of(text, "\"show_hash\": \"", "\"show_hash\": \"x"),
              "certificate.json: show_hash must be 64 lower-case hex digits");
    EXPECT_EQ(problem_of(text, "\"hold\"", "\"dive\""),
              "certificate.json: acts[3].role must be takeoff, transit, hold or landing");
    EXPECT_EQ(problem_of(text, "\"path_ratio\": 1.0", "\"path_ratio\": \"1\""),
              "certificate.json: acts[1].path_ratio must be a number");
    EXPECT_EQ(problem_of(text, "\"separation_rounds\"", "\"rounds\""),
              "certificate.json: acts[1].separation_rounds is missing");
    EXPECT_THAT(problem_of(text, "{", "["), HasSubstr("parse error"));
    EXPECT_FALSE(read_certificate("").ok());
    EXPECT_EQ(read_certificate("[]").error().message, "certificate.json: show is missing");
}

}  // namespace
}  // namespace aerogram::exporter
