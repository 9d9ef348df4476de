#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "export/bytes/html_page.hpp"
#include "export/report/report_content.hpp"
#include "export/report/report_files.hpp"

// The bundled page, made an object by the linker (cmake/AerogramPage.cmake).
extern "C" {
extern const char _binary_report_page_html_start[];  // NOLINT(bugprone-reserved-identifier)
extern const char _binary_report_page_html_end[];    // NOLINT(bugprone-reserved-identifier)
}

namespace aerogram::exporter {
namespace {

using Json = nlohmann::ordered_json;

std::string_view page() {
    return {_binary_report_page_html_start,
            static_cast<std::size_t>(_binary_report_page_html_end - _binary_report_page_html_start)};
}

/// Lines of charts to a tenth of a millimetre, maps to a centimetre: no screen shows more.
Json number(double value, double per_unit) {
    return std::isfinite(value) ? Json(std::round(value * per_unit) / per_unit) : Json(nullptr);
}
Json numbers(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double value : values) list.push_back(number(value, 1e4));
    return list;
}

Json facts_json(const std::vector<Fact>& facts) {
    Json list = Json::array();
    for (const Fact& fact : facts) list.push_back(Json::array({fact.name, fact.value}));
    return list;
}

Json json_of(const Cover& cover) {
    Json figures = Json::array();
    for (const Figure& f : cover.figures)
        figures.push_back({{"name", f.name}, {"value", f.value}, {"detail", f.detail}});
    return {{"title", cover.title},
            {"verdict", cover.verdict},
            {"certified", cover.certified},
            {"reasons", cover.reasons},
            {"statement", cover.statement},
            {"hash", cover.hash},
            {"figures", std::move(figures)},
            {"facts", facts_json(cover.facts)},
            {"limits", facts_json(cover.limits)},
            {"findings", facts_json(cover.findings)},
            {"signing", cover.signing}};
}

const char* name_of(Layer layer) {
    constexpr std::array<const char*, 8> kNames{"ground_risk", "contingency", "flight", "audience",
                                                "obstacle",    "fence",       "track",  "home"};
    return kNames[static_cast<std::size_t>(layer)];
}

struct ToJson {
    Json operator()(const Words& words) const {
        constexpr std::array<const char*, 4> kTones{"plain", "note", "good", "bad"};
        return {{"kind", "words"}, {"text", words.text}, {"tone", kTones[static_cast<std::size_t>(words.tone)]}};
    }
    Json operator()(const Facts& facts) const { return {{"kind", "facts"}, {"facts", facts_json(facts.facts)}}; }
    Json operator()(const Table& table) const {
        Json columns = Json::array(), rows = Json::array(), bad = Json::array(), bad_cells = Json::array();
        for (const Column& c : table.columns) columns.push_back({{"title", c.title}, {"numeric", c.numeric}});
        for (std::size_t r = 0; r < table.rows.size(); ++r) {
            rows.push_back(table.rows[r].cells);
            if (table.rows[r].bad) bad.push_back(r);
            for (const std::size_t c : table.rows[r].bad_cells) bad_cells.push_back(Json::array({r, c}));
        }
        return {{"kind", "table"},
                {"name", table.name},
                {"caption", table.caption},
                {"columns", std::move(columns)},
                {"rows", std::move(rows)},
                {"bad", std::move(bad)},
                {"badCells", std::move(bad_cells)},
                {"screenOnly", table.only_on_screen}};
    }
    Json operator()(const Chart& chart) const {
        Json lines = Json::array(), limits = Json::array(), bands = Json::array();
        for (const ChartLine& l : chart.lines) lines.push_back({{"name", l.name}, {"values", numbers(l.values)}});
        for (const ChartLimit& l : chart.limits)
            limits.push_back({{"name", l.name}, {"value", l.value}, {"line", l.line}});
        for (const ChartBand& b : chart.bands) bands.push_back({{"name", b.name}, {"from", b.from}, {"to", b.to}});
        return {{"kind", "chart"},    {"name", chart.name},       {"title", chart.title},  {"unit", chart.unit},
                {"bars", chart.bars}, {"xUnit", chart.x_unit},    {"x", numbers(chart.x)}, {"lines", lines},
                {"limits", limits},   {"bands", std::move(bands)}};
    }
    Json operator()(const Plan& plan) const {
        Json layers = Json::array();
        for (const PlanLayer& layer : plan.layers) {
            Json shapes = Json::array();
            for (const std::vector<Vec2>& shape : layer.shapes) {
                Json flat = Json::array();
                for (const Vec2& p : shape) {
                    flat.push_back(number(p.x, 1e2));
                    flat.push_back(number(p.y, 1e2));
                }
                shapes.push_back(std::move(flat));
            }
            layers.push_back({{"layer", name_of(layer.layer)},
                              {"name", layer.name},
                              {"shapes", std::move(shapes)},
                              {"labels", layer.labels}});
        }
        return {{"kind", "plan"},
                {"name", plan.name},
                {"title", plan.title},
                {"across", plan.across},
                {"up", plan.up},
                {"layers", std::move(layers)},
                {"north", plan.north ? Json::array({plan.north->x, plan.north->y}) : Json(nullptr)}};
    }
};

Json json_of(const ReportContent& content) {
    Json sections = Json::array();
    for (const Section& section : content.sections) {
        Json blocks = Json::array();
        for (const Block& block : section.blocks) blocks.push_back(std::visit(ToJson{}, block));
        sections.push_back({{"name", section.name},
                            {"title", section.title},
                            {"meaning", section.meaning},
                            {"blocks", std::move(blocks)}});
    }
    return {{"cover", json_of(content.cover)},
            {"program", content.program},
            {"hash", content.short_hash},
            {"sections", std::move(sections)}};
}

}  // namespace

std::string report_html(const Report& report) {
    const ReportContent content = report_content(report);
    const std::string title = html_escaped(content.cover.title);
    const std::string data =
        script_safe(json_of(content).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return filled_page(page(), std::array<Filling, 2>{{{"@@TITLE@@", title}, {"@@REPORT@@", data}}});
}

}  // namespace aerogram::exporter
