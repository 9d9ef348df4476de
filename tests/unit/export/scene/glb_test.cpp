#include "export/scene/glb.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "export/bytes/little_endian.hpp"
#include "export/verify/judge.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

/// A GLB file of this JSON and these bytes.
std::string glb(std::string json, const std::string& bin) {
    json.append((4 - json.size() % 4) % 4, ' ');
    std::string file = "glTF";
    put(file, std::uint32_t{2});
    put(file, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + bin.size()));
    put(file, static_cast<std::uint32_t>(json.size()));
    file += "JSON" + json;
    put(file, static_cast<std::uint32_t>(bin.size()));
    file += std::string("BIN\0", 4) + bin;
    return file;
}

std::string floats(const std::vector<float>& values) {
    std::string bytes;
    for (const float value : values) put(bytes, value);
    return bytes;
}

/// One node "cube" under the given nodes (JSON, each followed by a comma), moved by two keys at 0 s and 2 s.
std::string foreign_json(const std::string& parents, std::size_t node, const std::string& interpolation,
                         std::size_t values) {
    return R"({"asset":{"version":"2.0"},"nodes":[)" + parents +
           R"({"name":"cube","mesh":0}],"meshes":[{"primitives":[{"attributes":{},"material":0}]}],
"materials":[{"emissiveFactor":[0.5,0.25,1]}],"buffers":[{"byteLength":)" +
           std::to_string(8 + 12 * values) + R"(}],"bufferViews":[{"buffer":0,"byteLength":)" +
           std::to_string(8 + 12 * values) +
           R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR"},
{"bufferView":0,"byteOffset":8,"componentType":5126,"count":)" +
           std::to_string(values) + R"(,"type":"VEC3"}],"animations":[{"channels":[{"sampler":0,"target":{"node":)" +
           std::to_string(node) + R"(,"path":"translation"}}],"samplers":[{"input":0,"output":1,"interpolation":")" +
           interpolation + R"("}]}]})";
}

Result<RecordedShow> read(const std::string& bytes) {
    return glb_format().read(std::vector<FileBytes>{{"a.glb", bytes}});
}
std::string error_of(const std::string& bytes) {
    const auto show = read(bytes);
    return show ? "none" : show.error().message;
}

const std::vector<float> kTwoKeys{0, 2, 1, 2, 3, 5, 6, 7};

TEST(Glb, WritesTheseBytes) {
    const auto files = written_files(glb_format(), fixed::show());
    ASSERT_EQ(files.size(), 1U);
    EXPECT_EQ(files[0].path, "show.glb");
    EXPECT_TRUE(glb_format().recognises("anything", files[0].bytes));
    expect_golden("show.glb", files[0].bytes);
}

TEST(Glb, ReadsBackWithinTheStatedRounding) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(glb_format(), written_files(glb_format(), plan));
    ASSERT_EQ(show.drones.size(), 3U);
    ASSERT_TRUE(well_formed(show).ok()) << well_formed(show).error().message;
    EXPECT_NEAR(show.duration_s, seconds_from_ms(plan.duration_ms()), show.rounding.time_s);
    EXPECT_LT(show.rounding.position_m, 1e-4);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(show.drones[i].name, "drone-00" + std::to_string(i + 1));
        for (Millis t = 0; t <= plan.duration_ms(); t += 7) {
            const double t_s = seconds_from_ms(t);
            const Vec3 exact = planner::sample(plan, DroneId(i), t_s).motion.position_m;
            const double allowed =
                show.rounding.fit_m + std::sqrt(3.0) * show.rounding.position_m + 6.0 * show.rounding.time_s;
            ASSERT_LE(glm::length(position_at(show.drones[i], t_s) - exact), allowed) << i << " at " << t;
        }
    }
}

