#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "export/bytes/files.hpp"
#include "tests/fuzz/format_targets.hpp"

namespace aerogram::exporter {
namespace {

using Target = void (*)(std::string_view);

/// Exact-size heap copies, so that a sanitizer sees any read past the end.
void replay(Target target, std::string_view bytes) {
    const auto copy = std::make_unique<char[]>(bytes.size());
    std::ranges::copy(bytes, copy.get());
    target({copy.get(), bytes.size()});
}

void replay_corpus(Target target, const std::string& name) {
    const std::filesystem::path corpus(AEROGRAM_SOURCE_DIR);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpus / "tests/fuzz/corpus" / name)) {
        SCOPED_TRACE(entry.path());
        const auto bytes = read_file(entry.path());
        ASSERT_TRUE(bytes.ok());
        replay(target, *bytes);
        for (std::size_t cut = 0; cut < bytes->size(); cut += 1 + bytes->size() / 40)
            replay(target, std::string_view(*bytes).substr(0, cut));
        ++files;
    }
    EXPECT_GE(files, 3u);
}

TEST(FormatCorpus, SkycIsHandled) {
    replay_corpus(fuzz::try_skyc, "skyc");
}
TEST(FormatCorpus, SkybIsHandled) {
    replay_corpus(fuzz::try_skyb, "skyb");
}
TEST(FormatCorpus, CsvZipIsHandled) {
    replay_corpus(fuzz::try_csv_zip, "csv_zip");
}
TEST(FormatCorpus, LightProgramIsHandled) {
    replay_corpus(fuzz::try_light_program, "light_program");
}
TEST(FormatCorpus, VvizIsHandled) {
    replay_corpus(fuzz::try_vviz, "vviz");
}
TEST(FormatCorpus, KmzIsHandled) {
    replay_corpus(fuzz::try_kmz, "kmz");
}
TEST(FormatCorpus, CzmlIsHandled) {
    replay_corpus(fuzz::try_czml, "czml");
}
TEST(FormatCorpus, GlbIsHandled) {
    replay_corpus(fuzz::try_glb, "glb");
}
TEST(FormatCorpus, Px4CsvIsHandled) {
    replay_corpus(fuzz::try_px4_csv, "px4_csv");
}
TEST(FormatCorpus, CrazyflieIsHandled) {
    replay_corpus(fuzz::try_crazyflie, "crazyflie");
}
TEST(FormatCorpus, QgcPlanIsHandled) {
    replay_corpus(fuzz::try_qgc_plan, "qgc_plan");
}
TEST(FormatCorpus, WaypointsIsHandled) {
    replay_corpus(fuzz::try_waypoints, "waypoints");
}

}  // namespace
}  // namespace aerogram::exporter
