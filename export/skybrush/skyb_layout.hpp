#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// Bytes of a .skyb file (FORMATS.md 2): a header, then blocks of a type, a length and a body.
namespace aerogram::exporter::skyb {

inline constexpr std::string_view kMagic = "skyb";
inline constexpr std::uint8_t kFeatureCrc = 1;
inline constexpr std::size_t kCrcAt = 6, kCrcBytes = 4;  ///< in files of version 2 with the feature
inline constexpr std::size_t kLargestBlock = 65'535;

enum Block : std::uint8_t { none = 0, trajectory = 1, lights = 2, comment = 3, return_plan = 4, yaw = 5, events = 6 };
/// How an axis of a segment is written, two bits each: the number of its values.
enum Axis : std::uint8_t { constant = 0, linear = 1, cubic = 2, seventh = 3 };
inline constexpr std::uint8_t kYawInside = 0x80;  ///< of the scale byte: the trajectory's own yaw counts

inline constexpr std::int64_t kLongestSegmentMs = 60'000;  ///< written; 65,535 fit
inline constexpr std::uint8_t kPyro = 1;                   ///< type of a payload event
inline constexpr std::uint32_t kEventOn = 0, kEventOff = 0xFFFFFFFF;

/// The checksum of a whole file whose CRC bytes are taken as zero: reflected 0xEDB88320, begun with 0, not inverted.
/// @param file  at least kCrcAt + kCrcBytes.
[[nodiscard]] std::uint32_t checksum(std::string_view file);

}  // namespace aerogram::exporter::skyb
