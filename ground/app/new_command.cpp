#include <algorithm>
#include <iostream>

#include "export/bytes/files.hpp"
#include "ground/app/answers.hpp"
#include "ground/app/commands.hpp"
#include "ground/app/exit_status.hpp"
#include "planner/mission/mission_template.hpp"

namespace aerogram::ground {
namespace {

constexpr std::size_t kLongestName = 200;

}  // namespace

int report_error(const Error& error, const Session& session) {
    session.console.error(error.message);
    const int status = exit_status(error.code);
    if (session.json) std::cout << error_answer(error, status);
    return status;
}

int run_new(const NewCommand& command, const Session& session) {
    std::filesystem::path file = command.name;
    if (file.extension() != ".toml") file += ".toml";
    const std::string stem = file.stem().string();
    const bool plain =
        std::ranges::none_of(stem, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
    if (stem.empty() || stem.front() == '.' || !plain || stem.size() > kLongestName) {
        return report_error({ErrorCode::invalid_input,
                             "\"" + command.name + "\": a mission's name is 1 to " + std::to_string(kLongestName) +
                                 " characters, none of them a control character, the first no dot"},
                            session);
    }
    std::error_code unreachable;  // then writing says why
    if (std::filesystem::exists(file, unreachable)) {
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
