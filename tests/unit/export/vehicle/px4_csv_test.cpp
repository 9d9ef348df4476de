#include "export/vehicle/px4_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "export/verify/judge.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kHeader = "idx,t,px,py,pz,vx,vy,vz,ax,ay,az,yaw,mode,ledr,ledg,ledb\n";

Result<RecordedShow> read(const std::string& csv) {
    return px4_csv_format().read(std::vector<FileBytes>{{"px4/Drone 7.csv", csv}});
}
std::string error_of(const std::string& csv) {
    const auto show = read(csv);
    return show ? "none" : show.error().message;
}

std::vector<double> row(const std::string& csv, std::size_t number) {
    std::istringstream lines(csv);
    std::string line;
    for (std::size_t k = 0; k <= number; ++k) std::getline(lines, line);
    std::istringstream fields(line);
    std::vector<double> values;
    for (std::string field; std::getline(fields, field, ',');) values.push_back(std::stod(field));
    return values;
}

/// The header, and the row of every full second.
std::string seconds_of(const std::string& csv) {
    std::istringstream lines(csv);
    std::string text, line;
    for (std::size_t k = 0; std::getline(lines, line); ++k)
        if (k == 0 || k % 20 == 1) text += line + '\n';
    return text;
}

TEST(Px4Csv, WritesTheseBytes) {
    auto files = written_files(px4_csv_format(), fixed::show());
    ASSERT_EQ(files.size(), 4U);
    EXPECT_EQ(files[0].path, "px4/show.json");
    EXPECT_EQ(files[1].path, "px4/Drone 1.csv");
    for (const FileBytes& file : files) EXPECT_TRUE(px4_csv_format().recognises(file.path, file.bytes));
    for (std::size_t k = 1; k < files.size(); ++k) files[k].bytes = seconds_of(files[k].bytes);
    expect_golden("px4-csv.txt", unpacked_text(files));
}

/// The heading is 20.0 degrees: +y points there from north. An asymmetric state by this formula of its own.
TEST(Px4Csv, RowsAreStatesNorthEastDown) {
    const planner::FlightPlan plan = fixed::show();
    const std::string csv = written_files(px4_csv_format(), plan)[2].bytes;
    const double north = std::cos(20.0 * M_PI / 180.0), east = std::sin(20.0 * M_PI / 180.0);
    for (const std::size_t k : {0U, 201U, 365U, 700U, 1100U}) {
        const planner::DroneState exact = planner::sample(plan, DroneId(1), static_cast<double>(k) * 0.05);
        const auto values = row(csv, k + 1);
        ASSERT_EQ(values.size(), 16U);
        EXPECT_EQ(values[0], static_cast<double>(k));
        EXPECT_NEAR(values[1], static_cast<double>(k) * 0.05, 1e-12);
        std::size_t column = 2;
        for (const Vec3& v : {exact.motion.position_m, exact.motion.velocity_mps, exact.motion.acceleration_mps2}) {
            EXPECT_NEAR(values[column++], v.y * north - v.x * east, 0.00051);
            EXPECT_NEAR(values[column++], v.y * east + v.x * north, 0.00051);
            EXPECT_NEAR(values[column++], -v.z, 0.00051);
        }
        const double yaw = std::fmod(20.0 - exact.yaw_rad * 180.0 / M_PI + 720.0, 360.0);
        EXPECT_NEAR(values[11], yaw, 0.00051);
    }
    EXPECT_EQ(row(csv, 1)[12], 10.0);
    EXPECT_EQ(row(csv, 500)[12], 70.0);
    EXPECT_EQ(row(csv, 1300)[12], 100.0);
}

TEST(Px4Csv, ReadsBackWithinTheStatedRounding) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(px4_csv_format(), written_files(px4_csv_format(), plan));
    ASSERT_EQ(show.drones.size(), 3U);
    ASSERT_TRUE(well_formed(show).ok());
    EXPECT_EQ(show.show_hash, test_seal().show_hash);
    EXPECT_EQ(show.certified, true);
    EXPECT_EQ(show.title, plan.name);
    EXPECT_EQ(show.origin->heading_deg, plan.origin.heading_deg);
    EXPECT_FALSE(show.rounding.has_acceleration);
    for (std::size_t i = 0; i < 3; ++i) {
        const RecordedDrone& drone = show.drones[i];
        EXPECT_EQ(drone.name, "drone-00" + std::to_string(i + 1));
        EXPECT_EQ(drone.home_m, plan.pads_m[i]);
        EXPECT_EQ(drone.tracks.events, plan.tracks[i].events);
        for (Millis t = 0; t <= plan.duration_ms(); t += 7) {
            const double t_s = seconds_from_ms(t);
            const planner::DroneState exact = planner::sample(plan, DroneId(i), t_s);
            const double allowed = show.rounding.fit_m + std::sqrt(3.0) * show.rounding.position_m;
            ASSERT_LE(glm::length(position_at(drone, t_s) - exact.motion.position_m), allowed) << i << " at " << t;
            ASSERT_NEAR(yaw_at(drone.tracks.yaw, t_s), exact.yaw_rad, 0.01) << t;
            if (t % 350 == 0) {
                ASSERT_NEAR(light_at(drone.tracks.lights, t_s).g, exact.color.g, 0.51 / 255.0) << t;
            }
        }
    }
}

