#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"

namespace aerogram::planner {

/// Runs task(i) -> Result<T> for each i on the run's threads and gathers the values, or the error of the lowest i.
template <class T, class Task>
Result<std::vector<T>> gather(std::size_t count, const Run& run, std::string_view stage, const Task& task) {
    std::vector<std::optional<Result<T>>> results(count);
    parallel_for(count, run, stage, [&](std::size_t i) { results[i] = task(i); });
    std::vector<T> values;
    for (auto& result : results) {
        if (!result) return stopped_error();
        if (!*result) return result->error();
        values.push_back(std::move(**result));
    }
    return values;
}

}  // namespace aerogram::planner
