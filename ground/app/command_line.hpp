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
};
struct VerifyCommand {
    std::vector<std::filesystem::path> paths;
};
struct InspectCommand {
    std::filesystem::path file;           ///< a mission, or an exported file
    std::vector<double> at_s;             ///< of an exported file
    std::optional<std::string> keyframe;  ///< of a mission: name, number or clip
    std::optional<std::filesystem::path> png;
    int width_px = exporter::kPicture_px;  ///< of the picture
};
struct NewCommand {
    std::string name;
};

struct CommandLine {
    std::variant<PlanCommand, VerifyCommand, InspectCommand, NewCommand> command;
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
