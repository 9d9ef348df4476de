#include <algorithm>
#include <optional>

#include "export/report/pads_plan.hpp"
#include "export/report/page_blocks.hpp"
#include "export/report/report_files.hpp"
#include "export/report/report_words.hpp"
#include "geo/show_frame.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::size_t kRoomyFleet = 100;  ///< drones; more stand in two columns a page, by numbers only

std::vector<Column> columns_of(bool roomy, bool placed) {
    std::vector<Column> columns{{"Pad", 5, true}, {"Drone", 6, true}};
    if (roomy) columns.push_back({"Name", 14});
    columns.push_back({"Link/Id", 7, true});
    columns.push_back({"x (m)", 8, true});
    columns.push_back({"y (m)", 8, true});
    if (roomy) columns.push_back({"z (m)", 8, true});
    if (placed) columns.push_back({"Latitude °", 12, true});
    if (placed) columns.push_back({"Longitude °", 12, true});
    columns.push_back({"□", 4, true});
    return columns;
}

Table rows_of(const PadSheet& sheet) {
    const bool roomy = sheet.rows.size() <= kRoomyFleet;
    Table table{"pads", "", columns_of(roomy, sheet.origin.has_value()), {}};
    table.side_by_side = roomy ? 1 : 2;
    const std::optional<geo::ShowFrame> frame =
        sheet.origin ? std::optional<geo::ShowFrame>(*sheet.origin) : std::nullopt;
    for (const PadSheet::Row& row : sheet.rows) {
        TableRow cells{{std::to_string(row.pad), std::to_string(row.drone)}, false, {}};
        const auto add = [&](std::string text) { cells.cells.push_back(std::move(text)); };
        if (roomy) add(row.name);
        add(std::to_string(row.link) + "/" + std::to_string(row.system_id));
        add(fixed_text(row.home_m.x, 2));
        add(fixed_text(row.home_m.y, 2));
        if (roomy) add(fixed_text(row.home_m.z, 2));
        if (frame) {
            const geo::Geodetic place = frame->to_geodetic(row.home_m);
            add(fixed_text(place.latitude_deg, 7));
            add(fixed_text(place.longitude_deg, 7));
        }
        add("□");
        table.rows.push_back(std::move(cells));
    }
    return table;
}

std::vector<Fact> facts_of(const PadSheet& sheet) {
    std::size_t links = 0;
    for (const PadSheet::Row& row : sheet.rows) links = std::max(links, row.link);
    std::vector<Fact> facts{{"Drones", count_text(sheet.rows.size()) +
                                           (sheet.rows.size() < sheet.fleet ? " of " + count_text(sheet.fleet) : "")},
                            {"Links", count_text(links) + ", system ids 1 to 250 on each"}};
    if (sheet.origin) {
        facts.push_back({"Origin", origin_text(*sheet.origin)});
        facts.push_back({"Heading", fixed_text(sheet.origin->heading_deg, 2) + "° from true north: where y points"});
    } else {
        facts.push_back({"Origin", "none: positions are in the show frame only"});
    }
    if (sheet.rows.size() > kRoomyFleet) facts.push_back({"Names, heights", "in pads.csv"});
    return facts;
}

}  // namespace

Result<std::string> pads_pdf(const PadSheet& sheet) {
    PageEdges edges;
    edges.title = sheet.title;
    edges.right = "hash " + short_hash(sheet.show_hash) + " · pad sheet";
    if (!sheet.certified) edges.banner = "NOT CERTIFIED – DO NOT FLY";
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
