#include "ground/app/console.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace aerogram::ground {
namespace {

constexpr auto kRedrawInterval = std::chrono::milliseconds(80);
constexpr int kBarCells = 30;

}  // namespace

Console::Console(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {
}

Console::~Console() {
    clear_line();
}

void Console::progress(std::string_view stage, double fraction) {
    if (quiet_) return;
    const bool changed = stage_ != stage;
    stage_ = stage;
    if (!terminal_) {
        if (told_.insert(stage_).second) std::cerr << "aerogram: " << stage << "\n" << std::flush;
        return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (!changed && now - drawn_ < kRedrawInterval) return;
    drawn_ = now;
    const int filled = static_cast<int>(std::lround(std::clamp(fraction, 0.0, 1.0) * kBarCells));
    std::cerr << "\r\x1b[K  [" << std::string(static_cast<std::size_t>(filled), '=')
              << std::string(static_cast<std::size_t>(kBarCells - filled), ' ') << "] " << stage << std::flush;
    line_shown_ = true;
}

void Console::error(std::string_view message) {
    clear_line();
    std::cerr << message << "\n" << std::flush;
}

void Console::clear_line() {
    if (!line_shown_) return;
    std::cerr << "\r\x1b[K" << std::flush;
    line_shown_ = false;
}

}  // namespace aerogram::ground
