#include "export/vviz/vviz.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "export/verify/judge.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/large_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using planner::VvizFlavour;
using ::testing::HasSubstr;

planner::FlightPlan flavoured(VvizFlavour flavour) {
    planner::FlightPlan plan = fixed::show();
    plan.exporting.vviz = flavour;
    return plan;
}

TEST(Vviz, WritesTheseBytes) {
    expect_golden("vviz.txt", unpacked_text(written_files(vviz_format(), fixed::show())));
}

/// Places of a file by its text alone: home and the sum of the steps, with strtod and nothing of the reader.
std::vector<Vec3> places_in(const std::string& text, std::size_t drone) {
    std::size_t at = text.find("\"homeX\":");
    for (std::size_t k = 0; k < drone; ++k) at = text.find("\"homeX\":", at + 1);
    const std::size_t end = text.find(']', at);
    const auto number = [&](const std::string& key) {
        at = text.find("\"" + key + "\":", at) + key.size() + 3;
        return std::strtod(text.c_str() + at, nullptr);
    };
    std::vector<Vec3> places{{number("homeX"), number("homeY"), number("homeZ")}};
    while (text.find("\"dx\":", at) < end) {
        const double dx = number("dx"), dy = number("dy"), dz = number("dz");
        places.push_back(places.back() + Vec3(dx, dy, dz));
    }
    return places;
}

/// The asymmetric show's drone 3 stands at (6, -19, 0.125): right 6, up 0.125, 19 towards the audience; in A it stands
/// at (5.25, -1, 19).
TEST(Vviz, AxesAreRightUpForwardOrBackward) {
    for (const VvizFlavour flavour : {VvizFlavour::verge, VvizFlavour::finale}) {
        const double forward = flavour == VvizFlavour::verge ? 1.0 : -1.0;
        const std::string text = written_files(vviz_format(), flavoured(flavour))[0].bytes;
        const std::vector<Vec3> places = places_in(text, 2);
        EXPECT_EQ(places.front(), Vec3(6.0, 0.125, -19.0 * forward));
        const auto near_a = std::ranges::min_element(
            places, {}, [&](const Vec3& p) { return glm::length(p - Vec3(5.25, 19.0, -1.0 * forward)); });
        EXPECT_LE(glm::length(*near_a - Vec3(5.25, 19.0, -1.0 * forward)), 0.025);
        EXPECT_LE(glm::length(places.back() - places.front()), 1e-9);  // home again: nothing added up
    }
}

TEST(Vviz, ReadsBackWithinTheStatedErrorInBothFlavours) {
    for (const VvizFlavour flavour : {VvizFlavour::verge, VvizFlavour::finale}) {
        const planner::FlightPlan plan = flavoured(flavour);
        const RecordedShow show = read_back(vviz_format(), written_files(vviz_format(), plan));
        ASSERT_TRUE(well_formed(show).ok());
        ASSERT_EQ(show.drones.size(), 3u);
        EXPECT_NEAR(show.duration_s, seconds_from_ms(plan.duration_ms()), 1e-9);
        double worst_m = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const RecordedDrone& drone = show.drones[i];
            EXPECT_EQ(drone.name, "drone-00" + std::to_string(i + 1));
            EXPECT_LE(glm::length(*drone.home_m - plan.pads_m[i]), 1e-9);
            for (Millis t = 0; t <= plan.duration_ms(); t += 7) {
                const auto exact = planner::sample(plan, DroneId(i), seconds_from_ms(t));
                const double off_m = glm::length(position_at(drone, seconds_from_ms(t)) - exact.motion.position_m);
                worst_m = std::max(worst_m, off_m);
            }
        }
        EXPECT_LE(2.0 * worst_m, kVvizPairCost_m);  // two drones together stay within the margin
        EXPECT_GE(worst_m, 0.01);                   // and the room is used
        EXPECT_LE(worst_m, show.rounding.fit_m + std::sqrt(3.0) * show.rounding.position_m);
    }
}

/// Fades and holds within half a step of a byte at every frame, but for the frame before a jump.
TEST(Vviz, LightsReadBack) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(vviz_format(), written_files(vviz_format(), plan));
    for (std::size_t i = 0; i < 3; ++i) {
        for (Millis t = 0; t <= plan.duration_ms(); t += kVvizFrame_ms) {
            const Rgb exact = light_at(plan.tracks[i].lights, seconds_from_ms(t));
            const Rgb read = light_at(show.drones[i].tracks.lights, seconds_from_ms(t));
            ASSERT_NEAR(read.r, exact.r, 0.5 / 255.0 + 1e-9) << i << " at " << t;
            ASSERT_NEAR(read.g, exact.g, 0.5 / 255.0 + 1e-9) << i << " at " << t;
            ASSERT_NEAR(read.b, exact.b, 0.5 / 255.0 + 1e-9) << i << " at " << t;
        }
    }
}