TEST(Px4Csv, ItsOwnJudgeFindsNothingWrong) {
    const RecordedShow show = read_back(px4_csv_format(), written_files(px4_csv_format(), fixed::show()));
    const auto judgement = judge(show, {}, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    for (const Finding& finding : judgement->findings)
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
}

TEST(Px4Csv, FilesComeInTheOrderOfTheirNumbers) {
    const std::string rows = std::string("t,px,py,pz\n") + "0,1,2,-3\n1,1,2,-3\n";
    const auto show = px4_csv_format().read(
        std::vector<FileBytes>{{"Drone 10.csv", rows}, {"Drone 2.csv", rows}, {"lead.csv", rows}});
    ASSERT_TRUE(show.ok()) << show.error().message;
    std::vector<std::string> names;
    for (const RecordedDrone& drone : show->drones) names.push_back(drone.name);
    EXPECT_THAT(names, ElementsAre("Drone 2", "Drone 10", "lead"));
}

TEST(Px4Csv, ReadsWhatOthersWrite) {
    const auto show = read("\xEF\xBB\xBFt,pz,px,py,note,ledr\r\n0,-3,10,4,hello,254.6\r\n 0.5 ,-3,1.1e1,4,,12\r\n\r\n");
    ASSERT_TRUE(show.ok()) << show.error().message;
    const RecordedDrone& drone = show->drones[0];
    EXPECT_EQ(drone.name, "Drone 7");
    EXPECT_EQ(position_at(drone, 0.25), Vec3(4.0, 10.5, 3.0));
    EXPECT_EQ(light_at(drone.tracks.lights, 0.25), (Rgb{1.0, 0.0, 0.0}));
    EXPECT_TRUE(drone.tracks.yaw.empty());
    EXPECT_FALSE(drone.home_m);
}

TEST(Px4Csv, ErrorsNameFileAndLine) {
    const std::string header = kHeader, row = "0,0,1,2,-3,0,0,0,0,0,0,0,70,1,2,3\n", at = "px4/Drone 7.csv: line ";
    EXPECT_EQ(error_of(""), at + "1: no column t");
    EXPECT_EQ(error_of("t,px,py\n"), at + "1: no column pz");
    EXPECT_EQ(error_of("t,px,py,pz,px\n"), at + "1: two columns px");
    EXPECT_EQ(error_of(header + row), at + "3: needs at least two rows");
    EXPECT_EQ(error_of(header + row + row), at + "3: t must be above the row before");
    EXPECT_EQ(error_of(header + row + "1,1,x,2,-3,0,0,0,0,0,0,0,70,1,2,3\n"), at + "3: px = \"x\": must be a number");
    EXPECT_EQ(error_of(header + row + "1,1,1\n"), at + "3: py = \"\": must be a number");
    EXPECT_EQ(error_of(header + row + "1,1,1e8,2,-3,0,0,0,0,0,0,0,70,1,2,3\n"), at + "3: t or a place is out of range");
    const auto lonely = written_files(px4_csv_format(), fixed::show())[0];
    const auto show = px4_csv_format().read(std::vector<FileBytes>{lonely});
    ASSERT_FALSE(show.ok());
    EXPECT_EQ(show.error().message, "px4/show.json: no file of a drone beside it");
}

TEST(Px4Csv, DamagedInputIsRefusedNotCrashedOn) {
    const auto files = written_files(px4_csv_format(), fixed::show());
    std::size_t tried = 0, refused = 0;
    for (const std::size_t which : {0U, 1U}) {
        std::string bytes = files[which].bytes;
        if (which == 1) bytes.resize(6'000);
        for_damaged(bytes, 300, [&](const std::string& damaged) {
            std::vector<FileBytes> changed = files;
            changed[which].bytes = damaged;
            if (which == 1) changed.resize(2);
            ++tried;
            const auto show = px4_csv_format().read(changed);
            if (!show) ++refused;
            if (show)
                EXPECT_TRUE(well_formed(*show).ok()) << well_formed(*show).error().message;
            else
                EXPECT_THAT(show.error().message, HasSubstr("px4/"));
        });
    }
    EXPECT_GE(tried, 800U);
    EXPECT_GE(refused, 300U);
}

TEST(Px4Csv, SaysWhyAShowDoesNotFit) {
    planner::FlightPlan plan = fixed::show();
    EXPECT_EQ(px4_csv_format().unsuited(PlannedShow(plan)), "");
    plan.limits.plane = PlaneLimits{};
    EXPECT_THAT(px4_csv_format().unsuited(PlannedShow(plan)), HasSubstr("planes"));
    plan = fixed::show();
    plan.limits.export_margin_m = 0.005;
    EXPECT_THAT(px4_csv_format().unsuited(PlannedShow(plan)), HasSubstr("export_margin_m leaves no room"));
    plan = fixed::show();
    plan.certificate = {};
    plan.limits.acceleration_mps2 = 6.0;
    EXPECT_THAT(px4_csv_format().unsuited(PlannedShow(plan)), HasSubstr("accelerations above 5.7 m/s²"));
    plan = fixed::show();
    plan.acts.back().duration_ms = 200'000'000;
    EXPECT_THAT(px4_csv_format().unsuited(PlannedShow(plan)), HasSubstr("about 1.2 GB of text"));
}

}  // namespace
}  // namespace aerogram::exporter
