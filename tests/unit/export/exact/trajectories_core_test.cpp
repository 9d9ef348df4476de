#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "export/bytes/crc32.hpp"
#include "export/bytes/little_endian.hpp"
#include "export/bytes/sha256.hpp"
#include "export/exact/show_hash.hpp"
#include "export/exact/trajectories_bin.hpp"
#include "geo/contract.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/golden_bytes.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;
constexpr std::size_t kHeader = 72;

std::string file_of(const planner::FlightPlan& plan, int scalar_bytes = 8) {
    return trajectories_bytes(plan, {show_hash(plan), true}, scalar_bytes);
}

/// Makes CRCs and, in an exact file, the hash fit again after the payload was changed: only its meaning is wrong then.
std::string resealed(std::string file) {
    const std::string payload = file.substr(kHeader);
    std::string words;
    put(words, std::uint64_t{payload.size()});
    file.replace(24, 8, words);
    if (file[12] == 8) {
        const std::string hex = sha256_hex(payload);
        for (std::size_t i = 0; i < 32; ++i)
            file[32 + i] = static_cast<char>(std::stoi(hex.substr(2 * i, 2), nullptr, 16));
    }
    words.clear();
    put(words, crc32(payload));
    file.replace(64, 4, words);
    words.clear();
    put(words, crc32(std::string_view(file).substr(0, 68)));
    file.replace(68, 4, words);
    return file;
}

/// The file with `value` written over the payload at `at`, sound but for its meaning.
template <class T>
std::string with(std::string file, std::size_t at, T value) {
    std::string words;
    put(words, value);
    file.replace(at, words.size(), words);
    return resealed(file);
}

std::string problem_of(const std::string& file) {
    const auto show = read_trajectories(file);
    return show.ok() ? "none" : show.error().message;
}

/// Where in the file the text of this act name ends; role, timing, start, duration and kind follow.
std::size_t behind_name(const std::string& file, const std::string& name) {
    std::string text;
    put(text, static_cast<std::uint32_t>(name.size()));
    text += name;
    const std::size_t at = file.find(text);
    EXPECT_NE(at, std::string::npos);
    return at + 4 + (name.size() + 3) / 4 * 4;
}

TEST(Sha256, IsThatOfTheStandardsExamples) {
    EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Crc32, IsThatOfZip) {
    EXPECT_EQ(crc32(""), 0U);
    EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
    EXPECT_EQ(crc32("1"), 0x83DCEFB7U);
}

TEST(Trajectories, BytesAreGolden) {
    fixed::expect_golden("fixed.trajectories.bin", file_of(fixed::show()));
    fixed::expect_golden("fixed.trajectories4.bin", file_of(fixed::show(), 4));
}

TEST(Trajectories, HeaderIsAsDocumented) {
    const std::string file = file_of(fixed::show());
    EXPECT_EQ(file.substr(0, 8), "AEROGRAM");
    EXPECT_EQ(file.substr(8, 16), std::string("\1\0\0\0\10\0\0\0\1\0\0\0\110\0\0\0", 16));
    std::string hash;
    for (const char c : file.substr(32, 32)) {
        constexpr std::string_view kDigits = "0123456789abcdef";
        hash += kDigits[static_cast<std::uint8_t>(c) >> 4U];
        hash += kDigits[static_cast<std::uint8_t>(c) & 15U];
    }
    EXPECT_EQ(hash, sha256_hex(file.substr(kHeader))) << "tail -c +73 | sha256sum";
    EXPECT_EQ(hash, show_hash(fixed::show()));
}

TEST(Trajectories, EverythingBeginsAtAMultipleOfFour) {
    const std::string file = file_of(fixed::show(), 4);
    EXPECT_EQ(file.size() % 4, 0U);
    EXPECT_EQ(behind_name(file, "to B") % 4, 0U);
}

