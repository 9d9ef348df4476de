#include "export/bytes/file_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "export/bytes/files.hpp"
#include "tests/unit/export/scratch_folder.hpp"

namespace aerogram::exporter {
namespace {

TEST(FileWriter, KeepsAllPiecesInOrder) {
    const fixed::ScratchFolder folder;
    const auto path = folder.path() / "deep" / "a.txt";
    for (const std::string last : {"end", ""}) {
        auto file = FileWriter::create(path);
        ASSERT_TRUE(file.ok());
        ASSERT_TRUE(file->append("one, ").ok());
        ASSERT_TRUE(file->append(std::string(3'000'000, 'x')).ok());
        ASSERT_TRUE(file->append(last).ok());
        ASSERT_TRUE(file->close().ok());
        EXPECT_EQ(read_file(path).value(), "one, " + std::string(3'000'000, 'x') + last);
    }
}

TEST(FileWriter, NamesTheFileThatCannotBeWritten) {
    const auto nowhere = FileWriter::create("/proc/nobody/a.txt");
    ASSERT_FALSE(nowhere.ok());
    EXPECT_EQ(nowhere.error().code, ErrorCode::io);
    auto full = FileWriter::create("/dev/full");
    ASSERT_TRUE(full.ok());
    const Status put = full->append("x");
    ASSERT_FALSE(put.ok());
    EXPECT_THAT(put.error().message, ::testing::HasSubstr("/dev/full: cannot be written"));
    EXPECT_FALSE(full->append("y").ok());
    EXPECT_FALSE(full->close().ok());
}

}  // namespace
}  // namespace aerogram::exporter
