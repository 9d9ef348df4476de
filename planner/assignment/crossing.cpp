#include "planner/assignment/crossing.hpp"

#include "planner/assignment/assignment.hpp"

namespace aerogram::planner {
namespace {

constexpr int kRoundsOfTies = 8;

double size_of(const Coordinates& c) {
    return c.size() == 0 ? 0.0 : 2.0 * radius_of(c);
}

/// One look at every pair: those with a product below the limit change slots (only if that sorts them, when asked to).
/// Returns whether any did; nothing when stopped.
std::optional<bool> swap_below(Flights& flights, std::vector<SlotId>& slot, double limit_m2, bool only_sorting,
                               const Run& run) {
    bool any = false;
    for (std::size_t i = 0; i < slot.size(); ++i) {
        if (run.stopped()) return std::nullopt;
        for (std::size_t j = i; (j = flights.first_below(i, j + 1, limit_m2)) < slot.size();) {
            if (only_sorting && slot[i] < slot[j]) continue;
            const Vec3 to = flights.to[i];
            flights.to.set(i, flights.to[j]);
            flights.to.set(j, to);
            std::swap(slot[i], slot[j]);
            any = true;
        }
    }
    return any;
}

/// Until a look at every pair finds none crossing. False when stopped.
bool swap_crossing(Flights& flights, std::vector<SlotId>& slot, const Run& run) {
    while (true) {
        const std::optional<bool> any = swap_below(flights, slot, -flights.tolerance_m2, false, run);
        if (!any) return false;
        if (!*any) return true;
    }
}

}  // namespace

Flights::Flights(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::span<const SlotId> slot_of,
                 const SeparationMetric& metric)
    : from(centred(from_m, metric)), to(slot_of.size()) {
    const Coordinates slots = centred(to_m, metric);
    for (std::size_t d = 0; d < slot_of.size(); ++d) to.set(d, slots[slot_of[d].value]);
    tolerance_m2 = kCrossingTolerance * size_of(from) * size_of(slots);
}

std::size_t Flights::first_below(std::size_t i, std::size_t begin, double limit_m2) const {
    constexpr std::size_t kBlock = 256;
    const Vec3 a = from[i], b = to[i];
    const auto product = [&](std::size_t j) {
        return (a.x - from.x[j]) * (b.x - to.x[j]) + (a.y - from.y[j]) * (b.y - to.y[j]) +
               (a.z - from.z[j]) * (b.z - to.z[j]);
    };
    for (std::size_t block = begin; block < from.size(); block += kBlock) {
        const std::size_t end = std::min(block + kBlock, from.size());
        std::int64_t found = 0;
        for (std::size_t j = block; j < end; ++j) found |= product(j) < limit_m2 ? 1 : 0;
        for (std::size_t j = block; found != 0 && j < end; ++j)
            if (product(j) < limit_m2) return j;
    }
    return from.size();
}

bool uncross(std::span<const Vec3> from_m, std::span<const Vec3> to_m, std::vector<SlotId>& slot_of,
             const SeparationMetric& metric, const Run& run) {
    Flights flights(from_m, to_m, slot_of, metric);
    if (!swap_crossing(flights, slot_of, run)) return false;
    for (int round = 0; round < kRoundsOfTies; ++round) {
        const std::optional<bool> sorted = swap_below(flights, slot_of, flights.tolerance_m2, true, run);
        if (!sorted || !swap_crossing(flights, slot_of, run)) return false;
        if (!*sorted) break;
    }
    return true;
}

std::optional<CrossingPair> find_crossing(std::span<const Vec3> from_m, std::span<const Vec3> to_m,
                                          std::span<const SlotId> slot_of, const SeparationMetric& metric) {
    AEROGRAM_REQUIRE(from_m.size() == to_m.size() && from_m.size() == slot_of.size(), from_m.size(), to_m.size(),
                     slot_of.size());
    const Flights flights(from_m, to_m, slot_of, metric);
    for (std::size_t i = 0; i < slot_of.size(); ++i)
        if (const std::size_t j = flights.first_below(i, i + 1, -flights.tolerance_m2); j < slot_of.size())
            return CrossingPair{DroneId(i), DroneId(j)};
    return std::nullopt;
}

}  // namespace aerogram::planner
