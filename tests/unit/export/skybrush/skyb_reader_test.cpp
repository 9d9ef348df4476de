#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "export/bytes/little_endian.hpp"
#include "export/skybrush/skyb.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/skybrush/skyb_decoder.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

std::string words(std::initializer_list<int> values) {
    std::string out;
    for (const int value : values) put(out, static_cast<std::int16_t>(value));
    return out;
}
std::string bytes(std::initializer_list<int> values) {
    std::string out;
    for (const int value : values) out += static_cast<char>(value);
    return out;
}
std::string block(int type, const std::string& body) {
    return bytes({type}) + words({static_cast<int>(body.size())}) + body;
}
/// A segment: format, milliseconds, values.
std::string segment(int format, int ms, std::initializer_list<int> values) {
    return bytes({format}) + words({ms}) + words(values);
}
/// Scale 10, from (1, 2, 0) m.
std::string path(const std::string& segments) {
    return block(1, bytes({10}) + words({100, 200, 0, 0}) + segments);
}
std::string version_1(const std::string& blocks) {
    return "skyb\x01" + blocks;
}
std::string version_2(const std::string& blocks) {
    std::string file = std::string("skyb\x02\x01", 6) + std::string(4, '\0') + blocks, crc;
    put(crc, decoder::slow_crc(file));
    return file.replace(6, 4, crc);
}

Result<RecordedShow> read(const std::string& file) {
    return read_skyb(std::vector<FileBytes>{{"skyb/Ann.skyb", file}});
}
std::string error_of(const std::string& file) {
    const auto show = read(file);
    return show ? "none" : show.error().message;
}

TEST(SkybReader, ReadsTheSmallestForeignFileWithItsAxes) {
    const auto show = read(version_1(path(segment(0x10, 4000, {500}))));
    ASSERT_TRUE(show.ok()) << show.error().message;
    const RecordedDrone& drone = show->drones.at(0);
    EXPECT_EQ(drone.name, "Ann");
    EXPECT_EQ(first_position(drone), Vec3(-2.0, 1.0, 0.0));  // Y left is our -x, X front our +y
    EXPECT_EQ(position_at(drone, 2.0), Vec3(-2.0, 1.0, 2.5));
    EXPECT_EQ(drone.home_m, first_position(drone));
    EXPECT_EQ(show->duration_s, 4.0);
    EXPECT_EQ(show->rounding.position_m, 0.005);
    EXPECT_FALSE(show->rounding.has_acceleration);  // it starts at 1.25 m/s
    EXPECT_FALSE(show->certified || show->show_hash || show->limits || show->origin);
    EXPECT_TRUE(well_formed(*show).ok());
}

/// Axes of degree 0, 1, 3 and 7 side by side, against Bernstein's formula in the test's decoder.
TEST(SkybReader, ReadsEveryDegree) {
    const std::string file =
        version_2(path(segment(0x1B, 3000, {1, 50, -70, 90, 400, 4, 300, 210, 150, 260, 700}) +
                       segment(0x26, 60'000, {12, 700, 650, 900, 100, 200, 300}) + segment(0x00, 65'535, {})));
    const auto show = read(file);
    ASSERT_TRUE(show.ok()) << show.error().message;
    const decoder::File expected = decoder::decoded(file);
    ASSERT_EQ(show->drones[0].pieces.size(), 3U);
    EXPECT_EQ(show->drones[0].pieces[0].degree, 7);
    for (double t = 0.0; t < 70.0; t += 0.37) {
        const auto p = expected.position_m(t);
        ASSERT_LE(glm::length(position_at(show->drones[0], t) - Vec3(-p[1], p[0], p[2])), 1e-9) << t;
    }
    EXPECT_TRUE(well_formed(*show).ok());
}

