#include "planner/separation/fleet_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geo/contract.hpp"
#include "geo/random.hpp"

namespace aerogram::planner {
namespace {

constexpr std::size_t kPairsAPiece = 2048, kDronesAPiece = 64;
constexpr std::size_t kDronesABlock = SobolevSmoother::kLanes / 3;
constexpr double kFullGain = 2.0;       ///< what the limits' weights reckon with (projection.cpp)
constexpr double kRelaxation = 0.9;     ///< of pushes that act on one drone alone
constexpr double kIntoBand_m = 0.02;    ///< aimed at inside the band
constexpr double kAtLimit = 1.003;      ///< differences up to this share of their limit are left alone
constexpr double kLongestStep = 0.12;   ///< of the required separation
constexpr std::size_t kReadBeyond = 4;  ///< places that closest_approaches may read behind the last sample

/// How far a drone moved on each knot interval: the farthest of the interval's instants, both ends included.
void farthest_by_interval(const double* before, const double* after, const Sampling& sampling, double* by_interval_m) {
    const std::size_t intervals = sampling.intervals(), axis = sampling.axis_stride();
    std::array<double, kMostRows + 1> squared;
    std::fill_n(by_interval_m, intervals, 0.0);
    for (std::size_t q = 0; q < sampling.per_interval(); ++q) {
        const std::size_t at = sampling.before(q);
        squared_steps(before + at, after + at, axis, intervals + (q == 0 ? 1 : 0), squared.data());
        for (std::size_t m = 0; m < intervals; ++m) {
            by_interval_m[m] = std::max(by_interval_m[m], q == 0 ? std::max(squared[m], squared[m + 1]) : squared[m]);
        }
    }
    for (std::size_t m = 0; m < intervals; ++m) by_interval_m[m] = std::sqrt(by_interval_m[m]);
}

}  // namespace

FleetState::FleetState(const Lattice& input, const ProjectionTask& task)
    : task_(task),
      order_(neighbourly_order(input)),
      curves_(curves_of(input, order_)),
      sampling_(input.rows(), task.samples_per_interval),
      pulled_(input.drones, 0),
      moved_m_(input.drones, 0.0),
      ratio_(input.drones, 0.0),
      outside_m_(input.drones, 0.0),
      clear_until_m_(input.drones, 0.0),
      longest_step_m_(kLongestStep * task.required_m),
      banded_(input.rows(), true) {
    const std::size_t n = input.drones, rows = input.rows();
    AEROGRAM_REQUIRE(rows <= kMostRows, rows);
    std::vector<bool> fixed(rows, false);
    for (std::size_t k = 0; k < 3; ++k) fixed[k] = fixed[rows - 1 - k] = true;
    for (std::size_t k = 0; k < rows; ++k) banded_[k] = !fixed[k];
    for (const std::size_t knot : task.held_knots) {
        AEROGRAM_REQUIRE(knot >= 3 && knot + 6 <= rows, knot, rows);
        for (std::size_t k = knot; k < knot + 3; ++k) banded_[k] = false;
    }
    const double width = task.smoothing_knots > 0.0 ? task.smoothing_knots : static_cast<double>(rows) / 17.0;
    smoother_.emplace(fixed, std::pow(width, 4), task.held_knots);
    if (task.motion) motion_.emplace(*task.motion, width, kFullGain);
    airspace_.emplace(task, sampling_, n);

    samples_.drone_stride = forces_.drone_stride = sampling_.drone_stride();
    samples_.values.assign(n * samples_.drone_stride + kReadBeyond, 0.0);
    forces_.values.assign(n * forces_.drone_stride, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        sample(i, samples_.of(i));
        assess(i);
    }
}

void FleetState::sample(std::size_t drone, double* samples) const {
    for (std::size_t a = 0; a < 3; ++a) {
        const double scale = a == 2 ? 1.0 / task_.metric.downwash : 1.0;
        sampling_.evaluate(curves_.axis(drone, a), scale, samples + a * sampling_.axis_stride());
    }
}

/// Notes how a drone stands to its limits and to the band.
void FleetState::assess(std::size_t drone) {
    const double* z = curves_.axis(drone, 2);
    if (motion_) ratio_[drone] = motion_->ratio(curves_.axis(drone, 0), curves_.axis(drone, 1), z, curves_.rows);
    double outside_m = 0.0;
    const auto [low, high] = std::minmax_element(z, z + curves_.rows);
    if (*low >= task_.floor_z_m && *high <= task_.ceiling_z_m) {
        outside_m_[drone] = 0.0;
        return;
    }
    for (std::size_t k = 0; k < curves_.rows; ++k) {
        if (banded_[k]) outside_m = std::max({outside_m, task_.floor_z_m - z[k], z[k] - task_.ceiling_z_m});
    }
    outside_m_[drone] = outside_m;
}

bool FleetState::list_pairs(double needed_m, double slack_m, const Run& run) {
    pairs_.emplace(sampling_, curves_.drones, needed_m, slack_m);
    return pairs_->refresh(samples_, run);
}

void FleetState::look_at(ClosePair& pair, double aim_m, double limit_m, Piece& piece, std::uint32_t place) const {
    const double together_m = moved_m_[pair.i] + moved_m_[pair.j];
    if (together_m + aim_m < pair.look_again_m) return;
    const std::size_t count = pair.last - pair.first;
    double squared[kMostRows + kReadBeyond], share[kMostRows + kReadBeyond];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t q = 0; q < sampling_.per_interval(); ++q) {
        const std::size_t before = sampling_.before(q) + pair.first, after = sampling_.after(q) + pair.first;
        closest_approaches(samples_.of(pair.i), samples_.of(pair.j), sampling_.axis_stride(), before, after, count,
                           squared, share);
        piece.closeness.looked_at += count;
        const double smallest_here = smallest(squared, count);
        if (smallest_here < least && smallest_here < piece.closeness.closest_m * piece.closeness.closest_m) {
            const auto m = static_cast<std::size_t>(std::find(squared, squared + count, smallest_here) - squared);
            const double per = static_cast<double>(sampling_.per_interval());
            piece.closeness.i = pair.i;
            piece.closeness.j = pair.j;
            piece.closeness.share = (static_cast<double>(pair.first + m) + (static_cast<double>(q) + share[m]) / per) /
                                    static_cast<double>(sampling_.intervals());
        }
        least = std::min(least, smallest_here);
        if (smallest_here >= aim_m * aim_m) continue;
        for (std::size_t m = 0; m < count; ++m) {
            if (squared[m] >= aim_m * aim_m) continue;
            const std::size_t a = sampling_.axis_stride();
            const auto difference = [&](std::size_t at) {
                const double *i = samples_.of(pair.i) + at, *j = samples_.of(pair.j) + at;
                return Vec3{j[0] - i[0], j[a] - i[a], j[2 * a] - i[2 * a]};
            };
            const double w = share[m], distance_m = std::sqrt(squared[m]);
            const Vec3 nearest = (1.0 - w) * difference(before + m) + w * difference(after + m);
            const Vec3 unit = distance_m > 1e-9 ? nearest / distance_m : Vec3{0.0, 0.0, 1.0};
            const Vec3 gradient = task_.metric.scaled(unit);  // of the distance, by the displacement in metres
            const Vec3 move = gradient * (0.5 * (aim_m - distance_m) / glm::dot(gradient, gradient));
            piece.closeness.shortfall_m += aim_m - distance_m;
            piece.pushes.push_back({pair.i, pair.j, static_cast<std::uint32_t>(before + m),
                                    static_cast<std::uint32_t>(after + m), w, move});
        }
    }
    const double distance_m = std::sqrt(least);
    pair.look_again_m = together_m + distance_m;
    piece.closeness.closest_m = std::min(piece.closeness.closest_m, distance_m);
    if (distance_m < limit_m) piece.close.push_back(place);
}

