#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "export/bytes/files.hpp"
#include "export/bytes/zip.hpp"
#include "export/certificate_json.hpp"
#include "export/export_show.hpp"
#include "export/manifest_json.hpp"
#include "export/verify_show.hpp"
#include "planner/motion/certificate.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/scratch_folder.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using PlainRun = aerogram::Run;

Verified verified(const fs::path& path) {
    return verify_path(path, PlainRun{}).value();
}

/// The fixed show with the certificate that it deserves.
planner::FlightPlan honest_show() {
    planner::FlightPlan plan = fixed::show();
    const planner::Surroundings around{geo::ShowFrame(plan.origin), plan.airspace, plan.pads_m, plan.limits};
    for (std::size_t a = 0; a < plan.acts.size(); ++a) {
        planner::ActCertificate& act = plan.certificate.acts[a];
        const std::string method = act.method, assignment = act.assignment;
        act = planner::certify(plan.acts[a], around, PlainRun{}).value();
        act.method = method;
        act.assignment = assignment;
    }
    return plan;
}

void export_plan(const planner::FlightPlan& plan, const fs::path& folder, const std::vector<std::string>& formats) {
    const auto exported =
        export_show(plan, folder, {.formats = formats, .best_effort = false, .drones = {}}, PlainRun{});
    ASSERT_TRUE(exported.ok()) << exported.error().message;
}

/// That show exported into a folder. @param formats  empty: all.
void export_fixed(const fs::path& folder, const std::vector<std::string>& formats = {}) {
    export_plan(honest_show(), folder, formats);
}

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
}

/// Writes the manifest anew after `change`, its own hash right, so that only what it says can be wrong.
template <class Change>
void rewrite_manifest(const fs::path& folder, Change change) {
    Manifest manifest = read_manifest(read_file(folder / kManifestName).value()).value();
    change(manifest);
    ASSERT_TRUE(write_file(folder / kManifestName, manifest_json(manifest)).ok());
}

TEST(VerifyFolder, IntactExportHoldsAndEveryFormatIsJudged) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder);
    const Verified result = verified(folder);
    EXPECT_THAT(result.problems, IsEmpty());
    EXPECT_TRUE(result.held());
    const Manifest manifest = read_manifest(read_file(folder / kManifestName).value()).value();
    std::size_t written = 0;
    for (const ManifestFormat& format : manifest.formats) written += format.skipped.empty() ? 1U : 0U;
    ASSERT_EQ(result.shows.size(), written);
    for (const Judgement& judgement : result.shows) {
        EXPECT_EQ(judgement.limits_from, "manifest.json");
        EXPECT_TRUE(!judgement.separation_claimed || judgement.min_separation_m >= 1.5) << judgement.format;
        EXPECT_TRUE(judgement.held()) << judgement.format;
    }
}

TEST(VerifyFolder, EveryChangedByteIsNoticedAndTheFileNamed) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder, {"trajectories"});
    std::size_t flips = 0;
    for (const fs::path& file : files_in(folder)) {
        const std::string bytes = read_file(file).value();
        const std::size_t step = std::max<std::size_t>(1, bytes.size() / 300);
        for (std::size_t at = 0; at < bytes.size(); at += step, ++flips) {
            std::string changed = bytes;
            changed[at] = static_cast<char>(changed[at] ^ static_cast<char>(1 + at % 255));
            ASSERT_TRUE(write_file(file, changed).ok());
            const Verified result = verified(folder);
            EXPECT_FALSE(result.held());
            EXPECT_THAT(result.problems, Contains(StartsWith(file.string()))) << "byte " << at;
        }
        ASSERT_TRUE(write_file(file, bytes).ok());
    }
    EXPECT_GE(flips, 800U);
    EXPECT_TRUE(verified(folder).held());
}

