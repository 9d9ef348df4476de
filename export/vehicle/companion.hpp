#pragma once
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "export/bytes/file_bytes.hpp"
#include "export/outgoing/format.hpp"

/// `show.json` beside the files of vehicles whose own formats have no room for notes: what the show says of itself
/// (export/outgoing/facts_json.hpp), and of each drone its file, name, home, landing place and payload events.
namespace aerogram::exporter {

inline constexpr std::string_view kCompanionName = "show.json";

/// {"format": "...", "show": {...}, "drones": [{"file", "name", "number", "home_m", "land_m",
/// "events_ms_channel_on"}]}.
/// @param file_of  the name, without a folder, of the file of drone i.
[[nodiscard]] std::string companion_text(const OutgoingShow& show, const Seal& seal, std::string_view format,
                                         const std::function<std::string(std::size_t)>& file_of);

/// True of a companion of this format by its beginning.
[[nodiscard]] bool is_companion(std::string_view format, std::string_view first_bytes);

/// What a companion says, for its readers.
struct Companion {
    RecordedShow show;                            ///< all but the drones
    std::map<std::string, RecordedDrone> drones;  ///< by file; without flights
};
/// Errors: invalid_input with file and key.
Result<Companion> read_companion(const FileBytes& file, std::string_view format);

/// The files in the order of the whole number that their names end in ("Drone 2.csv" before "Drone 10.csv"), then of
/// their names.
[[nodiscard]] std::vector<const FileBytes*> in_order_of_numbers(std::span<const FileBytes> files);

/// "Drone 2.csv" of "px4/Drone 2.csv".
[[nodiscard]] std::string file_name(const std::string& path);

}  // namespace aerogram::exporter
