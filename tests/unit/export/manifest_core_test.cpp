#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/bytes/files.hpp"
#include "export/bytes/sha256.hpp"
#include "export/manifest_json.hpp"
#include "export/outgoing/program.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/golden_bytes.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

Manifest example() {
    Manifest m;
    m.program = kProgramName;
    m.version = kProgramVersion;
    m.show_name = "Fixed \u00e9tude, \"manifest_sha256\": \"not here\"";
    m.show_hash = sha256_hex("show");
    m.certified = true;
    m.duration_s = 70.6;
    m.origin = {{35.6586, 139.7454, 40.1}, 20.0, 36.7};
    m.limits.min_separation_m = 0.1 + 0.2;  // has no short decimal form
    m.limits.ceiling_m = 90.0;
    m.endurance_s = 600.0;
    m.airspace = fixed::airspace();
    Rounding rounding{0.0005, 0.01, true, 0.02, false, 0.0, 0.0005};
    m.formats = {{"trajectories", "", {}}, {"csv", "", rounding}, {"skyc", "more than 5,000 drones", {}}};
    m.files = {{"trajectories.bin", "trajectories", 3'584, sha256_hex("a"), "exact", 1.0 / 3.0},
               {"qgc/drone-001.plan", "qgc", 12, sha256_hex("b"), "none: separation not claimed", std::nullopt},
               {"certificate.json", "certificate", 0, sha256_hex(""), std::nullopt, std::nullopt}};
    m.fleet = 2;
    m.drones = {{"drone-001", {0.0, -20.0, 0.0}}, {"drone-002", {2.5, -20.25, 1e-3}}};
    return m;
}

/// The text with the first `what` replaced and its own hash made to fit again.
std::string altered(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), by);
    const std::size_t digits = text.find("\"manifest_sha256\": \"") + 20;
    text.replace(digits, 64, std::string(64, '0'));
    return text.replace(digits, 64, sha256_hex(text));
}

std::string problem_of(const std::string& text) {
    const auto manifest = read_manifest(text);
    return manifest.ok() ? "none" : manifest.error().message;
}

TEST(Manifest, BytesAreGolden) {
    fixed::expect_golden("manifest.json", manifest_json(example()));
}

TEST(Manifest, ComesBackBitForBit) {
    const Manifest m = example();
    const auto read = read_manifest(manifest_json(m));
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->program, "aerogram");
    EXPECT_EQ(read->show_name, m.show_name);
    EXPECT_EQ(read->show_hash, m.show_hash);
    EXPECT_TRUE(read->certified);
    EXPECT_EQ(read->duration_s, 70.6);
    EXPECT_EQ(read->origin.ground.longitude_deg, 139.7454);
    EXPECT_EQ(read->origin.geoid_undulation_m, 36.7);
    EXPECT_EQ(read->limits.min_separation_m, 0.1 + 0.2);
    EXPECT_EQ(read->limits.ceiling_m, 90.0);
    EXPECT_EQ(read->airspace.geofence_m, m.airspace.geofence_m);
    EXPECT_EQ(read->airspace.audience_m, m.airspace.audience_m);
    EXPECT_EQ(std::get<geo::Prism>(read->airspace.obstacles[1].shape).outline_m,
              std::get<geo::Prism>(m.airspace.obstacles[1].shape).outline_m);
    EXPECT_EQ(std::get<geo::Cylinder>(read->airspace.obstacles[0].shape).center_m, Vec2(30.0, 10.0));
    ASSERT_EQ(read->formats.size(), 3U);
    EXPECT_EQ(read->formats[1].rounding.speed_allowance_mps, 0.02);
    EXPECT_FALSE(read->formats[1].rounding.has_acceleration);
    EXPECT_EQ(read->formats[2].skipped, "more than 5,000 drones");
    ASSERT_EQ(read->files.size(), 3U);
    EXPECT_EQ(read->files[0].min_separation_m, 1.0 / 3.0);
    EXPECT_EQ(read->files[1].timing, "none: separation not claimed");
    EXPECT_EQ(read->files[1].min_separation_m, std::nullopt);
    EXPECT_EQ(read->files[2].timing, std::nullopt);
    ASSERT_EQ(read->drones.size(), 2U);
    EXPECT_EQ(read->drones[1].pad_m, Vec3(2.5, -20.25, 1e-3));
    EXPECT_EQ(manifest_json(*read), manifest_json(m));
}

