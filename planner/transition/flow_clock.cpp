#include "planner/transition/flow_clock.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

/// keyframe 0..m-1: does the fleet stand there?
bool rests_at(std::size_t keyframe, std::span<const FlowLeg> legs) {
    return keyframe == 0 || keyframe == legs.size() || legs[keyframe - 1].options.corner;
}

/// How much longer a leg takes, at the same top speed, for the ends at which it rests.
double rest_factor(std::size_t leg, std::span<const FlowLeg> legs) {
    const int rests = (rests_at(leg, legs) ? 1 : 0) + (rests_at(leg + 1, legs) ? 1 : 0);
    return rests == 2 ? 1.875 : rests == 1 ? 1.5 : 1.0;
}

double leg_length_m(const Points& from, const Points& to) {
    double sum = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 d = to[i] - from[i];
        sum += glm::dot(d, d) * glm::dot(d, d);
    }
    return std::pow(sum / static_cast<double>(from.size()), 0.25);
}

std::vector<double> default_times(std::span<const SpectralKeyframe> keyframes, std::span<const FlowLeg> legs) {
    std::vector<double> times(legs.size());
    double mean = 0.0;
    for (std::size_t j = 0; j < legs.size(); ++j) {
        times[j] = leg_length_m(keyframes[j].positions_m, keyframes[j + 1].positions_m);
        mean += times[j] / static_cast<double>(legs.size());
    }
    for (std::size_t j = 0; j < legs.size(); ++j) {
        times[j] = (mean > 0.0 ? std::max(times[j], 0.1 * mean) : 1.0) * rest_factor(j, legs);
    }
    return times;
}

/// Each leg's share of the time; the sum is 1.
std::vector<double> shares(std::span<const SpectralKeyframe> keyframes, std::span<const FlowLeg> legs) {
    std::vector<double> times = default_times(keyframes, legs);
    double given_s = 0.0, given_default = 0.0;
    for (std::size_t j = 0; j < legs.size(); ++j) {
        if (!legs[j].duration_s) continue;
        AEROGRAM_REQUIRE(*legs[j].duration_s > 0.0, *legs[j].duration_s);
        given_s += *legs[j].duration_s;
        given_default += times[j];
    }
    double sum = 0.0;
    for (std::size_t j = 0; j < legs.size(); ++j) {
        if (given_s > 0.0) times[j] = legs[j].duration_s ? *legs[j].duration_s : times[j] * given_s / given_default;
        sum += times[j];
    }
    for (double& t : times) t /= sum;
    return times;
}

std::vector<std::size_t> rounded_knots(const std::vector<double>& shares, std::size_t total) {
    std::vector<std::size_t> knots{0};
    double sum = 0.0;
    for (const double share : shares) {
        sum += share;
        const auto knot = static_cast<std::size_t>(std::llround(sum * static_cast<double>(total)));
        knots.push_back(std::max(knot, knots.back() + kLeastKnotsPerLeg));
    }
    return knots;
}

/// The largest error of a keyframe's instant, as a share of the whole time.
double worst_error(const std::vector<double>& shares, const std::vector<std::size_t>& knots) {
    double sum = 0.0, worst = 0.0;
    for (std::size_t j = 0; j < shares.size(); ++j) {
        sum += shares[j];
        worst = std::max(worst, std::abs(static_cast<double>(knots[j + 1]) / static_cast<double>(knots.back()) - sum));
    }
    return worst;
}

}  // namespace

std::vector<std::size_t> flow_knots(std::span<const SpectralKeyframe> keyframes, std::span<const FlowLeg> legs,
                                    std::size_t rows_per_leg) {
    const std::vector<double> leg_shares = shares(keyframes, legs);
    const std::size_t least = std::max(rows_per_leg, kLeastKnotsPerLeg) * legs.size();
    std::vector<std::size_t> best = rounded_knots(leg_shares, least);
    double best_error = worst_error(leg_shares, best);
    for (std::size_t total = least + 1; total <= least + least / 4; ++total) {
        std::vector<std::size_t> knots = rounded_knots(leg_shares, total);
        const double error = worst_error(leg_shares, knots);
        if (error < best_error - 1e-12) {
            best_error = error;
            best = std::move(knots);
        }
    }
    return best;
}

FlowClock::FlowClock(std::vector<std::size_t> keyframe_knots, std::span<const FlowLeg> legs)
    : knots_(std::move(keyframe_knots)), slopes_(knots_.size(), 0.0) {
    AEROGRAM_REQUIRE(knots_.size() == legs.size() + 1 && !legs.empty(), knots_.size(), legs.size());
    for (std::size_t j = 0; j < slopes_.size(); ++j) {
        if (rests_at(j, legs)) continue;
        const double before = static_cast<double>(knots_[j] - knots_[j - 1]);
        const double after = static_cast<double>(knots_[j + 1] - knots_[j]);
        const double middle = 2.0 / (before / rest_factor(j - 1, legs) + after / rest_factor(j, legs));
        slopes_[j] = std::min(middle, 2.0 / std::max(before, after));
    }
}

FlowPlace FlowClock::at(double knot) const {
    std::size_t leg = 0;
    while (leg + 2 < knots_.size() && knot >= static_cast<double>(knots_[leg + 1])) ++leg;
    const double length = static_cast<double>(knots_[leg + 1] - knots_[leg]);
    const double x = (knot - static_cast<double>(knots_[leg])) / length;
    const double leave = slopes_[leg] * length, arrive = slopes_[leg + 1] * length;
    // Quintic Hermite: from 0 to 1 with end slopes `leave` and `arrive` and no end accelerations.
    const double x3 = x * x * x, x4 = x3 * x, x5 = x4 * x;
    const double share = (10.0 * x3 - 15.0 * x4 + 6.0 * x5) + leave * (x - 6.0 * x3 + 8.0 * x4 - 3.0 * x5) +
                         arrive * (-4.0 * x3 + 7.0 * x4 - 3.0 * x5);
    return {leg, std::clamp(share, 0.0, 1.0)};
}

}  // namespace aerogram::planner
