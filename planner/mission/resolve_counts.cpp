#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

// Whole numbers near `exact` that sum to `total`; the largest remainders are rounded up, ties to the first.
std::vector<std::size_t> largest_remainder(const std::vector<double>& exact, std::size_t total) {
    std::vector<std::size_t> counts;
    for (const double e : exact) counts.push_back(static_cast<std::size_t>(std::floor(e + 1e-9)));
    std::vector<std::size_t> order(exact.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto remainder = [&](std::size_t i) { return exact[i] - static_cast<double>(counts[i]); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return remainder(a) > remainder(b) + 1e-9; });
    std::size_t left = total - std::min(total, std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
    for (const std::size_t i : order) {
        if (left == 0) break;
        ++counts[i];
        --left;
    }
    return counts;
}

}  // namespace

Result<std::vector<std::size_t>> resolve_counts(std::span<const CountWish> parts, std::size_t fleet) {
    std::vector<std::size_t> counts(parts.size(), 0);
    std::vector<std::size_t> by_share;
    std::vector<std::size_t> by_rest;
    std::vector<double> exact;
    double asked = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].drones) {
            counts[i] = *parts[i].drones;
            asked += static_cast<double>(counts[i]);
        } else if (parts[i].share) {
            by_share.push_back(i);
            exact.push_back(*parts[i].share * static_cast<double>(fleet));
            asked += exact.back();
        } else {
            by_rest.push_back(i);
        }
    }
    const double left = static_cast<double>(fleet) - asked;
    const auto rounded = [](double d) { return shown(std::round(d * 100.0) / 100.0); };
    const std::string of_fleet = rounded(asked) + " of " + std::to_string(fleet) + " drones";
    if (left < static_cast<double>(by_rest.size()) - 0.5) {
        return Error{ErrorCode::invalid_input,
                     "the parts take " + of_fleet +
                         (by_rest.empty() ? "; must be at most all of them"
                                          : "; must leave at least one for each part without drones or share")};
    }
    const std::size_t given = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    const double shares = std::accumulate(exact.begin(), exact.end(), 0.0);
    const std::size_t for_shares = std::min(fleet - given, static_cast<std::size_t>(std::llround(shares)));
    const auto shared = largest_remainder(exact, for_shares);
    for (std::size_t k = 0; k < by_share.size(); ++k) counts[by_share[k]] = shared[k];
    const std::size_t rest = fleet - given - for_shares;  // without a part to take them: spare drones
    for (std::size_t k = 0; k < by_rest.size(); ++k) {
        counts[by_rest[k]] = rest / by_rest.size() + (k < rest % by_rest.size() ? 1 : 0);
    }
    if (std::find(counts.begin(), counts.end(), std::size_t{0}) != counts.end()) {
        return Error{ErrorCode::invalid_input, "a part would get no drone; must be at least one each"};
    }
    return counts;
}

}  // namespace aerogram::planner
