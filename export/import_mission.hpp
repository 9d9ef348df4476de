#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "export/open_show.hpp"
#include "geo/show_frame.hpp"

/// A show that exists becomes a mission that can be edited and planned again (docs/convert.md).
namespace aerogram::exporter {

struct ImportOptions {
    std::vector<std::size_t> drones;  ///< only these, by their numbers, rising; empty: all
    std::optional<geo::ShowOrigin> origin;
    bool force = false;  ///< replace files that are there
};

struct Imported {
    std::string from;                          ///< name of the format
    std::vector<std::filesystem::path> files;  ///< written: the mission first
    std::size_t drones = 0, keyframes = 0;
    double accuracy_m = 0.0;  ///< what the format states that a place may be off by
    std::string completed_from;
    bool plans = false;                ///< the mission was planned, and certified, as it was written
    std::string cannot_plan;           ///< else why not
    std::vector<std::string> assumed;  ///< what the file did not say
    std::vector<std::string> left;     ///< what is not carried, or comes later than it was
};

/// Writes OUT (a .toml) and beside it a folder of its name with pads.csv and keyframe-01.csv...: one keyframe for each
/// span in which the whole fleet stands in the air, places and colours by drone, `assign = "keep"`. The mission is
/// planned once to see which formations can stand when they stood: these keep their time (`at_s`), or arrive somewhat
/// later and leave when they left; the others come as soon as they can.
/// Errors: invalid_input: IN cannot be read, has no times, flies planes, never stands in the air, or does not say where
/// on the globe it is and options.origin does not either; OUT or its folder is there already; io; stopped.
Result<Imported> import_mission(const std::filesystem::path& in, const std::filesystem::path& out,
                                const ImportOptions& options, const Run& run);

}  // namespace aerogram::exporter
