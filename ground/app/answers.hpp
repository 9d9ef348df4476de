#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "export/export_show.hpp"
#include "export/record/recorded_show.hpp"
#include "export/verify_show.hpp"
#include "planner/motion/flight_plan.hpp"

/// The objects that --json prints on stdout: one a command, two-space indented, ending with a newline. Lengths in
/// metres, times in seconds; keys carry their units.
namespace aerogram::ground {

std::string plan_answer(const planner::FlightPlan& plan, const exporter::ExportedShow& shown,
                        const std::filesystem::path& out);
std::string verify_answer(const std::vector<std::pair<std::filesystem::path, exporter::Verified>>& verified);
std::string inspect_answer(const exporter::RecordedShow& show, const std::vector<double>& at_s);
std::string new_answer(const std::filesystem::path& file);
std::string error_answer(const Error& error, int status);

}  // namespace aerogram::ground
