#include <iostream>

#include "export/files.hpp"
#include "ground/app/answers.hpp"
#include "ground/app/commands.hpp"
#include "ground/app/exit_status.hpp"
#include "planner/mission/mission_template.hpp"

namespace aerogram::ground {

int report_error(const Error& error, const Session& session) {
    session.console.error(error.message);
    const int status = exit_status(error.code);
    if (session.json) std::cout << error_answer(error, status);
    return status;
}

int run_new(const NewCommand& command, const Session& session) {
    std::filesystem::path file = command.name;
    if (file.extension() != ".toml") file += ".toml";
    if (file.stem().empty()) {
        return report_error({ErrorCode::invalid_input, command.name + ": a mission needs a name"}, session);
    }
    if (std::filesystem::exists(file)) {
        return report_error({ErrorCode::invalid_input, file.string() + ": is there already; choose another name"},
                            session);
    }
    if (auto written = exporter::write_file(file, planner::mission_template(file.stem().string())); !written) {
        return report_error(written.error(), session);
    }
    if (session.json) {
        std::cout << new_answer(file);
    } else if (!session.quiet) {
        std::cout << "written: " << file.string() << "\nnext:    aerogram plan " << file.string() << "\n";
    }
    return kDone;
}

}  // namespace aerogram::ground
