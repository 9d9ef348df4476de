#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "export/convert.hpp"
#include "export/export_show.hpp"
#include "export/import_mission.hpp"
#include "export/picture/formation_facts.hpp"
#include "export/record/recorded_show.hpp"
#include "export/verify_show.hpp"
#include "planner/formation/formation.hpp"
#include "planner/mission/mission.hpp"
#include "planner/motion/flight_plan.hpp"

/// The objects that --json prints on stdout: one a command, two-space indented, ending with a newline. Lengths in
/// metres, times in seconds; keys carry their units.
namespace aerogram::ground {

struct InspectedFormation {
    exporter::FormationFacts facts;
    planner::Formation formation;
};

std::string plan_answer(const planner::FlightPlan& plan, const exporter::ExportedShow& shown,
                        const std::filesystem::path& out);
std::string verify_answer(const std::vector<std::pair<std::filesystem::path, exporter::Verified>>& verified);
std::string inspect_answer(const exporter::OpenedShow& opened, const std::vector<double>& at_s,
                           const std::optional<std::filesystem::path>& picture);
std::string convert_answer(const exporter::Converted& converted);
std::string import_answer(const exporter::Imported& imported);
/// One keyframe's object, or, of a clip's name, {"keyframes": [...]} with one a frame. @param picture  what was
/// written.
std::string formation_answer(const std::vector<InspectedFormation>& inspected,
                             const std::optional<std::filesystem::path>& picture);
/// What keyframes a mission has.
std::string keyframes_answer(const planner::Mission& mission);
std::string new_answer(const std::filesystem::path& file);
std::string error_answer(const Error& error, int status);

}  // namespace aerogram::ground
