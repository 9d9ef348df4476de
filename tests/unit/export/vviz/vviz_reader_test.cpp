#include "export/vviz/vviz_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "export/vviz/vviz.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Result<RecordedShow> read(const std::string& text) {
    return read_vviz(std::vector<FileBytes>{{"a.vviz", text}});
}
std::string error_of(const std::string& text) {
    const auto show = read(text);
    return show ? "none" : show.error().message;
}

const std::string kRates = R"({"version":"1.0","defaultPositionRate":2,"defaultColorRate":10,"performances":[)";
std::string drone(const std::string& samples, const std::string& payloads = "[]") {
    return R"({"id":0,"agentDescription":{"homeX":1,"homeY":0,"homeZ":-2,"agentTraversal":[)" + samples +
           R"(]},"payloadDescription":)" + payloads + "}";
}
std::string show_of(const std::string& performances) {
    return kRates + performances + "]}";
}

/// As Finale's and Verge's documents lay it out: no dt where the rate says it, heading steps, a pyro payload, comments
/// of no one; Z forward.
TEST(VvizReader, ReadsWhatOthersWrite) {
    const auto show = read(R"({
  "performances": [ { "payloadDescription": [
      { "eventTime": 3.5, "id": 1, "type": "Pyro", "vdl": "gerb", "partNumber": "" },
      { "payloadActions": [ {"r":255,"g":0,"b":0,"w":9}, {"b":0,"g":255,"r":0,"frames":10}, {"r":0,"g":255,"b":0,"frames":20},
                            {"r":0,"g":0,"b":0} ], "id": 0, "type": "Light", "lumens": 900.0 } ],
    "agentDescription": { "agentTraversal": [
        { "dx": 0.0, "dy": 0.0, "dz": 0.0, "dh": 0.0 },
        { "dt": 1.5, "dx": 3.0, "dy": 1e1, "dz": -4.0 },
        { "dz": 0, "dy": 0, "dx": 0 }, { "dx": 0, "dy": 0, "dz": 0, "dt": 2 }, { "dx": 0, "dy": 0, "dz": 0, "dt": 0 },
        { "dx": 0.0, "dy": -10, "dz": 0.0, "dt": 5.00 } ],
      "homeH": 90, "homeX": -7.5, "homeZ": -7.5, "homeY": 0.05, "airframe": "IOStar" }, "id": 7 } ],
  "timeOffsetSecs": 120.0, "defaultColorRate": 10.0, "defaultPositionRate": 2.0, "coordinateFrame": "ogl", "version": "1.0",
  "globalReferenceFrame": { "lat": 39.9, "lon": -75.1, "alt": 0.0 }, "performanceName": "VVIZ\u0054est", "events": [[], {}, null, true] } )");
    ASSERT_TRUE(show.ok()) << show.error().message;
    ASSERT_TRUE(well_formed(*show).ok());
    const RecordedDrone& d = show->drones[0];
    EXPECT_EQ(show->title, "VVIZTest");
    EXPECT_EQ(d.name, "drone-001");
    EXPECT_FALSE(show->origin);
    EXPECT_DOUBLE_EQ(show->duration_s, 9.5);  // the first sample takes 1 / rate
    EXPECT_EQ(*d.home_m, Vec3(-7.5, -7.5, 0.05));
    EXPECT_EQ(position_at(d, 0.5), Vec3(-7.5, -7.5, 0.05));
    EXPECT_LE(glm::length(position_at(d, 2.0) - Vec3(-4.5, -11.5, 10.05)), 1e-12);
    EXPECT_LE(glm::length(position_at(d, 4.5) - Vec3(-4.5, -11.5, 10.05)), 1e-12);
    EXPECT_LE(glm::length(position_at(d, 7.0) - Vec3(-4.5, -11.5, 5.05)), 1e-12);
    EXPECT_EQ(d.pieces.size(), 4u);  // what stands is one piece
    const auto& lights = d.tracks.lights;
    EXPECT_EQ(light_at(lights, 0.0), (Rgb{1, 0, 0}));
    EXPECT_EQ(light_at(lights, 0.5), (Rgb{0.5, 0.5, 0}));
    EXPECT_EQ(light_at(lights, 2.9), (Rgb{0, 1, 0}));
    EXPECT_NEAR(light_at(lights, 3.05).g, 0.5, 1e-9);
    EXPECT_EQ(light_at(lights, 9.0), (Rgb{0, 0, 0}));
    ASSERT_EQ(d.tracks.yaw.size(), 1u);
    EXPECT_DOUBLE_EQ(d.tracks.yaw[0].yaw_rad, -std::numbers::pi / 2.0);
    EXPECT_FALSE(show->rounding.has_acceleration);
}

