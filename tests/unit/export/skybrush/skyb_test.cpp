#include "export/skybrush/skyb.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "export/outgoing/curve_fit.hpp"
#include "export/outgoing/planned_show.hpp"
#include "export/verify/judge.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/skybrush/skyb_decoder.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

std::string hex_of(const std::vector<FileBytes>& files) {
    std::string text;
    for (const FileBytes& file : files) {
        text += "==== " + file.path;
        for (std::size_t k = 0; k < file.bytes.size(); ++k) {
            constexpr std::string_view kDigits = "0123456789abcdef";
            const auto byte = static_cast<unsigned char>(file.bytes[k]);
            text += k % 32 == 0 ? '\n' : ' ';
            text += {kDigits[byte >> 4U], kDigits[byte & 15U]};
        }
        text += '\n';
    }
    return text;
}

std::string refusal(const planner::FlightPlan& plan) {
    const ScratchFolder folder;
    const auto written = skyb_format().write(PlannedShow(plan), test_seal(), folder.path(), aerogram::Run{});
    if (written) return "none";
    EXPECT_EQ(written.error().code, ErrorCode::infeasible);
    EXPECT_EQ("skyb: " + skyb_format().unsuited(PlannedShow(plan)), written.error().message);
    return written.error().message;
}

/// The fixed show with everything but the ground `by` farther out, so that 16 bits hold fewer digits.
planner::FlightPlan far_show(const Vec3& by) {
    planner::FlightPlan plan = fixed::show();
    for (Vec3& pad : plan.pads_m) pad += by;
    for (planner::Act& act : plan.acts) {
        if (auto* hold = std::get_if<planner::Hold>(&act.motion))
            for (Vec3& p : hold->positions_m) p += by;
        if (auto* straight = std::get_if<planner::Straight>(&act.motion)) {
            for (Vec3& p : straight->from_m) p += by;
            for (Vec3& p : straight->to_m) p += by;
        }
        if (auto* lattice = std::get_if<planner::Lattice>(&act.motion))
            for (Vec3& p : lattice->points_m) p += by;
    }
    return plan;
}

TEST(Skyb, WritesTheseBytes) {
    expect_golden("skyb.txt", hex_of(written_files(skyb_format(), fixed::show())));
}

TEST(Skyb, IsAFileADroneRecognisedByItsFirstBytes) {
    const auto files = written_files(skyb_format(), fixed::show());
    ASSERT_EQ(files.size(), 3U);
    EXPECT_EQ(files[2].path, "skyb/drone-003.skyb");
    EXPECT_TRUE(skyb_format().recognises("x", files[0].bytes.substr(0, 16)));
    EXPECT_FALSE(skyb_format().recognises("x.skyb", "skyb\x03\x01"));
    EXPECT_FALSE(skyb_format().recognises("x.skyb", "skyc"));
}

/// Properties 1 and 2, by the test's own decoder: X front is our y, Y left our -x, metres / 1000 / scale.
TEST(Skyb, Property1And2_RoundedCurvesAndExactDurations) {
    for (const Vec3& by : {Vec3{}, Vec3{300.0, -41.5, 0.0}, Vec3{-900.0, 200.0, 0.0}}) {
        planner::FlightPlan plan = far_show(by);
        plan.limits.export_margin_m = 0.2;
        const PlannedShow show(plan);
        const auto files = written_files(skyb_format(), plan);
        for (std::size_t i = 0; i < 3; ++i) {
            const decoder::File file = decoder::decoded(files[i].bytes);
            EXPECT_EQ(file.duration_ms, plan.duration_ms());
            const Fitted fitted = show.fitted(i);
            const double allowed_m = 0.002 * file.scale;
            for (const FittedPiece& piece : fitted.pieces) {
                for (int k = 0; k <= 8; ++k) {
                    const double u = k / 8.0, v = 1.0 - u;
                    const auto& c = piece.controls_m;
                    const Vec3 exact =
                        v * v * v * c[0] + 3.0 * u * v * v * c[1] + 3.0 * u * u * v * c[2] + u * u * u * c[3];
                    const auto p = file.position_m(
                        (static_cast<double>(piece.start_ms) + u * static_cast<double>(piece.duration_ms)) / 1000.0);
                    const Vec3 held{-p[1], p[0], p[2]};
                    ASSERT_LE(glm::length(held - exact), allowed_m) << i << " at " << piece.start_ms << " + " << k;
                }
            }
        }
    }
}

