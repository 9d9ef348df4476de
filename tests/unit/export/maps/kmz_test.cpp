#include "export/maps/kmz.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/verify/judge.hpp"
#include "tests/unit/export/large_show.hpp"
#include "tests/unit/export/maps/map_oracle.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string document(const planner::FlightPlan& plan, bool certified = true) {
    return unzip_bytes(written_files(kmz_format(), plan, test_seal(certified))[0].bytes).value()[0].bytes;
}
Result<RecordedShow> read(const std::string& kml) {
    return read_kmz(std::vector<FileBytes>{{"a.kml", kml}});
}
std::string error_of(const std::string& kml) {
    const auto show = read(kml);
    return show ? "none" : show.error().message;
}
std::string kml_of(const std::string& inside) {
    return "<kml xmlns:gx=\"g\"><Document><name>Other</name>\n" + inside + "\n</Document></kml>";
}
std::string track_of(const std::string& inside) {
    return kml_of("<Placemark><name>ann</name><gx:Track><altitudeMode>absolute</altitudeMode>" + inside +
                  "</gx:Track></Placemark>");
}

TEST(Kmz, WritesTheseBytes) {
    expect_golden("show.kmz.txt", unpacked_text(written_files(kmz_format(), fixed::show())));
}

TEST(Kmz, ReadsBackWithinTheStatedRounding) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(kmz_format(), written_files(kmz_format(), plan));
    oracle::expect_flown(show, plan);
    EXPECT_EQ(show.title, plan.name);
    EXPECT_EQ(show.show_hash, test_seal().show_hash);
    EXPECT_EQ(show.certified, true);
    EXPECT_EQ(show.drones[1].name, "drone-002");
    EXPECT_EQ(show.origin->heading_deg, plan.origin.heading_deg);
    EXPECT_EQ(show.origin->geoid_undulation_m, plan.origin.geoid_undulation_m);
    EXPECT_EQ(show.limits->min_separation_m, plan.limits.min_separation_m);
    EXPECT_EQ(show.airspace->geofence_m, plan.airspace.geofence_m);
    EXPECT_EQ(show.airspace->obstacles.size(), 2u);
    EXPECT_EQ(show.endurance_s, plan.endurance_s);
    const Rounding& r = show.rounding;
    EXPECT_LE(2.0 * r.fit_m + 2.0 * std::sqrt(3.0) * r.position_m, plan.limits.export_margin_m);
    EXPECT_FALSE(r.has_acceleration);
}

TEST(Kmz, ShowsBesideTheDateLineAndInTheSouthReadBackToo) {
    for (const auto& [latitude_deg, longitude_deg] :
         {std::pair{0.0, 180.0}, {60.0, -179.99999}, {-33.9, 179.9999}, {-54.8, -68.3}, {78.2, 15.6}}) {
        planner::FlightPlan plan = oracle::show_at(latitude_deg, longitude_deg);
        oracle::expect_flown(read_back(kmz_format(), written_files(kmz_format(), plan)), plan);
        for (const auto& place : oracle::numbers_between(document(plan), "<gx:coord>", "</gx:coord>"))
            ASSERT_LT(std::abs(place[0] - longitude_deg), 1.0) << "no jump by 360 degrees";
    }
}

/// The coordinates themselves, through a formula that shares nothing with the writer: neither mirrored nor turned.
TEST(Kmz, FirstAndHighestPlacesAreWhereTheyShouldBe) {
    const planner::FlightPlan plan = fixed::show();
    const std::string text = document(plan);
    const auto homes = oracle::numbers_between(text.substr(text.find("<name>Homes")), "<coordinates>", "</coord");
    ASSERT_GE(homes.size(), 3u);
    const auto show_of = [&](const std::vector<double>& lla) {
        return oracle::to_show(plan.origin, {lla[0], lla[1], lla[2] + *plan.origin.geoid_undulation_m});
    };
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(glm::length(show_of(homes[i]) - fixed::pads()[i]), 0.001) << i;
    const auto places = oracle::numbers_between(text, "<gx:coord>", "</gx:coord>");
    double nearest_m = 1e9;
    for (const auto& lla : places) nearest_m = std::min(nearest_m, glm::length(show_of(lla) - fixed::formation_b()[2]));
    EXPECT_LT(nearest_m, 0.02) << "formation B's third drone";
    const auto rings = oracle::numbers_between(text.substr(text.find("<name>Geofence")), "<coordinates>", "</coord");
    for (std::size_t k = 0; k < plan.airspace.geofence_m.size(); ++k) {
        const Vec2 fence = plan.airspace.geofence_m[k];
        const Vec3 corner = show_of({rings[0][3 * k], rings[0][3 * k + 1], rings[0][3 * k + 2]});
        EXPECT_LT(glm::length(corner - Vec3(fence.x, fence.y, plan.limits.ceiling_m)), 0.001) << k;
    }
}