TEST(Trajectories, GivesBackWhatThePlanHolds) {
    const planner::FlightPlan plan = fixed::show();
    for (const int width : {8, 4}) {
        const auto show = read_trajectories(file_of(plan, width));
        ASSERT_TRUE(show.ok()) << show.error().message;
        EXPECT_EQ(show->format, "trajectories");
        EXPECT_EQ(show->title, plan.name);
        EXPECT_EQ(show->show_hash, show_hash(plan));
        EXPECT_EQ(show->certified, true);
        EXPECT_EQ(show->duration_s, 70.6);
        EXPECT_EQ(show->origin->ground.latitude_deg, 35.65860);
        EXPECT_EQ(show->origin->ground.longitude_deg, 139.74540);
        EXPECT_EQ(show->origin->ground.height_m, 40.0);
        EXPECT_EQ(show->origin->heading_deg, 20.0);
        EXPECT_EQ(show->origin->geoid_undulation_m, 36.7);
        EXPECT_EQ(show->limits->ceiling_m, plan.limits.ceiling_m);
        EXPECT_EQ(show->limits->jerk_mps3, plan.limits.jerk_mps3);
        EXPECT_EQ(show->endurance_s, 600.0);
        EXPECT_EQ(show->airspace->geofence_m, plan.airspace.geofence_m);
        EXPECT_EQ(show->airspace->audience_m, plan.airspace.audience_m);
        ASSERT_EQ(show->airspace->obstacles.size(), 2U);
        EXPECT_EQ(std::get<geo::Cylinder>(show->airspace->obstacles[0].shape).radius_m, 4.0);
        EXPECT_EQ(show->airspace->obstacles[1].name, "stage");
        EXPECT_EQ(show->airspace->obstacles[1].base_m, 0.5);
        EXPECT_EQ(std::get<geo::Prism>(show->airspace->obstacles[1].shape).outline_m.size(), 3U);
        EXPECT_EQ(show->cues, plan.cues);
        ASSERT_EQ(show->drones.size(), 3U);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(show->drones[i].name, "drone-00" + std::to_string(i + 1));
            EXPECT_EQ(show->drones[i].home_m, plan.pads_m[i]);  // halves and quarters: exact as floats too
            EXPECT_EQ(show->drones[i].land_m, plan.pads_m[i]);
            EXPECT_EQ(show->drones[i].tracks, plan.tracks[i]);
        }
    }
}

// The planner's own evaluation is the oracle: other code, same curve.
TEST(Trajectories, PositionsAreThoseOfThePlan) {
    const planner::FlightPlan plan = fixed::show();
    for (const int width : {8, 4}) {
        const double tolerance_m = width == 8 ? 1e-12 : 1e-5;
        const auto show = read_trajectories(file_of(plan, width));
        ASSERT_TRUE(show.ok());
        EXPECT_LE(show->rounding.position_m, tolerance_m);
        for (std::size_t i = 0; i < 3; ++i) {
            for (int step = 0; step <= 1412; ++step) {
                const double t_s = 0.05 * step;
                const Vec3 difference =
                    position_at(show->drones[i], t_s) - sample(plan, DroneId(i), t_s).motion.position_m;
                ASSERT_LE(glm::length(difference), tolerance_m) << "drone " << i + 1 << " at " << t_s;
            }
        }
    }
}

TEST(Trajectories, PiecesFollowEachOtherAndHoldsStand) {
    const auto show = read_trajectories(file_of(fixed::show()));
    ASSERT_TRUE(show.ok());
    const RecordedDrone& drone = show->drones[1];
    ASSERT_EQ(drone.pieces.size(), 8U + 16U + 1U + 12U + 1U + 20U + 10U);
    double end_s = 0.0;
    for (const Piece& piece : drone.pieces) {
        EXPECT_NEAR(piece.start_s, end_s, 1e-12);
        end_s = piece.start_s + piece.duration_s;
        EXPECT_LE(piece.first_control + piece.degree + 1U, drone.controls_m.size());
    }
    EXPECT_EQ(drone.pieces[24].degree, 0);
    EXPECT_EQ(drone.controls_m[drone.pieces[24].first_control], fixed::formation_a()[1]);
}

