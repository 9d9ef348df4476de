#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace aerogram::exporter::fixed {

/// Compares with tests/golden/writers/`name`, byte for byte. With AEROGRAM_UPDATE_GOLDEN=1 in the environment the file
/// is written instead: look at the difference before it is committed.
inline void expect_golden(const std::string& name, const std::string& bytes) {
    const std::filesystem::path file = std::filesystem::path(AEROGRAM_SOURCE_DIR) / "tests/golden/writers" / name;
    if (const char* update = std::getenv("AEROGRAM_UPDATE_GOLDEN"); update != nullptr && std::string(update) == "1") {
        std::ofstream(file, std::ios::binary) << bytes;
    }
    std::ifstream in(file, std::ios::binary);
    ASSERT_TRUE(in) << file << " is missing; AEROGRAM_UPDATE_GOLDEN=1 writes it";
    const std::string golden{std::istreambuf_iterator<char>(in), {}};
    const auto [ours, theirs] = std::mismatch(bytes.begin(), bytes.end(), golden.begin(), golden.end());
    EXPECT_TRUE(bytes == golden) << name << " differs from byte " << ours - bytes.begin() << " on; " << bytes.size()
                                 << " bytes, golden " << golden.size();
    static_cast<void>(theirs);
}

}  // namespace aerogram::exporter::fixed