TEST(VvizReader, ADroneWithoutSamplesStaysHome) {
    const auto show = read(show_of(drone("") + "," + drone(R"({"dx":1,"dy":2,"dz":3})")));
    ASSERT_TRUE(show.ok()) << show.error().message;
    EXPECT_TRUE(well_formed(*show).ok());
    EXPECT_EQ(position_at(show->drones[0], 9.0), Vec3(1, -2, 0));
    EXPECT_EQ(position_at(show->drones[1], 9.0), Vec3(2, 1, 2));
}

TEST(VvizReader, ErrorsNameFileDroneAndByte) {
    const std::string step = R"({"dx":0,"dy":1,"dz":0})";
    EXPECT_EQ(error_of(""), "a.vviz: byte 1: the text ends too early");
    EXPECT_EQ(error_of("[]"), "a.vviz: byte 1: must be an object");
    EXPECT_EQ(error_of("{}"), "a.vviz: holds no performances");
    EXPECT_EQ(error_of(show_of("")), "a.vviz: holds no performances");
    EXPECT_EQ(error_of(show_of(drone(""))), "a.vviz: no performance has a sample with a time");
    EXPECT_EQ(error_of(R"({"version":"2.0"})"), "a.vviz: byte 12: version must be \"1.0\"");
    EXPECT_EQ(error_of(R"({"coordinateFrame":"enu"})"), "a.vviz: byte 20: coordinateFrame must be \"ogl\"");
    EXPECT_EQ(error_of(show_of(drone(step)) + "x"),
              "a.vviz: byte " + std::to_string(show_of(drone(step)).size() + 1) + ": something follows after the end");
    EXPECT_THAT(error_of(show_of(drone(step) + "," + drone(R"({"dx":0,"dy":1})"))),
                AllOf(StartsWith("a.vviz: performance 2: byte "), HasSubstr("dz is missing")));
    EXPECT_THAT(error_of(show_of(drone(R"({"dx":0,"dy":1,"dz":"0"})"))), HasSubstr("must be a number from"));
    EXPECT_THAT(error_of(show_of(drone(R"({"dx":0,"dy":1e9,"dz":0})"))), HasSubstr("must be a number from"));
    EXPECT_THAT(error_of(show_of(drone(R"({"dx":0,"dy":1e999,"dz":0})"))), HasSubstr("must be a number from"));
    EXPECT_THAT(error_of(show_of(drone(R"({"dx":0,"dy":NaN,"dz":0})"))), HasSubstr("must be a number from"));
    EXPECT_THAT(error_of(show_of(drone(R"({"dx":0,"dx":1,"dy":1,"dz":0})"))), HasSubstr("dx appears twice"));
    EXPECT_THAT(error_of(show_of(drone(R"({"dx":0,"dy":1,"dz":0,"dt":-1})"))), HasSubstr("from 0 to 86400"));
    EXPECT_THAT(error_of(show_of(drone(R"({"dx":0,"dy":1,"dz":0,"dt":0})"))),
                HasSubstr("dt must be at least 0.001, or 0 where nothing moves"));
    EXPECT_THAT(error_of(show_of(drone(R"({"dx":2e6,"dy":1,"dz":0})"))), HasSubstr("farther than 1e6 m"));
    EXPECT_THAT(error_of(show_of(drone(R"({"dx":0,"dy":1,"dz":0,"dt":86400},)" + step))), HasSubstr("beyond 24 hours"));
    EXPECT_THAT(error_of(show_of("{}")), HasSubstr("performance 1: byte"));
    EXPECT_THAT(error_of(show_of("{}")), HasSubstr("agentDescription is missing"));
    EXPECT_THAT(error_of(R"({"performances":[)" + drone(step) + "]}"),
                HasSubstr("a sample has no dt, and defaultPositionRate is missing"));
    EXPECT_THAT(error_of(show_of(drone(step, R"([{"type":"Light","payloadActions":[{"r":256,"g":0,"b":0}]}])"))),
                HasSubstr("must be a number from 0 to 255"));
    EXPECT_THAT(error_of(R"({"aerogram":{"flavour":"up"},)" + show_of(drone(step)).substr(1)),
                HasSubstr("a.vviz: aerogram: flavour: must be \"verge\" or \"finale\""));
    EXPECT_THAT(error_of(R"({"version":"1.0","version":"1.0"})"), HasSubstr("a key appears twice"));
    EXPECT_THAT(error_of(R"({"x":)" + std::string(100'000, '[') + "}"), HasSubstr("nested too deep"));
}

TEST(VvizReader, DamagedFilesAreRefusedOrSound) {
    const std::string text = written_files(vviz_format(), fixed::show())[0].bytes;
    std::size_t refused = 0;
    for_damaged(text, 3'000, [&](const std::string& damaged) {
        const auto show = read(damaged);
        refused += show.ok() ? 0u : 1u;
        if (show) {
            ASSERT_TRUE(well_formed(*show).ok());
        } else {
            ASSERT_THAT(show.error().message, StartsWith("a.vviz: "));
        }
    });
    EXPECT_GT(refused, 1'000u);
}

}  // namespace
}  // namespace aerogram::exporter
