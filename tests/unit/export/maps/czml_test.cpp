#include "export/maps/czml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/maps/czml_packet.hpp"
#include "export/verify/judge.hpp"
#include "tests/unit/export/large_show.hpp"
#include "tests/unit/export/maps/map_oracle.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string text_of(const planner::FlightPlan& plan, bool certified = true) {
    return written_files(czml_format(), plan, test_seal(certified))[0].bytes;
}
Result<RecordedShow> read(const std::string& czml) {
    return read_czml(std::vector<FileBytes>{{"a.czml", czml}});
}
std::string error_of(const std::string& packets) {
    const auto show = read("[" + packets + "]");
    return show ? "none" : show.error().message;
}

TEST(Czml, WritesTheseBytes) {
    expect_golden("show.czml", text_of(fixed::show()));
}

TEST(Czml, ReadsBackWithinTheStatedRounding) {
    planner::FlightPlan plan = fixed::show();
    plan.origin.geoid_undulation_m.reset();  // heights are ellipsoidal
    const RecordedShow show = read_back(czml_format(), written_files(czml_format(), plan));
    oracle::expect_flown(show, plan);
    EXPECT_EQ(show.title, plan.name);
    EXPECT_EQ(show.show_hash, test_seal().show_hash);
    EXPECT_EQ(show.certified, true);
    EXPECT_EQ(show.drones[2].name, "drone-003");
    EXPECT_EQ(show.origin->ground.height_m, plan.origin.ground.height_m);
    EXPECT_EQ(show.origin->geoid_undulation_m, std::nullopt);
    EXPECT_EQ(show.airspace->geofence_m, plan.airspace.geofence_m);
    EXPECT_LE(2.0 * show.rounding.fit_m + 2.0 * std::sqrt(3.0) * show.rounding.position_m, plan.limits.export_margin_m);
}

TEST(Czml, LightsReadBackWithinADisplayColoursStep) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(czml_format(), written_files(czml_format(), plan));
    for (std::size_t i = 0; i < 3; ++i)
        for (Millis t = 0; t <= plan.duration_ms(); t += 5) {
            const Rgb exact = light_at(plan.tracks[i].lights, seconds_from_ms(t));
            const Rgb held = light_at(show.drones[i].tracks.lights, seconds_from_ms(t));
            for (const double off : {exact.r - held.r, exact.g - held.g, exact.b - held.b})
                ASSERT_LE(std::abs(off), 1.2 / 255.0) << i << " at " << t;
        }
}

TEST(Czml, ShowsBesideTheDateLineAndInTheSouthReadBackToo) {
    for (const auto& [latitude_deg, longitude_deg] :
         {std::pair{0.0, 180.0}, {60.0, -179.99999}, {-33.9, 179.9999}, {-54.8, -68.3}, {78.2, 15.6}}) {
        const planner::FlightPlan plan = oracle::show_at(latitude_deg, longitude_deg);
        oracle::expect_flown(read_back(czml_format(), written_files(czml_format(), plan)), plan);
    }
}

/// The coordinates themselves, through a formula that shares nothing with the writer: neither mirrored nor turned.
TEST(Czml, SampledPlacesAreWhereTheyShouldBe) {
    const planner::FlightPlan plan = fixed::show();
    const std::string text = text_of(plan);
    const auto tracks =
        oracle::numbers_between(text.substr(text.find("\"drone-001\"")), "\"cartographicDegrees\":[", "]");
    ASSERT_EQ(tracks.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_EQ(tracks[i].size() % 4, 0u);
        ASSERT_GT(tracks[i].size(), 40u);
        for (std::size_t k = 0; k < tracks[i].size(); k += 4) {
            const Vec3 exact = planner::sample(plan, DroneId(i), tracks[i][k]).motion.position_m;
            const Vec3 held = oracle::to_show(plan.origin, {tracks[i][k + 1], tracks[i][k + 2], tracks[i][k + 3]});
            ASSERT_LT(glm::length(held - exact), 0.0006) << i << " at " << tracks[i][k];
        }
    }
}

