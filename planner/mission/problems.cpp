#include "planner/mission/problems.hpp"

#include <algorithm>

namespace aerogram::planner {

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

}  // namespace

void Problems::add(int line, const std::string& what) {
    add_elsewhere(line, file_.generic_string() + ":" + std::to_string(line) + ": " + what);
}

void Problems::add_elsewhere(int line, std::string message) {
    found_.push_back({line, std::move(message)});
}

Error Problems::error() const {
    AEROGRAM_REQUIRE(!found_.empty());
    std::vector<Problem> sorted = found_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Problem& a, const Problem& b) { return a.line < b.line; });
    std::string message;
    for (const Problem& problem : sorted) {
        if (!message.empty()) message += '\n';
        message += problem.message;
    }
    return {ErrorCode::invalid_input, message};
}

std::filesystem::path Problems::resolved(const std::string& path) const {
    return (file_.parent_path() / path).lexically_normal();
}

std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& known) {
    if (word.size() > 40) return {};
    std::string_view best;
    std::size_t least = word.size() + 1;
    for (const std::string_view candidate : known) {
        // A part of a compound name ("hold" for "hold_s", "speed" for "speed_up_mps") is as near as one slip.
        const bool part = word.size() >= 3 && candidate.starts_with(word);
        const std::size_t distance = part ? 1 : edit_distance(word, candidate);
        const std::size_t typo = std::max<std::size_t>(1, (std::max(word.size(), candidate.size()) + 1) / 3);
        if (distance < least && distance <= typo) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace aerogram::planner
