#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <set>
#include <utility>

#include "export/bytes/files.hpp"
#include "tests/unit/export/scratch_folder.hpp"

namespace aerogram::exporter {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kFiles = 8;
const fs::path kNames[kFiles] = {"a", "b", "sub/c", "sub/d", "sub/deeper/e", "f", "g", "manifest.json"};

/// Fills a folder whose every file holds the generation's number; the manifest comes last, as in an export.
bool fill(const fs::path& folder, int generation) {
    const std::string bytes = std::to_string(generation) + std::string(5'000, '.');
    for (const fs::path& name : kNames) {
        if (!write_file(folder / name, bytes)) return false;
    }
    return true;
}

/// The generation a complete folder holds; -1 when files are missing or of different generations.
int generation_of(const fs::path& folder) {
    std::set<std::string> seen;
    int files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_directory()) continue;
        const auto bytes = read_file(entry.path());
        if (!bytes.ok() || bytes->size() < 5'001) return -1;
        seen.insert(*bytes);
        ++files;
    }
    return files == kFiles && seen.size() == 1 ? std::atoi(seen.begin()->c_str()) : -1;
}

std::size_t entries_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

Status write_generation(const fs::path& destination, int generation) {
    auto staged = StagedFolder::beside(destination);
    if (!staged) return staged.error();
    if (!fill(staged->path(), generation)) return Error{ErrorCode::io, "cannot fill"};
    return staged->commit();
}

TEST(Files, BytesComeBack) {
    const fixed::ScratchFolder scratch;
    const std::string bytes("\0\1\xff text", 8);
    ASSERT_TRUE(write_file(scratch.path() / "new/folders/file", bytes).ok());
    EXPECT_EQ(*read_file(scratch.path() / "new/folders/file"), bytes);
    ASSERT_TRUE(write_file(scratch.path() / "new/folders/file", "short").ok());
    EXPECT_EQ(*read_file(scratch.path() / "new/folders/file"), "short");
}

TEST(Files, ErrorsNameTheFile) {
    const fixed::ScratchFolder scratch;
    const std::string missing = (scratch.path() / "missing").string();
    EXPECT_EQ(read_file(missing).error().code, ErrorCode::io);
    EXPECT_EQ(read_file(missing).error().message, missing + ": cannot be opened: No such file or directory");
    EXPECT_EQ(read_file(scratch.path()).error().message, scratch.path().string() + ": not a regular file");
    ASSERT_TRUE(write_file(scratch.path() / "file", "12345").ok());
    EXPECT_EQ(read_file(scratch.path() / "file", 4).error().code, ErrorCode::invalid_input);
    EXPECT_THAT(read_file(scratch.path() / "file", 4).error().message, HasSubstr("5 bytes; at most 4 are read"));
    EXPECT_EQ(write_file(scratch.path() / "file/below", "x").error().code, ErrorCode::io);
    EXPECT_EQ(write_file(scratch.path(), "x").error().code, ErrorCode::io);
}

TEST(ReplaceFile, CreatesFoldersReplacesAndLeavesNothingBeside) {
    const fixed::ScratchFolder scratch;
    const fs::path file = scratch.path() / "new" / "picture.png";
    ASSERT_TRUE(replace_file(file, "first").ok());
    ASSERT_TRUE(replace_file(file, std::string(100'000, 'x')).ok());
    EXPECT_EQ(*read_file(file), std::string(100'000, 'x'));
    EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1);
}

TEST(ReplaceFile, ALinkStaysALink) {
    const fixed::ScratchFolder scratch;
    const fs::path file = scratch.path() / "real.png", link = scratch.path() / "link.png";
    ASSERT_TRUE(write_file(file, "old").ok());
    fs::create_symlink("real.png", link);
    ASSERT_TRUE(replace_file(link, "new").ok());
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(*read_file(file), "new");
}

TEST(ReplaceFile, WhatCannotBeReplacedStays) {
    const fixed::ScratchFolder scratch;
    const fs::path folder = scratch.path() / "folder";
    fs::create_directory(folder);
    ASSERT_TRUE(write_file(folder / "inside", "kept").ok());
    const auto refused = replace_file(folder, "bytes");
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::io);
    EXPECT_THAT(refused.error().message, HasSubstr(folder.string()));
    EXPECT_EQ(*read_file(folder / "inside"), "kept");
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), {}), 1);
    EXPECT_FALSE(replace_file("/proc/none/picture.png", "bytes").ok());
}

TEST(StagedFolder, CommitCreatesThenReplaces) {
    const fixed::ScratchFolder scratch;
    const fs::path show = scratch.path() / "out/show";
    ASSERT_TRUE(write_generation(show, 1).ok());
    EXPECT_EQ(generation_of(show), 1);
    ASSERT_TRUE(write_generation(show, 2).ok());
    EXPECT_EQ(generation_of(show), 2);
    EXPECT_EQ(entries_in(show.parent_path()), 1U) << "nothing is left beside it";
}

TEST(StagedFolder, WithoutCommitNothingChanges) {
    const fixed::ScratchFolder scratch;
    const fs::path show = scratch.path() / "show";
    ASSERT_TRUE(write_generation(show, 1).ok());
    {
        auto staged = StagedFolder::beside(show);
        ASSERT_TRUE(staged.ok());
        ASSERT_TRUE(fill(staged->path(), 2));
        StagedFolder moved = std::move(*staged);
        EXPECT_EQ(generation_of(moved.path()), 2);
    }
    EXPECT_EQ(generation_of(show), 1);
    EXPECT_EQ(entries_in(scratch.path()), 1U);
}

TEST(StagedFolder, AnEmptyDestinationIsReplaced) {
    const fixed::ScratchFolder scratch;
    fs::create_directory(scratch.path() / "show");
    ASSERT_TRUE(write_generation(scratch.path() / "show/", 1).ok());
    EXPECT_EQ(generation_of(scratch.path() / "show"), 1);
}

TEST(StagedFolder, ForeignFoldersAndFilesAreRefused) {
    const fixed::ScratchFolder scratch;
    ASSERT_TRUE(write_file(scratch.path() / "thesis/chapter-1", "irreplaceable").ok());
    for (const char* name : {"thesis", "thesis/chapter-1"}) {
        const auto staged = StagedFolder::beside(scratch.path() / name);
        ASSERT_FALSE(staged.ok());
        EXPECT_EQ(staged.error().code, ErrorCode::invalid_input);
        EXPECT_THAT(staged.error().message, HasSubstr("exists and is no folder written by aerogram"));
    }
    EXPECT_EQ(StagedFolder::beside("/").error().code, ErrorCode::invalid_input);
    EXPECT_EQ(*read_file(scratch.path() / "thesis/chapter-1"), "irreplaceable");
}

// A folder that becomes foreign while the show is computed must not be swallowed by the commit either.
TEST(StagedFolder, AFolderThatAppearsMeanwhileIsKept) {
    const fixed::ScratchFolder scratch;
    auto staged = StagedFolder::beside(scratch.path() / "show");
    ASSERT_TRUE(staged.ok());
    ASSERT_TRUE(fill(staged->path(), 1));
    ASSERT_TRUE(write_file(scratch.path() / "show/notes", "mine").ok());
    EXPECT_FALSE(staged->commit().ok());
    EXPECT_EQ(*read_file(scratch.path() / "show/notes"), "mine");
}

TEST(StagedFolder, ALinkStaysALink) {
    const fixed::ScratchFolder scratch;
    ASSERT_TRUE(write_generation(scratch.path() / "real", 1).ok());
    fs::create_directory_symlink("real", scratch.path() / "link");
    ASSERT_TRUE(write_generation(scratch.path() / "link", 2).ok());
    EXPECT_TRUE(fs::is_symlink(scratch.path() / "link"));
    EXPECT_EQ(generation_of(scratch.path() / "real"), 2);
}

TEST(StagedFolder, LivingFoldersAreNobodysLeftovers) {
    const fixed::ScratchFolder scratch;
    const fs::path show = scratch.path() / "show";
    auto first = StagedFolder::beside(show);
    ASSERT_TRUE(first.ok());
    ASSERT_TRUE(fill(first->path(), 1));
    ASSERT_TRUE(write_generation(show, 2).ok());
    EXPECT_EQ(generation_of(first->path()), 1) << "still there while its owner lives";
    ASSERT_TRUE(first->commit().ok());
    EXPECT_EQ(generation_of(show), 1);
    EXPECT_EQ(entries_in(scratch.path()), 1U);
}

TEST(StagedFolder, OnlyLeftoversOfTheSameDestinationAreRemoved) {
    const fixed::ScratchFolder scratch;
    for (const char* name : {".show.aerogram-123-1", ".show.aerogram-notes", ".other.aerogram-123-1", ".show"}) {
        ASSERT_TRUE(write_file(scratch.path() / name / "file", "x").ok());
    }
    ASSERT_TRUE(write_generation(scratch.path() / "show", 1).ok());
    EXPECT_FALSE(fs::exists(scratch.path() / ".show.aerogram-123-1"));
    EXPECT_TRUE(fs::exists(scratch.path() / ".show.aerogram-notes/file"));
    EXPECT_TRUE(fs::exists(scratch.path() / ".other.aerogram-123-1/file"));
    EXPECT_TRUE(fs::exists(scratch.path() / ".show/file"));
}

TEST(StagedFolder, ManyFilesAreFlushedAtOnce) {
    const fixed::ScratchFolder scratch;
    auto staged = StagedFolder::beside(scratch.path() / "show");
    ASSERT_TRUE(staged.ok());
    for (int i = 0; i < 300; ++i) ASSERT_TRUE(write_file(staged->path() / "waypoints" / std::to_string(i), "x").ok());
    ASSERT_TRUE(staged->commit().ok());
    EXPECT_EQ(entries_in(scratch.path() / "show/waypoints"), 300U);
}

/// splitmix64
std::uint64_t next_random(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
}

/// A child that writes one generation after another until it is killed; it says on `ready` when it begins.
pid_t start_writer(const fs::path& show, int first_generation, int ready) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    const char go = 'g';
    if (::write(ready, &go, 1) != 1) ::_exit(2);
    for (int generation = first_generation;; ++generation) {
        if (!write_generation(show, generation).ok()) ::_exit(3);
    }
}

