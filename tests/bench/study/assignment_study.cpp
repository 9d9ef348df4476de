// Who flies where at the least squared cost: CPU seconds, certified gap, pairwise property, memory.
#include <stdexcept>

#include "planner/assignment/assignment.hpp"
#include "tests/bench/study/instances.hpp"
#include "tests/bench/study/study.hpp"

namespace aerogram::study {
namespace {

using planner::Assignment;

Json assignment(const Arguments& arguments) {
    const std::string& name = arguments.word(0);
    const std::size_t n = arguments.count(1);
    const Instance instance = make_instance(name, n);
    const auto solve = [&] {
        return planner::assign_shortest(instance.from_m, instance.to_m, {}, SeparationMetric{}, Run{}).value();
    };
    const MemoryRise memory;
    Assignment found = solve();
    const double peak_mb = memory.peak_mb();
    const double seconds =
        median_cpu_s(static_cast<std::size_t>(arguments.number("runs", 3)), [&] { found = solve(); });
    if (!found.pairwise) throw std::runtime_error("a pair crosses");
    if (!(found.duality_gap <= 1e-6)) throw std::runtime_error("the gap is above 1e-6");
    return Json{}
        .add("instance", name)
        .add("n", static_cast<double>(n))
        .add("cost_m2", found.cost_m2)
        .add("gap", found.duality_gap)
        .add("pairwise", found.pairwise)
        .add("cpu_s", seconds)
        .add("peak_mb", peak_mb);
}

const Study kAssignment{"assignment", "INSTANCE N [--runs 3]", "sheet-sphere 60 --runs 1", assignment};

}  // namespace
}  // namespace aerogram::study