TEST(Manifest, ItsOwnHashCanBeCheckedByHand) {
    std::string text = manifest_json(example());
    const std::size_t digits = text.find("\"manifest_sha256\": \"") + 20;
    const std::string hash = text.substr(digits, 64);
    EXPECT_EQ(sha256_hex(text.replace(digits, 64, std::string(64, '0'))), hash);
}

TEST(Manifest, AnyChangedByteIsAnError) {
    const std::string text = manifest_json(example());
    for (std::size_t at = 0; at < text.size(); ++at) {
        std::string damaged = text;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        ASSERT_FALSE(read_manifest(damaged).ok()) << "byte " << at;
    }
    for (std::size_t size = 0; size < text.size(); ++size) {
        ASSERT_FALSE(read_manifest(std::string_view(text).substr(0, size)).ok()) << size;
    }
    EXPECT_THAT(problem_of(text + "\n"), HasSubstr("its own SHA-256 (manifest_sha256) does not fit"));
}

TEST(Manifest, TellsWhichFieldIsWrong) {
    const std::string text = manifest_json(example());
    EXPECT_EQ(problem_of("{}"), "manifest.json: manifest_sha256 is missing");
    EXPECT_EQ(problem_of(altered(text, "\"manifest_version\": 1", "\"manifest_version\": 2")),
              "manifest.json: manifest_version must be 1");
    EXPECT_EQ(problem_of(altered(text, "\"ceiling_m\"", "\"ceiling\"")), "manifest.json: limits.ceiling_m is missing");
    EXPECT_EQ(problem_of(altered(text, "\"downwash\": 1.0", "\"downwash\": 0.5")),
              "manifest.json: limits.downwash must be at least 1");
    EXPECT_EQ(problem_of(altered(text, "\"latitude_deg\": 35.6586", "\"latitude_deg\": 95")),
              "manifest.json: origin.latitude_deg is out of range");
    EXPECT_EQ(problem_of(altered(text, "\"certified\": true", "\"certified\": 1")),
              "manifest.json: certified must be true or false");
    EXPECT_EQ(problem_of(altered(text, "\"bytes\": 12", "\"bytes\": -12")),
              "manifest.json: files[2].bytes must be a whole number, not negative");
    EXPECT_EQ(problem_of(altered(text, "\"drone_count\": 2", "\"drone_count\": 3")),
              "manifest.json: drone_count is not the number of drones listed");
    EXPECT_EQ(problem_of(altered(text, "certificate.json", "trajectories.bin")),
              "manifest.json: files[3].path occurs twice");
    EXPECT_THAT(problem_of(altered(text, "\"drones\": [", "\"drones\": [[")), HasSubstr("parse error"));
}

TEST(Manifest, PathsStayInsideTheFolder) {
    const std::string text = manifest_json(example());
    for (const char* path : {"", "/etc/passwd", "../secret", "qgc/../../secret", "qgc//x", "./x", "qgc/"}) {
        EXPECT_EQ(problem_of(altered(text, "qgc/drone-001.plan", path)),
                  "manifest.json: files[2].path must stay inside the folder")
            << path;
    }
}

TEST(Manifest, VersionIsThatOfTheBuild) {
    const auto build = read_file(std::string(AEROGRAM_SOURCE_DIR) + "/CMakeLists.txt");
    ASSERT_TRUE(build.ok());
    EXPECT_THAT(*build, HasSubstr("project(aerogram VERSION " + std::string(kProgramVersion)));
}

}  // namespace
}  // namespace aerogram::exporter
