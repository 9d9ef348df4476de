#include <optional>

#include "export/report/pads_plan.hpp"
#include "export/report/page_blocks.hpp"
#include "export/report/report_files.hpp"
#include "export/report/report_words.hpp"
#include "geo/show_frame.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kRoomyFleet = 100;  ///< drones; more stand in two columns a page, by numbers only

Table rows_of(const PadSheet& sheet) {
    const bool roomy = sheet.rows.size() <= kRoomyFleet;
    Table table{"pads", "", {}, {}};
    table.side_by_side = roomy ? 1 : 2;
    table.columns = {{"Pad", 5, true}, {"Drone", 6, true}};
    if (roomy) table.columns.push_back({"Name", 14});
    for (const char* title : {"Link", "Id"}) table.columns.push_back({title, 4, true});
    for (const char* title : {"x (m)", "y (m)", "z (m)"}) table.columns.push_back({title, 8, true});
    if (sheet.origin)
        for (const char* title : {"Latitude °", "Longitude °"}) table.columns.push_back({title, 12, true});
    table.columns.push_back({"□", 4, true});
    const std::optional<geo::ShowFrame> frame =
        sheet.origin ? std::optional<geo::ShowFrame>(*sheet.origin) : std::nullopt;
    for (const PadSheet::Row& row : sheet.rows) {
        TableRow cells{{std::to_string(row.pad), std::to_string(row.drone)}, false, {}};
        if (roomy) cells.cells.push_back(row.name);
        cells.cells.insert(cells.cells.end(), {std::to_string(row.link), std::to_string(row.system_id)});
        for (const double metres : {row.home_m.x, row.home_m.y, row.home_m.z})
            cells.cells.push_back(fixed_text(metres, 2));
        if (frame) {
            const geo::Geodetic place = frame->to_geodetic(row.home_m);
            cells.cells.insert(cells.cells.end(),
                               {fixed_text(place.latitude_deg, 7), fixed_text(place.longitude_deg, 7)});
        }
        cells.cells.emplace_back("□");
        table.rows.push_back(std::move(cells));
    }
    return table;
}

std::vector<Fact> facts_of(const PadSheet& sheet) {
    const std::size_t links = sheet.rows.empty() ? 0 : sheet.rows.back().link;
    std::vector<Fact> facts{{"Drones", count_text(sheet.rows.size())},
                            {"Links", count_text(links) + ", system ids 1 to 250 on each"}};
    if (sheet.origin) {
        facts.push_back({"Origin", origin_text(*sheet.origin)});
        facts.push_back({"Heading", fixed_text(sheet.origin->heading_deg, 2) + "° from true north: where y points"});
    } else {
        facts.push_back({"Origin", "none: positions are in the show frame only"});
    }
    return facts;
}

}  // namespace

Result<std::string> pads_pdf(const PadSheet& sheet) {
    PageEdges edges;
    edges.title = sheet.title;
    edges.right = "hash " + short_hash(sheet.show_hash) + " · pad sheet";
    edges.foot = "Pad sheet: put each drone on its pad and tick it off";
    const Table table = rows_of(sheet);
    return drawn_pages("Pad sheet: " + sheet.title, edges, [&](PageFlow& flow) {
        flow.words("PAD SHEET", Face::bold, 8.5, inks::kDim);
        for (const std::string& line : wrapped(flow.paper(), sheet.title, Face::bold, 17.0, kColumn, 3))
            flow.words(line, Face::bold, 17.0, inks::kText);
        flow.skip(4.0);
        for (std::size_t at = 0; at < sheet.show_hash.size(); at += 32)
            flow.words((at == 0 ? "hash " : "     ") + grouped_hash(sheet.show_hash, at, at + 32), Face::mono, 10.0,
                       inks::kText);
        flow.skip(6.0);
        draw_facts(flow, facts_of(sheet));
        draw_table(flow, table);
        draw_pads_plan(flow, sheet);
    });
}

}  // namespace aerogram::exporter
