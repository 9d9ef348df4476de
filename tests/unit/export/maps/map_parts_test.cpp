#include <gtest/gtest.h>

#include <random>

#include "export/maps/map_lights.hpp"
#include "export/maps/map_time.hpp"
#include "export/maps/map_tracks.hpp"
#include "export/maps/track_corners.hpp"
#include "export/maps/xml_cursor.hpp"
#include "export/outgoing/planned_show.hpp"
#include "tests/unit/export/maps/map_oracle.hpp"

namespace aerogram::exporter {
namespace {

using Event = XmlCursor::Event;

/// "<a:", ">a" and texts, one after another; "!" and the problem at a fault.
std::string walked(const std::string& xml) {
    XmlCursor cursor(xml);
    std::string out;
    for (;;) {
        switch (cursor.next()) {
            case Event::start:
                out += "<" + std::string(cursor.name()) + ":" + std::string(cursor.attribute());
                break;
            case Event::end:
                out += ">" + std::string(cursor.name());
                break;
            case Event::text:
                out += cursor.text().value_or("?");
                break;
            case Event::done:
                return out;
            case Event::broken:
                return "!" + cursor.problem();
        }
    }
}

TEST(XmlCursor, TellsElementsAndTextsInOrder) {
    EXPECT_EQ(walked("\xEF\xBB\xBF<?xml version='1.0'?>\n<!-- <x> --><a><b name=\"n\" other='>'/>t<!-- c -->u</a>\n"),
              "<a:<b:n>btu>a");
    EXPECT_EQ(walked("<gx:Track xmlns:gx = \"u\"/>"),
              "!1: a tag is not closed, or its attributes are not name=\"value\"");
    EXPECT_EQ(walked("<gx:Track ></gx:Track >"), "<Track:>Track");
    EXPECT_EQ(walked("<a>&lt;&amp;&#233;&#x1F600;<![CDATA[<&]]></a>"), "<a:<&\u00e9\U0001F600<&>a");
}

TEST(XmlCursor, FaultsNameTheLine) {
    EXPECT_EQ(walked("<a>\n<b></a>"), "!2: </a> ends nothing");
    EXPECT_EQ(walked("<a>\n"), "!2: ends inside <a>");
    EXPECT_EQ(walked(""), "!1: holds no element");
    EXPECT_EQ(walked("x<a/>"), "!1: text outside of any element");
    EXPECT_EQ(walked("<a/><b/>"), "!1: a second outermost element");
    EXPECT_EQ(walked("<a>&nbsp;</a>"), "!1: entity \"&nbsp;\" is unknown");
    EXPECT_EQ(walked("<!DOCTYPE a><a/>"), "!1: a document type is not read");
    EXPECT_EQ(walked("<a><!-- x</a>"), "!1: a comment does not end");
    std::string deep;
    for (int k = 0; k < 100; ++k) deep += "<a>";
    EXPECT_EQ(walked(deep), "!1: elements are nested too deeply");
}

TEST(XmlCursor, TextsAreEscapedAndReadBack) {
    const std::string text = "a<b>&\"' \u00e9 \U0001F600";
    EXPECT_EQ(walked("<a>" + xml_text(text) + "</a>"), "<a:" + text + ">a");
    EXPECT_EQ(xml_text("x\x01y\x80"), "x?y?");
}

TEST(MapTime, ReadsWhatIso8601AndKmlAllow) {
    const std::int64_t noon = 946'684'800LL * 1'000'000 + 43'200LL * 1'000'000;
    EXPECT_EQ(utc_micros("2000-01-01T12:00:00Z"), noon);
    EXPECT_EQ(utc_micros("2000-01-01T12:00:00"), noon);
    EXPECT_EQ(utc_micros(" 2000-01-01T14:30:00+02:30\n"), noon);
    EXPECT_EQ(utc_micros("2000-01-01T07:00:00-0500"), noon);
    EXPECT_EQ(utc_micros("2000-01-01T12:00:00.25Z"), noon + 250'000);
    EXPECT_EQ(utc_micros("2000-01-01T12:00:00.1234567Z"), noon + 123'456);
    for (const char* bad : {"", "2000-01-01", "2000-01-01T12:00:00.Z", "2000-13-01T12:00:00Z", "2000-01-01T12:00:60Z",
                            "2000-01-01T12:00:00z", "2000-01-01T12:00:00+1", "2000-01-01T12:00:00+15:00"})
        EXPECT_EQ(utc_micros(bad), std::nullopt) << bad;
}

TEST(MapTime, ManyTimesReadAsOneByOne) {
    std::mt19937_64 random(5);
    UtcReader reader;
    for (int k = 0; k < 20'000; ++k) {
        std::string text = utc_text_ms(946'684'800'000LL + static_cast<std::int64_t>(random() % 300'000));
        if (random() % 10 == 0) text[random() % text.size()] = static_cast<char>('0' + random() % 11);
        if (random() % 10 == 0) text.replace(text.size() - 1, 1, "+00:30");
        EXPECT_EQ(reader.micros(text), utc_micros(text)) << text;
    }
}

TEST(MapLights, Property1_LightsComeBackWithinADisplayColoursStep) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int round = 0; round < 300; ++round) {
        std::vector<LightKey> keys;
        Millis time_ms = static_cast<Millis>(random() % 3) * 20;
        for (int k = 0; k < 12; ++k) {
            keys.push_back({time_ms, {share(random), share(random), share(random)}, random() % 2 == 0});
            time_ms += static_cast<Millis>(random() % 4) * 20;  // also several at one time
        }
        const auto samples = color_samples(keys);
        for (std::size_t k = 1; k < samples.size(); ++k) ASSERT_LT(samples[k - 1].time_ms, samples[k].time_ms);
        const auto again = light_keys(samples);
        for (Millis t = 0; t < time_ms + 100; ++t) {
            if (t % 20 == 19) continue;  // where jumps go over
            const Rgb a = light_at(keys, seconds_from_ms(t)), b = light_at(again, seconds_from_ms(t));
            for (const double off : {a.r - b.r, a.g - b.g, a.b - b.b})
                ASSERT_LE(std::abs(off), 1.2 / 255.0) << "round " << round << " at " << t;
        }
    }
}

TEST(TrackCorners, Property1And4_LinesStayWithinTheFitFromStartToEnd) {
    const planner::FlightPlan plan = fixed::show();
    const PlannedShow show(plan);
    const MapCut cut = map_cut(show.facts()).value();
    for (std::size_t i = 0; i < show.drones(); ++i) {
        const auto corners = track_corners(show, i, cut);
        EXPECT_EQ(corners.front().time_ms, 0);
        EXPECT_EQ(corners.back().time_ms, plan.duration_ms());
        for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
            ASSERT_LT(corners[k].time_ms, corners[k + 1].time_ms);
            for (const double u : {0.1, 0.3, 0.5, 0.7, 0.9}) {
                const double t_s =
                    std::lerp(seconds_from_ms(corners[k].time_ms), seconds_from_ms(corners[k + 1].time_ms), u);
                const Vec3 line = glm::mix(corners[k].place_m, corners[k + 1].place_m, u);
                ASSERT_LE(glm::length(line - planner::sample(plan, DroneId(i), t_s).motion.position_m), kMapFit_m);
            }
        }
    }
}

