#pragma once
#include "export/report/page_flow.hpp"
#include "export/report/report_files.hpp"

namespace aerogram::exporter {

/// Plans of the pads with their numbers, as many sheets as it takes that no two numbers touch; where there are several,
/// an overview of the sheets first. Each begins a page.
void draw_pads_plan(PageFlow& flow, const PadSheet& sheet);

}  // namespace aerogram::exporter
