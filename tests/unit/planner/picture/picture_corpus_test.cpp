#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "tests/fuzz/picture_targets.hpp"

namespace aerogram::planner {
namespace {

namespace fs = std::filesystem;

TEST(PictureCorpus, EveryFileIsAPictureOrRefused) {
    std::size_t files = 0, read = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(AEROGRAM_SOURCE_DIR) / "tests/fuzz/corpus/picture")) {
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
        const auto exact = std::make_unique<char[]>(bytes.size());  // so that reading beyond it is seen
        std::copy(bytes.begin(), bytes.end(), exact.get());
        fuzz::try_picture({exact.get(), bytes.size()});
        read += decode_png(bytes).ok() || decode_jpeg(bytes).ok();
        ++files;
    }
    EXPECT_GE(files, 13U);
    EXPECT_GE(read, 9U);
}

TEST(PictureCorpus, KindsOfPngAreReadAlike) {
    const fs::path folder = fs::path(AEROGRAM_SOURCE_DIR) / "tests/fuzz/corpus/picture";
    for (const char* name : {"grey-1", "grey-16", "color", "color-16-alpha", "palette-4", "interlaced"}) {
        const auto picture = read_picture(folder / (std::string(name) + ".png"));
        ASSERT_TRUE(picture.ok()) << name;
        EXPECT_EQ(picture->width, 11U) << name;
        EXPECT_EQ(picture->height, 7U) << name;
    }
    for (const char* name : {"short", "wide", "promise", "no-palette"})
        EXPECT_FALSE(read_picture(folder / (std::string(name) + ".png")).ok()) << name;
    for (const char* name : {"baseline", "progressive", "grey"})
        EXPECT_EQ(read_picture(folder / (std::string(name) + ".jpg"))->width, 32U) << name;
}

}  // namespace
}  // namespace aerogram::planner
