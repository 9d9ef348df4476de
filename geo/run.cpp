#include "geo/run.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace aerogram {

Error stopped_error() {
    return {ErrorCode::stopped, "stopped on request"};
}

void parallel_for(std::size_t count, const Run& run, std::string_view stage,
                  const std::function<void(std::size_t)>& task) {
    std::atomic<std::size_t> next{0};
    std::size_t finished = 0;
    std::mutex mutex;
    std::vector<std::exception_ptr> failures(count);
    const auto work = [&] {
        for (std::size_t i = next++; i < count && !run.stopped(); i = next++) {
            try {
                task(i);
            } catch (...) {
                failures[i] = std::current_exception();
            }
            if (!stage.empty()) {
                const std::lock_guard lock(mutex);
                ++finished;
                run.report(stage, static_cast<double>(finished) / static_cast<double>(count));
            }
        }
    };
    std::vector<std::jthread> helpers;
    for (std::size_t extra = 1; extra < std::min<std::size_t>(run.threads, count); ++extra) helpers.emplace_back(work);
    work();
    helpers.clear();  // joins
    for (const auto& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

}  // namespace aerogram