FleetState::Closeness FleetState::push_pairs(double aim_m, double limit_m, const Run& run) {
    auto& pairs = pairs_->pairs();
    pieces_.resize((pairs.size() + kPairsAPiece - 1) / kPairsAPiece);
    parallel_for(pieces_.size(), run, "", [&](std::size_t p) {
        Piece& piece = pieces_[p];
        piece.closeness = {};
        piece.pushes.clear();
        piece.close.clear();
        for (std::size_t k = p * kPairsAPiece; k < std::min(pairs.size(), (p + 1) * kPairsAPiece); ++k) {
            look_at(pairs[k], aim_m, limit_m, piece, static_cast<std::uint32_t>(k));
        }
    });
    Closeness all;
    const std::size_t axis = sampling_.axis_stride();
    for (const Piece& piece : pieces_) {
        if (piece.closeness.closest_m < all.closest_m) {
            all.closest_m = piece.closeness.closest_m;
            all.i = piece.closeness.i;
            all.j = piece.closeness.j;
            all.share = piece.closeness.share;
        }
        all.shortfall_m += piece.closeness.shortfall_m;
        all.looked_at += piece.closeness.looked_at;
        for (const Push& push : piece.pushes) {
            double *i = forces_.of(push.i), *j = forces_.of(push.j);
            for (std::size_t a = 0; a < 3; ++a) {
                const double before = (1.0 - push.share) * push.move[static_cast<int>(a)];
                const double after = push.share * push.move[static_cast<int>(a)];
                i[a * axis + push.before] -= before;
                i[a * axis + push.after] -= after;
                j[a * axis + push.before] += before;
                j[a * axis + push.after] += after;
            }
            pulled_[push.i] = pulled_[push.j] = 1;
        }
    }
    return all;
}

