#include "export/skybrush/skyc.hpp"
#include "export/outgoing/planned_show.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "export/outgoing/curve_fit.hpp"
#include "export/verify/judge.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string entry(const std::vector<FileBytes>& files, const std::string& path) {
    const auto entries = unzip_bytes(files.at(0).bytes);
    for (const FileBytes& e : entries.value())
        if (e.path == path) return e.bytes;
    ADD_FAILURE() << "no entry " << path;
    return {};
}

TEST(Skyc, WritesTheseBytes) {
    expect_golden("show.skyc.txt", unpacked_text(written_files(skyc_format(), fixed::show())));
}

TEST(Skyc, IsRecognisedByItsFirstEntry) {
    const auto files = written_files(skyc_format(), fixed::show());
    ASSERT_EQ(files.size(), 1u);
    EXPECT_EQ(files[0].path, "show.skyc");
    EXPECT_TRUE(skyc_format().recognises("x.zip", files[0].bytes));
    EXPECT_TRUE(skyc_format().recognises("x.skyc", files[0].bytes.substr(0, 64)));
    EXPECT_FALSE(skyc_format().recognises("x.skyc", "QGC WPL 110"));
}

/// The asymmetric show catches swapped and mirrored axes.
TEST(Skyc, ReadsBackWithinTheStatedRounding) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(skyc_format(), written_files(skyc_format(), plan));
    ASSERT_EQ(show.drones.size(), 3u);
    ASSERT_TRUE(well_formed(show).ok());
    EXPECT_DOUBLE_EQ(show.duration_s, seconds_from_ms(plan.duration_ms()));
    const Rounding& r = show.rounding;
    EXPECT_LE(r.acceleration_allowance_mps2, 0.25 * plan.limits.acceleration_mps2 + 0.084);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE(glm::length(*show.drones[i].home_m - plan.pads_m[i]), std::sqrt(3.0) * r.position_m);
        EXPECT_LE(glm::length(*show.drones[i].land_m - plan.pads_m[i]), std::sqrt(3.0) * r.position_m);
        for (Millis t = 0; t <= plan.duration_ms(); t += 7) {
            const double t_s = seconds_from_ms(t);
            const planner::DroneState exact = planner::sample(plan, DroneId(i), t_s);
            const Vec3 miss = position_at(show.drones[i], t_s) - exact.motion.position_m;
            ASSERT_LE(glm::length(miss), r.fit_m + std::sqrt(3.0) * r.position_m) << "drone " << i << " at " << t;
            const Vec3 speed_miss = velocity_at(show.drones[i], t_s) - exact.motion.velocity_mps;
            if (t < plan.duration_ms()) {
                ASSERT_LE(glm::length(speed_miss), r.speed_allowance_mps) << i << " at " << t;
            }
        }
    }
}