TEST(Czml, ItsOwnJudgeFindsNothingWrong) {
    const auto judgement =
        judge(read_back(czml_format(), written_files(czml_format(), fixed::show())), {}, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    for (const Finding& finding : judgement->findings)
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
    EXPECT_TRUE(judgement->problems.empty());
}

TEST(Czml, CarefulAndQuickReadersAgree) {
    const std::string text = text_of(fixed::show());
    std::size_t drones = 0;
    for (std::size_t at = text.find("{\"id\":\"drone-"); at != std::string::npos;
         at = text.find("{\"id\":\"drone-", at + 1)) {
        const std::string packet = text.substr(at, text.find("]}}}", at) + 4 - at);
        const auto quick = read_plain_czml_packet(packet);
        const auto careful = read_czml_packet(packet);
        ASSERT_TRUE(quick.has_value() && careful.ok() && careful->track.has_value()) << packet;
        EXPECT_EQ(quick->track.at_us, careful->track->track.at_us);
        EXPECT_EQ(quick->track.places_m, careful->track->track.places_m);
        EXPECT_EQ(quick->track.drone.home_m, careful->track->track.drone.home_m);
        ASSERT_EQ(quick->colors.size(), careful->track->colors.size());
        for (std::size_t k = 0; k < quick->colors.size(); ++k)
            EXPECT_EQ(quick->colors[k].color, careful->track->colors[k].color);
        ++drones;
    }
    EXPECT_EQ(drones, 3u);
}

TEST(Czml, StartAndUncertifiedMarkAreHeld) {
    planner::FlightPlan plan = fixed::show();
    plan.exporting.start_utc_s = parse_utc("2026-12-31T23:59:30Z");
    const std::string text = text_of(plan, false);
    EXPECT_THAT(text, HasSubstr("\"interval\":\"2026-12-31T23:59:30Z/2027-01-01T00:00:40.600Z\""));
    EXPECT_THAT(text, HasSubstr("\"name\":\"UNCERTIFIED: Fixed"));
    const auto show = read(text);
    ASSERT_TRUE(show.ok());
    oracle::expect_flown(*show, plan);
    EXPECT_EQ(show->certified, false);
    EXPECT_THAT(text_of(plan), Not(HasSubstr("UNCERTIFIED")));
}

/// 100,000 drones on the ground whose lamps never rest.
class Glittering final : public OutgoingShow {
  public:
    Glittering() {
        facts_.drones.resize(100'000);
        facts_.origin = fixed::show().origin;
        facts_.duration_ms = facts_.landing_begin_ms = 20'000;
        for (Millis t = 0; t < 20'000; t += 20)
            tracks_.lights.push_back({t, {1.0, 0.0, t % 40 == 0 ? 1.0 : 0.0}, false});
    }
    [[nodiscard]] const OutgoingFacts& facts() const override { return facts_; }
    [[nodiscard]] const Tracks& tracks(std::size_t) const override { return tracks_; }
    [[nodiscard]] Flight flight(std::size_t) const override { return {{{0.0, 20.0, 0, 0}}, {Vec3{}}}; }
    [[nodiscard]] Fitted fitted(std::size_t) const override { return {}; }

  private:
    OutgoingFacts facts_;
    Tracks tracks_;
};

TEST(Czml, WhatDoesNotFitIsRefused) {
    planner::FlightPlan plan = fixed::show();
    plan.limits.export_margin_m = 0.004;
    EXPECT_THAT(czml_format().unsuited(PlannedShow(plan)), HasSubstr("export_margin_m leaves no room"));
    EXPECT_THAT(czml_format().unsuited(Glittering()), HasSubstr("about 3080 MB of text; browsers hold 500 MB"));
}

TEST(Czml, ThreadsChangeNothing) {
    const planner::FlightPlan plan = large::show(300);
    aerogram::Run run;
    run.threads = 3;
    const ScratchFolder folder;
    ASSERT_TRUE(czml_format().write(PlannedShow(plan), test_seal(), folder.path(), run).ok());
    EXPECT_TRUE(read_file(folder.path() / "show.czml").value() == text_of(plan));
}

TEST(Czml, ReadsWhatOthersWrite) {
    const auto show = read(R"( [ {"id":"document","version":"1.0","name":"Other"},
{"id":"tower","position":{"cartographicDegrees":[1,2,3]}},
{"id":"a","name":"R&D \"]}}}","position":{"epoch":"2020-01-01T00:00:10Z","cartographicDegrees":[0,10,0,100, 4,10.00001,0.00002,101.5]},
 "point":{"color":{"rgba":[255,0,0,255]}}},
{"id":"b","position":{"cartographicDegrees":["2020-01-01T00:00:11.5Z",10,0,90,"2020-01-01T01:00:12+01:00",10,0,95]},
 "point":{"color":{"epoch":"2020-01-01T00:00:10Z","rgbaf":[0,0,0,0,1,2,0,1,0,1]}}}
] )");
    ASSERT_TRUE(show.ok()) << show.error().message;
    EXPECT_EQ(show->title, "Other");
    ASSERT_EQ(show->drones.size(), 2u);
    EXPECT_EQ(show->drones[0].name, "R&D \"]}}}");
    EXPECT_EQ(show->drones[1].name, "b");
    EXPECT_DOUBLE_EQ(show->duration_s, 4.0);
    const Vec3 half = position_at(show->drones[0], 2.0);
    EXPECT_NEAR(half.x, 0.5 * 1e-5 * 111'319.5, 0.001);  // degrees of the equator
    EXPECT_NEAR(half.y, 0.5 * 2e-5 * 110'574.3, 0.001);
    EXPECT_NEAR(half.z, 0.75, 0.001);
    EXPECT_DOUBLE_EQ(show->drones[1].pieces[0].start_s, 1.5);
    EXPECT_EQ(light_at(show->drones[0].tracks.lights, 1.0), (Rgb{1.0, 0.0, 0.0}));
    EXPECT_NEAR(light_at(show->drones[1].tracks.lights, 1.0).g, 0.5, 1e-9);
    EXPECT_EQ(show->origin->ground.height_m, 100.0);
    EXPECT_EQ(show->certified, std::nullopt);
}

TEST(Czml, ErrorsNameFilePacketAndKey) {
    const std::string drone = R"({"id":"a","position":{"epoch":"2020-01-01T00:00:00Z","cartographicDegrees":)";
    EXPECT_EQ(error_of(""), "a.czml: holds no tracks");
    EXPECT_EQ(read("{}").error().message, "a.czml: must be a list of packets");
    EXPECT_EQ(read("[").error().message, "a.czml: packet 1: the list breaks off");
    EXPECT_EQ(error_of("{},7"), "a.czml: packet 2: the list breaks off");
    EXPECT_EQ(error_of("{\"id\":}"), "a.czml: packet 1: is no JSON");
    EXPECT_EQ(error_of(drone + "[0,1,2,3,0,1,2,3]}}"), "a.czml: packet 1: position: times must rise");
    EXPECT_EQ(error_of("{}," + drone + "[0,1,2,3,4,5]}}"),
              "a.czml: packet 2: position: must be time, longitude, latitude, height, and so on");
    EXPECT_EQ(error_of(drone + "[0,1,91,3]}}"), "a.czml: packet 1: position: must be a number within its bounds");
    EXPECT_EQ(error_of(R"({"position":{"cartographicDegrees":[0,1,2,3]}})"),
              "a.czml: packet 1: position: times in seconds need an epoch");
    EXPECT_EQ(error_of(R"({"position":{"cartesian":[0,1,2,3]}})"),
              "a.czml: packet 1: position: must be sampled as cartographicDegrees or cartographicRadians");
    EXPECT_EQ(error_of(R"({"position":[{"interval":"x"}]})"), "a.czml: packet 1: position: intervals are not read");
    EXPECT_EQ(error_of(R"({"position":{"interpolationAlgorithm":"LAGRANGE","interpolationDegree":5,)"
                       R"("epoch":"2020-01-01T00:00:00Z","cartographicDegrees":[0,1,2,3]}})"),
              "a.czml: packet 1: position: only linear interpolation is read");
}

TEST(Czml, DamagedInputIsRefusedNotCrashedOn) {
    std::size_t refused = 0, variants = 0;
    for_damaged(text_of(fixed::show()), 1'500, [&](const std::string& damaged) {
        const auto show = read(damaged);
        ++variants;
        refused += show.ok() ? 0u : 1u;
        if (show.ok()) {
            EXPECT_TRUE(well_formed(*show).ok());
        } else {
            EXPECT_THAT(show.error().message, HasSubstr("a.czml: "));
        }
    });
    EXPECT_GT(variants, 1'800u);
    EXPECT_GT(refused, 500u);
}

TEST(Czml, IsRecognised) {
    EXPECT_TRUE(czml_format().recognises("anything", text_of(fixed::show())));
    EXPECT_TRUE(czml_format().recognises("a.czml", "["));
    EXPECT_FALSE(czml_format().recognises("a.json", "[{\"id\":\"x\"}]"));
}

}  // namespace
}  // namespace aerogram::exporter
