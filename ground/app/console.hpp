#pragma once
#include <chrono>
#include <iosfwd>
#include <set>
#include <string>
#include <string_view>

namespace aerogram::ground {

/// Where messages go: stderr. On a terminal progress is one line that is rewritten; elsewhere each stage is a plain
/// line.
class Console {
  public:
    explicit Console(bool quiet);
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    void progress(std::string_view stage, double fraction);
    void error(std::string_view message);
    /// Takes the progress line away, before an answer is printed.
    void clear_line();

  private:
    bool quiet_, terminal_;
    bool line_shown_ = false;
    std::string stage_;
    std::set<std::string> told_;  ///< stages that have their line, where progress is not drawn
    std::chrono::steady_clock::time_point drawn_{};
};

}  // namespace aerogram::ground
