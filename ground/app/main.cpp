#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string_view>

#include "ground/app/answers.hpp"
#include "ground/app/command_line.hpp"
#include "ground/app/commands.hpp"
#include "ground/app/exit_status.hpp"
#include "ground/app/interrupt.hpp"

namespace {

using namespace aerogram;
using namespace aerogram::ground;

int dispatch(const CommandLine& line) {
    const InterruptWatch interrupt;
    Console console(line.quiet);
    const Session session{
        line.json,
        line.quiet,
        console,
        {interrupt.token(), [&](std::string_view stage, double fraction) { console.progress(stage, fraction); },
         line.threads}};
    if (const auto* plan = std::get_if<PlanCommand>(&line.command)) return run_plan(*plan, session);
    if (const auto* verify = std::get_if<VerifyCommand>(&line.command)) return run_verify(*verify, session);
    if (const auto* inspect = std::get_if<InspectCommand>(&line.command)) return run_inspect(*inspect, session);
    if (const auto* convert = std::get_if<ConvertCommand>(&line.command)) return run_convert(*convert, session);
    return run_new(std::get<NewCommand>(line.command), session);
}

/// For arguments that could not be parsed: --json is honoured all the same.
bool asks_for_json(int argc, char** argv) {
    return std::any_of(argv, argv + argc, [](const char* word) { return std::string_view(word) == "--json"; });
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const auto parsed = parse_command_line(argc, argv);
        if (const auto* farewell = std::get_if<Farewell>(&parsed)) {
            (farewell->status == kDone ? std::cout : std::cerr) << farewell->text;
            if (farewell->status != kDone && asks_for_json(argc, argv)) {
                std::cout << error_answer({ErrorCode::invalid_input, farewell->text}, farewell->status);
            }
            return farewell->status;
        }
        return dispatch(std::get<CommandLine>(parsed));
    } catch (const std::bad_alloc&) {
        std::cerr << "aerogram: there is not enough memory for this\n";
        return kBadInput;
    } catch (const std::exception& bug) {
        std::cerr << "aerogram: this is a bug, please report it: " << bug.what() << "\n";
        return 70;
    }
}