TEST(Glb, BringsBackWhatTheShowSaysOfItself) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(glb_format(), written_files(glb_format(), plan, test_seal(false)));
    EXPECT_EQ(show.title, plan.name);
    EXPECT_EQ(show.show_hash, test_seal().show_hash);
    EXPECT_EQ(show.certified, false);
    ASSERT_TRUE(show.origin && show.limits && show.airspace);
    EXPECT_EQ(show.origin->ground.latitude_deg, plan.origin.ground.latitude_deg);
    EXPECT_EQ(show.origin->heading_deg, plan.origin.heading_deg);
    EXPECT_EQ(show.origin->geoid_undulation_m, plan.origin.geoid_undulation_m);
    EXPECT_EQ(show.limits->jerk_mps3, plan.limits.jerk_mps3);
    EXPECT_EQ(show.airspace->geofence_m, plan.airspace.geofence_m);
    EXPECT_EQ(show.airspace->audience_m, plan.airspace.audience_m);
    ASSERT_EQ(show.airspace->obstacles.size(), 2U);
    EXPECT_EQ(show.airspace->obstacles[0].name, "mast");
    EXPECT_EQ(show.endurance_s, 600.0);
    EXPECT_EQ(show.cues, plan.cues);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(show.drones[i].home_m, plan.pads_m[i]);
        EXPECT_EQ(show.drones[i].tracks.yaw, plan.tracks[i].yaw);
        EXPECT_EQ(show.drones[i].tracks.events, plan.tracks[i].events);
        for (Millis t = 0; t <= plan.duration_ms(); t += 20) {
            const double t_s = seconds_from_ms(t);
            const Rgb a = light_at(plan.tracks[i].lights, t_s), b = light_at(show.drones[i].tracks.lights, t_s);
            ASSERT_LE(std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}), 0.51 / 255.0) << t;
        }
    }
}

/// X right, Y up, Z towards the audience, read from the bytes by hand: the second drone's first key is its pad.
TEST(Glb, AxesAreRightUpAndTowardsTheAudience) {
    const std::string bytes = written_files(glb_format(), fixed::show())[0].bytes;
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, bytes.data() + 12, 4);
    const std::string json = bytes.substr(20, json_bytes);
    const auto number_after = [&](const std::string& key, std::size_t from) {
        return std::stoul(json.substr(json.find(key, from) + key.size()));
    };
    const std::size_t view = json.find("\"key values\"");
    const std::size_t start = 28 + json_bytes + number_after("\"byteOffset\":", view);
    const std::size_t last_accessor = json.rfind("\"VEC3\"", json.find("\"bufferViews\":["));
    const std::size_t second_accessor = json.rfind("\"VEC3\"", last_accessor - 1);
    const std::size_t offset = number_after("\"byteOffset\":", json.rfind("{", second_accessor));
    float place[3];
    std::memcpy(place, bytes.data() + start + offset + 12, 12);
    const Vec3 pad = fixed::pads()[1];
    EXPECT_EQ(place[0], static_cast<float>(pad.x));
    EXPECT_EQ(place[1], static_cast<float>(pad.z));
    EXPECT_EQ(place[2], static_cast<float>(-pad.y));
}