/// In memory where there is such a file system: a kill is no power cut, and disks are slow.
fs::path quick_folder() {
    return ::access("/dev/shm", W_OK) == 0 ? fs::path("/dev/shm") : fs::temp_directory_path();
}

// The delay before each kill is the random input of this test, not a way of waiting for something.
TEST(StagedFolder, KilledAtAnyMomentLeavesTheOldFolderOrTheNewOne) {
    const fixed::ScratchFolder scratch(quick_folder());
    const fs::path show = scratch.path() / "show";
    constexpr std::uint64_t kSeed = 20260;
    std::uint64_t state = kSeed;
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    ASSERT_TRUE(write_generation(show, 0).ok());
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(write_generation(show, 1).ok());
    const auto one_write = std::chrono::steady_clock::now() - start;
    const auto longest_us =
        static_cast<std::uint64_t>(3 * std::chrono::duration_cast<std::chrono::microseconds>(one_write).count() + 100);
    int before = 1, advanced = 0, leftovers = 0;
    for (int moment = 0; moment < 100; ++moment) {
        int ready[2];
        ASSERT_EQ(::pipe(ready), 0);
        const pid_t child = start_writer(show, before + 1, ready[1]);
        ASSERT_GT(child, 0);
        char go = 0;
        ASSERT_EQ(::read(ready[0], &go, 1), 1);
        ::usleep(static_cast<useconds_t>(next_random(state) % longest_us));
        ASSERT_EQ(::kill(child, SIGKILL), 0);
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the writer failed by itself: " << status;
        ::close(ready[0]);
        ::close(ready[1]);
        const int now = generation_of(show);
        ASSERT_GE(now, before) << "at moment " << moment;
        advanced += now > before ? 1 : 0;
        leftovers += entries_in(scratch.path()) > 1 ? 1 : 0;
        ASSERT_LE(entries_in(scratch.path()), 2U) << "each run removes what the one before left";
        before = now;
    }
    EXPECT_GT(advanced, 0) << "some writers finished";
    EXPECT_GT(leftovers, 0) << "some were killed in the middle";
    ASSERT_TRUE(write_generation(show, before + 1).ok());
    EXPECT_EQ(entries_in(scratch.path()), 1U);
    EXPECT_EQ(generation_of(show), before + 1);
}

}  // namespace
}  // namespace aerogram::exporter
