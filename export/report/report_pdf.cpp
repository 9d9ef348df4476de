#include <algorithm>

#include "export/report/page_blocks.hpp"
#include "export/report/report_files.hpp"
#include "export/report/report_words.hpp"

namespace aerogram::exporter {
namespace {

void draw_words(PageFlow& flow, const Words& words) {
    const bool strong = words.tone == Tone::good || words.tone == Tone::bad;
    const Ink ink = words.tone == Tone::bad    ? inks::kBad
                    : words.tone == Tone::good ? inks::kGood
                    : words.tone == Tone::note ? inks::kDim
                                               : inks::kText;
    flow.words(words.text, strong ? Face::bold : Face::regular, 8.0, ink);
    flow.skip(5.0);
}

struct DrawBlock {
    PageFlow& flow;
    void operator()(const Words& words) const { draw_words(flow, words); }
    void operator()(const Facts& facts) const { draw_facts(flow, facts.facts); }
    void operator()(const Table& table) const {
        if (!table.only_on_screen) draw_table(flow, table);
    }
    void operator()(const Chart& chart) const { draw_chart(flow, chart); }
    void operator()(const Plan& plan) const { draw_plan(flow, plan); }
};

void draw_section(PageFlow& flow, const Section& section) {
    constexpr double kWorthBeginning = 190.0;
    const bool own_page = std::any_of(section.blocks.begin(), section.blocks.end(),
                                      [](const Block& block) { return std::holds_alternative<Plan>(block); });
    flow.need(own_page ? flow.whole_room() : kWorthBeginning);
    flow.words(section.title, Face::bold, 13.0, inks::kText);
    flow.skip(1.0);
    if (!section.meaning.empty()) flow.words(section.meaning, Face::regular, 7.8, inks::kDim);
    flow.skip(6.0);
    for (const Block& block : section.blocks) std::visit(DrawBlock{flow}, block);
    flow.skip(10.0);
}

}  // namespace

Result<std::string> report_pdf(const Report& report) {
    const ReportContent content = report_content(report);
    PageEdges edges;
    edges.title = content.cover.title;
    edges.right = "hash " + content.short_hash + " · " + content.cover.verdict;
    edges.foot = "Flight validation report · " + content.program;
    if (!content.cover.certified) edges.banner = content.cover.verdict;
    return drawn_pages("Flight validation report: " + content.cover.title, edges, [&](PageFlow& flow) {
        draw_cover(flow, content.cover);
        flow.new_page();
        for (const Section& section : content.sections) draw_section(flow, section);
    });
}

}  // namespace aerogram::exporter