TEST(Glb, ItsOwnJudgeFindsNothingWrong) {
    const RecordedShow show = read_back(glb_format(), written_files(glb_format(), fixed::show()));
    const auto judgement = judge(show, {}, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    EXPECT_TRUE(judgement->held());
    for (const Finding& finding : judgement->findings)
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
}

TEST(Glb, DronesWithTheSameTimesShareThem) {
    planner::FlightPlan plan = fixed::show();
    plan.acts = {{"fly", planner::ActRole::transit, planner::Timing::free, 0, 8'000,
                  planner::Straight{fixed::pads(), fixed::above_pads(), fixed::profile(11)}}};
    plan.keyframes.clear();
    const std::string bytes = written_files(glb_format(), plan)[0].bytes;
    std::size_t scalars = 0;
    for (std::size_t at = bytes.find("\"SCALAR\""); at != std::string::npos; at = bytes.find("\"SCALAR\"", at + 1))
        ++scalars;
    EXPECT_EQ(scalars, 2U);  // triangles and one of times
}

TEST(Glb, ReadsLinearAndStepKeysAndMaterials) {
    const auto linear = read(glb(foreign_json("", 0, "LINEAR", 2), floats(kTwoKeys)));
    ASSERT_TRUE(linear.ok()) << linear.error().message;
    ASSERT_EQ(linear->drones.size(), 1U);
    EXPECT_EQ(linear->drones[0].name, "cube");
    EXPECT_EQ(position_at(linear->drones[0], 1.0), Vec3(3.0, -5.0, 4.0));
    EXPECT_FALSE(linear->rounding.has_acceleration);
    EXPECT_TRUE(linear->rounding.has_speed);
    EXPECT_EQ(light_at(linear->drones[0].tracks.lights, 1.0), (Rgb{0.5, 0.25, 1.0}));
    EXPECT_FALSE(linear->certified);
    const auto step = read(glb(foreign_json("", 0, "STEP", 2), floats(kTwoKeys)));
    ASSERT_TRUE(step.ok()) << step.error().message;
    EXPECT_EQ(position_at(step->drones[0], 1.9), Vec3(1.0, -3.0, 2.0));
    EXPECT_EQ(last_position(step->drones[0]), Vec3(5.0, -7.0, 6.0));
    EXPECT_FALSE(step->rounding.has_speed);
}

/// Hermite by its closed form, tangents in m/s.
TEST(Glb, ReadsCubicKeysAsTheFormatDefinesThem) {
    const std::vector<float> values{0, 2, 9, 9, 9, 1, 2, 3, 1, -1, 0.5F, 0, 2, -1, 5, 6, 7, 9, 9, 9};
    const auto show = read(glb(foreign_json("", 0, "CUBICSPLINE", 6), floats(values)));
    ASSERT_TRUE(show.ok()) << show.error().message;
    const double t = 0.3, t2 = t * t, t3 = t2 * t, d = 2.0;
    const Vec3 p = (2 * t3 - 3 * t2 + 1) * Vec3(1, 2, 3) + d * (t3 - 2 * t2 + t) * Vec3(1, -1, 0.5) +
                   (3 * t2 - 2 * t3) * Vec3(5, 6, 7) + d * (t3 - t2) * Vec3(0, 2, -1);
    EXPECT_LT(glm::length(position_at(show->drones[0], t * d) - Vec3(p.x, -p.z, p.y)), 1e-12);
}

/// A parent turned 90 degrees about Y (X to -Z), twice as large, 10 m up; its own parent a matrix that shifts X by 100.
TEST(Glb, ParentsThatStandAreApplied) {
    const std::string parents =
        R"({"children":[1],"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,100,0,0,1]},)"
        R"({"children":[2],"translation":[0,10,0],"rotation":[0,0.7071067811865476,0,0.7071067811865476],"scale":[2,2,2]},)";
    const auto show = read(glb(foreign_json(parents, 2, "LINEAR", 2), floats(kTwoKeys)));
    ASSERT_TRUE(show.ok()) << show.error().message;
    // (1, 2, 3) -> scaled (2, 4, 6) -> turned (6, 4, -2) -> (106, 14, -2) -> show (106, 2, 14)
    EXPECT_LT(glm::length(first_position(show->drones[0]) - Vec3(106.0, 2.0, 14.0)), 1e-12);
}

