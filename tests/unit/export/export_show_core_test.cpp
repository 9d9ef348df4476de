#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "export/bytes/files.hpp"
#include "export/bytes/sha256.hpp"
#include "export/certificate_json.hpp"
#include "export/exact/show_hash.hpp"
#include "export/export_show.hpp"
#include "export/formats.hpp"
#include "export/manifest_json.hpp"
#include "export/verify_agreement.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/scratch_folder.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::vector<std::string> kExact{"trajectories"};

std::map<std::string, std::string> contents(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_directory()) files[fs::relative(entry.path(), folder).string()] = *read_file(entry.path());
    }
    return files;
}

/// A show whose drones 1 and 2 meet head-on at B.
planner::FlightPlan colliding() {
    planner::FlightPlan plan = fixed::show();
    for (planner::Act& act : plan.acts) {
        if (act.name == "B") std::get<planner::Hold>(act.motion).positions_m[1] = fixed::formation_b()[0];
    }
    return plan;
}

TEST(DroneName, HasThreeDigitsOrAsManyAsTheFleetNeeds) {
    EXPECT_EQ(drone_name(1, 10), "drone-001");
    EXPECT_EQ(drone_name(42, 999), "drone-042");
    EXPECT_EQ(drone_name(42, 1'000), "drone-0042");
    EXPECT_EQ(drone_name(10'000, 10'000), "drone-10000");
}

TEST(Formats, AreCompleteAndNamedOnce) {
    std::set<std::string_view> names;
    for (const Format& format : formats()) {
        EXPECT_TRUE(names.insert(format.name).second) << format.name;
        EXPECT_EQ(find_format(format.name), &format);
        EXPECT_FALSE(format.description.empty());
        EXPECT_TRUE(format.write != nullptr && format.read != nullptr && format.recognises != nullptr &&
                    format.unsuited != nullptr);
    }
    EXPECT_EQ(formats().front().name, "trajectories");
    EXPECT_EQ(find_format("nothing"), nullptr);
    EXPECT_EQ(recognise("notes.txt", "just words"), nullptr);
}

TEST(ExportShow, WritesEveryFormatWithItsHashes) {
    const fixed::ScratchFolder scratch;
    const planner::FlightPlan plan = fixed::show();
    const auto exported =
        export_show(plan, scratch.path() / "show", {.formats = {}, .best_effort = false, .drones = {}}, {});
    ASSERT_TRUE(exported.ok()) << exported.error().message;
    EXPECT_EQ(exported->show_hash, show_hash(plan));
    EXPECT_TRUE(exported->certified);
    ASSERT_EQ(exported->formats.size(), formats().size());

    auto files = contents(scratch.path() / "show");
    const auto manifest = read_manifest(files["manifest.json"]);
    ASSERT_TRUE(manifest.ok()) << manifest.error().message;
    EXPECT_EQ(manifest->show_hash, exported->show_hash);
    EXPECT_TRUE(manifest->certified);
    EXPECT_EQ(manifest->limits.min_separation_m, plan.limits.min_separation_m);
    EXPECT_EQ(manifest->drones[2].pad_m, plan.pads_m[2]);
    ASSERT_EQ(manifest->files.size() + 1, files.size()) << "every file but the manifest is listed";
    for (const ManifestFile& file : manifest->files) {
        ASSERT_TRUE(files.contains(file.path)) << file.path;
        EXPECT_EQ(file.bytes, files[file.path].size());
        EXPECT_EQ(file.sha256, sha256_hex(files[file.path])) << file.path;
        EXPECT_EQ(file.timing.has_value(), !is_paper(file.format)) << file.path;
        if (file.min_separation_m) {
            EXPECT_GE(*file.min_separation_m, plan.limits.min_separation_m) << file.path;
        }
    }
    const auto certificate = read_certificate(files["certificate.json"]);
    ASSERT_TRUE(certificate.ok()) << certificate.error().message;
    EXPECT_EQ(certificate->show_hash, exported->show_hash);
    EXPECT_TRUE(certificate->certified);
}

TEST(ExportShow, EveryFormatRecognisesItsOwnFiles) {
    const fixed::ScratchFolder scratch;
    const auto exported =
        export_show(fixed::show(), scratch.path() / "show", {.formats = {}, .best_effort = false, .drones = {}}, {});
    ASSERT_TRUE(exported.ok()) << exported.error().message;
    const auto files = contents(scratch.path() / "show");
    for (const ExportedFormat& format : exported->formats) {
        EXPECT_EQ(format.files.empty(), !format.skipped.empty()) << format.name;
        for (const std::string& path : format.files) {
            const Format* recognised = recognise(path, files.at(path));
            ASSERT_NE(recognised, nullptr) << path;
            EXPECT_EQ(recognised->name, format.name) << path;
        }
    }
}

TEST(ExportShow, SameShowGivesTheSameBytesOnAnyNumberOfThreads) {
    const fixed::ScratchFolder scratch;
    aerogram::Run two;
    two.threads = 2;
    ASSERT_TRUE(
        export_show(fixed::show(), scratch.path() / "one", {.formats = {}, .best_effort = false, .drones = {}}, {})
            .ok());
    ASSERT_TRUE(
        export_show(fixed::show(), scratch.path() / "two", {.formats = {}, .best_effort = false, .drones = {}}, two)
            .ok());
    EXPECT_EQ(contents(scratch.path() / "one"), contents(scratch.path() / "two"));
}

TEST(ExportShow, OnlyTheNamedFormatsAreWritten) {
    const fixed::ScratchFolder scratch;
    const auto exported = export_show(fixed::show(), scratch.path() / "show",
                                      {.formats = kExact, .best_effort = false, .drones = {}}, {});
    ASSERT_TRUE(exported.ok()) << exported.error().message;
    ASSERT_EQ(exported->formats.size(), 1U);
    EXPECT_EQ(contents(scratch.path() / "show").size(), 3U);
    const std::vector<std::string> unknown{"trajectories", "skyk"};
    const auto refused = export_show(fixed::show(), scratch.path() / "show",
                                     {.formats = unknown, .best_effort = false, .drones = {}}, {});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
    EXPECT_THAT(refused.error().message, HasSubstr("no format is named \"skyk\"; there are: trajectories"));
}

// Replacing a folder deletes what is in it: a web page's manifest.json once passed for ours.
TEST(ExportShow, ForeignFilesAreNeverReplaced) {
    const fixed::ScratchFolder scratch;
    const fs::path site = scratch.path() / "site", own = scratch.path() / "own";
    ASSERT_TRUE(write_file(site / "manifest.json", R"({"name": "a web page"})").ok());
    ASSERT_TRUE(write_file(site / "src" / "a.js", "x").ok());
    const auto before = contents(site);
    const auto refused = export_show(fixed::show(), site, {.formats = kExact, .best_effort = false, .drones = {}}, {});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
    EXPECT_THAT(refused.error().message, HasSubstr("no show folder written by aerogram"));
    EXPECT_EQ(contents(site), before);

    ASSERT_TRUE(export_show(fixed::show(), own, {.formats = kExact, .best_effort = false, .drones = {}}, {}).ok());
    ASSERT_TRUE(write_file(own / "notes" / "mine.txt", "mine").ok());
    const auto noted = export_show(fixed::show(), own, {.formats = kExact, .best_effort = false, .drones = {}}, {});
    ASSERT_FALSE(noted.ok());
    EXPECT_THAT(noted.error().message, HasSubstr("holds notes/mine.txt, which aerogram did not write"));
    EXPECT_TRUE(fs::exists(own / "notes" / "mine.txt"));
}

TEST(ExportShow, FilesThatBreakALimitAreNotKept) {
    const fixed::ScratchFolder scratch;
    ASSERT_TRUE(
        export_show(fixed::show(), scratch.path() / "show", {.formats = kExact, .best_effort = false, .drones = {}}, {})
            .ok());
    const auto before = contents(scratch.path());
    const auto exported =
        export_show(colliding(), scratch.path() / "show", {.formats = kExact, .best_effort = false, .drones = {}}, {});
    ASSERT_FALSE(exported.ok());
    EXPECT_EQ(exported.error().code, ErrorCode::infeasible);
    EXPECT_THAT(exported.error().message, HasSubstr("trajectories: separation 0, limit 1.5, drones 1 2, at "));
    EXPECT_THAT(exported.error().message, HasSubstr("show-refused/report.html"));
    auto after = contents(scratch.path());
    for (const char* report : {"report.html", "report.json", "report.pdf"})
        EXPECT_EQ(after.erase(std::string("show-refused/") + report), 1U) << "a refused show has its report";
    EXPECT_TRUE(after == before) << "the destination is as it was, and nothing else lies beside it";
    ASSERT_TRUE(
        export_show(fixed::show(), scratch.path() / "show", {.formats = kExact, .best_effort = false, .drones = {}}, {})
            .ok());
    EXPECT_TRUE(contents(scratch.path()) == before) << "a show that is not refused has none";
}

// "altitude_max 120, limit 120" was said of a show that was refused.
TEST(ExportShow, BrokenLimitIsSaidWithTheDigitsThatTellItFromWhatWasFound) {
    const fixed::ScratchFolder scratch;
    planner::FlightPlan plan = fixed::show();
    plan.limits.ceiling_m = 20.8721;  // flown: 20.875 m above the third pad, and the curve of the earth
    const auto exported = export_show(plan, scratch.path() / "show",
                                      {.formats = kExact, .best_effort = false, .drones = {}}, aerogram::Run{});
    ASSERT_FALSE(exported.ok());
    EXPECT_THAT(exported.error().message, HasSubstr("trajectories: altitude_max 20.875, limit 20.872, drone 3, at "));
    plan.limits.ceiling_m = 20.8742;
    EXPECT_TRUE(export_show(plan, scratch.path() / "show", {.formats = kExact, .best_effort = false, .drones = {}},
                            aerogram::Run{})
                    .ok());  // within 1 mm
    plan.limits = Limits{};
    plan.limits.speed_up_mps = 1.4931;
    const auto speed = export_show(plan, scratch.path() / "show",
                                   {.formats = kExact, .best_effort = false, .drones = {}}, aerogram::Run{});
    ASSERT_FALSE(speed.ok());
    EXPECT_THAT(speed.error().message, HasSubstr("trajectories: speed_up 1.49"));
    EXPECT_THAT(speed.error().message, HasSubstr(", limit 1.4931, drone 3, at "));
}

TEST(ExportShow, BestEffortMarksEveryFileAsUncertified) {
    const fixed::ScratchFolder scratch;
    const auto exported =
        export_show(colliding(), scratch.path() / "show", {.formats = kExact, .best_effort = true, .drones = {}}, {});
    ASSERT_TRUE(exported.ok()) << exported.error().message;
    EXPECT_FALSE(exported->certified);
    EXPECT_FALSE(exported->formats[0].judgement.held());
    auto files = contents(scratch.path() / "show");
    EXPECT_FALSE(read_manifest(files["manifest.json"])->certified);
    EXPECT_FALSE(read_certificate(files["certificate.json"])->certified);
    EXPECT_EQ(files["trajectories.bin"][16], '\0');
}

TEST(ExportShow, APlanThatIsNotCertifiedNeedsBestEffort) {
    const fixed::ScratchFolder scratch;
    planner::FlightPlan plan = fixed::show();
    plan.certificate.violations = {"endurance"};
    EXPECT_EQ(export_show(plan, scratch.path() / "show", {.formats = kExact, .best_effort = false, .drones = {}}, {})
                  .error()
                  .code,
              ErrorCode::infeasible);
    const auto exported =
        export_show(plan, scratch.path() / "show", {.formats = kExact, .best_effort = true, .drones = {}}, {});
    ASSERT_TRUE(exported.ok()) << exported.error().message;
    EXPECT_FALSE(exported->certified);
}

TEST(ExportShow, StopsWhenAsked) {
    const fixed::ScratchFolder scratch;
    std::stop_source source;
    aerogram::Run run;
    run.stop = source.get_token();
    std::vector<std::string> stages;
    run.progress = [&](std::string_view stage, double) {
        stages.emplace_back(stage);
        if (stage == "exporting") source.request_stop();
    };
    const auto exported = export_show(fixed::show(), scratch.path() / "show",
                                      {.formats = kExact, .best_effort = false, .drones = {}}, run);
    ASSERT_FALSE(exported.ok());
    EXPECT_EQ(exported.error().code, ErrorCode::stopped);
    EXPECT_TRUE(contents(scratch.path()).empty());
    EXPECT_EQ(stages.front(), "exporting");
    EXPECT_EQ(stages.back(), "exporting");
}

TEST(ExportShow, ForeignFoldersAreKept) {
    const fixed::ScratchFolder scratch;
    ASSERT_TRUE(write_file(scratch.path() / "thesis/chapter-1", "irreplaceable").ok());
    const auto exported = export_show(fixed::show(), scratch.path() / "thesis",
                                      {.formats = kExact, .best_effort = false, .drones = {}}, {});
    EXPECT_EQ(exported.error().code, ErrorCode::invalid_input);
    EXPECT_EQ(contents(scratch.path()).size(), 1U);
}

}  // namespace
}  // namespace aerogram::exporter
