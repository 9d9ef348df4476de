#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geo/result.hpp"

namespace aerogram::planner {

/// What is wrong with a mission: collected while reading, told all at once in line order.
class Problems {
  public:
    explicit Problems(std::filesystem::path file) : file_(std::move(file)) {}

    /// "file:line: what".
    void add(int line, const std::string& what);
    /// A problem in a file that the mission names at `line`; `message` carries its own "file:line: ".
    void add_elsewhere(int line, std::string message);

    [[nodiscard]] bool empty() const { return found_.empty(); }
    /// All problems, one a line, by line; those of one line in the order found. @pre not empty().
    [[nodiscard]] Error error() const;
    /// A path as the mission writes it, resolved against the mission's folder.
    [[nodiscard]] std::filesystem::path resolved(const std::string& path) const;

  private:
    struct Problem {
        int line;
        std::string message;
    };
    std::filesystem::path file_;
    std::vector<Problem> found_;
};

/// The word nearest to `word` by edit distance (swapped neighbours count one), or empty when none is near enough to be
/// a typo.
[[nodiscard]] std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace aerogram::planner