TEST(SkybReader, SkipsWhatItDoesNotKnowAndTakesTheFirstOfEachKind) {
    const std::string lights = block(2, bytes({0x07, 50, 0x06, 1, 0}));
    const auto show = read(
        version_2(block(4, "whatever") + block(77, "") + path(segment(0x10, 4000, {500})) +
                  path(segment(0x10, 9000, {900})) + block(3, "made by hand") + lights +
                  block(6, bytes({0x10, 0x27, 0, 0, 1, 3, 0, 0, 0, 0}) + bytes({0x11, 0x27, 0, 0, 9, 3, 0, 0, 0, 0}) +
                               bytes({0x20, 0x27, 0, 0, 1, 3, 255, 255, 255, 255})) +
                  bytes({0}) + "padding"));
    ASSERT_TRUE(show.ok()) << show.error().message;
    EXPECT_EQ(show->duration_s, 4.0);
    EXPECT_EQ(light_at(show->drones[0].tracks.lights, 0.5), (Rgb{1.0, 1.0, 1.0}));
    EXPECT_EQ(show->drones[0].tracks.events, (std::vector<PayloadEvent>{{10'000, 3, true}, {10'016, 3, false}}));
}

TEST(SkybReader, TakesYawFromItsBlockOrFromTheTrajectory) {
    const std::string turning = block(1, bytes({0x80 | 10}) + words({0, 0, 0, 900}) + segment(0x50, 4000, {500, 1800}));
    const auto inside = read(version_1(turning));
    ASSERT_TRUE(inside.ok()) << inside.error().message;
    EXPECT_NEAR(yaw_at(inside->drones[0].tracks.yaw, 2.0), -radians(135.0), 1e-12);
    const std::string yaw = block(5, bytes({0}) + words({100, 1000, 100, 0, -300}));
    const auto own = read(version_1(turning + yaw));
    ASSERT_TRUE(own.ok()) << own.error().message;
    EXPECT_NEAR(yaw_at(own->drones[0].tracks.yaw, 0.5), -radians(15.0), 1e-12);
    EXPECT_NEAR(yaw_at(own->drones[0].tracks.yaw, 3.0), radians(10.0), 1e-12);
    const auto automatic = read(version_1(path(segment(0x10, 10, {5})) + block(5, bytes({1}) + words({100}))));
    ASSERT_TRUE(automatic.ok());
    EXPECT_TRUE(automatic->drones[0].tracks.yaw.empty());
}

/// A jump without duration is a jump; standing only is a show of standing.
TEST(SkybReader, KeepsJumpsAndEmptyPaths) {
    const auto jump =
        read(version_1(path(segment(0x10, 1000, {100}) + segment(0x01, 0, {150}) + segment(0x10, 1000, {0}))));
    ASSERT_TRUE(jump.ok()) << jump.error().message;
    EXPECT_EQ(position_at(jump->drones[0], 0.999).y, 1.0);
    EXPECT_EQ(position_at(jump->drones[0], 1.5), Vec3(-2.0, 1.5, 0.5));
    const auto stands = read(version_1(path("")));
    ASSERT_TRUE(stands.ok());
    EXPECT_EQ(position_at(stands->drones[0], 0.7), Vec3(-2.0, 1.0, 0.0));
}

/// Corners of straight lines have no accelerations; smooth joints of straight pieces have.
TEST(SkybReader, TellsCornersFromSmoothCurves) {
    const auto smooth = read(version_1(
        path(segment(0x20, 1000, {0, 0, 33}) + segment(0x10, 1000, {133}) + segment(0x20, 1000, {166, 166, 166}))));
    ASSERT_TRUE(smooth.ok());
    EXPECT_TRUE(smooth->rounding.has_acceleration);
    const auto corner = read(version_1(path(segment(0x10, 1000, {100}) + segment(0x10, 1000, {0}))));
    ASSERT_TRUE(corner.ok());
    EXPECT_FALSE(corner->rounding.has_acceleration);
}

