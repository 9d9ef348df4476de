#include <algorithm>
#include <cmath>

#include "export/verify/slab.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kBin_s = 0.05, kMostBins = 1e5;
constexpr double kShortest_s = 0.02, kLongest_s = 16.0;
constexpr double kStretchesADrone = 4.0;

/// How much happens in the show up to a time, in the mean of all drones, to a twentieth of a second.
class Activity {
  public:
    Activity(const Timelines& shows, double begin_s, double end_s)
        : begin_s_(begin_s),
          bin_s_(std::max(kBin_s, (end_s - begin_s) / kMostBins)),
          travel_m_(static_cast<std::size_t>((end_s - begin_s) / bin_s_) + 3, 0.0),
          pieces_(travel_m_.size(), 0.0) {
        std::vector<double> change(travel_m_.size(), 0.0);  // of what is travelled in a bin, from bin to bin
        const double share = 1.0 / static_cast<double>(shows.drones.size());
        for (const RecordedDrone& drone : shows.drones) {
            for (const Piece& piece : drone.pieces) {
                const double finish_s = piece.start_s + piece.duration_s;
                if (finish_s <= begin_s || piece.start_s >= end_s) continue;
                const std::size_t first = bin(piece.start_s), last = bin(finish_s) + 1;
                pieces_[first] += share;
                if (piece.degree == 0) continue;
                const Vec3 *from = &drone.controls_m[piece.first_control], *to = from + piece.degree;
                const double bins = std::max(1.0, piece.duration_s / bin_s_);
                const double a_bin_m = glm::length(*to - *from) / bins * share;
                change[first] += a_bin_m;
                change[last] -= a_bin_m;
            }
        }
        for (std::size_t b = 1; b < change.size(); ++b) change[b] += change[b - 1];
        for (std::size_t b = 1; b < travel_m_.size(); ++b) {
            travel_m_[b] = travel_m_[b - 1] + change[b - 1];
            pieces_[b] += pieces_[b - 1];
        }
    }
    [[nodiscard]] double travel_m(double from_s, double to_s) const {
        return at(travel_m_, to_s) - at(travel_m_, from_s);
    }
    [[nodiscard]] double pieces(double from_s, double to_s) const { return pieces_[bin(to_s)] - pieces_[bin(from_s)]; }

  private:
    [[nodiscard]] std::size_t bin(double t_s) const {
        const double b = std::clamp((t_s - begin_s_) / bin_s_, 0.0, static_cast<double>(travel_m_.size() - 2));
        return static_cast<std::size_t>(b);
    }
    [[nodiscard]] double at(const std::vector<double>& sums, double t_s) const {
        const std::size_t b = bin(t_s);
        const double share = std::clamp((t_s - begin_s_) / bin_s_ - static_cast<double>(b), 0.0, 1.0);
        return sums[b] + share * (sums[b + 1] - sums[b]);
    }

    double begin_s_, bin_s_;
    std::vector<double> travel_m_, pieces_;
};

/// The piece ends of the drone that has most, within the times, both of which are among them.
std::vector<double> natural_times(const Timelines& shows, double begin_s, double end_s) {
    const auto busiest = std::ranges::max_element(
        shows.drones, [](const RecordedDrone& a, const RecordedDrone& b) { return a.pieces.size() < b.pieces.size(); });
    std::vector<double> times{begin_s};
    for (const Piece& piece : busiest->pieces) {
        if (piece.start_s >= times.back() + kShortest_s && piece.start_s <= end_s - kShortest_s)
            times.push_back(piece.start_s);
    }
    times.push_back(end_s);
    return times;
}

}  // namespace

std::vector<double> slab_times(const Timelines& shows, double begin_s, double end_s, double travel_m) {
    const Activity activity(shows, begin_s, end_s);
    const auto much = [&](double from_s, double to_s) {
        return std::max({activity.travel_m(from_s, to_s) / travel_m, activity.pieces(from_s, to_s) / kStretchesADrone,
                         (to_s - from_s) / std::max(kLongest_s, (end_s - begin_s) / kMostBins)});
    };
    const std::vector<double> natural = natural_times(shows, begin_s, end_s);
    std::vector<double> times{begin_s};
    for (std::size_t k = 1; k < natural.size(); ++k) {
        if (k + 1 < natural.size() && much(times.back(), natural[k + 1]) <= 1.0) continue;
        const double from_s = times.back(), length_s = natural[k] - from_s;
        const double most = std::max(1.0, length_s / kShortest_s);
        const double parts = std::clamp(std::ceil(much(from_s, natural[k]) - 0.5), 1.0, most);
        for (double part = 1.0; part < parts; part += 1.0) times.push_back(from_s + length_s * (part / parts));
        times.push_back(natural[k]);
    }
    return times;
}

}  // namespace aerogram::exporter