TEST(Kmz, ItsOwnJudgeFindsNothingWrong) {
    const auto judgement =
        judge(read_back(kmz_format(), written_files(kmz_format(), fixed::show())), {}, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    for (const Finding& finding : judgement->findings)
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
    EXPECT_TRUE(judgement->problems.empty());
}

TEST(Kmz, TimesCountFromTheStatedStart) {
    planner::FlightPlan plan = fixed::show();
    EXPECT_THAT(document(plan), HasSubstr("<when>2000-01-01T00:00:00Z</when>"));
    plan.exporting.start_utc_s = parse_utc("2026-12-31T23:59:30Z");
    const std::string text = document(plan);
    EXPECT_THAT(text, HasSubstr("<when>2026-12-31T23:59:30Z</when>"));
    EXPECT_THAT(text, HasSubstr("<when>2027-01-01T00:00:40.6Z</when>")) << "the end, after 70.6 s";
    oracle::expect_flown(read_back(kmz_format(), written_files(kmz_format(), plan)), plan);
}

TEST(Kmz, UncertifiedShowsSaySoInTheirName) {
    EXPECT_THAT(document(fixed::show(), false), HasSubstr("<name>UNCERTIFIED: Fixed"));
    EXPECT_THAT(document(fixed::show()), Not(HasSubstr("UNCERTIFIED")));
    const RecordedShow show = read_back(kmz_format(), written_files(kmz_format(), fixed::show(), test_seal(false)));
    EXPECT_EQ(show.certified, false);
    EXPECT_EQ(show.title, fixed::show().name);
}

TEST(Kmz, TracksHaveTheFirstLightsColour) {
    // (1, 0.5, 0) linear is #ffbc00; KML's order is alpha, blue, green, red.
    EXPECT_THAT(document(fixed::show()), HasSubstr("<LineStyle><color>ff00bcff</color></LineStyle>"));
}

TEST(Kmz, WithoutAUndulationItIsRefused) {
    planner::FlightPlan plan = fixed::show();
    plan.origin.geoid_undulation_m.reset();
    EXPECT_THAT(kmz_format().unsuited(PlannedShow(plan)), HasSubstr("geoid_undulation_m"));
    const ScratchFolder folder;
    EXPECT_FALSE(kmz_format().write(PlannedShow(plan), test_seal(), folder.path(), aerogram::Run{}).ok());
    plan = fixed::show();
    plan.limits.export_margin_m = 0.004;
    EXPECT_THAT(kmz_format().unsuited(PlannedShow(plan)), HasSubstr("export_margin_m leaves no room"));
}

TEST(Kmz, LargeFleetsLinkTheirTracks) {
    const planner::FlightPlan plan = large::show(1'100);
    const auto files = written_files(kmz_format(), plan);
    const auto entries = unzip_bytes(files[0].bytes).value();
    ASSERT_EQ(entries.size(), 3u);
    EXPECT_THAT(entries[0].bytes, Not(HasSubstr("gx:Track>")));
    EXPECT_THAT(entries[0].bytes, HasSubstr("<href>tracks/2.kml</href>"));
    EXPECT_EQ(entries[1].path, "tracks/1.kml");
    const RecordedShow show = read_back(kmz_format(), files);
    ASSERT_EQ(show.drones.size(), 1'100u);
    EXPECT_EQ(show.drones[1'099].name, "drone-1100");
    const double middle_s = show.duration_s / 2.0;
    EXPECT_LT(glm::length(position_at(show.drones[1'099], middle_s) -
                          planner::sample(plan, DroneId(1'099), middle_s).motion.position_m),
              0.022);
    aerogram::Run run;
    run.threads = 3;
    const ScratchFolder folder;
    ASSERT_TRUE(kmz_format().write(PlannedShow(plan), test_seal(), folder.path(), run).ok());
    EXPECT_EQ(read_file(folder.path() / "show.kmz").value(), files[0].bytes) << "threads change nothing";
}

TEST(Kmz, ReadsWhatOthersWrite) {
    const auto show = read(kml_of(R"(<!-- a GPS logger's --><Placemark><name><![CDATA[R&D <1>]]></name>
<Style><LineStyle><color>ff0000ff</color></LineStyle></Style>
<gx:MultiTrack><gx:Track><altitudeMode>absolute</altitudeMode>
<when>2019-11-07T09:44:12.5+01:00</when><gx:coord>10 0 100</gx:coord>
<when>2019-11-07T08:44:16.25Z</when><gx:coord>10.00001  0.00002
 101.5</gx:coord></gx:Track><gx:Track><altitudeMode>absolute</altitudeMode>
<when>2019-11-07T08:44:20</when><gx:coord>10.00001 0.00002 101.5</gx:coord></gx:Track></gx:MultiTrack></Placemark>
<Placemark><name>a point</name><Point><coordinates>1,2,3</coordinates></Point></Placemark>
<Placemark><gx:Track><altitudeMode>absolute</altitudeMode><when>2019-11-07T08:44:13Z</when><gx:coord>10 0 90</gx:coord>
</gx:Track></Placemark>)"));
    ASSERT_TRUE(show.ok()) << show.error().message;
    ASSERT_EQ(show->drones.size(), 2u);
    EXPECT_EQ(show->drones[0].name, "R&D <1>");
    EXPECT_EQ(show->drones[1].name, "drone-002");
    EXPECT_DOUBLE_EQ(show->duration_s, 7.5);
    EXPECT_EQ(first_position(show->drones[0]), Vec3(0.0));
    const Vec3 half = position_at(show->drones[0], 1.875);
    EXPECT_NEAR(half.x, 0.5 * 1e-5 * 111'319.5, 0.001);  // degrees of the equator
    EXPECT_NEAR(half.y, 0.5 * 2e-5 * 110'574.3, 0.001);
    EXPECT_NEAR(half.z, 0.75, 0.001);
    EXPECT_NEAR(last_position(show->drones[1]).z, -10.0, 1e-6);
    EXPECT_FALSE(show->origin.has_value()) << "heights above the sea tell no ellipsoidal height";
    EXPECT_EQ(show->rounding.fit_m, 0.0);
}

TEST(Kmz, HeightsAboveGroundAreThoseOfTheShow) {
    const auto show = read(
        kml_of("<Placemark><gx:Track><altitudeMode>relativeToGround</altitudeMode><when>2020-01-01T00:00:00Z</when>"
               "<when>2020-01-01T00:00:02Z</when><gx:coord>5 5 3</gx:coord><gx:coord>5 5 "
               "9</gx:coord></gx:Track></Placemark>"));
    ASSERT_TRUE(show.ok()) << show.error().message;
    EXPECT_NEAR(position_at(show->drones[0], 1.0).z, 6.0, 1e-9);
}

TEST(Kmz, ErrorsNameFileAndLine) {
    const std::string when = "<when>2020-01-01T00:00:00Z</when>", coord = "<gx:coord>1 2 3</gx:coord>";
    EXPECT_EQ(error_of(kml_of("")), "a.kml: holds no tracks");
    EXPECT_EQ(error_of(track_of("\n" + when + "\n" + when + coord + coord)),
              "a.kml:4: <when> \"2020-01-01T00:00:00Z\": must be later than the one before");
    EXPECT_EQ(error_of(track_of(when)), "a.kml:2: a track has 1 <when> and 0 <gx:coord>");
    EXPECT_EQ(error_of(track_of("<when>yesterday</when>" + coord)),
              "a.kml:2: <when> \"yesterday\": must be a date and time like 2026-12-31T22:00:00.5Z");
    EXPECT_EQ(error_of(track_of(when + "<gx:coord>1 95 3</gx:coord>")),
              "a.kml:2: <gx:coord> \"1 95 3\": must be longitude, latitude and height");
    EXPECT_THAT(error_of(track_of(when + "<gx:coord>1,2,3</gx:coord>")), HasSubstr("must be longitude, latitude"));
    EXPECT_EQ(error_of(kml_of("<Placemark><gx:Track>" + when + coord + "</gx:Track></Placemark>")),
              "a.kml:2: altitudeMode \"\": must be absolute or relativeToGround");
    EXPECT_EQ(error_of("<!DOCTYPE kml [<!ENTITY a \"b\">]><kml/>"), "a.kml:1: a document type is not read");
    EXPECT_EQ(error_of("<kml><Document>"), "a.kml:1: ends inside <Document>");
    const auto archive = zip_bytes(std::vector<FileBytes>{{"readme.txt", "x"}}).value();
    EXPECT_EQ(read_kmz(std::vector<FileBytes>{{"a.kmz", archive}}).error().message, "a.kmz: holds no tracks");
}

TEST(Kmz, DamagedInputIsRefusedNotCrashedOn) {
    const auto files = written_files(kmz_format(), fixed::show());
    const std::string text = unzip_bytes(files[0].bytes).value()[0].bytes;
    std::size_t refused = 0, variants = 0;
    for_damaged(text, 600, [&](const std::string& damaged) {
        const auto show = read(damaged);
        ++variants;
        refused += show.ok() ? 0u : 1u;
        if (show.ok()) {
            EXPECT_TRUE(well_formed(*show).ok());
        } else {
            EXPECT_FALSE(show.error().message.empty());
        }
    });
    EXPECT_GT(variants, 800u);
    EXPECT_GT(refused, 300u);
    for_damaged(files[0].bytes, 300, [&](const std::string& damaged) {
        const auto show = read_kmz(std::vector<FileBytes>{{"show.kmz", damaged}});
        if (show.ok()) {
            EXPECT_TRUE(well_formed(*show).ok());
        }
    });
}

TEST(Kmz, IsRecognised) {
    const auto files = written_files(kmz_format(), fixed::show());
    EXPECT_TRUE(kmz_format().recognises("anything", files[0].bytes));
    EXPECT_TRUE(kmz_format().recognises("a.kml", "<kml>"));
    EXPECT_TRUE(kmz_format().recognises("x", "<?xml version=\"1.0\"?>\n<kml xmlns="));
    EXPECT_FALSE(kmz_format().recognises("x", "<?xml version=\"1.0\"?>\n<svg>"));
}

}  // namespace
}  // namespace aerogram::exporter
