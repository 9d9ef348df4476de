#include "export/convert.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/exact/show_hash.hpp"
#include "export/formats.hpp"
#include "export/outgoing/read_show.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

RecordedShow recorded(std::string_view format) {
    const Format& f = *find_format(format);
    return read_back(f, written_files(f, fixed::show(), {show_hash(fixed::show()), true}));
}

std::unique_ptr<ReadShow> outgoing(std::string_view format) {
    return std::move(ReadShow::of(recorded(format), {}, aerogram::Run{})).value();
}

/// The fixed show on disk in one format.
std::filesystem::path on_disk(const ScratchFolder& folder, std::string_view format) {
    const auto files = written_files(*find_format(format), fixed::show(), {show_hash(fixed::show()), true});
    for (const FileBytes& file : files) EXPECT_TRUE(write_file(folder.path() / file.path, file.bytes).ok());
    return folder.path() / files.front().path;
}

std::string refusal(const Result<Converted>& converted) {
    return converted.ok() ? "none" : converted.error().message;
}

TEST(Deviation, Property1_IsNeverBelowADenseSampling) {
    const auto show = outgoing("trajectories");
    for (const char* const format : {"csv", "skyc", "vviz"}) {
        const RecordedShow read = recorded(format);
        const double bound_m = deviation(*show, read, aerogram::Run{}).value().position_m;
        double sampled_m = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Flight flight = show->flight(i);
            FlightCursor cursor(flight);
            for (double t_s = 0.0; t_s < 71.0; t_s += 0.003)
                sampled_m =
                    std::max(sampled_m, glm::length(cursor.position_at(t_s) - position_at(read.drones[i], t_s)));
        }
        EXPECT_GE(bound_m, sampled_m) << format;
        EXPECT_LE(bound_m, sampled_m + 1e-4) << format;
        EXPECT_LE(bound_m, stated_accuracy_m(*show, read)) << format;
    }
}

TEST(Deviation, Property2_TheSameFlightsGiveNothing) {
    for (const char* const format : {"trajectories", "csv", "skyc"})
        EXPECT_LE(deviation(*outgoing(format), recorded(format), aerogram::Run{}).value().position_m, 1e-9) << format;
}

TEST(Deviation, NamesTheDroneAndTheTime) {
    const auto show = outgoing("skyc");
    RecordedShow read = recorded("skyc");
    for (Vec3& control : read.drones[1].controls_m) control.x += control.z > 10.0 ? 0.5 : 0.0;
    const Deviation off = deviation(*show, read, aerogram::Run{}).value();
    EXPECT_EQ(off.drone, 1u);
    EXPECT_NEAR(off.position_m, 0.5, 1e-6);
    EXPECT_GT(off.time_s, 8.0);
}

TEST(Losses, TellOnlyWhatWasThere) {
    const auto show = outgoing("trajectories");
    const RecordedShow given = recorded("trajectories");
    const auto told = losses(*show, given, recorded("csv"), find_format("csv")->lost);
    EXPECT_THAT(told, Contains("yaw of 1 drone"));
    EXPECT_THAT(told, Contains("2 payload events"));
    EXPECT_THAT(told, Contains("2 cues"));
    EXPECT_THAT(told, Contains("show hash"));
    EXPECT_THAT(told, Contains("airspace (geofence, audience, obstacles)"));
    const auto from_csv = losses(*outgoing("csv"), recorded("csv"), recorded("csv"), find_format("csv")->lost);
    EXPECT_TRUE(from_csv.empty()) << ::testing::PrintToString(from_csv);
}

TEST(FormatFor, GoesByEndingOrName) {
    const auto name = [](const std::string& out, const std::string& format = "") {
        const auto found = format_for(out, format);
        return found ? std::string((*found)->name) : found.error().message;
    };
    EXPECT_EQ(name("a/show.skyc"), "skyc");
    EXPECT_EQ(name("x-csv.zip"), "csv");
    EXPECT_EQ(name("show.anything", "skyc"), "skyc");
    EXPECT_EQ(name("a/qgc/"), "qgc");
    EXPECT_THAT(name("show.unknown"), HasSubstr("add --format with one of: trajectories, csv, "));
    EXPECT_THAT(name("show.skyc", "nosuch"), HasSubstr("no format is named \"nosuch\""));
}

TEST(Convert, WritesWhatItReadAndKeepsTheSeal) {
    const ScratchFolder folder;
    const auto in = on_disk(folder, "trajectories");
    const auto out = folder.path() / "out.skyc";
    const auto converted = convert(in, out, {}, aerogram::Run{});
    ASSERT_TRUE(converted.ok()) << refusal(converted);
    EXPECT_TRUE(converted->certified);
    EXPECT_LE(converted->deviation->position_m, converted->stated_m);
    const auto read = open_show(out, aerogram::Run{});
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read->show.show_hash, show_hash(fixed::show()));
    EXPECT_EQ(read->show.drones[2].name, "drone-003");
    EXPECT_THAT(refusal(convert(in, out, {}, aerogram::Run{})), HasSubstr("is there already; --force replaces it"));
    ConvertOptions again;
    again.force = true;
    again.drones = {3};
    const auto part = convert(in, out, again, aerogram::Run{});
    ASSERT_TRUE(part.ok()) << refusal(part);
    EXPECT_EQ(open_show(out, aerogram::Run{})->show.drones.size(), 1u);
    EXPECT_THAT(part->lost, Contains("2 drones, as was asked"));
    std::size_t left = 0;  // nothing else stays behind
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++left;
    EXPECT_EQ(left, 2u);
}

TEST(Convert, RefusesWhatCannotBe) {
    const ScratchFolder folder;
    const auto in = on_disk(folder, "skyc");
    const auto bytes = read_file(in).value();
    EXPECT_THAT(refusal(convert(in, in, {}, aerogram::Run{})), HasSubstr("is what is converted"));
    EXPECT_THAT(refusal(convert(in, folder.path() / "x.bin", {}, aerogram::Run{})),
                HasSubstr("cannot become trajectories: "));
    EXPECT_THAT(refusal(convert(folder.path() / "none.skyc", folder.path() / "x.skyc", {}, aerogram::Run{})),
                HasSubstr("does not exist"));
    ConvertOptions options;
    options.drones = {7};
    EXPECT_THAT(refusal(convert(in, folder.path() / "x-csv.zip", options, aerogram::Run{})),
                HasSubstr("has no drone 7"));
    ASSERT_TRUE(write_file(folder.path() / "full/file", "x").ok());
    options = {};
    options.format = "skyb";
    EXPECT_THAT(refusal(convert(in, folder.path() / "full", options, aerogram::Run{})),
                HasSubstr("is a folder with files in it"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "x-csv.zip"));
    EXPECT_EQ(read_file(in).value(), bytes);
}

}  // namespace
}  // namespace aerogram::exporter
