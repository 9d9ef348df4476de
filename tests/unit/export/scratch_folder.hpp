#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace aerogram::exporter::fixed {

/// An empty folder for one test, removed with all it holds.
class ScratchFolder {
  public:
    explicit ScratchFolder(const std::filesystem::path& base = std::filesystem::temp_directory_path()) {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        path_ = base / ("aerogram-" + std::string(test->test_suite_name()) + "-" + test->name() + "-" +
                        std::to_string(::getpid()));
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace aerogram::exporter::fixed
