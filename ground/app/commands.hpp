#pragma once
#include "geo/run.hpp"
#include "ground/app/command_line.hpp"
#include "ground/app/console.hpp"

namespace aerogram::ground {

/// How a command talks: stdout gets its answer (text, or one JSON object), the console its progress and errors.
struct Session {
    bool json = false;
    bool quiet = false;
    Console& console;
    Run run;
};

/// Each does its work and returns the exit status (exit_status.hpp).
int run_plan(const PlanCommand& command, const Session& session);
int run_verify(const VerifyCommand& command, const Session& session);
int run_inspect(const InspectCommand& command, const Session& session);
/// The part of inspect that looks at missions.
int run_inspect_mission(const InspectCommand& command, const Session& session);
/// Writes a show in another format, or imports it as a mission.
int run_convert(const ConvertCommand& command, const Session& session);
int run_new(const NewCommand& command, const Session& session);

/// Writes a picture whole or not at all; never over what is inspected.
Status write_picture(const InspectCommand& command, const Result<std::string>& png);

/// Reports an error in the session's form (with --json also as an object on stdout); returns its exit status.
int report_error(const Error& error, const Session& session);

}  // namespace aerogram::ground
