#include "ground/app/interrupt.hpp"

#include <unistd.h>

#include <ctime>

#include "ground/app/exit_status.hpp"

namespace aerogram::ground {
namespace {

sigset_t watched_signals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, signal);
    return set;
}

}  // namespace

InterruptWatch::InterruptWatch() {
    const sigset_t set = watched_signals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);  // inherited by every later thread
    watcher_ = std::jthread([this](const std::stop_token& ending) {
        const sigset_t signals = watched_signals();
        const timespec patience{0, 100'000'000};
        while (!ending.stop_requested()) {
            if (sigtimedwait(&signals, nullptr, &patience) <= 0) continue;
            if (!source_.request_stop()) _exit(kInterrupted);
        }
    });
}

InterruptWatch::~InterruptWatch() {
    watcher_.request_stop();
    pthread_kill(watcher_.native_handle(), SIGHUP);  // wakes it; blocked, so nothing else sees it
}

}  // namespace aerogram::ground
