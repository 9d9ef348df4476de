#include "planner/sampling/outline_points.hpp"

#include <algorithm>
#include <cmath>

#include "planner/sampling/contour_track.hpp"
#include "planner/sampling/site_grid.hpp"

namespace aerogram::planner {
namespace {

constexpr double kClose = 0.98;      ///< spacings; two points nearer than this are in each other's way
constexpr double kRoundAbout = 1.6;  ///< spacings along a contour, from which on it comes back from elsewhere
constexpr double kProbesPerSpacing = 4.0;

struct Candidate {
    std::size_t contour = 0;
    double along = 0.0;
    bool corner = false;
    Vec2 at{};
};

/// Corners, and equal steps between them.
void add_candidates(const Contour& contour, std::size_t index, double spacing, std::vector<Candidate>& out) {
    const ContourTrack track(contour);
    if (!(track.length() >= 2.0 * spacing)) return;
    std::vector<double> corners = corner_places(contour, track, kClose * spacing);
    const bool smooth = corners.empty();
    if (smooth) corners.push_back(0.0);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const double from = corners[k];
        const double to = k + 1 < corners.size() ? corners[k + 1] : corners.front() + track.length();
        const auto steps = std::max(1.0, std::floor((to - from) / spacing + 1e-9));
        for (double s = 0.0; s < steps; s += 1.0) {
            const double along = from + (to - from) * s / steps;
            out.push_back({index, along, s == 0.0 && !smooth, track.at(along)});
        }
    }
}

/// Places all along the contours, to see where they come near each other.
struct Probes {
    std::vector<Vec2> at;
    std::vector<std::size_t> contour;
    std::vector<double> along;
};

Probes probes_of(const Region& region, const std::vector<ContourTrack>& tracks, double pitch) {
    Probes out;
    for (std::size_t c = 0; c < region.contours.size(); ++c) {
        const double length = tracks[c].length();
        const double steps = std::max(1.0, std::ceil(length / pitch));
        for (double s = 0.0; s < steps; s += 1.0) {
            out.at.push_back(tracks[c].at(length * s / steps));
            out.contour.push_back(c);
            out.along.push_back(length * s / steps);
        }
    }
    return out;
}

}  // namespace

std::vector<Vec2> outline_points(const Region& region, double spacing) {
    std::vector<Candidate> candidates;
    std::vector<ContourTrack> tracks;
    tracks.reserve(region.contours.size());
    for (std::size_t c = 0; c < region.contours.size(); ++c) {
        tracks.emplace_back(region.contours[c]);
        add_candidates(region.contours[c], c, spacing, candidates);
    }
    if (candidates.empty()) return {};
    const double close = kClose * spacing;
    const Probes probes = probes_of(region, tracks, spacing / kProbesPerSpacing);
    const SiteGrid probe_grid(probes.at, close);
    const auto narrow = [&](const Candidate& c) {
        bool found = false;
        probe_grid.near(c.at, 1, [&](std::size_t i, const Vec2& p) {
            if (found || glm::distance(c.at, p) >= close) return;
            found = probes.contour[i] != c.contour ||
                    tracks[c.contour].way(probes.along[i], c.along) > kRoundAbout * spacing;
        });
        return found;
    };
    // Corners first, then the others in order; each keeps away from those taken.
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.corner > b.corner; });
    std::vector<Vec2> all;
    for (const Candidate& c : candidates) all.push_back(c.at);
    const SiteGrid grid(all, close);
    std::vector<bool> taken(all.size(), false);
    std::vector<Vec2> out;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (!candidates[i].corner && narrow(candidates[i])) continue;
        bool free = true;
        grid.near(all[i], 1, [&](std::size_t j, const Vec2& p) {
            if (taken[j] && glm::distance(p, all[i]) < close) free = false;
        });
        if (!free) continue;
        taken[i] = true;
        out.push_back(all[i]);
    }
    return out;
}

}  // namespace aerogram::planner
