#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "export/report/parts.hpp"
#include "export/report/report_files.hpp"
#include "tests/unit/export/report/hand_made.hpp"

namespace aerogram::exporter {
namespace {

using hand_made::Show;
using hand_made::Way;
using testing::DoubleNear;
using testing::ElementsAre;

Report report_of(const OutgoingShow& show, const Judgement& judgement = {}, unsigned threads = 1) {
    Run run;
    run.threads = threads;
    return make_report({show, judgement, "abc", true, {}, {}}, run).value();
}

const ReportSeries& series(const Report& report, const std::string& name) {
    return *std::ranges::find(report.series, name, &ReportSeries::name);
}
double largest(const ReportSeries& series) {
    return *std::ranges::max_element(series.values);
}

TEST(Report, SeriesHoldTheLargestOfEachStep) {
    Show show;
    const double height_m = 12.0, time_s = 10.0;
    show.add(Way({0.0, 0.0, 0.0}).stand(2.0).smooth(time_s, {0.0, 0.0, height_m}).stand(3.0));
    const Report report = report_of(show);
    EXPECT_EQ(report.times_s.front(), 0.0);
    EXPECT_EQ(report.times_s.back(), 15.0);
    EXPECT_LE(report.times_s.size(), 1500U);
    EXPECT_NEAR(largest(series(report, "Highest altitude")), height_m, 1e-9);
    EXPECT_NEAR(largest(series(report, "Speed up")), 1.5 * height_m / time_s, 2e-3);
    EXPECT_GE(largest(series(report, "Speed up")), 1.5 * height_m / time_s);
    EXPECT_NEAR(largest(series(report, "Acceleration")), 6.0 * height_m / (time_s * time_s), 1e-9);
    EXPECT_NEAR(largest(series(report, "Jerk")), 12.0 * height_m / (time_s * time_s * time_s), 1e-9);
    EXPECT_EQ(largest(series(report, "Horizontal speed")), 0.0);
    EXPECT_EQ(largest(series(report, "Speed down")), 0.0);
    EXPECT_EQ(series(report, "Speed up").values.front(), 0.0);
    EXPECT_EQ(series(report, "Highest altitude").limit, report.limits.ceiling_m);
}

TEST(Report, NearestIsExactAndItsHistogramCountsDroneInstants) {
    Show show;
    show.set().limits.downwash = 2.0;
    show.add(Way({0.0, 0.0, 10.0}).stand(10.0));
    show.add(Way({3.0, 0.0, 18.0}).stand(10.0));
    show.add(Way({0.0, 60.0, 18.0}).stand(10.0));
    const Report report = report_of(show);
    for (const double nearest : report.nearest_m) EXPECT_NEAR(nearest, 5.0, 1e-5);  // (3, 8 / 2)
    const std::size_t instants = report.times_s.size();
    EXPECT_EQ(report.histogram[20] + report.histogram[19], 2 * instants);  // 5 m is where two bars meet
    EXPECT_EQ(report.histogram.back(), instants);                          // beyond 10 m
}

TEST(Report, NobodyIsNearWhoStandsOnThePadsAlone) {
    Show show;
    show.add(Way({0.0, 0.0, 0.0}).stand(5.0));
    show.add(Way({1.0, 0.0, 0.0}).stand(5.0));
    const Report report = report_of(show);
    EXPECT_TRUE(std::isinf(report.nearest_m.front()));
    EXPECT_EQ(std::count_if(report.histogram.begin(), report.histogram.end(), [](std::size_t n) { return n > 0; }), 0);
    EXPECT_TRUE(report.encounters.empty());
    EXPECT_FALSE(report.emergencies.front().one_holds.distance_m);
    EXPECT_FALSE(report.emergencies.front().all_return.distance_m);
}

/// Passes at 2 m, turns far away, passes again at 3 m.
TEST(Report, EncountersAreOneAnApproachAndRefined) {
    Show show;
    show.add(Way({0.0, 0.0, 10.0}).stand(40.0));
    show.add(Way({-40.0, 2.0, 10.0})
                 .straight(19.0, {36.0, 2.0, 10.0})
                 .straight(1.0, {36.0, 3.0, 10.0})
                 .straight(20.0, {-44.0, 3.0, 10.0}));
    const Report report = report_of(show);
    ASSERT_EQ(report.encounters.size(), 2U);
    EXPECT_NEAR(report.encounters[0].distance_m, 2.0, 1e-7);
    EXPECT_NEAR(report.encounters[0].time_s, 10.0, 1e-3);
    EXPECT_NEAR(report.encounters[0].place_m.y, 1.0, 1e-7);
    EXPECT_NEAR(report.encounters[1].distance_m, 3.0, 1e-7);
    EXPECT_NEAR(report.encounters[1].time_s, 29.0, 1e-3);
    EXPECT_EQ(report.encounters[0].first, 1U);
    EXPECT_EQ(report.encounters[0].second, 2U);
}

TEST(Report, AlignmentsNameTheUpperDroneFirst) {
    Show show;
    show.add(Way({0.0, 0.0, 10.0}).stand(20.0));
    show.add(Way({-20.0, 0.25, 14.0}).straight(20.0, {20.0, 0.25, 14.0}));
    const Report report = report_of(show);
    ASSERT_EQ(report.alignments.size(), 1U);
    EXPECT_EQ(report.alignments[0].first, 2U);
    EXPECT_EQ(report.alignments[0].second, 1U);
    EXPECT_NEAR(report.alignments[0].vertical_m, 4.0, 1e-9);
    EXPECT_NEAR(report.alignments[0].horizontal_m, 0.25, 1e-6);
    EXPECT_NEAR(report.alignments[0].time_s, 10.0, 1e-3);
    EXPECT_EQ(report.alignment_radius_m, 0.75);
    EXPECT_EQ(report.alignment_height_m, 6.0);
}

TEST(Report, TurnsSayWhenDronesAreOffTheGround) {
    Show show;
    show.add(Way({0.0, 0.0, 0.0}).stand(3.0).straight(5.0, {0.0, 0.0, 10.0}).straight(5.0, {0.0, 0.0, 0.0}).stand(7.0));
    const Report report = report_of(show);
    EXPECT_NEAR(report.turns[0].leaves_s, 3.0, 0.03);  // 5 cm at 2 m/s
    EXPECT_NEAR(report.turns[0].lands_s, 13.0, 0.03);
    EXPECT_EQ(report.turns[0].drone, 1U);
}

TEST(Report, EnergyIsHoveringTimeAndTheClimbsOwn) {
    Show show;
    show.set().endurance_s = 100.0;
    show.set().reporting.reserve_percent = 50.0;
    show.add(Way({0.0, 0.0, 5.0}).stand(40.0), Vec3{0.0, 0.0, 0.0});
    show.add(Way({9.0, 0.0, 5.0}).straight(10.0, {9.0, 0.0, 30.0}).stand(30.0), Vec3{9.0, 0.0, 0.0});
    const Report report = report_of(show);
    const double climb = 0.25 + std::sqrt(0.25 * 0.25 + 1.0);  // 2.5 m/s at 5 m/s induced
    EXPECT_NEAR(report.energy.most_used, (10.0 * climb + 30.0) / 100.0, 1e-9);
    EXPECT_EQ(report.energy.most_used_by, 2U);
    EXPECT_NEAR(report.energy.mean_used, 0.5 * (0.4 + report.energy.most_used), 1e-9);
    EXPECT_TRUE(report.energy.held);
    const auto reserve = std::ranges::find(report.rules, "reserve", &ReportRule::rule);
    EXPECT_NEAR(reserve->margin, 0.5 - report.energy.most_used, 1e-9);
    show.set().reporting.reserve_percent = 60.0;
    EXPECT_FALSE(report_of(show).energy.held);
}

TEST(Report, RulesAreTheJudgementsWithMarginAndPlace) {
    Show show;
    show.add(Way({0.0, 0.0, 10.0}).straight(10.0, {20.0, 0.0, 10.0}));
    Judgement judgement;
    judgement.findings = {{"speed_horizontal", 5.0, 6.0, 0.0, {1}, 2.5, false},
                          {"separation", 1.5, 1.75, 0.0, {}, {}, true}};
    const Report report = report_of(show, judgement);
    EXPECT_EQ(report.rules[0].rule, "separation");
    EXPECT_EQ(report.rules[0].margin, 0.25);
    EXPECT_TRUE(report.rules[0].at_least);
    EXPECT_EQ(report.rules[1].margin, -1.0);
    EXPECT_FALSE(report.rules[1].held);
    EXPECT_THAT(report.rules[1].drones, ElementsAre(1U));
    EXPECT_NEAR(report.rules[1].place_m->x, 5.0, 1e-12);
    EXPECT_EQ(report.rules.size(), 4U);
}

TEST(Report, SensitivityMovesTheShowInsideItsFence) {
    Show show;
    show.set().origin = geo::ShowOrigin{{50.0, 10.0, 100.0}, 90.0, {}};  // +y goes east, +x south
    show.set().airspace.geofence_m = {{-50.0, -20.0}, {50.0, -20.0}, {50.0, 20.0}, {-50.0, 20.0}};
    show.add(Way({40.0, 10.0, 10.0}).stand(5.0));
    const Report report = report_of(show);
    const auto find = [&](const std::string& change) {
        return *std::ranges::find(report.sensitivities, change, &ReportSensitivity::change);
    };
    EXPECT_EQ(report.sensitivities.size(), 20U);
    EXPECT_NEAR(*find("origin 3 m east").geofence_margin_m, 7.0, 1e-3);
    EXPECT_NEAR(*find("origin 5 m south").geofence_margin_m, 5.0, 1e-3);
    EXPECT_NEAR(*find("origin 5 m north").geofence_margin_m, 10.0, 1e-3);
    EXPECT_EQ(find("origin 5 m west").farthest_moved_m, 5.0);
    EXPECT_FALSE(find("origin 5 m west").audience_margin_m);
    const double r = std::hypot(40.0, 10.0), turn = 7.0 * std::numbers::pi / 180.0;
    EXPECT_NEAR(find("heading +7°").farthest_moved_m, 2.0 * r * std::sin(0.5 * turn), 1e-9);
    // Counter-clockwise by 7 degrees: y grows.
    const double y = 40.0 * std::sin(turn) + 10.0 * std::cos(turn);
    EXPECT_NEAR(*find("heading -7°").geofence_margin_m, 20.0 - y, 1e-3);
    EXPECT_TRUE(find("heading -7°").held);
    show.set().airspace.geofence_m = {{-50.0, -20.0}, {50.0, -20.0}, {50.0, 14.0}, {-50.0, 14.0}};
    const Report tight = report_of(show);
    EXPECT_FALSE(std::ranges::find(tight.sensitivities, "heading -7°", &ReportSensitivity::change)->held);
}

TEST(Report, TracksKeepTheWay) {
    Show show;
    show.add(Way({0.0, 0.0, 10.0}).straight(10.0, {30.0, 0.0, 10.0}).straight(10.0, {30.0, 40.0, 10.0}));
    const Report report = report_of(show);
    ASSERT_EQ(report.tracks_m.size(), 1U);
    EXPECT_EQ(report.tracks_m[0].size(), 3U);
    EXPECT_NEAR(report.tracks_m[0][1].x, 30.0, 1e-4);
}

TEST(Report, ThreadsChangeNothing) {  // property (1)
    const Show show = hand_made::random_show(12, 3, 10.0, 5);
    EXPECT_EQ(report_json(report_of(show, {}, 1)), report_json(report_of(show, {}, 4)));
}

TEST(Report, StopsWhenAsked) {
    const Show show = hand_made::random_show(3, 1, 10.0, 5);
    std::stop_source stop;
    stop.request_stop();
    aerogram::Run run;
    run.stop = stop.get_token();
    const Judgement judgement;
    const auto report = make_report({show, judgement, "", true, {}, {}}, run);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::stopped);
}

TEST(ReportJson, HoldsTheNumbersInAStableOrder) {
    Report report;
    report.title = "A";
    report.nearest_m = {std::numeric_limits<double>::infinity(), 1.25};
    report.emergencies.push_back({});
    report.emergencies[0].all_land = {0.5, 3, 4, 7.0};
    const std::string text = report_json(report);
    EXPECT_THAT(text, testing::HasSubstr("\"report\": \"aerogram-flight-validation\""));
    EXPECT_THAT(text, testing::HasSubstr("null,\n   1.25"));
    EXPECT_LT(text.find("\"rules\""), text.find("\"over_time\""));
    EXPECT_LT(text.find("\"over_time\""), text.find("\"formats\""));
    EXPECT_THAT(text, testing::HasSubstr("\"one_holds\": null"));
    EXPECT_THAT(text, testing::HasSubstr("\"distance_m\": 0.5"));
    EXPECT_EQ(text, report_json(report));
}

}  // namespace
}  // namespace aerogram::exporter
