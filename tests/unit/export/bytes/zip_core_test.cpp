#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>

#include "export/bytes/crc32.hpp"
#include "export/bytes/little_endian.hpp"
#include "export/bytes/zip.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

/// A stored (uncompressed) archive written by hand, so that entries no honest writer makes can be tried.
struct HandMadeZip {
    std::string local, central;
    std::uint16_t entries = 0;

    void add(const std::string& name, const std::string& bytes, std::uint32_t claimed_size, std::uint16_t flags = 0) {
        const auto offset = static_cast<std::uint32_t>(local.size());
        const auto common = [&](std::string& out) {
            put<std::uint16_t>(out, 20);
            put<std::uint16_t>(out, flags);
            put<std::uint16_t>(out, 0);  // stored
            put<std::uint32_t>(out, 0x00210000U);
            put<std::uint32_t>(out, crc32(bytes));
            put<std::uint32_t>(out, static_cast<std::uint32_t>(bytes.size()));
            put<std::uint32_t>(out, claimed_size);
            put<std::uint16_t>(out, static_cast<std::uint16_t>(name.size()));
            put<std::uint16_t>(out, 0);
        };
        local += "PK\3\4";
        common(local);
        local += name + bytes;
        central += "PK\1\2";
        put<std::uint16_t>(central, 20);
        common(central);
        central.append(10, '\0');
        put<std::uint32_t>(central, offset);
        central += name;
        ++entries;
    }
    void add(const std::string& name, const std::string& bytes) {
        add(name, bytes, static_cast<std::uint32_t>(bytes.size()));
    }
    [[nodiscard]] std::string bytes() const {
        std::string out = local + central + "PK\5\6" + std::string(4, '\0');
        put<std::uint16_t>(out, entries);
        put<std::uint16_t>(out, entries);
        put<std::uint32_t>(out, static_cast<std::uint32_t>(central.size()));
        put<std::uint32_t>(out, static_cast<std::uint32_t>(local.size()));
        return out + std::string(2, '\0');
    }
};

std::string problem_of(std::string_view archive, const UnzipLimits& limits = {}) {
    const auto files = unzip_bytes(archive, limits);
    if (files.ok()) return "none";
    EXPECT_EQ(files.error().code, ErrorCode::invalid_input);
    return files.error().message;
}

