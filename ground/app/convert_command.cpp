#include <iostream>
#include <sstream>

#include "export/convert.hpp"
#include "export/import_mission.hpp"
#include "ground/app/answers.hpp"
#include "ground/app/commands.hpp"
#include "ground/app/exit_status.hpp"
#include "ground/app/wishes.hpp"
#include "ground/app/words.hpp"
#include "planner/mission/sections.hpp"

namespace aerogram::ground {
namespace {

constexpr double kMillimetres = 1000.0;

std::string millimetres(double metres) {
    return decimals(kMillimetres * metres, 2) + " mm";
}

bool is_mission(const std::filesystem::path& file) {
    return file.extension() == ".toml";
}

std::string listed(const std::string& head, const std::vector<std::string>& items) {
    std::string text;
    for (const std::string& item : items) text += head + item + "\n";
    return text;
}

std::string files_line(const std::vector<std::filesystem::path>& files) {
    std::string text = "written to     " + files.front().string();
    if (files.size() > 1) text += " and " + counted(files.size() - 1, "file") + " more";
    return text + "\n";
}

std::string told(const exporter::Converted& converted) {
    std::ostringstream text;
    text << converted.from << " -> " << converted.format << ": " << counted(converted.drones, "drone") << "\n";
    if (converted.deviation) {
        text << "accuracy       within " << millimetres(converted.deviation->position_m)
             << " of what was read, at every instant (" << converted.format << " states "
             << millimetres(converted.stated_m) << ")\n";
    } else {
        text << "accuracy       places within " << millimetres(converted.stated_m) << "; no times\n";
    }
    if (!converted.completed_from.empty()) text << "completed      from " << converted.completed_from << "\n";
    text << listed("assumed        ", converted.assumed) << listed("lost           ", converted.lost);
    if (!converted.no_longer_certified.empty())
        text << "NOT CERTIFIED  any more: " << converted.no_longer_certified << "\n";
    text << files_line(converted.files);
    return text.str();
}

std::string told(const exporter::Imported& imported, const std::filesystem::path& mission) {
    std::ostringstream text;
    text << imported.from << " -> mission: " << counted(imported.drones, "drone") << ", "
         << counted(imported.keyframes, "keyframe") << "\n";
    text << "accuracy       places within " << millimetres(imported.accuracy_m) << " (" << imported.from << "'s own)\n";
    if (!imported.completed_from.empty()) text << "completed      from " << imported.completed_from << "\n";
    text << listed("assumed        ", imported.assumed) << listed("lost           ", imported.left);
    text << (imported.plans ? "plans          certified, as it is\n"
                            : "DOES NOT PLAN  yet; correct it:\n" + imported.cannot_plan + "\n");
    text << files_line(imported.files) << "next           aerogram plan " << mission.string() << "\n";
    return text.str();
}

Result<std::vector<std::size_t>> numbers_of(const std::string& list) {
    std::vector<std::size_t> numbers;
    if (list.empty()) return numbers;
    const auto drones = planner::parse_drone_list(list, 0);
    if (!drones) return Error{drones.error().code, "--drones " + list + ": " + drones.error().message};
    for (const DroneId drone : *drones) numbers.push_back(drone.number());
    return numbers;
}

int run_import(const ConvertCommand& command, const exporter::ImportOptions& options, const Session& session) {
    const auto imported = exporter::import_mission(command.in, command.out, options, session.run);
    if (!imported) return report_error(imported.error(), session);
    session.console.clear_line();
    if (session.json) {
        std::cout << import_answer(*imported);
    } else if (!session.quiet) {
        std::cout << told(*imported, command.out);
    }
    return imported->plans ? kDone : kCannotBeFlown;
}

}  // namespace

int run_convert(const ConvertCommand& command, const Session& session) {
    exporter::ConvertOptions options;
    options.format = command.format;
    options.force = command.force;
    const auto numbers = numbers_of(command.drones);
    if (!numbers) return report_error(numbers.error(), session);
    options.drones = *numbers;
    const auto origin = parse_origin(command.origin);
    if (!origin) return report_error(origin.error(), session);
    options.origin = *origin;
    const Status wished =
        take_wishes({command.start_utc, command.timing, command.autopilot, command.vviz}, options.exporting);
    if (!wished) return report_error(wished.error(), session);
    if (is_mission(command.out)) {
        if (!command.format.empty())
            return report_error({ErrorCode::invalid_input, "--format " + command.format + ": " + command.out.string() +
                                                               " is a mission to import into"},
                                session);
        return run_import(command, {options.drones, options.origin, options.force}, session);
    }
    const auto converted = exporter::convert(command.in, command.out, options, session.run);
    if (!converted) return report_error(converted.error(), session);
    session.console.clear_line();
    if (session.json) {
        std::cout << convert_answer(*converted);
    } else if (!session.quiet) {
        std::cout << told(*converted);
    }
    return kDone;
}

}  // namespace aerogram::ground
