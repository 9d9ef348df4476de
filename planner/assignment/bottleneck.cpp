#include <algorithm>
#include <cmath>

#include "planner/assignment/assignment.hpp"
#include "planner/assignment/shortest.hpp"

namespace aerogram::planner {
namespace {

/// The search for the shortest longest flight halves an interval of squared lengths until it is this narrow, then goes
/// through the lengths of flights in it.
constexpr double kNarrow = 1e-6;

struct Reach {
    double reach2_m2;                      ///< exactly the squared length of one of the flights
    std::vector<std::uint32_t> target_of;  ///< a matching that flies no farther
};

double longest2_m2(const FreeMatch& match, const std::vector<std::uint32_t>& target_of) {
    double longest = 0.0;
    for (std::size_t i = 0; i < target_of.size(); ++i)
        longest = std::max(longest, match.allowed.distance2_m2(match.x[i], match.y[target_of[i]]));
    return longest;
}

/// Squared lengths of allowed flights in (low, high), ascending.
std::vector<double> lengths_between(const FreeMatch& match, double low, double high) {
    std::vector<double> lengths;
    for (std::size_t i = 0; i < match.x.size(); ++i)
        for (std::uint32_t j = 0; j < match.y.size(); ++j) {
            const double d = match.allowed.distance2_m2(match.x[i], match.y[j]);
            if (d > low && d < high && match.allowed(match.x, match.y, i, j)) lengths.push_back(d);
        }
    std::sort(lengths.begin(), lengths.end());
    lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
    return lengths;
}

/// No matching flies less far than the result: a maximum matching with shorter flights only left drones over, or there
/// is no shorter flight.
class BottleneckSearch {
  public:
    BottleneckSearch(const FreeMatch& match, Reach reach, const Run& run)
        : match_(match), allowed_(match.allowed), best_(std::move(reach)), run_(run) {}

    std::optional<Reach> least() {
        double low = 0.0;  // no matching flies less far than this
        for (int step = 0; best_.reach2_m2 - low > kNarrow * best_.reach2_m2; ++step) {
            const double middle = low + (best_.reach2_m2 - low) / 2.0;
            const std::optional<bool> is_enough = enough(middle);
            if (!is_enough) return std::nullopt;
            if (!*is_enough) low = middle;
            run_.report("assign", 0.1 + 0.4 * (1.0 - std::exp2(-step)));
        }
        const std::vector<double> lengths = lengths_between(match_, low, best_.reach2_m2);
        std::size_t begin = 0, end = lengths.size();  // all below begin are too short, the best one stands at end
        while (begin < end) {
            const std::size_t middle = begin + (end - begin) / 2;
            const std::optional<bool> is_enough = enough(lengths[middle]);
            if (!is_enough) return std::nullopt;
            if (*is_enough)
                end = middle;
            else
                begin = middle + 1;
        }
        return best_;
    }

  private:
    /// Whether a matching flies no farther; the best is then the longest flight of the one found.
    std::optional<bool> enough(double reach2_m2) {
        allowed_.reach2_m2 = reach2_m2;
        auto found = maximum_matching(match_.x, match_.y, allowed_, best_.target_of, run_);
        if (!found) return std::nullopt;
        if (!found->is_complete()) return false;
        best_ = {longest2_m2(match_, found->target_of), std::move(found->target_of)};
        return true;
    }

    const FreeMatch& match_;
    Allowed allowed_;
    Reach best_;
    const Run& run_;
};

/// Both sides about one origin, so that distances between them are true.
void bring_together(FreeMatch& match, std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                    const SeparationMetric& metric) {
    Vec3 origin_m{};
    for (const SlotId s : match.slots) origin_m += to_m[s.value] / static_cast<double>(match.slots.size());
    for (std::size_t i = 0; i < match.drones.size(); ++i)
        match.x.set(i, metric.scaled(from_m[match.drones[i].value] - origin_m));
    for (std::size_t j = 0; j < match.slots.size(); ++j)
        match.y.set(j, metric.scaled(to_m[match.slots[j].value] - origin_m));
}

/// Of the matchings that fly no farther than any must, the one at the least squared cost.
Result<double> match_bottleneck(FreeMatch& match, double pinned2_m2, std::vector<SlotId>& slot_of, const Run& run) {
    auto any = any_matching(match, run);
    if (!any) return any.error();
    const double longest2 = longest2_m2(match, any->target_of);
    const auto reach = BottleneckSearch(match, {longest2, std::move(any->target_of)}, run).least();
    if (!reach) return stopped_error();
    match.allowed.reach2_m2 = std::max(reach->reach2_m2, pinned2_m2);
    Run later = run;
    if (run.progress)
        later.progress = [&run](std::string_view stage, double share) { run.report(stage, 0.5 + 0.5 * share); };
    return solve_shortest(match, slot_of, later);
}

}  // namespace

Result<Assignment> assign_bottleneck(std::span<const Vec3> from_m, std::span<const Vec3> to_m, const MatchRules& rules,
                                     const SeparationMetric& metric, const Run& run) {
    require_sound(from_m, to_m, rules);
    const std::size_t n = from_m.size();
    std::vector<SlotId> slot_of(n);
    auto match = free_match(from_m, to_m, first_ids<DroneId>(n), first_ids<SlotId>(n), rules, metric, slot_of);
    if (!match) return match.error();
    double pinned2_m2 = 0.0, gap_m2 = 0.0;
    for (const auto& [drone, slot] : rules.pins) {
        const Vec3 flight_m = to_m[slot.value] - from_m[drone.value];
        pinned2_m2 = std::max(pinned2_m2, glm::dot(flight_m, flight_m));
    }
    if (!match->drones.empty()) {
        bring_together(*match, from_m, to_m, metric);
        const Result<double> gap = match_bottleneck(*match, pinned2_m2, slot_of, run);
        if (!gap) return gap.error();
        gap_m2 = *gap;
    }
    Assignment assignment = reported(from_m, to_m, std::move(slot_of), gap_m2, metric, run);
    assignment.longest_is_least = true;
    return assignment;
}

}  // namespace aerogram::planner
