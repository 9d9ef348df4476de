#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "export/picture/picture_size.hpp"
#include "geo/result.hpp"

/// What was typed, as values. Parsing knows no command's work; the commands know no parser.
namespace aerogram::ground {

struct PlanCommand {
    std::filesystem::path mission;
    std::filesystem::path out;         ///< empty: out/<mission file's stem>
    std::vector<std::string> formats;  ///< empty: all that suit the show
    bool best_effort = false;
    std::string drones;                ///< only these drones' files: "1-50,60"; empty: all
    std::vector<std::string> replace;  ///< "17=pad 41" each
    // Instead of what the mission's [export] says; empty: that.
    std::string start_utc, timing, autopilot, vviz;
};
struct ConvertCommand {
    std::filesystem::path in, out;
    std::string format;  ///< empty: by the ending of out
    std::string drones;  ///< "1-50,60"; empty: all
    std::string origin;  ///< "LATITUDE,LONGITUDE,HEIGHT,HEADING"; empty: what the file says
    std::string start_utc, timing, autopilot, vviz;
    bool force = false;
};
struct VerifyCommand {
    std::vector<std::filesystem::path> paths;
};
struct InspectCommand {
    std::filesystem::path file;           ///< a mission, an exported file, or a folder of them
    std::vector<double> at_s;             ///< of an exported file
    std::optional<std::string> keyframe;  ///< of a mission: name, number or clip
    std::optional<std::filesystem::path> png;
    int width_px = exporter::kPicture_px;  ///< of the picture
};
struct NewCommand {
    std::string name;
};

struct CommandLine {
    std::variant<PlanCommand, VerifyCommand, InspectCommand, ConvertCommand, NewCommand> command;
    unsigned threads = 1;
    bool json = false;
    bool quiet = false;
};

/// Text to print and the exit status to leave with: help, the version, or what is wrong with the arguments.
struct Farewell {
    std::string text;
    int status = 0;
};

/// Without arguments the command explains itself.
std::variant<CommandLine, Farewell> parse_command_line(int argc, const char* const* argv);

}  // namespace aerogram::ground
