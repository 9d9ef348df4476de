#include "export/skybrush/csv_zip.hpp"
#include "export/outgoing/planned_show.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "export/verify/judge.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kHeader = "Time [msec],x [m],y [m],z [m],Red,Green,Blue\n";

Result<RecordedShow> read(const std::string& csv, const std::string& name = "ann.csv") {
    return csv_format().read(
        std::vector<FileBytes>{{"csv.zip", zip_bytes(std::vector<FileBytes>{{name, csv}}).value()}});
}
std::string error_of(const std::string& csv) {
    const auto show = read(csv);
    return show ? "none" : show.error().message;
}

TEST(CsvZip, WritesTheseBytes) {
    expect_golden("csv.zip.txt", unpacked_text(written_files(csv_format(), fixed::show())));
}

TEST(CsvZip, HoldsOneFileADroneAndNothingElse) {
    const auto files = written_files(csv_format(), fixed::show());
    ASSERT_EQ(files.size(), 1u);
    const auto entries = unzip_bytes(files[0].bytes).value();
    ASSERT_EQ(entries.size(), 3u);
    EXPECT_EQ(entries[0].path, "drone-001.csv");
    EXPECT_TRUE(csv_format().recognises("anything", files[0].bytes));
    EXPECT_FALSE(csv_format().recognises("csv.zip", "no archive"));
}

/// X front is our +y, Y left our -x: an asymmetric first row, by hand.
TEST(CsvZip, AxesAreFrontLeftUp) {
    const auto entries = unzip_bytes(written_files(csv_format(), fixed::show())[0].bytes).value();
    EXPECT_EQ(entries[1].bytes.substr(0, std::string(kHeader).size() + 27),
              std::string(kHeader) + "0,-20.250,-2.500,0.000,0,0,");
}

TEST(CsvZip, ReadsBackWithinTheStatedRounding) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(csv_format(), written_files(csv_format(), plan));
    ASSERT_EQ(show.drones.size(), 3u);
    ASSERT_TRUE(well_formed(show).ok());
    EXPECT_DOUBLE_EQ(show.duration_s, seconds_from_ms(plan.duration_ms()));
    EXPECT_FALSE(show.rounding.has_acceleration);
    for (std::size_t i = 0; i < 3; ++i) {
        const RecordedDrone& drone = show.drones[i];
        for (Millis t = 0; t <= plan.duration_ms(); t += 7) {
            const Vec3 exact = planner::sample(plan, DroneId(i), seconds_from_ms(t)).motion.position_m;
            ASSERT_LE(glm::length(position_at(drone, seconds_from_ms(t)) - exact), show.rounding.fit_m)
                << i << " at " << t;
        }
        for (const Piece& piece : drone.pieces) {
            const planner::DroneState exact = planner::sample(plan, DroneId(i), piece.start_s);
            const Vec3 miss = position_at(drone, piece.start_s) - exact.motion.position_m;
            ASSERT_LE(std::max({std::abs(miss.x), std::abs(miss.y), std::abs(miss.z)}),
                      show.rounding.position_m + 1e-9);
            ASSERT_NEAR(light_at(drone.tracks.lights, piece.start_s).g, exact.color.g, 0.5 / 255.0 + 1e-9);
        }
    }
}

