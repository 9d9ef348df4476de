#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "export/exact/show_hash.hpp"
#include "export/formats.hpp"
#include "tests/unit/export/damage.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

/// Every format's files, damaged in hundreds of ways: the reader says what is wrong and where, or returns a sound show,
/// and never takes much memory.
namespace {

std::atomic<std::int64_t> held_bytes{0}, most_bytes{0};

void* counted(std::size_t size) {
    void* const place = std::malloc(std::max<std::size_t>(size, 1));
    if (place == nullptr) throw std::bad_alloc();
    const auto held = held_bytes.fetch_add(static_cast<std::int64_t>(malloc_usable_size(place))) +
                      static_cast<std::int64_t>(malloc_usable_size(place));
    std::int64_t most = most_bytes.load();
    while (held > most && !most_bytes.compare_exchange_weak(most, held)) {
    }
    return place;
}
void released(void* place) noexcept {
    if (place != nullptr) held_bytes.fetch_sub(static_cast<std::int64_t>(malloc_usable_size(place)));
    std::free(place);
}

}  // namespace

// What this program allocates is counted.
void* operator new(std::size_t size) {
    return counted(size);
}
void* operator new[](std::size_t size) {
    return counted(size);
}
void operator delete(void* place) noexcept {
    released(place);
}
void operator delete[](void* place) noexcept {
    released(place);
}
void operator delete(void* place, std::size_t) noexcept {
    released(place);
}
void operator delete[](void* place, std::size_t) noexcept {
    released(place);
}

namespace aerogram::exporter {
namespace {

constexpr std::size_t kLeastVersions = 200;
constexpr std::int64_t kMostBytes = std::int64_t{256} << 20;

std::vector<FileBytes> sound_files(const Format& format) {
    const planner::FlightPlan plan = fixed::show();
    return written_files(format, plan, {show_hash(plan), true});
}

class DamagedFiles : public ::testing::TestWithParam<std::string> {
  protected:
    const Format& format_ = *find_format(GetParam());

    /// Reads the files, one of which was damaged.
    void check(const std::vector<FileBytes>& files, std::size_t damaged, const std::string& how) {
        const std::int64_t before = held_bytes.load();
        most_bytes = before;
        const FileBytes& file = files[damaged];
        static_cast<void>(recognise(file.path, std::string_view(file.bytes).substr(0, 4096)));
        const Result<RecordedShow> show = format_.read(files);
        EXPECT_LE(most_bytes.load() - before, kMostBytes) << file.path << ": " << how;
        if (show) {
            ++read_;
            const Status sound = well_formed(*show);
            EXPECT_TRUE(sound.ok()) << file.path << ": " << how << ": " << (sound ? "" : sound.error().message);
            EXPECT_FALSE(show->drones.empty()) << file.path << ": " << how;
            return;
        }
        ++refused_;
        EXPECT_EQ(show.error().code, ErrorCode::invalid_input) << how << ": " << show.error().message;
        const auto named = [&](const FileBytes& each) {
            return show.error().message.find(each.path) != std::string::npos;
        };
        EXPECT_TRUE(std::ranges::any_of(files, named)) << file.path << ": " << how << ": " << show.error().message;
        EXPECT_LT(show.error().message.size(), 4'000u) << file.path << ": " << how;
    }

    std::size_t read_ = 0, refused_ = 0;
};

TEST_P(DamagedFiles, AreRefusedWithAReasonOrSound) {
    std::vector<FileBytes> files = sound_files(format_);
    ASSERT_FALSE(files.empty());
    std::vector<std::size_t> places{0};
    if (files.size() > 1) places.push_back(files.size() - 1);
    for (const std::size_t place : places) {
        const std::string whole = files[place].bytes;
        for (damage::Damaged& damaged : damage::versions(whole)) {
            files[place].bytes = std::move(damaged.bytes);
            check(files, place, damaged.how);
        }
        files[place].bytes = whole;
    }
    EXPECT_GE(read_ + refused_, kLeastVersions);
    const bool mostly_program = format_.name == "preview";  // a page's own program may be anything
    EXPECT_GE(refused_, mostly_program ? 1 : kLeastVersions / 4);
    const auto undamaged = format_.read(files);
    EXPECT_TRUE(undamaged.ok()) << undamaged.error().message;
}

TEST_P(DamagedFiles, MissingOrDoubledFilesAreRefusedOrSound) {
    std::vector<FileBytes> files = sound_files(format_);
    EXPECT_FALSE(format_.read(std::span<const FileBytes>()).ok());
    files.push_back(files.front());
    const auto doubled = format_.read(files);
    if (doubled) {
        EXPECT_TRUE(well_formed(*doubled).ok());
    } else {
        EXPECT_FALSE(doubled.error().message.empty());
    }
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const Format& format : formats()) all.emplace_back(format.name);
    return all;
}

std::string test_name(const ::testing::TestParamInfo<std::string>& format) {
    std::string name;
    for (const char c : format.param) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFiles, ::testing::ValuesIn(names()), test_name);

}  // namespace
}  // namespace aerogram::exporter
