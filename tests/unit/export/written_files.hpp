#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "export/bytes/files.hpp"
#include "export/bytes/zip.hpp"
#include "export/outgoing/format.hpp"
#include "export/outgoing/planned_show.hpp"

/// Writers run into memory, and their bytes compared with tests/golden/writers (AEROGRAM_UPDATE_GOLDEN=1 rewrites
/// them).
namespace aerogram::exporter {

inline Seal test_seal(bool certified = true) {
    return {std::string(32, 'a') + std::string(32, '7'), certified};
}

/// A folder of this test's own, removed at the end.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "aerogram-test-XXXXXX").string();
        EXPECT_NE(mkdtemp(name.data()), nullptr);
        path_ = name;
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() { std::filesystem::remove_all(path_); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// What a writer leaves on disk, in its stated order.
inline std::vector<FileBytes> written_files(const Format& format, const planner::FlightPlan& plan,
                                            const Seal& seal = test_seal()) {
    const ScratchFolder folder;
    std::vector<FileBytes> files;
    const auto paths = format.write(PlannedShow(plan), seal, folder.path(), Run{});
    EXPECT_TRUE(paths.ok()) << (paths.ok() ? "" : paths.error().message);
    if (!paths) return files;
    for (const std::string& path : *paths) files.push_back({path, read_file(folder.path() / path).value()});
    return files;
}

inline RecordedShow read_back(const Format& format, const std::vector<FileBytes>& files) {
    auto show = format.read(files);
    EXPECT_TRUE(show.ok()) << (show.ok() ? "" : show.error().message);
    return show ? *show : RecordedShow{};
}

/// The entries of an archive (or the file itself) as one text: compression is the library's business.
inline std::string unpacked_text(const std::vector<FileBytes>& files) {
    std::string text;
    for (const FileBytes& file : files) {
        const bool archive = file.bytes.starts_with("PK");
        const auto entries = archive ? unzip_bytes(file.bytes).value() : std::vector<FileBytes>{};
        if (!archive) text += "==== " + file.path + "\n" + file.bytes;
        for (const FileBytes& entry : entries) text += "==== " + file.path + ": " + entry.path + "\n" + entry.bytes;
    }
    return text;
}

inline void expect_golden(const std::string& name, const std::string& bytes) {
    const auto path = std::filesystem::path(AEROGRAM_SOURCE_DIR) / "tests/golden/writers" / name;
    if (std::getenv("AEROGRAM_UPDATE_GOLDEN") != nullptr) {
        ASSERT_TRUE(write_file(path, bytes).ok());
        return;
    }
    const auto golden = read_file(path);
    ASSERT_TRUE(golden.ok()) << golden.error().message << "; AEROGRAM_UPDATE_GOLDEN=1 writes it";
    EXPECT_TRUE(*golden == bytes) << name << " differs; AEROGRAM_UPDATE_GOLDEN=1 rewrites it";
}

/// Every reader must survive these: cut at every length up to 300 and then in steps, and each of `flips` bytes changed.
template <class Check>
void for_damaged(const std::string& bytes, std::size_t flips, const Check& check) {
    for (std::size_t n = 0; n < bytes.size(); n += n < 300 ? 1 : 1 + bytes.size() / 97) check(bytes.substr(0, n));
    std::uint64_t random = 0x9E3779B97F4A7C15u;
    for (std::size_t k = 0; k < flips && !bytes.empty(); ++k) {
        random ^= random << 13, random ^= random >> 7, random ^= random << 17;
        std::string changed = bytes;
        changed[random % changed.size()] = static_cast<char>(random >> 32);
        check(changed);
    }
}

}  // namespace aerogram::exporter
