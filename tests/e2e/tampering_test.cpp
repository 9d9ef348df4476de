#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "export/bytes/files.hpp"
#include "export/export_show.hpp"
#include "export/verify_folder.hpp"
#include "planner/mission/mission_reader.hpp"
#include "planner/plan.hpp"
#include "tests/unit/export/written_files.hpp"

/// Every file of a planned show, one random byte changed at a time: what `verify` looks at first names the file.
namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;

constexpr int kTimes = 500;
constexpr unsigned kSeed = 5;
const aerogram::Run kRun{};

void put(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Whether the folder's check names the file. @param listing  of the folder when it was whole.
bool is_noticed(const fs::path& folder, const FolderListing& listing, const ManifestFile& file) {
    if (file.path == kManifestName) {
        const auto now = list_show_folder(folder);
        return !now && now.error().message.find(kManifestName) != std::string::npos;
    }
    const auto intact = intact_files(folder, listing, file.format, kRun);
    return intact.ok() && intact->files.empty() && intact->problems.size() == 1 &&
           intact->problems.front().starts_with((folder / file.path).string() + ": ");
}

/// In how many of kTimes one changed byte of the file is noticed; afterwards it is as it was.
int times_noticed(const fs::path& folder, FolderListing listing, const ManifestFile& file, std::mt19937& random) {
    listing.manifest.files = {file};  // the others are not read again every time
    const std::string bytes = read_file(folder / file.path).value();
    int noticed = 0;
    for (int k = 0; k < kTimes; ++k) {
        std::string changed = bytes;
        char& byte = changed[random() % changed.size()];
        byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U + random() % 255U));
        put(folder / file.path, changed);
        noticed += is_noticed(folder, listing, file) ? 1 : 0;
    }
    put(folder / file.path, bytes);
    return noticed;
}

TEST(Tampering, EachFileFiveHundredTimes) {
    const auto mission = planner::read_mission(fs::path(AEROGRAM_SOURCE_DIR) / "missions/the-end.toml");
    ASSERT_TRUE(mission.ok());
    const auto plan = planner::plan(*mission, {}, kRun);
    ASSERT_TRUE(plan.ok());
    const ScratchFolder scratch;
    const fs::path folder = scratch.path() / "show";
    ASSERT_TRUE(export_show(*plan, folder, {}, kRun).ok());
    const auto listing = list_show_folder(folder);
    ASSERT_TRUE(listing.ok() && listing->problems.empty());
    std::vector<ManifestFile> files = listing->manifest.files;
    files.push_back({std::string(kManifestName), "manifest", 0, "", std::nullopt, std::nullopt});
    std::mt19937 random(kSeed);
    for (const ManifestFile& file : files)
        EXPECT_EQ(times_noticed(folder, *listing, file, random), kTimes) << file.path << ", seed " << kSeed;
    EXPECT_TRUE(list_show_folder(folder)->problems.empty());
}

}  // namespace
}  // namespace aerogram::exporter