TEST(VerifyFolder, OneChangedByteInAnyFormatIsNoticed) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder);
    for (const fs::path& file : files_in(folder)) {
        const std::string bytes = read_file(file).value();
        std::string changed = bytes;
        changed[bytes.size() / 2] = static_cast<char>(changed[bytes.size() / 2] ^ 4);
        ASSERT_TRUE(write_file(file, changed).ok());
        EXPECT_THAT(verified(folder).problems, Contains(StartsWith(file.string())));
        ASSERT_TRUE(write_file(file, bytes + "\n").ok());
        EXPECT_THAT(verified(folder).problems, Contains(StartsWith(file.string())));
        ASSERT_TRUE(write_file(file, bytes).ok());
    }
}

TEST(VerifyFolder, MissingAndExtraFilesAreNamed) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder, {"trajectories"});
    ASSERT_TRUE(write_file(folder / "qgc" / "drone-009.plan", "{}").ok());
    EXPECT_THAT(verified(folder).problems,
                ElementsAre((folder / "qgc/drone-009.plan").string() + ": not listed in the manifest"));
    fs::remove_all(folder / "qgc");
    fs::create_symlink("manifest.json", folder / "alias");
    EXPECT_THAT(verified(folder).problems, ElementsAre((folder / "alias").string() + ": not a plain file"));
    fs::remove(folder / "alias");
    fs::remove(folder / "certificate.json");
    EXPECT_THAT(verified(folder).problems, ElementsAre((folder / "certificate.json").string() + ": missing"));
}

TEST(VerifyFolder, MissingManifestIsAProblemOfAShowAndAnErrorElsewhere) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder, {"trajectories"});
    fs::remove(folder / kManifestName);
    EXPECT_THAT(verified(folder).problems,
                ElementsAre((folder / "manifest.json").string() + ": missing: not a show folder"));
    fs::create_directories(scratch.path() / "other");
    const auto other = verify_path(scratch.path() / "other", PlainRun{});
    ASSERT_FALSE(other.ok());
    EXPECT_EQ(other.error().code, ErrorCode::invalid_input);
}

TEST(VerifyFolder, ManifestsThatSayTooMuchAreCaught) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder, {"trajectories"});
    const std::string intact = read_file(folder / kManifestName).value();
    const auto problems_after = [&](auto change) {
        rewrite_manifest(folder, change);
        std::vector<std::string> problems = verified(folder).problems;
        EXPECT_TRUE(write_file(folder / kManifestName, intact).ok());
        return problems;
    };
    EXPECT_THAT(problems_after([](Manifest&) {}), IsEmpty());
    EXPECT_THAT(problems_after([](Manifest& m) { *m.files[0].min_separation_m += 0.001; }),
                ElementsAre(HasSubstr("the manifest claims a separation of")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.limits.ceiling_m = 500.0; }),
                ElementsAre(HasSubstr("a limit differs")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.origin.heading_deg += 7.0; }),
                ElementsAre(HasSubstr("the origin differs")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.airspace.geofence_m[0].x -= 1.0; }),
                ElementsAre(HasSubstr("the airspace differs")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.formats[0].rounding.position_m = 0.5; }),
                ElementsAre(HasSubstr("the stated rounding differs")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.drones[1].pad_m.x += 0.5; }),
                ElementsAre(HasSubstr("drone 2: home is 0.5 m from its pad in the manifest")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.drones[2].name = "drone-030"; }),
                ElementsAre(HasSubstr("drone 3 is named")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.duration_s += 1.0; }), Contains(HasSubstr("the duration differs")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.files[0].timing = "linear"; }),
                ElementsAre(HasSubstr("its timing")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.show_hash[0] = m.show_hash[0] == 'a' ? 'b' : 'a'; }),
                Contains(HasSubstr("the show hash differs")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.certified = false; }),
                Contains(HasSubstr("the certified mark differs")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.files.erase(m.files.begin()); }),
                Contains(HasSubstr("not listed in the manifest")));
}

/// What verify says of the show when act `act` of its certificate is changed.
template <class Change>
std::vector<std::string> problems_of_certificate(std::size_t act, Change change) {
    const fixed::ScratchFolder scratch;
    planner::FlightPlan plan = honest_show();
    change(plan.certificate.acts.at(act));
    export_plan(plan, scratch.path() / "show", {"trajectories"});
    return verified(scratch.path() / "show").problems;
}

