#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geo/run.hpp"
#include "planner/motion/swept_tree.hpp"
#include "planner/separation/fleet_curves.hpp"

namespace aerogram::planner {

/// Two drones (i < j) that may come too close, and when: on knot intervals [first, last).
struct ClosePair {
    std::uint32_t i = 0, j = 0;
    std::uint32_t first = 0, last = 0;
    double look_again_m = -1e300;  ///< need not be looked at before the two have moved so far together
};

/// Every pair whose chords may come closer than what is needed, kept up while drones move. The act is cut into
/// stretches of a few knot intervals; for each, all pairs closer than needed + 2 slack are listed, and listed anew once
/// a drone has moved there by more than the slack. So at every moment the list holds all pairs closer than needed. On a
/// stretch drones run nearly straight and in one rhythm, which is what a SweptTree finds pairs of.
class ClosePairs {
  public:
    ClosePairs(const Sampling& sampling, std::size_t drones, double needed_m, double slack_m);

    /// Lists the pairs of all stretches where somebody has moved too far; at first, of all. False when stopped or
    /// crowded.
    bool refresh(const SampledCurves& samples, const Run& run);
    /// Notes how far a drone moved on each knot interval. Safe to call from several threads for different drones.
    void moved(std::size_t drone, std::span<const double> by_interval_m);

    /// More pairs than can be separated in reasonable time (kMostPairs a drone): the list is not complete.
    [[nodiscard]] bool crowded() const { return crowded_; }
    [[nodiscard]] std::vector<ClosePair>& pairs() { return pairs_; }
    [[nodiscard]] const std::vector<ClosePair>& pairs() const { return pairs_; }
    /// Drones whose pairs were listed anew by the last refresh, counted by stretch; and pairs found then: the work
    /// done.
    [[nodiscard]] std::size_t listed() const { return listed_; }

  private:
    struct Stretch {
        std::uint32_t first = 0, last = 0;  ///< knot intervals [first, last)
        std::optional<SweptTree> tree;
        std::vector<std::uint32_t> found;  ///< i, j, i, j ... of the last listing
    };
    static constexpr std::size_t kMostPairs = 200;

    [[nodiscard]] std::size_t most_pairs() const { return kMostPairs * n_ + 10'000; }
    void list(Stretch& stretch, const SampledCurves& samples) const;
    void add(std::uint32_t i, std::uint32_t j, const Stretch& stretch);
    void put_in_order();

    const Sampling& sampling_;
    std::size_t n_;
    double reach_m_, slack_m_;
    bool crowded_ = false;
    std::size_t listed_ = 0;
    std::vector<Stretch> stretches_;
    std::vector<double> travelled_m_;  ///< by drone and stretch, since the stretch was last listed
    std::vector<ClosePair> pairs_;
    std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> partners_;  ///< of i: j and the pair's place
};

}  // namespace aerogram::planner