double FleetState::push_airspace(const Run& run) {
    if (airspace_->empty()) return 0.0;
    const std::size_t pieces = (curves_.drones + kDronesAPiece - 1) / kDronesAPiece;
    std::vector<double> shortfall_m(pieces, 0.0);
    parallel_for(pieces, run, "", [&](std::size_t p) {
        for (std::size_t i = p * kDronesAPiece; i < std::min(curves_.drones, (p + 1) * kDronesAPiece); ++i) {
            if (moved_m_[i] < clear_until_m_[i]) continue;
            const auto outcome = airspace_->push(i, samples_.of(i), forces_.of(i));
            shortfall_m[p] = std::max(shortfall_m[p], outcome.shortfall_m);
            if (outcome.shortfall_m > 0.0) pulled_[i] = 1;
            clear_until_m_[i] = moved_m_[i] + outcome.slack_m / task_.metric.downwash;
        }
    });
    return *std::max_element(shortfall_m.begin(), shortfall_m.end());
}

/// Moves drones by gain times the filtered corrections that fill(drone, c) puts into c[0..2], rows long each.
template <class Fill>
void FleetState::move(const std::vector<std::uint32_t>& drones, double gain, const Run& run, Fill fill) {
    const std::size_t rows = curves_.rows, pieces = (drones.size() + kDronesAPiece - 1) / kDronesAPiece;
    parallel_for(pieces, run, "", [&](std::size_t p) {
        std::vector<double> block(rows * SobolevSmoother::kLanes), before(sampling_.drone_stride());
        std::vector<double> corrections(3 * curves_.stride);
        double* const c[3] = {corrections.data(), corrections.data() + curves_.stride,
                              corrections.data() + 2 * curves_.stride};
        std::array<double, kMostRows> by_interval_m;
        const std::size_t end = std::min(drones.size(), (p + 1) * kDronesAPiece);
        for (std::size_t first = p * kDronesAPiece; first < end; first += kDronesABlock) {
            const std::size_t count = std::min(kDronesABlock, end - first);
            std::fill(block.begin(), block.end(), 0.0);
            for (std::size_t d = 0; d < count; ++d) {
                std::fill(corrections.begin(), corrections.end(), 0.0);
                fill(drones[first + d], c);
                for (std::size_t k = 0; k < rows; ++k) {
                    double* lanes = block.data() + k * SobolevSmoother::kLanes + 3 * d;
                    for (std::size_t a = 0; a < 3; ++a) lanes[a] = c[a][k];
                }
            }
            smoother_->apply(block.data());
            for (std::size_t d = 0; d < count; ++d) {
                const std::uint32_t i = drones[first + d];
                double longest = 0.0;
                for (std::size_t k = 0; k < rows; ++k) {
                    const double* lanes = block.data() + k * SobolevSmoother::kLanes + 3 * d;
                    longest = std::max(longest, lanes[0] * lanes[0] + lanes[1] * lanes[1] + lanes[2] * lanes[2]);
                }
                const double factor = std::min(gain, longest_step_m_ / std::sqrt(longest + 1e-300));
                for (std::size_t a = 0; a < 3; ++a) {
                    double* curve = curves_.axis(i, a);
                    const double* lane = block.data() + 3 * d + a;
                    for (std::size_t k = 0; k < rows; ++k) curve[k] += factor * lane[k * SobolevSmoother::kLanes];
                }
                std::copy_n(samples_.of(i), before.size(), before.data());
                sample(i, samples_.of(i));
                farthest_by_interval(before.data(), samples_.of(i), sampling_, by_interval_m.data());
                const std::span<const double> steps(by_interval_m.data(), sampling_.intervals());
                moved_m_[i] += *std::max_element(steps.begin(), steps.end());
                if (pairs_) pairs_->moved(i, steps);
                assess(i);
            }
        }
    });
}