const std::vector<FileBytes> kFiles{{"show.json", "{\"version\": 1}"},
                                    {"drones/drone-001/trajectory.json", std::string(5'000, 'a')},
                                    {"empty", ""},
                                    {"bytes", std::string("\0\1\2\377", 4)}};

TEST(Zip, GivesBackWhatWentInInOrder) {
    const auto archive = zip_bytes(kFiles);
    ASSERT_TRUE(archive.ok()) << archive.error().message;
    const auto files = unzip_bytes(*archive);
    ASSERT_TRUE(files.ok()) << files.error().message;
    ASSERT_EQ(files->size(), kFiles.size());
    for (std::size_t i = 0; i < kFiles.size(); ++i) {
        EXPECT_EQ((*files)[i].path, kFiles[i].path);
        EXPECT_EQ((*files)[i].bytes, kFiles[i].bytes);
    }
}

TEST(Zip, SameEntriesGiveTheSameBytesInAnyTimeZone) {
    const auto here = zip_bytes(kFiles);
    ::setenv("TZ", "Pacific/Kiritimati", 1);
    ::tzset();
    const auto there = zip_bytes(kFiles);
    ::unsetenv("TZ");
    ::tzset();
    ASSERT_TRUE(here.ok() && there.ok());
    EXPECT_EQ(*here, *there);
    EXPECT_EQ(here->substr(10, 4), std::string("\0\0\x21\0", 4)) << "1980-01-01 00:00:00";
}

TEST(Zip, NothingIsNoArchive) {
    EXPECT_EQ(zip_bytes({}).error().message, "zip: an archive needs entries");
    EXPECT_EQ(problem_of(""), "zip: an empty file is no archive");
}

TEST(Zip, HandMadeArchivesAreRead) {
    HandMadeZip zip;
    zip.add("a.txt", "hello");
    zip.add("folder/", "");
    zip.add("folder/b.txt", "there");
    const auto files = unzip_bytes(zip.bytes());
    ASSERT_TRUE(files.ok()) << files.error().message;
    ASSERT_EQ(files->size(), 2U);
    EXPECT_EQ((*files)[1].path, "folder/b.txt");
    EXPECT_EQ((*files)[1].bytes, "there");
}

TEST(Zip, NamesThatLeaveTheFolderAreRefused) {
    for (const char* name : {"/etc/passwd", "../up", "a/../../up", "a/..", "C:/x", "..\\up", "a\\b"}) {
        HandMadeZip zip;
        zip.add("fine", "x");
        zip.add(name, "x");
        EXPECT_EQ(problem_of(zip.bytes()), "zip: entry \"" + std::string(name) + "\" would leave the folder");
    }
    HandMadeZip nameless;
    nameless.add("", "x");
    EXPECT_THAT(problem_of(nameless.bytes()), HasSubstr("zip: "));
}

TEST(Zip, DuplicateNamesAreRefused) {
    HandMadeZip zip;
    zip.add("a", "1");
    zip.add("a", "2");
    EXPECT_EQ(problem_of(zip.bytes()), "zip: two entries have the same name");
}

TEST(Zip, EncryptedEntriesAreRefused) {
    HandMadeZip zip;
    zip.add("a", std::string(13, 'x'), 1, 1);
    EXPECT_EQ(problem_of(zip.bytes()), "zip: entry \"a\" is encrypted");
}

TEST(Zip, LyingSizesAreRefused) {
    for (const std::uint32_t claimed : {0U, 4U, 6U, 1'000'000U}) {
        HandMadeZip zip;
        zip.add("a", "hello", claimed);
        EXPECT_THAT(problem_of(zip.bytes()), HasSubstr("zip: ")) << claimed;
        EXPECT_NE(problem_of(zip.bytes()), "none") << claimed;
    }
}

TEST(Zip, BombsAreRefusedBeforeTheyAreUnpacked) {
    const auto bomb = zip_bytes(std::vector<FileBytes>{{"bomb", std::string(std::size_t{64} << 20U, '\0')}});
    ASSERT_TRUE(bomb.ok());
    EXPECT_LT(bomb->size(), 100'000U);
    EXPECT_EQ(problem_of(*bomb), "zip: would unpack to 67108864 bytes, more than a sound archive can");
}

TEST(Zip, LimitsAreHeld) {
    const auto archive = zip_bytes(kFiles);
    ASSERT_TRUE(archive.ok());
    UnzipLimits limits;
    limits.entries = 3;
    EXPECT_EQ(problem_of(*archive, limits), "zip: 4 entries; at most 3 are read");
    limits = {};
    limits.entry_bytes = 4'999;
    EXPECT_THAT(problem_of(*archive, limits), HasSubstr("is too large (5000 bytes)"));
    limits = {};
    limits.total_bytes = 5'001;
    EXPECT_THAT(problem_of(*archive, limits), HasSubstr("is too large"));
}

// What CRC and directory cannot see (dates, attributes, versions) may change; what comes out may not.
TEST(Zip, AnyDamageIsReportedOrHarmless) {
    const auto archive = zip_bytes(kFiles);
    ASSERT_TRUE(archive.ok());
    std::size_t refused = 0;
    for (std::size_t at = 0; at < archive->size(); ++at) {
        std::string damaged = *archive;
        damaged[at] = static_cast<char>(static_cast<std::uint8_t>(damaged[at]) ^ 0x55U);
        const auto files = unzip_bytes(damaged);
        if (!files.ok()) {
            ++refused;
            continue;
        }
        for (std::size_t i = 0; i < files->size(); ++i) {
            EXPECT_EQ((*files)[i].bytes, kFiles[i].bytes) << "byte " << at;
        }
    }
    EXPECT_GT(refused, archive->size() / 2);
    for (std::size_t size = 0; size < archive->size(); ++size) {
        EXPECT_FALSE(unzip_bytes(archive->substr(0, size)).ok()) << size;
    }
}

}  // namespace
}  // namespace aerogram::exporter
