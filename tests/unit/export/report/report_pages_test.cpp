#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>

#include "export/bytes/files.hpp"
#include "export/report/report_content.hpp"
#include "export/report/report_files.hpp"
#include "export/report/report_words.hpp"
#include "sample_report.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Table table_named(const ReportContent& content, const std::string& name) {
    for (const Section& section : content.sections)
        for (const Block& block : section.blocks)
            if (const auto* table = std::get_if<Table>(&block); table != nullptr && table->name == name) return *table;
    ADD_FAILURE() << "no table " << name;
    return {};
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(ReportWords, NumbersAsPeopleReadThem) {
    EXPECT_EQ(fixed_text(1.6335, 3), "1.634");
    EXPECT_EQ(fixed_text(-0.0004, 3), "0.000");
    EXPECT_EQ(fixed_text(-4.04, 1), "−4.0");
    EXPECT_EQ(fixed_text(std::numeric_limits<double>::infinity(), 1), kAbsent);
    EXPECT_EQ(signed_text(0.1334, 3), "+0.133");
    EXPECT_EQ(signed_text(0.0, 3), "0.000");
    EXPECT_EQ(count_text(1234567), "1,234,567");
    EXPECT_EQ(count_text(999), "999");
    EXPECT_EQ(clock_text(187.46), "3:07.5");
    EXPECT_EQ(clock_text(59.97), "1:00.0");
    EXPECT_EQ(clock_text(-1.5), "−0:01.5");
    EXPECT_EQ(clock_text(3725.0, 0), "62:05");
    EXPECT_EQ(drones_text(std::vector<std::size_t>{17, 23}), "17 and 23");
    EXPECT_EQ(drones_text(std::vector<std::size_t>{1, 2, 3, 4, 5}), "1, 2, 3 and 2 more");
    EXPECT_EQ(ranges_text(std::vector<std::size_t>{1, 2, 3, 5, 7, 8}), "1–3, 5, 7, 8");
    EXPECT_EQ(ranges_text(std::vector<std::size_t>{1, 3, 5}, 2), "1, 3 … (3)");
    EXPECT_EQ(grouped_hash("0123456789ab", 0, 12), "0123 4567 89ab");
}

TEST(ReportWords, ABrokenRuleNeverLooksHeldForWantOfDigits) {
    for (double margin = -1.0; margin < -2e-6; margin *= 0.5) {
        ReportRule rule{"separation", "Separation", "m", true, 1.5, 1.5 + margin, 0.0, margin, {}, {}, {}, false};
        const int digits = rule_digits(rule);
        EXPECT_NE(fixed_text(rule.worst, digits), fixed_text(rule.limit, digits)) << margin;
        EXPECT_THAT(signed_text(rule.margin, digits), HasSubstr("−")) << margin;
    }
}

TEST(ReportContent, TheRulesAreTheReports) {
    const Report report = sample::report({10, 187.0, false, "x"});
    const Table table = table_named(report_content(report), "rules");
    ASSERT_EQ(table.rows.size(), report.rules.size());
    for (std::size_t i = 0; i < report.rules.size(); ++i) {
        EXPECT_EQ(table.rows[i].cells.front(), report.rules[i].title);
        EXPECT_EQ(table.rows[i].cells.back(), report.rules[i].held ? "held" : "BROKEN");
        EXPECT_EQ(table.rows[i].bad, !report.rules[i].held);
        EXPECT_EQ(table.rows[i].cells.size(), table.columns.size());
    }
}

TEST(ReportContent, EverySecondHasARowAndWhatIsTooCloseIsMarked) {
    const Report report = sample::report({10, 187.0, true, "x"});
    const Table table = table_named(report_content(report), "emergency");
    ASSERT_EQ(table.rows.size(), report.emergencies.size());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        EXPECT_EQ(table.rows[i].cells.front(), clock_text(static_cast<double>(i), 0));
        const ReportEmergency& e = report.emergencies[i];
        std::vector<std::size_t> close;
        std::size_t column = 1;
        for (const ReportApproach& a :
             {e.one_holds, e.one_lands, e.one_returns, e.all_hold, e.all_land, e.all_return}) {
            if (a.distance_m && *a.distance_m < 1.5) close.push_back(column);
            ++column;
        }
        EXPECT_EQ(table.rows[i].bad_cells, close) << i;
    }
}

TEST(ReportContent, LargeFleetsAreSummarisedByTimeAndNobodyIsLost) {
    const Report report = sample::report({10000, 600.0, true, "x"});
    const ReportContent content = report_content(report);
    for (const char* name : {"takeoffs", "landings"}) {
        const Table table = table_named(content, name);
        EXPECT_LE(table.rows.size(), 60U);
        std::size_t drones = 0;
        for (const TableRow& row : table.rows) {
            std::string digits = row.cells[1];
            std::erase(digits, ',');
            drones += std::stoul(digits);
        }
        EXPECT_EQ(drones, 10000U) << name;
    }
    EXPECT_EQ(table_named(content, "turns").rows.size(), 10000U);
    EXPECT_TRUE(table_named(content, "turns").only_on_screen);
}

