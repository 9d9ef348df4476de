#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <thread>

#include "export/formats.hpp"
#include "export/outgoing/program.hpp"
#include "export/verify_agreement.hpp"
#include "ground/app/command_line.hpp"
#include "ground/app/exit_status.hpp"

namespace aerogram::ground {
namespace {

std::string format_list() {
    std::string names;
    for (const auto& format : exporter::formats()) names += (names.empty() ? "" : ",") + std::string(format.name);
    return names;
}

std::string paper_list() {
    std::string names;
    for (const auto& paper : exporter::kPapers) names += "," + std::string(paper);
    return names;
}

/// A line a format, for the end of a help.
std::string format_table() {
    constexpr std::size_t kNames = 14;
    std::string lines = "Formats:\n";
    for (const auto& format : exporter::formats()) {
        std::string name(format.name);
        name.resize(std::max(kNames, name.size() + 1), ' ');
        lines += "  " + name + std::string(format.description) + "\n";
    }
    return lines;
}

/// Options that plan and convert share: what a mission's [export] says.
template <class Command>
void add_export_options(CLI::App& app, Command& command, const std::string& instead) {
    app.add_option("--start-utc", command.start_utc,
                   "show time 0 as UTC, \"2026-12-31T22:00:00Z\", for waypoint missions that keep time" + instead);
    app.add_option(
        "--timing", command.timing,
        "of waypoint missions: none, absolute (waits for UTC times), speed (a speed a leg; inexact)" + instead);
    app.add_option("--autopilot", command.autopilot, "of waypoint missions: ardupilot or px4" + instead);
    app.add_option("--vviz", command.vviz,
                   "where z points in VVIZ files: verge (forward) or finale (backward)" + instead);
}

constexpr const char* kIntroduction =
    "Plans 3D airshow and drone formations: from a mission file to certified trajectories and files for ground "
    "stations.\n"
    "Start with:  aerogram new my-show   then:  aerogram plan my-show.toml";

}  // namespace

std::variant<CommandLine, Farewell> parse_command_line(int argc, const char* const* argv) {
    CommandLine line;
    line.threads = std::max(1U, std::thread::hardware_concurrency());
    CLI::App app(kIntroduction, "aerogram");
    app.set_version_flag("--version",
                         std::string(exporter::kProgramName) + " " + std::string(exporter::kProgramVersion));
    app.require_subcommand(1);
    app.fallthrough();
    app.add_flag("--json", line.json, "print one machine-readable object on stdout; messages go to stderr");
    app.add_flag("--quiet", line.quiet, "no progress and no summary; errors only");
    app.add_option("--threads", line.threads, "threads to use; results do not depend on it")
        ->check(CLI::Range(1U, 256U));

    PlanCommand plan;
    auto* plan_app = app.add_subcommand("plan", "plan a mission, certify it and write every export");
    plan_app->add_option("MISSION", plan.mission, "mission file (TOML)")->required();
    plan_app->add_option("-o,--out", plan.out, "folder to write; replaced as a whole (default: out/<mission name>)");
    plan_app->add_option("--format", plan.formats, "only these, comma separated: " + format_list() + paper_list())
        ->delimiter(',');
    plan_app->add_flag("--best-effort", plan.best_effort,
                       "write the show even where it is not certified, marked as such");
    plan_app->add_option("--drones", plan.drones,
                         "only these drones' files, \"1-50,60\"; the whole show is planned and gives the show hash");
    plan_app->add_option("--replace", plan.replace,
                         "\"17=pad 41\": a spare drone on pad 41 flies drone 17's part, nothing else changes; several "
                         "times for several drones");
    add_export_options(*plan_app, plan, "; instead of the mission's [export]");
    plan_app->footer(format_table());

    VerifyCommand verify;
    auto* verify_app =
        app.add_subcommand("verify", "re-read exported files and judge them again, from the files alone");
    verify_app->add_option("PATH", verify.paths, "show folders or single files")->required();

    InspectCommand inspect;
    auto* inspect_app = app.add_subcommand(
        "inspect", "tell, and draw, what a keyframe of a mission looks like or what is in an exported file");
    inspect_app
        ->add_option(
            "FILE", inspect.file,
            "a mission (.toml), an exported file in any format we read, or a folder of a show or of one format")
        ->required();
    inspect_app->add_option("--keyframe", inspect.keyframe,
                            "of a mission: a keyframe's name or number, or a clip's name for all its frames");
    inspect_app->add_option("--at", inspect.at_s, "of an exported file: positions and colours at these times, seconds");
    inspect_app->add_option("--png", inspect.png,
                            "write a picture: a keyframe from three sides with its spacings, or the show's front view "
                            "at each --at");
    inspect_app->add_option("--width", inspect.width_px, "of the picture, pixels")
        ->check(CLI::Range(exporter::kNarrowestPicture_px, exporter::kWidestPicture_px))
        ->capture_default_str();

    ConvertCommand convert;
    auto* convert_app = app.add_subcommand(
        "convert", "write a show in another format, or import it as a mission to edit; says what is lost");
    convert_app->add_option("IN", convert.in, "a file in any format we read, or a folder of a show or of one format")
        ->required();
    convert_app
        ->add_option("OUT", convert.out,
                     "a file, a folder for formats of a file a drone, or a mission (.toml) to import into")
        ->required();
    convert_app->add_option("--format", convert.format,
                            "of OUT, where its ending does not tell: one of " + format_list());
    convert_app->add_option("--drones", convert.drones, "only these drones: \"1-50,60\"");
    convert_app->add_option("--origin", convert.origin,
                            "where show (0, 0, 0) is and where +y points: LATITUDE,LONGITUDE,HEIGHT,HEADING (degrees, "
                            "metres above the ellipsoid, degrees clockwise from north)");
    add_export_options(*convert_app, convert, "");
    convert_app->add_flag("--force", convert.force, "replace OUT where it is there already");
    convert_app->footer(format_table());

    NewCommand create;
    auto* new_app = app.add_subcommand("new", "write a commented mission to start from");
    new_app->add_option("NAME", create.name, "the mission's name; writes NAME.toml")->required();

    if (argc <= 1) return Farewell{app.help(), kDone};
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::ostringstream out, wrong;
        const int status = app.exit(error, out, wrong) == 0 ? kDone : kBadInput;
        return Farewell{out.str() + wrong.str(), status};
    }
    for (std::string& format : plan.formats) format = CLI::detail::trim_copy(format);
    if (*plan_app) line.command = plan;
    if (*verify_app) line.command = verify;
    if (*inspect_app) line.command = inspect;
    if (*convert_app) line.command = convert;
    if (*new_app) line.command = create;
    return line;
}

}  // namespace aerogram::ground