TEST(Glb, ErrorsNameFileAndPlace) {
    const std::string sound = glb(foreign_json("", 0, "LINEAR", 2), floats(kTwoKeys));
    EXPECT_EQ(error_of("PK"), "a.glb: byte 0: cut short");
    EXPECT_EQ(error_of("not a glb file"), "a.glb: byte 0: must be glTF: this is no GLB file");
    EXPECT_EQ(error_of(sound.substr(0, 40)), "a.glb: byte 8: the length is not the file's");
    EXPECT_EQ(error_of(glb("{", "")), "a.glb: byte 5: is not JSON");
    EXPECT_EQ(error_of(glb(R"({"asset":{},"nodes":[]})", "")), "a.glb: no animation moves a node");
    EXPECT_THAT(error_of(glb(foreign_json("", 0, "LINEAR", 3), floats({0, 2, 1, 2, 3, 5, 6, 7, 8, 9, 9}))),
                HasSubstr("a.glb: animations[0].samplers[0]: has 3 values for 2 keys"));
    EXPECT_THAT(error_of(glb(foreign_json("", 0, "LINEAR", 2), floats({0, 2, 1, 2}))),
                HasSubstr("bufferViews[0]: reaches beyond the binary chunk"));
    EXPECT_THAT(error_of(glb(foreign_json("", 0, "LINEAR", 2), floats({2, 0, 1, 2, 3, 5, 6, 7}))),
                HasSubstr("key 1: times must rise"));
    EXPECT_THAT(error_of(glb(foreign_json("", 0, "LINEAR", 2), floats({0, 2, 1, NAN, 3, 5, 6, 7}))),
                HasSubstr("value 1: must be finite"));
    EXPECT_THAT(error_of(glb(foreign_json("", 0, "SPLINE", 2), floats(kTwoKeys))),
                HasSubstr("must be LINEAR, STEP or"));
    EXPECT_THAT(error_of(glb(foreign_json("", 7, "LINEAR", 2), floats(kTwoKeys))), HasSubstr("target.node"));
    EXPECT_THAT(
        error_of(glb(foreign_json(R"({"children":[1]},{"children":[0,2]},)", 2, "LINEAR", 2), floats(kTwoKeys))),
        HasSubstr("in a circle"));
    EXPECT_THAT(error_of(glb(foreign_json(R"({"children":[2]},{"children":[2]},)", 2, "LINEAR", 2), floats(kTwoKeys))),
                HasSubstr("has two parents"));
}

TEST(Glb, DamagedInputIsRefusedNotCrashedOn) {
    const std::string bytes = written_files(glb_format(), fixed::show())[0].bytes;
    std::size_t tried = 0, refused = 0;
    for_damaged(bytes, 600, [&](const std::string& damaged) {
        ++tried;
        const auto show = read(damaged);
        if (!show) {
            ++refused;
            EXPECT_THAT(show.error().message, HasSubstr("a.glb: "));
        } else {
            EXPECT_TRUE(well_formed(*show).ok()) << well_formed(*show).error().message;
        }
    });
    EXPECT_GE(tried, 900U);
    EXPECT_GE(refused, 400U);
}

/// A small file must not make large memory: 2,000 channels all name the same keys.
TEST(Glb, SharedKeysDoNotMultiply) {
    const std::size_t keys = 20'000, drones = 2'000;
    std::vector<float> values(keys + 3 * keys, 0.0F);
    for (std::size_t k = 0; k < keys; ++k) values[k] = static_cast<float>(k);
    std::string nodes, channels;
    for (std::size_t n = 0; n < drones; ++n) {
        nodes += (n > 0 ? ",{}" : "{}");
        channels += (n > 0 ? "," : "") + std::string(R"({"sampler":0,"target":{"path":"translation","node":)") +
                    std::to_string(n) + "}}";
    }
    const std::string size = std::to_string(values.size() * 4);
    const std::string json =
        R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + R"(],"buffers":[{"byteLength":)" + size +
        R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + size +
        R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":20000,"type":"SCALAR"},{"bufferView":0,"byteOffset":80000,"componentType":5126,"count":20000,"type":"VEC3"}],"animations":[{"channels":[)" +
        channels + R"(],"samplers":[{"input":0,"output":1}]}]})";
    EXPECT_THAT(error_of(glb(json, floats(values))), HasSubstr("more keys than the file has room for"));
}

TEST(Glb, SaysWhyAShowDoesNotFit) {
    planner::FlightPlan plan = fixed::show();
    plan.limits.export_margin_m = 0.001;
    EXPECT_THAT(glb_format().unsuited(PlannedShow(plan)), HasSubstr("export_margin_m leaves no room"));
    EXPECT_EQ(glb_format().unsuited(PlannedShow(fixed::show())), "");
}

}  // namespace
}  // namespace aerogram::exporter