TEST(Skyb, Property3_SameBytesWithOneAndTwoThreads) {
    const ScratchFolder folder;
    aerogram::Run two;
    two.threads = 2;
    ASSERT_TRUE(skyb_format().write(PlannedShow(fixed::show()), test_seal(), folder.path(), two).ok());
    for (const FileBytes& file : written_files(skyb_format(), fixed::show()))
        EXPECT_TRUE(read_file(folder.path() / file.path).value() == file.bytes);
}

/// The asymmetric show catches swapped and mirrored axes: against the plan itself.
TEST(Skyb, ReadsBackWithinTheStatedRounding) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(skyb_format(), written_files(skyb_format(), plan));
    ASSERT_EQ(show.drones.size(), 3U);
    ASSERT_TRUE(well_formed(show).ok());
    EXPECT_DOUBLE_EQ(show.duration_s, seconds_from_ms(plan.duration_ms()));
    const Rounding& r = show.rounding;
    EXPECT_EQ(r.position_m, 0.0005);
    EXPECT_TRUE(r.has_acceleration);
    EXPECT_LE(2.0 * r.fit_m + 2.0 * std::sqrt(3.0) * r.position_m, plan.limits.export_margin_m);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE(glm::length(*show.drones[i].home_m - plan.pads_m[i]), 0.001);
        EXPECT_LE(glm::length(*show.drones[i].land_m - plan.pads_m[i]), 0.001);
        for (Millis t = 0; t <= plan.duration_ms(); t += 7) {
            const double t_s = seconds_from_ms(t);
            const planner::DroneState exact = planner::sample(plan, DroneId(i), t_s);
            const Vec3 miss = position_at(show.drones[i], t_s) - exact.motion.position_m;
            ASSERT_LE(glm::length(miss), r.fit_m + std::sqrt(3.0) * r.position_m) << "drone " << i << " at " << t;
            if (t == plan.duration_ms()) continue;
            ASSERT_LE(glm::length(velocity_at(show.drones[i], t_s) - exact.motion.velocity_mps), r.speed_allowance_mps);
        }
    }
}

TEST(Skyb, CarriesTracksFactsAndClaims) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(skyb_format(), written_files(skyb_format(), plan));
    EXPECT_EQ(show.title, plan.name);
    EXPECT_EQ(show.show_hash, test_seal().show_hash);
    EXPECT_EQ(show.certified, true);
    EXPECT_EQ(show.endurance_s, plan.endurance_s);
    ASSERT_TRUE(show.origin && show.limits);
    EXPECT_EQ(show.origin->ground.latitude_deg, plan.origin.ground.latitude_deg);
    EXPECT_EQ(show.origin->ground.longitude_deg, plan.origin.ground.longitude_deg);
    EXPECT_EQ(show.origin->ground.height_m, plan.origin.ground.height_m);
    EXPECT_EQ(show.origin->heading_deg, plan.origin.heading_deg);
    EXPECT_EQ(show.origin->geoid_undulation_m, plan.origin.geoid_undulation_m);
    EXPECT_EQ(show.limits->min_separation_m, plan.limits.min_separation_m);
    EXPECT_EQ(show.limits->ceiling_m, plan.limits.ceiling_m);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(show.drones[i].name, "drone-00" + std::to_string(i + 1));
        for (Millis t = 0; t < plan.duration_ms(); t += 10) {
            const Rgb a = light_at(show.drones[i].tracks.lights, seconds_from_ms(t));
            const Rgb b = light_at(plan.tracks[i].lights, seconds_from_ms(t));
            const double apart = std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
            ASSERT_LE(apart, 1.0 / 255.0) << i << " at " << t;
            const double yaw = yaw_at(show.drones[i].tracks.yaw, seconds_from_ms(t));
            ASSERT_NEAR(yaw, yaw_at(plan.tracks[i].yaw, seconds_from_ms(t)), radians(0.0501)) << i << " at " << t;
        }
        EXPECT_EQ(show.drones[i].tracks.events, plan.tracks[i].events);
    }
}

