#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "export/bytes/files.hpp"
#include "export/report/report_files.hpp"
#include "sample_report.hpp"

namespace aerogram::exporter {
namespace {

TEST(ReportPages, SamplesToLookAt) {
    const char* folder = std::getenv("AEROGRAM_SAMPLES");
    if (folder == nullptr) GTEST_SKIP() << "AEROGRAM_SAMPLES=FOLDER writes them";
    for (const std::size_t drones : {10U, 1000U, 10000U})
        for (const bool certified : {true, false}) {
            const Report r = sample::report({drones, drones == 10000 ? 600.0 : 187.0, certified, certified ? "The end" : "A show with quite a long name, as people like to give them: the opening night of the 42nd summer festival by the lake, second version"});
            const auto stem = std::filesystem::path(folder) / (std::to_string(drones) + (certified ? "" : "-failing"));
            const auto pdf = report_pdf(r);
            ASSERT_TRUE(pdf.ok()) << pdf.error().message;
            ASSERT_TRUE(write_file(stem.string() + ".pdf", *pdf).ok());
            ASSERT_TRUE(write_file(stem.string() + ".html", report_html(r)).ok());
            const PadSheet pads = pad_sheet(sample::facts(r), r.show_hash);
            ASSERT_TRUE(write_file(stem.string() + "-pads.csv", pads_csv(pads)).ok());
            ASSERT_TRUE(write_file(stem.string() + "-pads.pdf", pads_pdf(pads).value()).ok());
        }
}

}  // namespace
}  // namespace aerogram::exporter
