#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "tests/fuzz/mesh_fuzz.cpp"

namespace aerogram::planner {
namespace {

namespace fs = std::filesystem;

TEST(MeshFuzz, CorpusHolds) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(AEROGRAM_SOURCE_DIR) / "tests/fuzz/corpus/mesh"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    ASSERT_GE(files.size(), 18U);
    for (const fs::path& file : files) {
        SCOPED_TRACE(file);
        std::ifstream in(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
        const auto exact = std::make_unique<std::uint8_t[]>(text.size());  // so that a sanitizer sees the end
        std::copy(text.begin(), text.end(), exact.get());
        EXPECT_EQ(LLVMFuzzerTestOneInput(exact.get(), text.size()), 0);
    }
}

}  // namespace
}  // namespace aerogram::planner
