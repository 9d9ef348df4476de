#pragma once
#include "export/outgoing/format.hpp"

namespace aerogram::exporter {

/// Format::read of vviz_format(): straight pieces from sample to sample, light keys that fade from sample to sample.
/// Rounding: 0.5 mm a coordinate, half of kVvizPairCost_m for the lines; speeds by 2 · 0.5 mm · √3 over the shortest
/// step; no accelerations.
Result<RecordedShow> read_vviz(std::span<const FileBytes> files);

}  // namespace aerogram::exporter