// Property 2 of trajectories_payload.
TEST(ShowHash, ChangesWithEverythingThePayloadHolds) {
    using Plan = planner::FlightPlan;
    const std::vector<std::pair<std::string, std::function<void(Plan&)>>> changes{
        {"name", [](Plan& p) { p.name += "!"; }},
        {"latitude", [](Plan& p) { p.origin.ground.latitude_deg += 1e-9; }},
        {"height", [](Plan& p) { p.origin.ground.height_m += 1e-3; }},
        {"heading", [](Plan& p) { p.origin.heading_deg += 7.0; }},
        {"no undulation", [](Plan& p) { p.origin.geoid_undulation_m.reset(); }},
        {"separation", [](Plan& p) { p.limits.min_separation_m += 0.1; }},
        {"ceiling", [](Plan& p) { p.limits.ceiling_m -= 1.0; }},
        {"endurance", [](Plan& p) { p.endurance_s += 1.0; }},
        {"fence", [](Plan& p) { p.airspace.geofence_m[2].x += 0.01; }},
        {"no fence", [](Plan& p) { p.airspace.geofence_m.clear(); }},
        {"audience", [](Plan& p) { p.airspace.audience_m[0][3].y -= 0.01; }},
        {"mast", [](Plan& p) { std::get<geo::Cylinder>(p.airspace.obstacles[0].shape).radius_m += 0.1; }},
        {"pads", [](Plan& p) { std::swap(p.pads_m[0], p.pads_m[1]); }},
        {"act name", [](Plan& p) { p.acts[1].name = "to a"; }},
        {"role", [](Plan& p) { p.acts[1].role = planner::ActRole::hold; }},
        {"timing", [](Plan& p) { p.acts[1].timing = planner::Timing::fixed; }},
        {"clock", [](Plan& p) { p.acts.back().duration_ms += 1; }},
        {"profile", [](Plan& p) { std::get<planner::Straight>(p.acts[1].motion).profile[5] += 1e-15; }},
        {"lattice", [](Plan& p) { std::get<planner::Lattice>(p.acts[3].motion).points_m[20].z += 1e-12; }},
        {"hold", [](Plan& p) { std::get<planner::Hold>(p.acts[2].motion).positions_m[2].y += 1e-12; }},
        {"light", [](Plan& p) { p.tracks[2].lights[0].color.g += 1e-12; }},
        {"fade", [](Plan& p) { p.tracks[2].lights[0].fade = false; }},
        {"yaw", [](Plan& p) { p.tracks[1].yaw[1].yaw_rad += 1e-12; }},
        {"event", [](Plan& p) { p.tracks[2].events[0].channel = 3; }},
        {"cue", [](Plan& p) { p.cues[1].time_ms += 20; }},
        {"keyframe", [](Plan& p) { p.keyframes[0].stands_to_ms += 1; }},
    };
    const std::string before = show_hash(fixed::show());
    EXPECT_EQ(before, show_hash(fixed::show()));
    for (const auto& [what, change] : changes) {
        planner::FlightPlan plan = fixed::show();
        change(plan);
        EXPECT_NE(show_hash(plan), before) << what;
    }
}

TEST(ShowHash, DoesNotDependOnTheCertificate) {
    planner::FlightPlan plan = fixed::show();
    plan.certificate = {};
    EXPECT_EQ(show_hash(plan), show_hash(fixed::show()));
}

// Property 1 of read_trajectories: with every bit pattern that differs in one, and in all bits.
TEST(Trajectories, AnyChangedByteIsAnError) {
    for (const int width : {8, 4}) {
        const std::string file = file_of(fixed::show(), width);
        for (std::size_t at = 0; at < file.size(); ++at) {
            for (const unsigned flip : {1U, 128U, 255U}) {
                std::string damaged = file;
                damaged[at] = static_cast<char>(static_cast<std::uint8_t>(damaged[at]) ^ flip);
                const auto show = read_trajectories(damaged);
                ASSERT_FALSE(show.ok()) << "byte " << at << " with bits " << flip;
                EXPECT_EQ(show.error().code, ErrorCode::invalid_input);
                EXPECT_THAT(show.error().message, HasSubstr("byte "));
            }
        }
    }
}

// The same damage with hash and CRCs made to fit: an error or another show, but never a crash or a read outside.
TEST(Trajectories, DamageThatWasSealedAgainIsSurvived) {
    for (const int width : {8, 4}) {
        const std::string file = file_of(fixed::show(), width);
        std::size_t refused = 0;
        for (std::size_t at = kHeader; at < file.size(); ++at) {
            std::string damaged = file;
            damaged[at] = static_cast<char>(static_cast<std::uint8_t>(damaged[at]) ^ 255U);
            const auto show = read_trajectories(resealed(damaged));
            refused += show.ok() ? 0U : 1U;
            EXPECT_TRUE(!show.ok() || show->drones.size() == 3U) << at;
        }
        EXPECT_GT(refused, 300U);
    }
}

TEST(Trajectories, EveryShorterFileIsAnError) {
    const std::string file = file_of(fixed::show(), 4);
    for (std::size_t size = 0; size < file.size(); ++size) {
        EXPECT_FALSE(read_trajectories(std::string_view(file).substr(0, size)).ok()) << size;
        const std::string sealed_again = size < kHeader ? "" : resealed(file.substr(0, size));
        EXPECT_FALSE(read_trajectories(sealed_again).ok()) << size;
    }
    EXPECT_THAT(problem_of(resealed(file + std::string(4, '\0'))), HasSubstr("bytes left over"));
}