// Only separations were once compared: any speed, altitude or margin could be claimed.
TEST(VerifyFolder, CertificateMayNotClaimMoreThanTheTrajectoriesHave) {
    using planner::ActCertificate;
    const std::string act = "certificate.json: act \"to B\" ";
    const auto expect = [&](const std::string& problem, auto change) {
        EXPECT_THAT(problems_of_certificate(3, change), ElementsAre(HasSubstr(act + problem)));
    };
    EXPECT_THAT(problems_of_certificate(3, [](ActCertificate&) {}), IsEmpty());
    expect("claims max_speed_horizontal_mps = ", [](ActCertificate& c) { c.extremes.speed_horizontal_mps *= 0.8; });
    expect("claims max_speed_up_mps = ", [](ActCertificate& c) { c.extremes.speed_up_mps *= 0.8; });
    expect("claims max_speed_down_mps = ", [](ActCertificate& c) { c.extremes.speed_down_mps *= 0.8; });
    expect("claims max_acceleration_mps2 = ", [](ActCertificate& c) { c.extremes.acceleration_mps2 *= 0.99; });
    expect("claims max_jerk_mps3 = ", [](ActCertificate& c) { c.extremes.jerk_mps3 *= 0.99; });
    expect("claims altitude_max_m = ", [](ActCertificate& c) { c.altitude_max_m -= 0.01; });
    expect("claims altitude_min_m = ", [](ActCertificate& c) { c.altitude_min_m += 0.01; });
    expect("claims geofence_margin_m = ", [](ActCertificate& c) { *c.geofence_margin_m *= 1.02; });
    expect("claims audience_margin_m = ", [](ActCertificate& c) { *c.audience_margin_m *= 1.02; });
    expect("claims obstacle_margin_m = ", [](ActCertificate& c) { *c.obstacle_margin_m *= 1.02; });
    expect("requires a separation of 1.5 m; the limits require 1.55",
           [](ActCertificate& c) { c.required_separation_m = 1.5; });
    EXPECT_THAT(problems_of_certificate(1, [](ActCertificate& c) { c.separation.lower_bound_m += 0.1; }),
                ElementsAre(HasSubstr("certificate.json: act \"to A\" claims a separation of ")));
    // The planner certifies to 1e-5 m.
    EXPECT_THAT(problems_of_certificate(
                    1, [](ActCertificate& c) { c.separation.lower_bound_m = c.required_separation_m - 0.9e-5; }),
                IsEmpty());
    EXPECT_THAT(problems_of_certificate(
                    1, [](ActCertificate& c) { c.separation.lower_bound_m = c.required_separation_m - 2e-5; }),
                ElementsAre(HasSubstr("is certified with a separation of 1.549980 m; it requires 1.550000")));
    // Milder than the truth is no lie.
    EXPECT_THAT(problems_of_certificate(3,
                                        [](ActCertificate& c) {
                                            c.extremes = {9.0, 9.0, 9.0, 9.0, 90.0};
                                            c.altitude_min_m = 0.0;
                                            c.altitude_max_m = 90.0;
                                            c.geofence_margin_m = c.audience_margin_m = c.obstacle_margin_m = 0.25;
                                        }),
                IsEmpty());
}

TEST(VerifyFolder, CertificatesClosestPairIsLookedAt) {
    using planner::ActCertificate, planner::Encounter;
    ASSERT_TRUE(honest_show().certificate.acts[1].separation.closest.has_value());
    const std::string act = "certificate.json: act \"to A\" ";
    const auto expect = [&](const std::string& problem, auto change) {
        const auto problems = problems_of_certificate(1, [&](ActCertificate& c) { change(*c.separation.closest); });
        EXPECT_THAT(problems, ElementsAre(HasSubstr(act + problem)));
    };
    expect("says that drones 1 and 2 are ", [](Encounter& e) { e.distance_m += 0.001; });
    expect("says that drones 1 and 2 are ", [](Encounter& e) { e.time_s += 4.0; });
    expect("says that drones 1 and 3 are ", [](Encounter& e) { e.second = DroneId(2); });
    expect("names drones 1 and 1 as the closest of 3", [](Encounter& e) { e.second = DroneId(0); });
    expect("names drones 1 and 10 as the closest of 3", [](Encounter& e) { e.second = DroneId(9); });
    expect("names a closest pair at ", [](Encounter& e) { e.time_s += 40.0; });
}