TEST(ReportContent, AFailingShowHasNothingToSign) {
    EXPECT_EQ(report_content(sample::report({10, 187.0, true, "x"})).cover.signing.size(), 4U);
    const Cover cover = report_content(sample::report({10, 187.0, false, "x"})).cover;
    EXPECT_TRUE(cover.signing.empty());
    EXPECT_EQ(cover.verdict, "NOT CERTIFIED – DO NOT FLY");
    EXPECT_EQ(cover.reasons.size(), 2U);
}

TEST(ReportPdf, SameReportSameBytesAndNoDate) {
    const Report report = sample::report({10, 60.0, true, "The end"});
    const auto once = report_pdf(report), again = report_pdf(report);
    ASSERT_TRUE(once.ok()) << once.error().message;
    EXPECT_EQ(*once, *again);
    EXPECT_THAT(once->substr(0, 8), HasSubstr("%PDF-1."));
    EXPECT_THAT(*once, Not(HasSubstr("CreationDate")));
    EXPECT_THAT(*once, Not(HasSubstr("ModDate")));
}

TEST(ReportPdf, AlmostNothingIsAReportToo) {
    Report report;
    const auto pdf = report_pdf(report);
    ASSERT_TRUE(pdf.ok()) << pdf.error().message;
    EXPECT_THAT(report_html(report), HasSubstr("NOT CERTIFIED"));
    report = sample::report({1, 3.0, true, "日本の空 – شو – 🎆 \xff"});
    report.nearest_m.assign(report.times_s.size(), std::numeric_limits<double>::infinity());
    report.encounters.clear();
    report.histogram.clear();
    report.rules[0].worst = report.rules[0].margin = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(report_pdf(report).ok());
    EXPECT_THAT(report_html(report), HasSubstr("日本の空"));
}

TEST(ReportHtml, NamesCannotBecomeMarkup) {
    Report report = sample::report({10, 30.0, true, "</script><script>alert(1)</script> & \"x\" @@REPORT@@"});
    report.keyframes[0].name = "</script><img src=x>";
    const std::string page = report_html(report);
    EXPECT_EQ(count_of(page, "alert(1)"), 2U);  // in the title, escaped, and in the data
    EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(page, Not(HasSubstr("<img src=x>")));
    EXPECT_EQ(count_of(page, "</script>"), 2U);  // of the data and of the program
    EXPECT_EQ(page, report_html(report));
}

TEST(ReportHtml, AnswersToNothingButItself) {
    const std::string page = report_html(sample::report({10, 30.0, true, "x"}));
    EXPECT_THAT(page, HasSubstr("default-src 'none'"));
    for (const char* outside : {"src=\"http", "href=\"http", "url(http", "fetch(", "XMLHttpRequest", "import("})
        EXPECT_THAT(page, Not(HasSubstr(outside)));
}

TEST(ReportHtml, TenThousandDronesAndTenMinutesStayBelowTenMegabytes) {
    EXPECT_LT(report_html(sample::report({10000, 600.0, true, "x"})).size(), 10'000'000U);
}

// tests/e2e/report.py has them written into a folder of its own and reads them with other programs.
TEST(ReportSamples, EveryPaperIsWrittenForFleetsOfEverySize) {
    const ScratchFolder scratch;
    const char* asked = std::getenv("AEROGRAM_REPORT_SAMPLES");
    const std::filesystem::path folder = asked != nullptr ? std::filesystem::path(asked) : scratch.path();
    const std::string long_name =
        "A show with quite a long name, as people like to give them: the opening night of the 42nd summer festival by "
        "the lake, second version";
    for (const std::size_t drones : {10U, 1000U, 10000U})
        for (const bool certified : {true, false}) {
            const Report r =
                sample::report({drones, drones == 10000 ? 600.0 : 187.0, certified, certified ? "The end" : long_name});
            const auto stem = (folder / (std::to_string(drones) + (certified ? "" : "-failing"))).string();
            const PadSheet pads = pad_sheet(sample::facts(r), r.show_hash, r.certified);
            const auto pdf = report_pdf(r), sheet = pads_pdf(pads);
            ASSERT_TRUE(pdf.ok() && sheet.ok());
            EXPECT_TRUE(pdf->starts_with("%PDF-") && sheet->starts_with("%PDF-")) << stem;
            const std::string rows = pads_csv(pads), json = report_json(r);
            EXPECT_EQ(count_of(rows, "\n"), drones + 1) << stem;
            EXPECT_THAT(json, HasSubstr("\"" + r.show_hash + "\"")) << stem;
            ASSERT_TRUE(write_file(stem + ".pdf", *pdf).ok());
            ASSERT_TRUE(write_file(stem + ".html", report_html(r)).ok());
            ASSERT_TRUE(write_file(stem + ".json", json).ok());
            ASSERT_TRUE(write_file(stem + "-pads.csv", rows).ok());
            ASSERT_TRUE(write_file(stem + "-pads.pdf", *sheet).ok());
        }
}

}  // namespace
}  // namespace aerogram::exporter
