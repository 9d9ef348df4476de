#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "export/report/report.hpp"
#include "geo/vec3.hpp"

/// What the pages of a report say, in words and rows, before anything is drawn: report_html and report_pdf show this
/// and nothing else, so that both say the same. Texts are UTF-8 and not escaped.
namespace aerogram::exporter {

struct Fact {
    std::string name, value;
};
/// A number that stands large on the first page.
struct Figure {
    std::string name, value, detail;
};
/// The first page.
struct Cover {
    std::string title, verdict;  ///< "CERTIFIED", or "NOT CERTIFIED – DO NOT FLY"
    bool certified = false;
    std::vector<std::string> reasons;
    std::string statement;          ///< what the verdict means
    std::vector<std::string> hash;  ///< two lines of groups of four digits
    std::vector<Figure> figures;    ///< six
    std::vector<Fact> facts;        ///< place, heading, drones, ...
    std::vector<Fact> limits;
    std::vector<Fact> findings;        ///< a line of each section
    std::vector<std::string> signing;  ///< what the pilot fills in; empty: nothing to be signed
};

enum class Tone { plain, note, good, bad };
struct Words {
    std::string text;
    Tone tone = Tone::plain;
};
struct Facts {
    std::vector<Fact> facts;
};
struct Column {
    std::string title;
    double share = 1.0;    ///< of the table's width
    bool numeric = false;  ///< to the right, never wrapped
};
struct TableRow {
    std::vector<std::string> cells;
    bool bad = false;
    std::vector<std::size_t> bad_cells = {};  ///< columns, where not the whole row is
};
struct Table {
    std::string name;  ///< an identifier, "rules"
    std::string caption;
    std::vector<Column> columns;
    std::vector<TableRow> rows;
    std::size_t side_by_side = 1;  ///< columns of rows on paper
    bool only_on_screen = false;   ///< too long for paper
};
struct ChartLine {
    std::string name;
    std::vector<double> values;  ///< not finite: a gap
};
struct ChartLimit {
    std::string name;
    double value = 0.0;
    std::size_t line = 0;  ///< whose colour it has
};
struct ChartBand {
    std::string name;
    double from = 0.0, to = 0.0;
};
struct Chart {
    std::string name, title, unit;
    bool bars = false;   ///< x: where each bar begins
    std::string x_unit;  ///< "min:s", "m"
    std::vector<double> x;
    std::vector<ChartLine> lines;  ///< at most three
    std::vector<ChartLimit> limits;
    std::vector<ChartBand> bands;
};
enum class Layer { ground_risk, contingency, flight, audience, obstacle, fence, track, home };
struct PlanLayer {
    Layer layer = Layer::track;
    std::string name;
    std::vector<std::vector<Vec2>> shapes;  ///< outlines, or ways, or (homes) one list of places
    std::vector<std::string> labels;        ///< one a shape, or none
};
/// A map in metres, y up.
struct Plan {
    std::string name, title, across, up;  ///< what the axes are
    std::vector<PlanLayer> layers;        ///< from the bottom to the top
    std::optional<Vec2> north;            ///< a unit vector
};
using Block = std::variant<Words, Facts, Table, Chart, Plan>;

struct Section {
    std::string name, title;
    std::string meaning;  ///< what its numbers mean, one or two sentences
    std::vector<Block> blocks;
};
struct ReportContent {
    Cover cover;
    std::string program, short_hash;  ///< for the edges of each page
    std::vector<Section> sections;
};
[[nodiscard]] ReportContent report_content(const Report& report);

// Its parts.
[[nodiscard]] Cover cover_of(const Report& report);
[[nodiscard]] Section rules_section(const Report& report);
[[nodiscard]] Section over_time_section(const Report& report);
[[nodiscard]] Section distances_section(const Report& report);
[[nodiscard]] Section places_section(const Report& report);
[[nodiscard]] Section turns_section(const Report& report);
[[nodiscard]] Section energy_section(const Report& report);
[[nodiscard]] Section emergency_section(const Report& report);
[[nodiscard]] Section sensitivity_section(const Report& report);
[[nodiscard]] Section lights_section(const Report& report);
[[nodiscard]] Section files_section(const Report& report);
[[nodiscard]] Section glossary_section(const Report& report);
[[nodiscard]] std::vector<ChartBand> keyframe_bands(const Report& report);

}  // namespace aerogram::exporter
