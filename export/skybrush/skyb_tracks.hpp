#pragma once
#include <span>
#include <string>
#include <vector>

#include "export/bytes/little_endian.hpp"
#include "geo/tracks.hpp"

/// Bodies of the yaw and the event block of a .skyb file.
namespace aerogram::exporter {

/// Tenths of a degree clockwise from +X, as durations and changes that add up without drift; what is longer than 65 s
/// or turns by more than 3,276 degrees is cut into parts. Property: yaw_at of what is read back is within 0.05 degrees.
[[nodiscard]] std::string skyb_yaw(std::span<const YawKey> keys);
/// No keys where the file leaves yaw to the vehicle. @param in  over the block's body.
[[nodiscard]] std::vector<YawKey> read_skyb_yaw(ByteCursor& in);

/// @param events  channels from 0 to 255.
[[nodiscard]] std::string skyb_events(std::span<const PayloadEvent> events);
/// In time order; events of other types are left out. @param in  over the block's body.
[[nodiscard]] std::vector<PayloadEvent> read_skyb_events(ByteCursor& in);

}  // namespace aerogram::exporter
