#pragma once
#include <string>
#include <string_view>

#include "export/outgoing/format.hpp"

/// preview.html: the show in a browser, one self-contained page (docs/formats/preview.md). It holds a trajectories.bin
/// with 4-byte scalars and the viewer of export/preview, which evaluates the same splines.
namespace aerogram::exporter {

/// The page. @param plan  one for which trajectories_unsuited() is empty.
std::string preview_page(const planner::FlightPlan& plan, const Seal& seal);

/// The show that a page holds. Errors: invalid_input when it is no page of ours or its show is damaged.
Result<RecordedShow> read_preview(std::string_view page);

const Format& preview_format();

}  // namespace aerogram::exporter