TEST(Skyb, ItsOwnJudgeFindsNothingWrong) {
    const RecordedShow show = read_back(skyb_format(), written_files(skyb_format(), fixed::show()));
    const auto judgement = judge(show, {}, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    EXPECT_TRUE(judgement->problems.empty());
    for (const Finding& finding : judgement->findings)
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
}

TEST(Skyb, MarksUncertifiedShows) {
    const auto files = written_files(skyb_format(), fixed::show(), test_seal(false));
    EXPECT_THAT(decoder::decoded(files[0].bytes).comment, HasSubstr("UNCERTIFIED aerogram 1\n"));
    EXPECT_EQ(read_back(skyb_format(), files).certified, false);
}

/// A quarter of an hour of standing: segments of at most a minute.
TEST(Skyb, CutsLongSegments) {
    planner::FlightPlan plan = fixed::show();
    plan.acts[2].duration_ms = 900'001;
    plan.acts[1].duration_ms = 200'003;
    Millis start_ms = 0;
    for (planner::Act& act : plan.acts) act.start_ms = start_ms, start_ms += act.duration_ms;
    const auto files = written_files(skyb_format(), plan);
    for (const FileBytes& bytes : files) {
        const decoder::File file = decoder::decoded(bytes.bytes);
        EXPECT_EQ(file.duration_ms, plan.duration_ms());
        EXPECT_LE(file.longest_ms, 60'000);
    }
    EXPECT_EQ(read_back(skyb_format(), files).duration_s, seconds_from_ms(plan.duration_ms()));
}

TEST(Skyb, YawTurnsClockwiseInTenthsWithoutDrift) {
    planner::FlightPlan plan = fixed::show();
    auto& keys = plan.tracks[0].yaw;
    for (int k = 0; k < 390; ++k) keys.push_back({k * 177, 0.0173 * k + std::sin(1.7 * k)});
    keys.push_back({70'600, 200.0});
    const auto files = written_files(skyb_format(), plan);
    const decoder::File file = decoder::decoded(files[0].bytes);
    ASSERT_FALSE(file.yaw.empty());
    for (const YawKey& key : keys) {
        const double held_deg = file.yaw_deg(seconds_from_ms(key.time_ms));
        ASSERT_NEAR(std::remainder(held_deg + degrees(key.yaw_rad), 360.0), 0.0, 0.0501) << key.time_ms;
    }
    const RecordedShow show = read_back(skyb_format(), files);
    ASSERT_NEAR(show.drones[0].tracks.yaw.back().yaw_rad, 200.0, radians(0.0501));
}

TEST(Skyb, StateWhyAShowCannotLeave) {
    planner::FlightPlan narrow = fixed::show();
    narrow.limits.export_margin_m = 0.0015;
    EXPECT_EQ(refusal(narrow), "skyb: export_margin_m leaves no room for coordinates of 1 mm a unit");
    EXPECT_EQ(refusal(far_show({600.0, 0.0, 0.0})).substr(0, 4), "none");
    EXPECT_EQ(refusal(far_show({1'500.0, 0.0, 0.0})),
              "skyb: export_margin_m leaves no room for coordinates of 47 mm a unit");
    planner::FlightPlan remote = far_show({4'500.0, 0.0, 0.0});
    remote.limits.export_margin_m = 1.0;
    EXPECT_THAT(refusal(remote), HasSubstr("drone-001: goes farther than 4161 m from the origin along an axis"));
    planner::FlightPlan low = fixed::show();
    low.acts = {{"hop", planner::ActRole::takeoff, planner::Timing::free, 0, 20'000,
                 planner::Straight{low.pads_m, low.pads_m, fixed::profile(11)}}};
    auto& hop = std::get<planner::Straight>(low.acts[0].motion);
    hop.to_m[1].z += 2.4;
    EXPECT_EQ(refusal(low),
              "skyb: drone-002: rises by less than 2.5 m above its start: show firmware would not take off");
    planner::FlightPlan payload = fixed::show();
    payload.tracks[2].events.push_back({30'000, 256, true});
    EXPECT_EQ(refusal(payload), "skyb: drone-003: payload channel 256: 0 to 255 can be written");
    planner::FlightPlan bright = fixed::show();
    std::uint64_t random = 7;
    for (Millis t = 0; t < 400'000; t += 20) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        bright.tracks[1].lights.push_back(
            {t,
             {double(random >> 56) / 255, double(random >> 48 & 255) / 255, double(random >> 40 & 255) / 255},
             false});
    }
    EXPECT_THAT(refusal(bright), HasSubstr("skyb: drone-002: its lights take"));
    planner::FlightPlan plane = fixed::show();
    plane.limits.plane = PlaneLimits{};
    EXPECT_THAT(skyb_format().unsuited(PlannedShow(plane)), HasSubstr("planes"));
}

}  // namespace
}  // namespace aerogram::exporter