// A show turned by a few degrees about its origin flies through the fence.
TEST(VerifyFolder, OriginInAnyFormatIsTheManifests) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder, {"skyc"});
    EXPECT_THAT(verified(folder).problems, IsEmpty());
    const std::string intact = read_file(folder / kManifestName).value();
    const auto problems_after = [&](auto change) {
        rewrite_manifest(folder, change);
        std::vector<std::string> problems = verified(folder).problems;
        EXPECT_TRUE(write_file(folder / kManifestName, intact).ok());
        return problems;
    };
    EXPECT_THAT(problems_after([](Manifest& m) { m.origin.heading_deg += 7.0; }),
                ElementsAre(HasSubstr("show.skyc: the origin's heading is 20, in the manifest 27")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.origin.heading_deg += 0.001; }),
                ElementsAre(HasSubstr("the origin's heading is 20, in the manifest 20.001")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.origin.heading_deg -= 360.0; }), IsEmpty());
    EXPECT_THAT(problems_after([](Manifest& m) { m.origin.ground.latitude_deg += 2e-7; }),
                ElementsAre(HasSubstr("the origin's latitude is 35.6586")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.origin.ground.longitude_deg -= 2e-7; }),
                ElementsAre(HasSubstr("the origin's longitude is 139.7454")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.origin.ground.latitude_deg += 0.5e-7; }), IsEmpty());
    EXPECT_THAT(problems_after([](Manifest& m) { m.origin.ground.height_m += 0.002; }),
                ElementsAre(HasSubstr("the origin's height is ")));
    EXPECT_THAT(problems_after([](Manifest& m) { m.origin.geoid_undulation_m.reset(); }),
                Contains(HasSubstr("the origin's geoid undulation is 36.7")));
}

// In a folder nobody stands on the ground but at the pads of the manifest, whatever a file leaves out.
TEST(VerifyFolder, FilesWithoutHomesAreJudgedByTheManifestsPads) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder, {"csv"});
    EXPECT_TRUE(verified(folder).held());
    rewrite_manifest(folder, [](Manifest& m) { m.drones[1].pad_m.z -= 3.0; });
    const Verified moved = verified(folder);
    ASSERT_EQ(moved.shows.size(), 1U);
    const auto pads = std::ranges::find(moved.shows[0].findings, "pads", &Finding::rule);
    ASSERT_NE(pads, moved.shows[0].findings.end());
    EXPECT_FALSE(pads->held);
    EXPECT_THAT(pads->drones, ElementsAre(2U));
    const Judgement alone = verified(folder / "csv.zip").shows.at(0);  // the manifest lies beside it
    EXPECT_TRUE(std::ranges::any_of(alone.findings, [](const Finding& f) { return f.rule == "pads" && !f.held; }));
}

TEST(VerifyFolder, BrokenLimitsAreFindings) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    planner::FlightPlan plan = honest_show();
    plan.limits.speed_horizontal_mps = 0.5;
    ASSERT_TRUE(export_show(plan, folder,
                            {.formats = std::vector<std::string>{"trajectories"}, .best_effort = true, .drones = {}},
                            PlainRun{})
                    .ok());
    const Verified result = verified(folder);
    EXPECT_FALSE(result.held());
    EXPECT_THAT(result.problems, ElementsAre(HasSubstr("manifest.json: says that this show is not certified")));
    ASSERT_EQ(result.shows.size(), 1U);
    for (const Finding& finding : result.shows[0].findings) EXPECT_EQ(finding.held, finding.rule != "speed_horizontal");
}