TEST(Trajectories, TellsWhatIsWrongAndWhere) {
    const std::string file = file_of(fixed::show());
    EXPECT_EQ(problem_of("PK"), "byte 0: cut short");
    EXPECT_THAT(problem_of(std::string(100, 'x')), HasSubstr("does not begin with AEROGRAM"));
    EXPECT_EQ(problem_of(with<std::uint32_t>(file, 8, 2)), "byte 8: version 2; this program reads version 1");
    EXPECT_EQ(problem_of(with<std::uint32_t>(file, 16, 5)), "byte 16: unknown flags");
    EXPECT_EQ(problem_of(with<std::uint32_t>(file, 72, 0xFFFFFFF0U)), "byte 72: a count that the file cannot hold");
    EXPECT_EQ(problem_of(with<char>(file, 76, '\xFF')), "byte 76: text that is not plain UTF-8");
    std::string other_hash = file;
    other_hash[40] = static_cast<char>(other_hash[40] ^ 1);
    std::string words;
    put(words, crc32(std::string_view(other_hash).substr(0, 68)));
    EXPECT_EQ(problem_of(other_hash.replace(68, 4, words)), "byte 32: the show hash is not that of the payload");
}

TEST(Trajectories, RefusesActsThatCannotBe) {
    const std::string file = file_of(fixed::show());
    const std::size_t hold = behind_name(file, "A"), straight = behind_name(file, "to A"),
                      curve = behind_name(file, "to B");
    constexpr std::size_t kStart = 8, kDuration = 12, kKind = 16, kRows = 20;
    EXPECT_THAT(problem_of(with<std::uint32_t>(file, hold, 4)), HasSubstr("must be below 4"));
    EXPECT_THAT(problem_of(with<std::uint32_t>(file, hold + 4, 2)), HasSubstr("must be below 2"));
    EXPECT_THAT(problem_of(with<std::uint32_t>(file, hold + kKind, 3)), HasSubstr("must be below 3"));
    EXPECT_THAT(problem_of(with<std::int32_t>(file, hold + kStart, 23'999)), HasSubstr("does not begin where"));
    EXPECT_THAT(problem_of(with<std::int32_t>(file, hold + kDuration, 0)), HasSubstr("a duration out of range"));
    EXPECT_THAT(problem_of(with<std::int32_t>(file, hold + kDuration, -5)), HasSubstr("a duration out of range"));
    EXPECT_THAT(problem_of(with<std::int32_t>(file, hold + kDuration, 0x7FFFFFFF)),
                HasSubstr("a duration out of range"));
    EXPECT_THAT(problem_of(with<std::uint32_t>(file, straight + kRows, 3)), HasSubstr("rows out of range"));
    EXPECT_THAT(problem_of(with<std::uint32_t>(file, straight + kRows, 257)), HasSubstr("rows out of range"));
    EXPECT_THAT(problem_of(with<std::uint32_t>(file, curve + kRows, 0x40000000)), HasSubstr("file cannot hold"));
    EXPECT_THAT(problem_of(with<double>(file, hold + kRows, std::nan(""))), HasSubstr("not finite"));
    EXPECT_EQ(problem_of(with<double>(file, curve + kRows + 4 + 40 * 8, 1e7)),
              "byte " + std::to_string(curve + kRows + 4 + 40 * 8) + ": a number that is not finite or too large");
}

TEST(Trajectories, RefusesTracksThatRunBackwards) {
    planner::FlightPlan plan = fixed::show();
    std::swap(plan.tracks[0].lights[1].time_ms, plan.tracks[0].lights[2].time_ms);
    EXPECT_THAT(problem_of(file_of(plan)), HasSubstr("a time before the one before"));
    plan = fixed::show();
    std::swap(plan.tracks[1].yaw[1].time_ms, plan.tracks[1].yaw[2].time_ms);
    EXPECT_THAT(problem_of(file_of(plan)), HasSubstr("a time before the one before"));
}

TEST(Trajectories, UnsuitedShowsAreNamed) {
    planner::FlightPlan plan = fixed::show();
    EXPECT_EQ(trajectories_unsuited(plan), "");
    plan.cues[0].time_ms = Millis{1} << 31U;
    EXPECT_EQ(trajectories_unsuited(plan), "a cue more than 24 days away");
    EXPECT_THROW(trajectories_payload(plan, 8), ContractViolation);
    plan = fixed::show();
    std::get<planner::Straight>(plan.acts[0].motion).profile.resize(300, 1.0);
    EXPECT_EQ(trajectories_unsuited(plan), "act \"take-off\" has a profile of more than 256 rows");
}

}  // namespace
}  // namespace aerogram::exporter
