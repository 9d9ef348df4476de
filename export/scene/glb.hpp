#pragma once
#include <cstdint>

#include "export/outgoing/format.hpp"

/// `show.glb`: glTF 2.0 in one binary file, an animated node a drone (docs/formats/glb.md).
namespace aerogram::exporter {

/// The largest file that is written, bytes: what scene programs still open.
inline constexpr std::uint64_t kLargestGlb = std::uint64_t{1} << 30U;

/// Writes a node a drone, named after it, all with one small shape; translations as CUBICSPLINE keys, which are the
/// fitted C1 cubics themselves, rounded to floats; drones with the same key times share them. Emission of each shape is
/// the first bright light of its drone; glTF cannot animate it without an extension that viewers lack, so all lights
/// stand in a buffer view of ours, 8 bits a channel; yaw, events, home and landing place in the nodes' extras; what the
/// show says of itself (export/outgoing/facts_json.hpp) in asset.extras.aerogram.
[[nodiscard]] const Format& glb_format();

/// Format::read of glb_format(): every node that an animation moves is a drone. Other programs' files: LINEAR, STEP and
/// CUBICSPLINE translations, under parents that stand (translations, rotations, scales, matrices); sparse accessors,
/// external buffers and moving parents are refused. A file without lights of ours has its materials' emission.
/// Rounding: floats of the largest coordinate, speed and time; the fit is fit_bound's; steps have no speeds, straight
/// keys no accelerations. Errors: invalid_input with file and place; memory is at most about 20 times the bytes.
Result<RecordedShow> read_glb(std::span<const FileBytes> files);

}  // namespace aerogram::exporter