void FleetState::fill_corrections(std::size_t drone, double gain, bool limits, double* const c[3]) {
    if (pulled_[drone]) {
        for (std::size_t a = 0; a < 3; ++a) {
            sampling_.spread_back(forces_.of(drone) + a * sampling_.axis_stride(),
                                  1.0 / static_cast<double>(sampling_.per_interval()), c[a]);
        }
        pulled_[drone] = 0;
    }
    const double* z = curves_.axis(drone, 2);
    if (limits && ratio_[drone] > kAtLimit) {
        motion_->push(curves_.axis(drone, 0), curves_.axis(drone, 1), z, curves_.rows, c[0], c[1], c[2]);
    }
    if (outside_m_[drone] <= 0.0) return;
    const double into_m = std::min(kIntoBand_m, 0.5 * (task_.ceiling_z_m - task_.floor_z_m));
    for (std::size_t k = 0; k < curves_.rows; ++k) {
        if (!banded_[k]) continue;
        const double below_m = task_.floor_z_m - z[k], above_m = z[k] - task_.ceiling_z_m;
        const double share = kRelaxation * kFullGain / gain;
        if (below_m > 0.0) c[2][k] += share * (below_m + into_m);
        if (above_m > 0.0) c[2][k] -= share * (above_m + into_m);
    }
}

std::size_t FleetState::advance(double gain, bool limits, const Run& run) {
    std::vector<std::uint32_t> drones;
    for (std::uint32_t i = 0; i < curves_.drones; ++i) {
        if (pulled_[i] || outside_m_[i] > 0.0 || (limits && ratio_[i] > kAtLimit)) drones.push_back(i);
    }
    move(drones, gain, run, [&](std::uint32_t i, double* const c[3]) { fill_corrections(i, gain, limits, c); });
    return drones.size();
}

void FleetState::nudge_close(std::uint64_t seed, double size_m, const Run& run) {
    std::vector<bool> meets(curves_.drones, false);
    for (const Piece& piece : pieces_) {
        for (const std::uint32_t place : piece.close) {
            meets[pairs_->pairs()[place].i] = meets[pairs_->pairs()[place].j] = true;
        }
    }
    std::vector<Vec3> by_input(curves_.drones);
    Random random(seed);
    for (Vec3& sideways : by_input) {
        sideways = {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
        sideways *= size_m / std::max(0.1, glm::length(sideways));
    }
    std::vector<std::uint32_t> drones;
    for (std::uint32_t i = 0; i < curves_.drones; ++i) {
        if (pulled_[i]) std::fill_n(forces_.of(i), sampling_.drone_stride(), 0.0);
        pulled_[i] = 0;
        if (meets[i]) drones.push_back(i);
    }
    const std::size_t rows = curves_.rows;
    move(drones, 1.0, run, [&](std::uint32_t i, double* const c[3]) {
        const Vec3& sideways = by_input[order_[i]];
        for (std::size_t k = 3; k + 3 < rows; ++k) {
            const double u = static_cast<double>(k - 2) / static_cast<double>(rows - 5);
            const double bump = 16.0 * u * u * (1.0 - u) * (1.0 - u);
            for (int a = 0; a < 3; ++a) c[a][k] = bump * sideways[a];
        }
    });
}

Encounter FleetState::encounter(const Closeness& closeness) const {
    const auto [first, second] = std::minmax(order_[closeness.i], order_[closeness.j]);
    return {DroneId(first), DroneId(second), closeness.share, closeness.closest_m};
}

double FleetState::motion_ratio() const {
    return *std::max_element(ratio_.begin(), ratio_.end());
}
double FleetState::band_excess_m() const {
    return *std::max_element(outside_m_.begin(), outside_m_.end());
}

Lattice FleetState::lattice_in_band() const {
    Lattice lattice = lattice_of(curves_, order_);
    if (band_excess_m() <= 0.0) return lattice;
    for (std::size_t k = 0; k < curves_.rows; ++k) {
        if (!banded_[k]) continue;
        for (std::size_t i = 0; i < curves_.drones; ++i) {
            lattice.at(k, i).z = std::clamp(lattice.at(k, i).z, task_.floor_z_m, task_.ceiling_z_m);
        }
    }
    return lattice;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> FleetState::close() const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
    for (const Piece& piece : pieces_) {
        for (const std::uint32_t place : piece.close) {
            const ClosePair& pair = pairs_->pairs()[place];
            result.emplace_back(std::minmax(order_[pair.i], order_[pair.j]));
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace aerogram::planner
