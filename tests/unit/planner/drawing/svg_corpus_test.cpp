#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "tests/fuzz/svg_targets.hpp"

namespace aerogram::planner::testing {
namespace {

TEST(SvgCorpus, EveryFileIsASoundDrawingOrRefused) {
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(AEROGRAM_SOURCE_DIR) / "tests/fuzz/corpus/svg")) {
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(in), {}};
        const auto exact = std::make_unique<char[]>(bytes.size());  // so that reading past the end is found
        std::memcpy(exact.get(), bytes.data(), bytes.size());
        fuzz::try_svg({exact.get(), bytes.size()});
        ++files;
    }
    EXPECT_GE(files, 6U);
}

}  // namespace
}  // namespace aerogram::planner::testing
