#pragma once
#include "export/outgoing/format.hpp"

namespace aerogram::exporter {

/// Format::read of csv_format(): straight pieces from row to row, light keys that fade from row to row, home at the
/// first row. Rounding: 0.5 mm a coordinate; speeds by 2 · 0.5 mm · √3 over the shortest interval in which anybody
/// moves; no accelerations.
Result<RecordedShow> read_csv_zip(std::span<const FileBytes> files);

}  // namespace aerogram::exporter