TEST(SkybReader, ErrorsNameFileAndByte) {
    const std::string sound = path(segment(0x10, 4000, {500}));
    EXPECT_EQ(error_of(""), "skyb/Ann.skyb: byte 0: cut short");
    EXPECT_EQ(error_of("skyc\x01"), "skyb/Ann.skyb: byte 0: does not begin with \"skyb\"");
    EXPECT_EQ(error_of("skyb\x03"), "skyb/Ann.skyb: byte 4: version 3 is not known");
    EXPECT_EQ(error_of("skyb\x02\x06"), "skyb/Ann.skyb: byte 5: feature bits 6 are not known");
    EXPECT_EQ(error_of("skyb\x02\x01zz"), "skyb/Ann.skyb: byte 6: cut short");
    EXPECT_EQ(error_of("skyb\x02\x01zzzz" + sound), "skyb/Ann.skyb: byte 6: the checksum is not that of the file");
    EXPECT_EQ(error_of("skyb\x01"), "skyb/Ann.skyb: byte 5: holds no trajectory");
    EXPECT_EQ(error_of(version_1(bytes({1, 9, 0, 10}))), "skyb/Ann.skyb: byte 8: cut short");
    EXPECT_EQ(error_of(version_1(block(1, bytes({0}) + words({0, 0, 0, 0})))),
              "skyb/Ann.skyb: byte 8: an empty trajectory: its scale is 0");
    EXPECT_EQ(error_of(version_1(path(segment(0x10, 4000, {500}) + "x"))), "skyb/Ann.skyb: byte 23: cut short");
    EXPECT_EQ(error_of(version_1(sound + block(2, "\x13"))),
              "skyb/Ann.skyb: light program, byte 0: instruction 19 is not known");
    EXPECT_THAT(error_of(version_1(sound + block(5, "12"))), HasSubstr("byte 26: cut short"));
    EXPECT_THAT(error_of(version_1(sound + block(6, "123456789"))), HasSubstr("cut short"));
    EXPECT_EQ(error_of(version_1(sound + block(3, "aerogram 1\nhome 1 2 x\n"))),
              "skyb/Ann.skyb: comment: home \"1 2 x\": must be 3 numbers");
    EXPECT_THAT(error_of(version_1(sound + block(3, "aerogram 1\nshow abc\n"))), HasSubstr("64 lower-case hex digits"));
    EXPECT_THAT(error_of(version_1(sound + block(3, "aerogram 1\norigin 91 0 0 0\n"))), HasSubstr("comment: origin"));
    EXPECT_THAT(error_of(version_1(sound + block(3, "aerogram 1\nlimits 1 2\n"))), HasSubstr("comment: limits"));
}

TEST(SkybReader, AllFilesMustBeOfOneShow) {
    auto files = written_files(skyb_format(), fixed::show());
    planner::FlightPlan turned = fixed::show();
    turned.origin.heading_deg += 7.0;
    files[2] = written_files(skyb_format(), turned)[2];
    const auto mixed = read_skyb(files);
    ASSERT_FALSE(mixed.ok());
    EXPECT_EQ(mixed.error().message, "skyb/drone-003.skyb: is of another show than skyb/drone-001.skyb");
    files.pop_back();
    EXPECT_EQ(read_skyb(files)->drones.size(), 2U);
}

/// With the checksum in place one byte anywhere is found; without it what is read is sound.
TEST(SkybReader, DamagedFilesAreRefusedNotCrashedOn) {
    const std::string file = written_files(skyb_format(), fixed::show())[1].bytes;
    for_damaged(file, 2'000, [&](const std::string& damaged) {
        if (damaged != file) {
            ASSERT_FALSE(read(damaged).ok());
        }
    });
    std::size_t read_well = 0;
    for_damaged("skyb\x01" + file.substr(10), 3'000, [&](const std::string& damaged) {
        const auto show = read(damaged);
        if (!show) {
            EXPECT_THAT(show.error().message, HasSubstr("skyb/Ann.skyb: "));
            return;
        }
        EXPECT_TRUE(well_formed(*show).ok());
        ++read_well;
    });
    EXPECT_GT(read_well, 100U);
}

}  // namespace
}  // namespace aerogram::exporter
