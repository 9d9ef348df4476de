#pragma once
#include <signal.h>

#include <stop_token>
#include <thread>

namespace aerogram::ground {

/// Turns Ctrl-C (SIGINT), SIGTERM and SIGHUP into a stop request, taken on a thread of its own. A second signal ends
/// the process at once; nothing is lost, since folders are swapped in only when complete. Create it before any other
/// thread.
class InterruptWatch {
  public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

  private:
    std::stop_source source_;
    std::jthread watcher_;
};

}  // namespace aerogram::ground