TEST(Vviz, TellsWhatTheShowIs) {
    const planner::FlightPlan plan = fixed::show();
    for (const bool certified : {true, false}) {
        const auto files = written_files(vviz_format(), plan, test_seal(certified));
        EXPECT_EQ(files[0].bytes.find("UNCERTIFIED Fixed") != std::string::npos, !certified);
        EXPECT_THAT(files[0].bytes, HasSubstr("\"alt\":3.300}"));  // above the sea: 40 m less 36.7 m
        const RecordedShow show = read_back(vviz_format(), files);
        EXPECT_EQ(show.title, plan.name);
        EXPECT_EQ(show.show_hash, test_seal().show_hash);
        EXPECT_EQ(show.certified, certified);
        ASSERT_TRUE(show.origin && show.limits && show.airspace);
        EXPECT_EQ(show.origin->ground.height_m, 40.0);
        EXPECT_EQ(show.origin->heading_deg, 20.0);
        EXPECT_EQ(show.airspace->geofence_m.size(), 5u);
        EXPECT_EQ(show.cues, plan.cues);
    }
    planner::FlightPlan unknown = fixed::show();
    unknown.origin.geoid_undulation_m.reset();
    EXPECT_EQ(written_files(vviz_format(), unknown)[0].bytes.find("globalReferenceFrame"), std::string::npos);
}

/// Planes begin in the air: their homes were read as where the path begins.
TEST(Vviz, HomesThatThePathDoesNotTouchAreKept) {
    for (const VvizFlavour flavour : {VvizFlavour::verge, VvizFlavour::finale}) {
        planner::FlightPlan plan = flavoured(flavour);
        const RecordedShow usual = read_back(vviz_format(), written_files(vviz_format(), plan));
        EXPECT_LE(glm::length(*usual.drones[1].land_m - plan.pads_m[1]), 1e-9);
        plan.pads_m[1] = {100.0, 60.0, -3.5};
        const RecordedShow show = read_back(vviz_format(), written_files(vviz_format(), plan));
        EXPECT_EQ(*show.drones[1].home_m, plan.pads_m[1]);
        EXPECT_EQ(*show.drones[1].land_m, plan.pads_m[1]);
        EXPECT_EQ(first_position(show.drones[1]), first_position(usual.drones[1]));
        EXPECT_LE(glm::length(*show.drones[2].home_m - plan.pads_m[2]), 1e-9);
    }
}

TEST(Vviz, ItsOwnJudgeFindsNothingWrong) {
    for (const planner::FlightPlan& plan : {fixed::show(), large::show(60)}) {
        RecordedShow show = read_back(vviz_format(), written_files(vviz_format(), plan));
        state_missing_places(show, plan.pads_m);
        const auto judgement = judge(show, {}, aerogram::Run{});
        ASSERT_TRUE(judgement.ok()) << judgement.error().message;
        EXPECT_GE(judgement->min_separation_m, plan.limits.min_separation_m);
        for (const Finding& finding : judgement->findings)
            EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
    }
}

TEST(Vviz, SameBytesWithOneAndThreeThreads) {
    const planner::FlightPlan plan = large::show(700);  // more than a block
    std::vector<std::string> texts;
    for (const unsigned threads : {1u, 3u}) {
        const ScratchFolder folder;
        aerogram::Run run;
        run.threads = threads;
        ASSERT_TRUE(vviz_format().write(PlannedShow(plan), test_seal(), folder.path(), run).ok());
        texts.push_back(read_file(folder.path() / "show.vviz").value());
    }
    EXPECT_TRUE(texts[0] == texts[1]);
    EXPECT_EQ(read_back(vviz_format(), {{"show.vviz", texts[0]}}).drones.size(), 700u);
}

/// 2 (a dt² / 8 + tolerance) + 2 √3 · 0.5 mm is the pair cost.
TEST(Vviz, FitSpendsThePairCost) {
    planner::FlightPlan plan = fixed::show();
    for (const double margin_m : {0.01, 0.05, 0.5}) {
        for (const double acceleration_mps2 : {0.1, 2.0, 9.0}) {
            plan.limits.export_margin_m = margin_m;
            plan.certificate.acts[0].extremes.acceleration_mps2 = acceleration_mps2;
            const OutgoingFacts facts = PlannedShow(plan).facts();
            const auto fit = vviz_fit(facts);
            ASSERT_TRUE(fit);
            const double dt_s = seconds_from_ms(fit->step_ms);
            const double each_m = facts.acceleration_mps2 * dt_s * dt_s / 8.0 + fit->tolerance_m;
            EXPECT_NEAR(2.0 * each_m + std::sqrt(3.0) * 0.001, std::min(margin_m, kVvizPairCost_m), 1e-12);
            EXPECT_GE(fit->tolerance_m, 0.0);
        }
    }
    plan.limits.export_margin_m = 0.0017;
    EXPECT_FALSE(vviz_fit(PlannedShow(plan).facts()));
    EXPECT_THAT(vviz_format().unsuited(PlannedShow(plan)), HasSubstr("export_margin_m leaves no room"));
}

TEST(Vviz, IsRecognised) {
    EXPECT_TRUE(vviz_format().recognises("a.vviz", ""));
    EXPECT_TRUE(vviz_format().recognises("a.json", "\n {\"version\":\"1.0\",\"defaultPositionRate\":4"));
    EXPECT_FALSE(vviz_format().recognises("a.json", "{\"fileType\":\"Plan\"}"));
    EXPECT_FALSE(vviz_format().recognises("a.txt", "x {\"defaultPositionRate\":4"));
}

}  // namespace
}  // namespace aerogram::exporter