TEST(VerifyFile, IsJudgedByWhatItHolds) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder, {"trajectories"});
    const fs::path file = folder / "trajectories.bin";
    const Verified inside = verified(file);
    EXPECT_TRUE(inside.held());
    ASSERT_EQ(inside.shows.size(), 1U);
    EXPECT_EQ(inside.shows[0].limits_from, "the manifest beside it");

    fs::create_directory(scratch.path() / "alone");
    const fs::path alone = scratch.path() / "alone" / "trajectories.bin";
    fs::copy_file(file, alone);
    const Verified result = verified(alone);
    EXPECT_TRUE(result.held());
    EXPECT_EQ(result.shows.at(0).limits_from, "the file");

    const fs::path cut = scratch.path() / "trajectories.bin";
    ASSERT_TRUE(write_file(cut, read_file(file).value().substr(0, 500)).ok());
    const auto damaged = verify_path(cut, PlainRun{});
    ASSERT_FALSE(damaged.ok());
    EXPECT_EQ(damaged.error().code, ErrorCode::invalid_input);
    EXPECT_THAT(damaged.error().message, StartsWith(cut.string() + ": "));
}

TEST(VerifyFile, ChangedFileInsideItsFolderIsNoticed) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder, {"csv"});
    std::string bytes = read_file(folder / "csv.zip").value();
    bytes.push_back('\n');
    ASSERT_TRUE(write_file(folder / "csv.zip", bytes).ok());
    const auto result = verify_path(folder / "csv.zip", PlainRun{});
    EXPECT_FALSE(result.ok() && result->held());
}

TEST(VerifyFile, UncertifiedFileDoesNotHoldWhateverItsNumbers) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    planner::FlightPlan plan = honest_show();
    plan.certificate.violations = {"the show lasts too long"};
    ASSERT_TRUE(export_show(plan, folder,
                            {.formats = std::vector<std::string>{"trajectories"}, .best_effort = true, .drones = {}},
                            PlainRun{})
                    .ok());
    fs::create_directory(scratch.path() / "alone");
    fs::copy_file(folder / "trajectories.bin", scratch.path() / "alone" / "trajectories.bin");
    const Verified result = verified(scratch.path() / "alone" / "trajectories.bin");
    EXPECT_THAT(result.shows.at(0).problems, ElementsAre(HasSubstr("not certified")));
}

// Two drones that hover 0.3 m apart for a minute passed: a CSV's first row was taken for its home.
TEST(VerifyFile, CsvOfDronesThatOnlyHoverHasNoGround) {
    const fixed::ScratchFolder scratch;
    const fs::path file = scratch.path() / "csv.zip";
    const auto csv = [](const std::string& place) {
        std::string rows = "Time [msec],x [m],y [m],z [m],Red,Green,Blue\n";
        for (int t = 0; t <= 60'000; t += 250) rows += std::to_string(t) + "," + place + ",0,0,0\n";
        return rows;
    };
    const auto found_at = [&](const std::string& one, const std::string& other) {
        const std::vector<FileBytes> entries{{"a.csv", csv(one)}, {"b.csv", csv(other)}};
        EXPECT_TRUE(write_file(file, zip_bytes(entries).value()).ok());
        return verified(file).shows.at(0);
    };
    const Judgement hovering = found_at("0,0,30", "0.3,0,30");
    EXPECT_FALSE(hovering.held());
    EXPECT_NEAR(hovering.closest_m, 0.3, 1e-9);
    EXPECT_TRUE(found_at("0,0,0", "0.3,0,0").held());  // on the ground
}

TEST(VerifyFile, UnknownAndMissingFilesAreErrors) {
    const fixed::ScratchFolder scratch;
    const fs::path file = scratch.path() / "notes.txt";
    ASSERT_TRUE(write_file(file, "hello").ok());
    const auto unknown = verify_path(file, PlainRun{});
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.error().message, file.string() + ": not a format that can be read");
    const auto missing = verify_path(scratch.path() / "nothing", PlainRun{});
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().code, ErrorCode::io);
}

}  // namespace
}  // namespace aerogram::exporter
