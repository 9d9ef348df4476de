#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "tests/fuzz/points_targets.hpp"

namespace aerogram::planner {
namespace {

namespace fs = std::filesystem;

TEST(PointsCorpus, EveryFileIsPointsOrRefused) {
    std::size_t files = 0, read = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(AEROGRAM_SOURCE_DIR) / "tests/fuzz/corpus/points")) {
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
        const auto exact = std::make_unique<char[]>(bytes.size());  // so that reading beyond it is seen
        std::copy(bytes.begin(), bytes.end(), exact.get());
        fuzz::try_points({exact.get(), bytes.size()});
        read += parse_csv_points(bytes, "any.csv").ok();
        ++files;
    }
    EXPECT_GE(files, 8U);
    EXPECT_GE(read, 2U);
}

}  // namespace
}  // namespace aerogram::planner