TEST(CsvZip, ItsOwnJudgeFindsNothingWrong) {
    const RecordedShow show = read_back(csv_format(), written_files(csv_format(), fixed::show()));
    const auto judgement = judge(show, {}, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    for (const Finding& finding : judgement->findings)
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
}

/// Two chords of a dt² / 8 and two rounded points.
TEST(CsvZip, RowStepKeepsAPairWithinTheMargin) {
    planner::FlightPlan plan = fixed::show();
    plan.certificate = {};
    EXPECT_EQ(csv_row_step_ms(PlannedShow(plan).facts()), 250);
    plan.limits.acceleration_mps2 = 4.0;
    EXPECT_EQ(csv_row_step_ms(PlannedShow(plan).facts()), 200);
    plan.limits.export_margin_m = 0.01;
    EXPECT_EQ(csv_row_step_ms(PlannedShow(plan).facts()), 50);
    plan.limits.export_margin_m = 0.001;
    EXPECT_EQ(csv_row_step_ms(PlannedShow(plan).facts()), std::nullopt);
    EXPECT_THAT(csv_format().unsuited(PlannedShow(plan)), HasSubstr("export_margin_m leaves no room"));
    plan = fixed::show();
    plan.certificate.acts[0].extremes.acceleration_mps2 = 9.0;  // an uncertified plan may be over its limits
    EXPECT_EQ(csv_row_step_ms(PlannedShow(plan).facts()), 125);
}

TEST(CsvZip, ReadsWhatOthersWrite) {
    const auto show = read(
        "\xEF\xBB\xBFtime [MSEC],X [m],Y [m],Z [m],red,GREEN,blue,Yaw [deg]\r\n"
        "0, 1.5,2,3,255,0,0,7\r\n500,2.5,2,3,0,255,0,8\r\n\r\n",
        "shows/Ann.CSV");
    ASSERT_TRUE(show.ok()) << show.error().message;
    const RecordedDrone& drone = show->drones[0];
    EXPECT_EQ(drone.name, "Ann");
    EXPECT_EQ(position_at(drone, 0.25), Vec3(-2.0, 2.0, 3.0));
    EXPECT_EQ(light_at(drone.tracks.lights, 0.25), (Rgb{0.5, 0.5, 0.0}));
}

TEST(CsvZip, ErrorsNameArchiveFileAndLine) {
    const std::string header = kHeader, row = "0,1,2,3,0,0,0\n", at = "csv.zip: ann.csv:";
    EXPECT_EQ(error_of("t,x,y\n"), at + "1: column \"t\": must be \"time [msec]\"");
    EXPECT_EQ(error_of(""), at + "1: column \"\": must be \"time [msec]\"");
    EXPECT_EQ(error_of(header), at + "2: needs at least two rows");
    EXPECT_EQ(error_of(header + row), at + "3: needs at least two rows");
    EXPECT_EQ(error_of(header + row + row), at + "3: time [msec] = 0: must be above the row before, 0");
    EXPECT_EQ(error_of(header + row + "\n5,1,2,3,0,0,0\n"),
              at + "3: time [msec] = \"\": must be a whole number from 0 to 86400000");
    EXPECT_EQ(error_of(header + row + "5,1,nan,3,0,0,0\n"), at + "3: y [m] = \"nan\": must be a number within ±1e6");
    EXPECT_EQ(error_of(header + row + "5,1,2,1e7,0,0,0\n"), at + "3: z [m] = \"1e7\": must be a number within ±1e6");
    EXPECT_EQ(error_of(header + row + "5,1,2,3,0,256,0\n"),
              at + "3: green = \"256\": must be a whole number from 0 to 255");
    EXPECT_EQ(error_of(header + row + "5,1,2,3,0,0\n"), at + "3: blue = \"\": must be a whole number from 0 to 255");
    EXPECT_EQ(error_of(header + row + "5.5,1,2,3,0,0,0\n"),
              at + "3: time [msec] = \"5.5\": must be a whole number from 0 to 86400000");
    const auto empty = csv_format().read(
        std::vector<FileBytes>{{"csv.zip", zip_bytes(std::vector<FileBytes>{{"readme.txt", "x"}}).value()}});
    ASSERT_FALSE(empty.ok());
    EXPECT_EQ(empty.error().message, "csv.zip: holds no .csv file");
}

TEST(CsvZip, DamagedInputIsRefusedNotCrashedOn) {
    const std::string csv = std::string(kHeader) + "0,1,2,3,9,9,9\n250,1.5,2,3,0,0,0\n500,2,2,-3,1,2,3\n";
    for_damaged(csv, 2'000, [&](const std::string& damaged) {
        const auto show = read(damaged);
        if (show) {
            EXPECT_TRUE(well_formed(*show).ok()) << damaged;
        }
    });
    const std::string archive = zip_bytes(std::vector<FileBytes>{{"ann.csv", csv}}).value();
    std::size_t refused = 0;
    for_damaged(archive, 1'000, [&](const std::string& damaged) {
        refused += csv_format().read(std::vector<FileBytes>{{"csv.zip", damaged}}).ok() ? 0u : 1u;
    });
    EXPECT_GT(refused, 500u);
}

}  // namespace
}  // namespace aerogram::exporter
