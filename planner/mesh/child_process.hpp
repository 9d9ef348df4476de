#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "geo/result.hpp"
#include "geo/run.hpp"

namespace aerogram::planner {

struct ChildLimits {
    std::size_t memory_bytes = std::size_t{3} << 30U;  ///< beyond what this process has mapped already
    std::size_t result_bytes = std::size_t{1} << 30U;
    unsigned cpu_s = 120;    ///< processor time
    unsigned wall_s = 480;   ///< on the clock of the wall; catches a child that sleeps
};

/// The result of `work`, run in a child process, so that whatever a library does there (abort, invalid access, exit,
/// endless loop, all memory) is an error here and nothing else. The child prints nothing, writes no file and no core,
/// holds none of our open files, and dies with this thread.
/// @param work  its answer in bytes, or its error. Runs on a copy of this process: changes it makes stay there.
/// @param who  begins the messages about the child itself: "TetGen".
/// Errors: those of `work`; invalid_input when the child ends without an answer (says how) or exceeds a limit (says
/// which); io when the system starts no process; stopped. A ContractViolation in the child is thrown here.
///
/// Why fork without exec is sound: only the calling thread lives on in the child, so a lock that another thread holds
/// at that moment stays locked there for ever. glibc brings its own (malloc, stdio, loader) through fork in a usable
/// state; the work may use those, and must not wait for other threads of ours. Should it meet a lock of somebody else's
/// all the same, the limit on wall time ends it.
Result<std::string> run_in_child(std::string_view who, const std::function<Result<std::string>()>& work,
                                 const ChildLimits& limits, const Run& run);

}  // namespace aerogram::planner
