#pragma once
#include <string>

#include "export/report/report.hpp"

/// The report as files (docs/report.md). All show the numbers of one Report.
namespace aerogram::exporter {

/// Machine-readable, with every number at full precision. Same report, same bytes.
std::string report_json(const Report& report);
/// One self-contained page with interactive charts.
std::string report_html(const Report& report);
/// A4 pages, vector graphics; the show's name, hash, verdict and page number on each. Same report, same bytes.
/// Errors: io when the PDF library cannot.
Result<std::string> report_pdf(const Report& report);

/// A sheet to print and to walk the field with: pad, drone, link and system id, home position.
struct PadSheet {
    std::string title, show_hash;
    std::optional<geo::ShowOrigin> origin;
    bool certified = true;  ///< false: every page says so
    std::size_t fleet = 0;  ///< drones of the whole show
    struct Row {
        std::size_t pad = 0, drone = 0;       ///< numbers
        std::string name;                     ///< "drone-017"
        std::size_t link = 1, system_id = 1;  ///< MAVLink's ids have one byte: at most 250 vehicles a link
        Vec3 home_m{};
    };
    std::vector<Row> rows;
};
[[nodiscard]] PadSheet pad_sheet(const OutgoingFacts& facts, const std::string& show_hash, bool certified);
/// Header `pad,drone,name,link,system_id,x_m,y_m,z_m,latitude_deg,longitude_deg,height_m`.
std::string pads_csv(const PadSheet& sheet);
/// A4 pages: the rows, and a plan of the pads with their numbers. Errors: as report_pdf.
Result<std::string> pads_pdf(const PadSheet& sheet);

}  // namespace aerogram::exporter
