#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "export/certificate_json.hpp"
#include "export/export_show.hpp"
#include "export/files.hpp"
#include "export/manifest_json.hpp"
#include "export/sha256.hpp"
#include "export/verify_agreement.hpp"
#include "export/verify_show.hpp"
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

/// The fixed show with separations in its certificate that it has.
planner::FlightPlan honest_show() {
    planner::FlightPlan plan = fixed::show();
    for (std::size_t a = 0; a < plan.certificate.acts.size(); ++a) {
        plan.certificate.acts[a].separation.lower_bound_m = 2.0 + 0.0625 * static_cast<double>(a);
    }
    return plan;
}

/// That show exported into a folder. @param formats  empty: all.
void export_fixed(const fs::path& folder, const std::vector<std::string>& formats = {}) {
    const auto exported = export_show(honest_show(), folder, formats, false, PlainRun{});
    ASSERT_TRUE(exported.ok()) << exported.error().message;
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

/// Replaces text in a file and makes the manifest agree with its bytes.
void forge(const fs::path& folder, const std::string& name, const std::string& from, const std::string& to) {
    std::string bytes = read_file(folder / name).value();
    const std::size_t at = bytes.find(from);
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, from.size(), to);
    ASSERT_TRUE(write_file(folder / name, bytes).ok());
    rewrite_manifest(folder, [&](Manifest& manifest) {
        const auto file = std::ranges::find(manifest.files, name, &ManifestFile::path);
        ASSERT_NE(file, manifest.files.end());
        file->bytes = bytes.size();
        file->sha256 = sha256_hex(bytes);
    });
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

TEST(VerifyFolder, CertificateMayNotClaimMoreThanTheTrajectoriesHave) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder, {"trajectories"});
    forge(folder, "certificate.json", "\"min_separation_m\": 2.0625", "\"min_separation_m\": 6.0625");
    EXPECT_THAT(verified(folder).problems,
                ElementsAre(HasSubstr("certificate.json: act \"to A\" claims a separation of 6.062 m")));
}

TEST(VerifyFolder, BrokenLimitsAreFindings) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    planner::FlightPlan plan = honest_show();
    plan.limits.speed_horizontal_mps = 0.5;
    ASSERT_TRUE(export_show(plan, folder, std::vector<std::string>{"trajectories"}, true, PlainRun{}).ok());
    const Verified result = verified(folder);
    EXPECT_FALSE(result.held());
    EXPECT_THAT(result.problems, IsEmpty());
    ASSERT_EQ(result.shows.size(), 1U);
    for (const Finding& finding : result.shows[0].findings) EXPECT_EQ(finding.held, finding.rule != "speed_horizontal");
}

TEST(VerifyFile, IsJudgedByWhatItHolds) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    export_fixed(folder, {"trajectories"});
    const fs::path file = folder / "trajectories.bin";
    const Verified result = verified(file);
    EXPECT_TRUE(result.held());
    ASSERT_EQ(result.shows.size(), 1U);
    EXPECT_EQ(result.shows[0].limits_from, "the file");

    const fs::path cut = scratch.path() / "trajectories.bin";
    ASSERT_TRUE(write_file(cut, read_file(file).value().substr(0, 500)).ok());
    const auto damaged = verify_path(cut, PlainRun{});
    ASSERT_FALSE(damaged.ok());
    EXPECT_EQ(damaged.error().code, ErrorCode::invalid_input);
    EXPECT_THAT(damaged.error().message, StartsWith(cut.string() + ": "));
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

/// One drone, 10 m along x in 10 s, 5 cm of rounding.
RecordedShow line_show(double shift_m) {
    RecordedShow show;
    show.format = "lines";
    show.duration_s = 10.0;
    show.rounding.fit_m = 0.05;
    RecordedDrone drone;
    drone.controls_m = {{shift_m, 0, 10}, {10 + shift_m, 0, 10}};
    drone.pieces = {{0.0, 10.0, 0, 1}};
    show.drones = {drone};
    return show;
}

TEST(DisagreementOfShows, IsBeyondTheSumOfTheRoundings) {
    const geo::ShowOrigin origin{{35.0, 139.0, 40.0}, 20.0, {}};
    EXPECT_THAT(disagreement_of_shows(line_show(0.0), line_show(0.0999), Limits{}, origin), IsEmpty());
    EXPECT_THAT(disagreement_of_shows(line_show(0.0), line_show(0.11), Limits{}, origin),
                ElementsAre(StartsWith("drone 1 at 0 s is 0.11 m from where lines has it (0.1 m may differ)")));
}

TEST(DisagreementOfShows, WaypointsLieOnTheTrajectory) {
    const geo::ShowOrigin origin{{35.0, 139.0, 40.0}, 20.0, {}};
    const geo::ShowFrame frame(origin);
    RecordedShow reference = line_show(0.0), mission;
    reference.drones[0].home_m = Vec3{0, 0, 0};
    mission.timed = false;
    RecordedDrone drone;
    drone.home = frame.to_geodetic({0, 0, 0});
    drone.home->height_m = 0.0;  // unknown to the format
    drone.waypoints = {{frame.to_geodetic({10, 0, 10}), 10.0, 1.0, Waypoint::Kind::fly_to}};
    mission.drones = {drone};
    EXPECT_THAT(disagreement_of_shows(reference, mission, Limits{}, origin), IsEmpty());
    mission.drones[0].waypoints[0].altitude_above_home_m = 10.2;
    EXPECT_THAT(disagreement_of_shows(reference, mission, Limits{}, origin),
                ElementsAre(StartsWith("drone 1: waypoint 1 is 0.2 m from where lines goes")));
}

}  // namespace
}  // namespace aerogram::exporter