TEST(TrackCorners, Property2_ClimbAndLandingAreCornersOfTheirOwn) {
    const planner::FlightPlan plan = fixed::show();
    const PlannedShow show(plan);
    const auto corners = track_corners(show, 0, map_cut(show.facts()).value());
    for (const Millis t : {show.facts().takeoff_end_ms, show.facts().landing_begin_ms})
        EXPECT_NE(std::ranges::find(corners, t, &Corner::time_ms), corners.end()) << t;
}

/// A flight of straight lines between times off every grid.
class Zigzag final : public OutgoingShow {
  public:
    Zigzag() {
        facts_.drones.resize(1);
        facts_.duration_ms = facts_.landing_begin_ms = 2'000;
        flight_.controls_m = {{0, 0, 0}, {3, 0, 5}, {3, 4, 1}};
        flight_.pieces = {{0.0, 1.0371, 0, 1}, {1.0371, 0.9629, 1, 1}};
    }
    [[nodiscard]] const OutgoingFacts& facts() const override { return facts_; }
    [[nodiscard]] const Tracks& tracks(std::size_t) const override { return tracks_; }
    [[nodiscard]] Flight flight(std::size_t) const override { return flight_; }
    [[nodiscard]] Fitted fitted(std::size_t) const override { return {}; }

  private:
    OutgoingFacts facts_;
    Tracks tracks_;
    Flight flight_;
};

TEST(TrackCorners, Property3_JumpsOfTheVelocityAreSampled) {
    const Zigzag show;
    const auto corners = track_corners(show, 0, {250, 0.013});
    ASSERT_EQ(corners.size(), 3u);
    EXPECT_EQ(corners[1].time_ms, 1'037);
    EXPECT_LT(glm::length(corners[1].place_m - Vec3(3, 0, 5)), 0.002);
}

TEST(MapTracks, PlacesAreThreeNumbersHoweverTheyAreSpaced) {
    EXPECT_EQ(parse_place("1 -2.5 3e2", 1e3), Vec3(1.0, -2.5, 300.0));
    EXPECT_EQ(parse_place("\n 1  2\t3 ", 1e3), Vec3(1.0, 2.0, 3.0));
    for (const char* bad : {"", "1 2", "1 2 3 4", "1 2 x", "1,2,3", "1 2 1e4", "nan 2 3"})
        EXPECT_EQ(parse_place(bad, 1e3), std::nullopt) << bad;
}

}  // namespace
}  // namespace aerogram::exporter