TEST(Skyc, CarriesTracksCuesOriginLimitsAndClaims) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(skyc_format(), written_files(skyc_format(), plan));
    EXPECT_EQ(show.title, plan.name);
    EXPECT_EQ(show.show_hash, test_seal().show_hash);
    EXPECT_EQ(show.certified, true);
    EXPECT_EQ(show.cues, plan.cues);
    ASSERT_TRUE(show.origin);
    EXPECT_NEAR(show.origin->ground.latitude_deg, plan.origin.ground.latitude_deg, 0.5e-7);
    EXPECT_NEAR(show.origin->ground.longitude_deg, plan.origin.ground.longitude_deg, 0.5e-7);
    EXPECT_NEAR(show.origin->ground.height_m, plan.origin.ground.height_m, 0.0005);
    EXPECT_EQ(show.origin->heading_deg, plan.origin.heading_deg);
    ASSERT_TRUE(show.limits);
    EXPECT_EQ(show.limits->min_separation_m, plan.limits.min_separation_m);
    EXPECT_EQ(show.limits->speed_up_mps, plan.limits.speed_up_mps);
    EXPECT_EQ(show.limits->speed_down_mps, plan.limits.speed_down_mps);
    EXPECT_EQ(show.limits->jerk_mps3, plan.limits.jerk_mps3);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(show.drones[i].name, "drone-00" + std::to_string(i + 1));
        for (Millis t = 0; t < plan.duration_ms(); t += 10) {
            const Rgb a = light_at(show.drones[i].tracks.lights, seconds_from_ms(t));
            const Rgb b = light_at(plan.tracks[i].lights, seconds_from_ms(t));
            ASSERT_NEAR(a.r, b.r, 1.0 / 255.0) << i << " at " << t;
            ASSERT_NEAR(a.g, b.g, 1.0 / 255.0) << i << " at " << t;
            ASSERT_NEAR(a.b, b.b, 1.0 / 255.0) << i << " at " << t;
        }
    }
    ASSERT_EQ(show.drones[1].tracks.yaw.size(), 3u);
    EXPECT_NEAR(show.drones[1].tracks.yaw[1].yaw_rad, 1.5, radians(0.0005));
    EXPECT_EQ(show.drones[2].tracks.events, (std::vector<PayloadEvent>{{27'500, 2, true}}));  // "off" would fire
}

TEST(Skyc, ItsOwnJudgeFindsNothingWrong) {
    const RecordedShow show = read_back(skyc_format(), written_files(skyc_format(), fixed::show()));
    const auto judgement = judge(show, {}, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    EXPECT_TRUE(judgement->problems.empty());
    for (const Finding& finding : judgement->findings)
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
}

TEST(Skyc, YawTurnsClockwiseFromTheFront) {
    EXPECT_THAT(entry(written_files(skyc_format(), fixed::show()), "show.json"),
                HasSubstr(R"("setpoints":[[8.0,0.0],[24.0,-85.944],[36.6,42.972]])"));
}

TEST(Skyc, MarksUncertifiedShows) {
    const auto files = written_files(skyc_format(), fixed::show(), test_seal(false));
    EXPECT_THAT(entry(files, "show.json"), HasSubstr("\"title\":\"UNCERTIFIED Fixed"));
    const RecordedShow show = read_back(skyc_format(), files);
    EXPECT_EQ(show.certified, false);
    EXPECT_EQ(show.title, fixed::show().name);
}

TEST(Skyc, LeavesTheLocationOutWithoutAGeoidAndSaysSo) {
    planner::FlightPlan plan = fixed::show();
    plan.origin.geoid_undulation_m.reset();
    const auto files = written_files(skyc_format(), plan);
    const std::string json = entry(files, "show.json");
    EXPECT_THAT(json, Not(HasSubstr("\"location\"")));
    EXPECT_THAT(json, HasSubstr("no location: geoid undulation not known"));
    const RecordedShow show = read_back(skyc_format(), files);
    EXPECT_FALSE(show.origin);
    EXPECT_EQ(show.title, plan.name);
}

TEST(Skyc, SegmentsAreTakeOffShowAndLanding) {
    EXPECT_THAT(entry(written_files(skyc_format(), fixed::show()), "show.json"),
                HasSubstr(R"("segments":{"takeoff":[0.0,8.0],"show":[8.0,60.6],"landing":[60.6,70.6]})"));
}

/// The audience camera, by quaternion algebra: it must look at the show's middle with its head up.
TEST(Skyc, TheAudienceCameraLooksAtTheShow) {
    const std::string json = entry(written_files(skyc_format(), fixed::show()), "show.json");
    double q[4], p[3];
    const auto numbers = [&](const char* key, double* out, int count) {
        const char* at = json.c_str() + json.find(key) + std::string(key).size();
        for (int i = 0; i < count; ++i) {
            char* end = nullptr;
            out[i] = std::strtod(at, &end);
            at = end + 1;
        }
    };
    numbers("\"position\":[", p, 3);
    numbers("\"orientation\":[", q, 4);
    const auto rotated = [&](const Vec3& v) {
        const Vec3 u{q[1], q[2], q[3]};
        return v + 2.0 * glm::cross(u, glm::cross(u, v) + q[0] * v);
    };
    const Vec3 looks = rotated({0.0, 0.0, -1.0}), head = rotated({0.0, 1.0, 0.0});
    EXPECT_NEAR(glm::length(looks), 1.0, 1e-5);
    EXPECT_NEAR(looks.y, 0.0, 1e-5);
    EXPECT_GT(looks.x, 0.7);
    EXPECT_GT(head.z, 0.7);
    EXPECT_LT(p[0], -20.25);  // in front of the pads
    EXPECT_EQ(p[2], 1.7);
}

/// More drones than one file holds, each standing on its pad.
planner::FlightPlan standing_fleet(std::size_t drones) {
    planner::FlightPlan plan = fixed::show();
    plan.pads_m.clear();
    for (std::size_t i = 0; i < drones; ++i)
        plan.pads_m.emplace_back(2.0 * static_cast<double>(i % 100), -2.0 * static_cast<double>(i / 100), 0.0);
    plan.acts = {{"stand", planner::ActRole::hold, planner::Timing::free, 0, 10'000, planner::Hold{plan.pads_m}}};
    plan.tracks.assign(drones, {});
    plan.tracks.back().lights = {{5'000, {1.0, 0.0, 0.0}, false}};
    plan.keyframes.clear();
    return plan;
}

TEST(Skyc, FleetTooLargeForAFileLeavesAsSeveral) {
    const planner::FlightPlan plan = standing_fleet(5'001);
    EXPECT_EQ(skyc_format().unsuited(PlannedShow(plan)), "");
    const auto files = written_files(skyc_format(), plan);
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(files[0].path, "show-1.skyc");
    EXPECT_EQ(files[1].path, "show-2.skyc");

    const RecordedShow all = read_back(skyc_format(), files);
    ASSERT_EQ(all.drones.size(), 5'001U);
    for (std::size_t i = 0; i < all.drones.size(); ++i) {
        ASSERT_EQ(all.drones[i].name, drone_name(i + 1, 5'001));
        ASSERT_EQ(all.drones[i].home_m, plan.pads_m[i]);
    }
    EXPECT_EQ(all.drones.back().tracks.lights.back().time_ms, 10'000);
    EXPECT_EQ(all.drones.front().tracks.lights.size(), 1U);

    const RecordedShow first = read_back(skyc_format(), {files[0]}), second = read_back(skyc_format(), {files[1]});
    EXPECT_EQ(first.drones.size() + second.drones.size(), 5'001U);
    for (const RecordedShow* part : {&first, &second}) {
        EXPECT_LE(part->drones.size(), kSkycDrones);
        EXPECT_EQ(part->origin->ground.latitude_deg, all.origin->ground.latitude_deg);
        EXPECT_EQ(part->origin->heading_deg, all.origin->heading_deg);
        EXPECT_EQ(part->show_hash, all.show_hash);
        EXPECT_EQ(part->cues.size(), plan.cues.size());
    }

    const auto refused = [&](const std::vector<FileBytes>& wrong) {
        const auto show = skyc_format().read(wrong);
        return show.ok() ? std::string() : show.error().message;
    };
    EXPECT_EQ(refused({files[1], files[0]}), "show-1.skyc: is part 1 of 2, after part 2 of 2");
    EXPECT_EQ(refused({files[0], files[0]}), "show-1.skyc: is part 1 of 2, after part 1 of 2");
    const auto uncertified = written_files(skyc_format(), plan, test_seal(false));
    EXPECT_EQ(refused({files[0], uncertified[1]}), "show-2.skyc: is of another show than the part before");
    planner::FlightPlan turned = plan;
    turned.origin.heading_deg += 7.0;
    EXPECT_EQ(refused({files[0], written_files(skyc_format(), turned)[1]}),
              "show-2.skyc: has another origin than the part before");
}

TEST(Skyc, RefusesAMarginWithoutRoomForMillimetres) {
    planner::FlightPlan plan = fixed::show();
    plan.limits.export_margin_m = 0.001;
    EXPECT_EQ(skyc_format().unsuited(PlannedShow(plan)),
              "export_margin_m leaves no room for millimetres; 0.01 would do");
}

TEST(Skyc, RefusesCurvesThatHalfSecondPiecesCannotFollow) {
    planner::FlightPlan plan = fixed::show();
    planner::Act& act = plan.acts[3];
    auto& lattice = std::get<planner::Lattice>(act.motion);
    const planner::Lattice slow = lattice;
    lattice.points_m.clear();
    for (std::size_t k = 0; k < 96; ++k) {
        for (std::size_t i = 0; i < 3; ++i) {
            const bool rest = k < 4 || k > 91;
            lattice.points_m.push_back(slow.at(k < 48 ? 0 : 14, i) +
                                       (rest ? 0.0 : 1.0) * Vec3{0.0, 0.3 * (k % 4 < 2), 0.0});
        }
    }
    const ScratchFolder folder;
    const auto written = skyc_format().write(PlannedShow(plan), test_seal(), folder.path(), aerogram::Run{});
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().code, ErrorCode::infeasible);
    EXPECT_THAT(written.error().message, HasSubstr("skyc: drone-001: pieces of 500 ms miss the flight by"));
    EXPECT_EQ("skyc: " + skyc_format().unsuited(PlannedShow(plan)), written.error().message);
}

/// A folder-less file is judged against the airspace and the endurance that it holds.
TEST(Skyc, CarriesAirspaceAndEndurance) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(skyc_format(), written_files(skyc_format(), plan));
    EXPECT_EQ(show.endurance_s, plan.endurance_s);
    ASSERT_TRUE(show.airspace);
    EXPECT_EQ(show.airspace->geofence_m, plan.airspace.geofence_m);
    EXPECT_EQ(show.airspace->audience_m, plan.airspace.audience_m);
    ASSERT_EQ(show.airspace->obstacles.size(), 2U);
    EXPECT_EQ(show.airspace->obstacles[0].name, "mast");
    EXPECT_EQ(std::get<geo::Cylinder>(show.airspace->obstacles[0].shape).center_m, Vec2(30.0, 10.0));
    EXPECT_EQ(std::get<geo::Prism>(show.airspace->obstacles[1].shape).outline_m.size(), 3U);
    const auto judgement = judge(show, {}, aerogram::Run{});
    ASSERT_TRUE(judgement.ok());
    const auto judged = [&](const std::string& rule) {
        return std::ranges::count(judgement->findings, rule, &Finding::rule);
    };
    EXPECT_EQ(judged("geofence"), 1);
    EXPECT_EQ(judged("audience"), 1);
    EXPECT_EQ(judged("endurance"), 1);
}

TEST(Skyc, CarriesMusic) {
    const ScratchFolder folder;
    planner::FlightPlan plan = fixed::show();
    plan.audio = folder.path() / "Some music.MP3";
    const std::string music = "ID3" + std::string(100'000, '\x55');
    ASSERT_TRUE(write_file(*plan.audio, music).ok());
    EXPECT_EQ(skyc_format().unsuited(PlannedShow(plan)), "");
    const auto files = written_files(skyc_format(), plan);
    EXPECT_TRUE(entry(files, "audio.mp3") == music);
    EXPECT_THAT(entry(files, "show.json"),
                HasSubstr(R"("media":{"audio":{"data":{"$ref":"./audio.mp3"},"filename":"audio.mp3",)"
                          R"("mediaType":"audio/mpeg","startTime":0}})"));
    EXPECT_EQ(read_back(skyc_format(), files).drones.size(), 3U);
}

TEST(Skyc, RefusesMusicThatIsMissingTooLargeOrOfNoKnownKind) {
    const ScratchFolder folder;
    planner::FlightPlan plan = fixed::show();
    const auto refusal = [&](const char* name) {
        plan.audio = folder.path() / name;
        return skyc_format().unsuited(PlannedShow(plan));
    };
    EXPECT_THAT(refusal("none.mp3"), HasSubstr("none.mp3: is missing"));
    ASSERT_TRUE(write_file(folder.path() / "song.txt", "x").ok());
    EXPECT_THAT(refusal("song.txt"), HasSubstr("its ending is none of mp3"));
    ASSERT_TRUE(write_file(folder.path() / "long.mp3", "x").ok());
    std::filesystem::resize_file(folder.path() / "long.mp3", (std::uintmax_t{64} << 20U) + 1);
    EXPECT_THAT(refusal("long.mp3"), HasSubstr("67108865 bytes; 64 MiB is the most a show carries"));
    const auto written = skyc_format().write(PlannedShow(plan), test_seal(), folder.path(), aerogram::Run{});
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().code, ErrorCode::invalid_input);
}

TEST(Skyc, SameBytesWithOneAndTwoThreads) {
    const ScratchFolder folder;
    aerogram::Run two;
    two.threads = 2;
    ASSERT_TRUE(skyc_format().write(PlannedShow(fixed::show()), test_seal(), folder.path(), two).ok());
    const auto one = written_files(skyc_format(), fixed::show());
    EXPECT_TRUE(read_file(folder.path() / "show.skyc").value() == one[0].bytes);
}

}  // namespace
}  // namespace aerogram::exporter
