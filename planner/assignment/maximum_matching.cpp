#include "planner/assignment/maximum_matching.hpp"

#include <algorithm>

#include "planner/assignment/kd_order.hpp"

namespace aerogram::planner {
namespace {

constexpr std::uint32_t kLeaf = 16;

/// Targets that the current round of searches has not reached, by leaf.
class Unreached {
  public:
    Unreached(const Coordinates& targets, const Allowed& allowed)
        : targets_(targets), allowed_(allowed), order_(kd_order(targets, kLeaf)) {
        left_.resize((order_.size() + kLeaf - 1) / kLeaf);
        for (std::size_t leaf = 0; leaf < left_.size(); ++leaf)
            box_.push_back(box_of(targets, order_, leaf * kLeaf, end_of(leaf)));
        reset();
    }
    void reset() {
        for (std::size_t leaf = 0; leaf < left_.size(); ++leaf) left_[leaf] = end_of(leaf) - leaf * kLeaf;
    }
    [[nodiscard]] std::size_t leaves() const { return left_.size(); }

    /// Takes out a target of the leaf that the bidder may have; kUnmatched when there is none.
    std::uint32_t take(std::size_t leaf, std::size_t bidder, const Coordinates& bidders) {
        if (left_[leaf] == 0) return kUnmatched;
        const Vec3 x = bidders[bidder];
        const Vec3 nearest = glm::clamp(x, box_[leaf].low, box_[leaf].high);
        if (allowed_.distance2_m2(x, nearest) > allowed_.reach2_m2) return kUnmatched;
        const std::size_t begin = leaf * kLeaf;
        for (std::size_t k = begin; k < begin + left_[leaf]; ++k) {
            const std::uint32_t target = order_[k];
            if (!allowed_(bidders, targets_, bidder, target)) continue;
            --left_[leaf];
            std::swap(order_[k], order_[begin + left_[leaf]]);
            return target;
        }
        return kUnmatched;
    }

  private:
    [[nodiscard]] std::size_t end_of(std::size_t leaf) const {
        return std::min<std::size_t>((leaf + 1) * kLeaf, order_.size());
    }
    const Coordinates& targets_;
    const Allowed& allowed_;
    std::vector<std::uint32_t> order_;
    std::vector<Box> box_;
    std::vector<std::size_t> left_;  ///< by leaf: how many of its targets, which stand first, are unreached
};

class Search {
  public:
    Search(const Coordinates& bidders, const Coordinates& targets, const Allowed& allowed)
        : bidders_(bidders),
          unreached_(targets, allowed),
          target_of_(bidders.size(), kUnmatched),
          owner_(targets.size(), kUnmatched),
          cursor_(bidders.size()),
          via_(bidders.size()) {}

    void keep(std::uint32_t bidder, std::uint32_t target) {
        target_of_[bidder] = target;
        owner_[target] = bidder;
    }
    [[nodiscard]] bool is_matched(std::uint32_t bidder) const { return target_of_[bidder] != kUnmatched; }
    void new_round() {
        unreached_.reset();
        std::fill(cursor_.begin(), cursor_.end(), 0);
        reached_.clear();
    }
    /// One more pair along a path of targets that this round has not reached; false when there is none.
    bool join(std::uint32_t bidder) {
        std::vector<std::uint32_t> path{bidder};
        while (!path.empty()) {
            const std::uint32_t at = path.back(), target = next(at);
            if (target == kUnmatched) {
                path.pop_back();
                continue;
            }
            via_[at] = target;
            reached_.push_back(target);
            if (owner_[target] != kUnmatched) {
                path.push_back(owner_[target]);
                continue;
            }
            for (const std::uint32_t b : path) keep(b, via_[b]);
            return true;
        }
        return false;
    }
    /// After join() has failed first thing in a new round.
    [[nodiscard]] MaximumMatching stuck(std::uint32_t bidder) const {
        MaximumMatching result{target_of_, {bidder}, reached_};
        for (const std::uint32_t target : reached_) result.stuck_bidders.push_back(owner_[target]);
        std::sort(result.stuck_bidders.begin(), result.stuck_bidders.end());
        std::sort(result.their_targets.begin(), result.their_targets.end());
        return result;
    }
    [[nodiscard]] MaximumMatching complete() const { return {target_of_, {}, {}}; }

  private:
    /// Leaves that a bidder has found nothing in hold nothing for it for the rest of the round.
    std::uint32_t next(std::uint32_t bidder) {
        for (std::size_t& leaf = cursor_[bidder]; leaf < unreached_.leaves(); ++leaf)
            if (const std::uint32_t target = unreached_.take(leaf, bidder, bidders_); target != kUnmatched)
                return target;
        return kUnmatched;
    }

    const Coordinates& bidders_;
    Unreached unreached_;
    std::vector<std::uint32_t> target_of_, owner_;
    std::vector<std::size_t> cursor_;
    std::vector<std::uint32_t> via_;      ///< by bidder of the path: the target it would take
    std::vector<std::uint32_t> reached_;  ///< in this round
};

}  // namespace

std::optional<MaximumMatching> maximum_matching(const Coordinates& bidders, const Coordinates& targets,
                                                const Allowed& allowed, const std::vector<std::uint32_t>& start,
                                                const Run& run) {
    Search search(bidders, targets, allowed);
    for (std::uint32_t i = 0; i < start.size(); ++i)
        if (start[i] != kUnmatched && allowed(bidders, targets, i, start[i])) search.keep(i, start[i]);
    std::vector<std::uint32_t> free;
    for (const std::uint32_t i : kd_order(bidders))
        if (!search.is_matched(i)) free.push_back(i);
    while (!free.empty()) {
        const std::size_t before = free.size();
        search.new_round();
        std::vector<std::uint32_t> still_free;
        for (const std::uint32_t i : free) {
            if (run.stopped()) return std::nullopt;
            if (!search.join(i)) still_free.push_back(i);
        }
        free = std::move(still_free);
        if (free.size() == before) {
            search.new_round();
            search.join(free.front());
            return search.stuck(free.front());
        }
    }
    return search.complete();
}

}  // namespace aerogram::planner
