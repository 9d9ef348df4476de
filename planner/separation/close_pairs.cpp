#include "planner/separation/close_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aerogram::planner {
namespace {

constexpr std::uint32_t kIntervals = 8;  ///< of a stretch

/// Collects pairs until there are too many.
struct Collector {
    double reach_m;
    std::size_t most;
    std::vector<std::uint32_t>& found;

    [[nodiscard]] double limit_m() const {
        return found.size() > 2 * most ? -std::numeric_limits<double>::infinity() : reach_m;
    }
    void visit(std::uint32_t i, std::uint32_t j) {
        found.push_back(i);
        found.push_back(j);
    }
};

}  // namespace

ClosePairs::ClosePairs(const Sampling& sampling, std::size_t drones, double needed_m, double slack_m)
    : sampling_(sampling), n_(drones), reach_m_(needed_m + 2.0 * slack_m), slack_m_(slack_m), partners_(drones) {
    const auto intervals = static_cast<std::uint32_t>(sampling.intervals());
    for (std::uint32_t m = 0; m < intervals; m += kIntervals) {
        stretches_.push_back({m, std::min(m + kIntervals, intervals), std::nullopt, {}});
    }
    travelled_m_.assign(n_ * stretches_.size(), std::numeric_limits<double>::infinity());
}

void ClosePairs::list(Stretch& stretch, const SampledCurves& samples) const {
    const std::size_t axis = sampling_.axis_stride(), per = sampling_.per_interval();
    const auto sample = [&](std::size_t i, std::size_t at) {
        const double* own = samples.of(i) + at;
        return Vec3{own[0], own[axis], own[2 * axis]};
    };
    Points from(n_), to(n_);
    double squared = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
        from[i] = sample(i, stretch.first);
        to[i] = sample(i, stretch.last);
        squared += glm::dot(to[i] - from[i], to[i] - from[i]);
    }
    // The fleet's rhythm: the share of the way that fits all drones best, sample by sample.
    std::vector<std::pair<std::size_t, double>> rhythm;
    for (std::size_t m = stretch.first; m < stretch.last; ++m) {
        for (std::size_t q = m == stretch.first ? 1 : 0; q < per; ++q)
            rhythm.emplace_back(sampling_.before(q) + m, 0.0);
    }
    for (std::size_t i = 0; i < n_; ++i) {
        for (auto& [at, share] : rhythm) share += glm::dot(sample(i, at) - from[i], to[i] - from[i]);
    }
    for (auto& [at, share] : rhythm) share = squared > 0.0 ? share / squared : 0.0;
    std::vector<double> stray_m(n_, 0.0);
    for (std::size_t i = 0; i < n_; ++i) {
        double most = 0.0;
        for (const auto& [at, share] : rhythm) {
            const Vec3 off = sample(i, at) - from[i] - share * (to[i] - from[i]);
            most = std::max(most, glm::dot(off, off));
        }
        stray_m[i] = std::sqrt(most);
    }
    if (!stretch.tree) stretch.tree.emplace(from, to);
    stretch.tree->place(from, to, stray_m);
    stretch.found.clear();
    Collector collector{reach_m_, most_pairs(), stretch.found};
    stretch.tree->for_each_close_pair(collector);
}

void ClosePairs::add(std::uint32_t i, std::uint32_t j, const Stretch& stretch) {
    for (const auto& [partner, place] : partners_[i]) {
        if (partner != j) continue;
        ClosePair& pair = pairs_[place];
        if (pair.first <= stretch.first && pair.last >= stretch.last) return;
        pair.first = std::min(pair.first, stretch.first);
        pair.last = std::max(pair.last, stretch.last);
        pair.look_again_m = -1e300;
        return;
    }
    partners_[i].emplace_back(j, static_cast<std::uint32_t>(pairs_.size()));
    pairs_.push_back({i, j, stretch.first, stretch.last});
    crowded_ = crowded_ || pairs_.size() > most_pairs();
}

bool ClosePairs::refresh(const SampledCurves& samples, const Run& run) {
    const bool first_time = pairs_.empty();
    std::vector<bool> stale(stretches_.size(), false);
    for (std::size_t i = 0; i < n_; ++i) {
        const double* travelled = travelled_m_.data() + i * stretches_.size();
        for (std::size_t s = 0; s < stretches_.size(); ++s) stale[s] = stale[s] || travelled[s] > slack_m_;
    }
    parallel_for(stretches_.size(), run, "", [&](std::size_t s) {
        if (stale[s]) list(stretches_[s], samples);
    });
    if (run.stopped()) return false;
    listed_ = 0;
    for (std::size_t s = 0; s < stretches_.size(); ++s) {
        if (!stale[s]) continue;
        for (std::size_t i = 0; i < n_; ++i) travelled_m_[i * stretches_.size() + s] = 0.0;
        const auto& found = stretches_[s].found;
        listed_ += n_ + found.size() / 2;
        for (std::size_t p = 0; p < found.size() && !crowded_; p += 2) add(found[p], found[p + 1], stretches_[s]);
    }
    if (first_time) put_in_order();
    return !crowded_;
}

/// Sorts the pairs by drone, so that a walk through them stays in near memory.
void ClosePairs::put_in_order() {
    std::sort(pairs_.begin(), pairs_.end(),
              [](const ClosePair& a, const ClosePair& b) { return std::pair(a.i, a.j) < std::pair(b.i, b.j); });
    for (auto& partners : partners_) partners.clear();
    for (std::uint32_t place = 0; place < pairs_.size(); ++place) {
        partners_[pairs_[place].i].emplace_back(pairs_[place].j, place);
    }
}

void ClosePairs::moved(std::size_t drone, std::span<const double> by_interval_m) {
    double* travelled = travelled_m_.data() + drone * stretches_.size();
    for (std::size_t s = 0; s < stretches_.size(); ++s) {
        double farthest = 0.0;
        for (std::uint32_t m = stretches_[s].first; m < stretches_[s].last; ++m) {
            farthest = std::max(farthest, by_interval_m[m]);
        }
        travelled[s] += farthest;
    }
}

}  // namespace aerogram::planner
