#include "planner/separation/airspace_push.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace aerogram::planner {
namespace {

constexpr double kExtra_m = 0.05;    ///< aimed at beyond the margin: the margin itself is never quite reached
constexpr double kStep_m = 0.1;      ///< shortest step along a chord
constexpr double kFarthest_m = 1e3;  ///< detours are not sought beyond
constexpr double kRelaxation = 0.9;  ///< times the projection's gain: just below what would overshoot for ever

/// How far p must go along the direction until it is clear by aim_m.
double way_out_m(const std::function<double(const Vec3&)>& clear_m, const Vec3& p, const Vec3& direction,
                 double aim_m) {
    double way_m = 0.0;
    while (way_m < kFarthest_m) {
        const double lacking_m = aim_m - clear_m(p + way_m * direction);
        if (lacking_m <= 0.0) return way_m;
        way_m += std::max(lacking_m, kStep_m);
    }
    return std::numeric_limits<double>::infinity();
}

Vec3 gradient(const std::function<double(const Vec3&)>& clear_m, const Vec3& p) {
    constexpr double h = 1e-4;
    Vec3 g{};
    for (int a = 0; a < 3; ++a) {
        Vec3 step{};
        step[a] = h;
        g[a] = (clear_m(p + step) - clear_m(p - step)) / (2.0 * h);
    }
    const double length = glm::length(g);
    return length > 1e-6 ? g / length : Vec3{1.0, 0.0, 0.0};
}

}  // namespace

AirspacePush::AirspacePush(const ProjectionTask& task, const Sampling& sampling, std::size_t drones)
    : sampling_(sampling),
      downwash_(task.metric.downwash),
      margin_m_(task.airspace_margin_m),
      ceiling_z_m_(task.ceiling_z_m),
      sides_(drones) {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (!task.airspace.geofence_m.empty()) {
        const geo::Polygon& fence = task.airspace.geofence_m;
        regions_.push_back({[&fence](const Vec3& p) { return geo::signed_distance(fence, {p.x, p.y}); }, never});
    }
    for (const geo::Polygon& audience : task.airspace.audience_m) {
        regions_.push_back({[&audience](const Vec3& p) { return -geo::signed_distance(audience, {p.x, p.y}); }, never});
    }
    for (const geo::Obstacle& obstacle : task.airspace.obstacles) {
        regions_.push_back(
            {[&obstacle](const Vec3& p) { return geo::clearance(obstacle, p); }, obstacle.base_m + obstacle.height_m});
    }
}

/// Sample s in the order of time, in metres.
Vec3 AirspacePush::sample(const double* samples, std::size_t s) const {
    const std::size_t per = sampling_.per_interval(), a = sampling_.axis_stride();
    const double* at = samples + sampling_.before(s % per) + s / per;
    return {at[0], at[a], at[2 * a] * downwash_};
}

AirspacePush::Graze AirspacePush::graze(const Region& region, const double* samples, std::size_t chord,
                                        double enough_m) const {
    const Vec3 from = sample(samples, chord), way = sample(samples, chord + 1) - from;
    const double length = glm::length(way);
    Graze worst{chord, 0.0, std::numeric_limits<double>::infinity(), from};
    for (double gone_m = 0.0;;) {
        const double share = length > 0.0 ? std::min(1.0, gone_m / length) : 1.0;
        const Vec3 at = from + share * way;
        const double clear_m = region.clear_m(at);
        if (clear_m < worst.clear_m) worst = {chord, share, clear_m, at};
        if (share >= 1.0) return worst;
        gone_m += std::max(clear_m - enough_m, kStep_m);
    }
}

AirspacePush::Outcome AirspacePush::push(std::size_t drone, const double* samples, double* forces) {
    const std::size_t chords = sampling_.intervals() * sampling_.per_interval();
    Vec3 low = sample(samples, 0), high = low;
    for (std::size_t s = 1; s <= chords; ++s) {
        const Vec3 p = sample(samples, s);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vec3 center = 0.5 * (low + high);
    const double half_m = 0.5 * glm::length(high - low);
    Outcome outcome{0.0, std::numeric_limits<double>::infinity()};
    std::vector<Graze> run;
    for (std::size_t r = 0; r < regions_.size(); ++r) {
        const Region& region = regions_[r];
        const double beyond_m = region.clear_m(center) - half_m - margin_m_ - kExtra_m;
        outcome.slack_m = std::min(outcome.slack_m, beyond_m);
        if (beyond_m > 0.0) continue;
        const double required_m =
            std::min({margin_m_, region.clear_m(sample(samples, 0)), region.clear_m(sample(samples, chords))});
        const double aim_m = required_m + kExtra_m;
        double short_m = 0.0;
        const auto finish = [&] {
            if (short_m > 1e-6) push_run(drone, r, run, aim_m, samples, forces);
            outcome.shortfall_m = std::max(outcome.shortfall_m, short_m);
            short_m = 0.0;
            run.clear();
        };
        double least_m = std::numeric_limits<double>::infinity();
        for (std::size_t c = 0; c < chords; ++c) {
            const Graze g = graze(region, samples, c, aim_m);
            least_m = std::min(least_m, g.clear_m - aim_m);
            if (g.clear_m >= aim_m) {
                finish();
                continue;
            }
            run.push_back(g);
            short_m = std::max(short_m, required_m - g.clear_m);
        }
        finish();
        outcome.slack_m = std::min(outcome.slack_m, std::max(least_m, -1.0));
    }
    return outcome;
}

void AirspacePush::push_run(std::size_t drone, std::size_t region, std::span<const Graze> run, double aim_m,
                            const double* samples, double* forces) {
    const auto& clear_m = regions_[region].clear_m;
    const double deepest_m = std::ranges::min_element(run, {}, [](const Graze& g) { return g.clear_m; })->clear_m;
    if (deepest_m >= 0.0) {
        for (const Graze& g : run) add(forces, g, (aim_m - g.clear_m) * gradient(clear_m, g.at));
        return;
    }
    const Vec3 along = sample(samples, run.back().chord + 1) - sample(samples, run.front().chord);
    const Vec3 direction = side(drone, region, run, along, aim_m);
    for (const Graze& g : run) {
        const double way_m = way_out_m(clear_m, g.at, direction, aim_m);
        add(forces, g, std::isfinite(way_m) ? way_m * direction : (aim_m - g.clear_m) * gradient(clear_m, g.at));
    }
}

/// To which side the drone goes round the region: as it decided before, else the way that is least far.
Vec3 AirspacePush::side(std::size_t drone, std::size_t region, std::span<const Graze> run, const Vec3& along,
                        double aim_m) {
    for (const Side& s : sides_[drone]) {
        if (s.region == region) return s.direction;
    }
    const double level = std::hypot(along.x, along.y);
    const Vec3 left = level > 1e-6 ? Vec3{-along.y / level, along.x / level, 0.0} : Vec3{1.0, 0.0, 0.0};
    Vec3 best = left;
    double best_m = std::numeric_limits<double>::infinity();
    const bool over = regions_[region].top_m + aim_m <= ceiling_z_m_;
    for (const Vec3& direction : {left, -left, Vec3{0.0, 0.0, 1.0}}) {
        if (direction.z > 0.0 && !over) continue;
        double farthest_m = 0.0;
        for (const Graze& g : run) {
            farthest_m = std::max(farthest_m, way_out_m(regions_[region].clear_m, g.at, direction, aim_m));
        }
        if (farthest_m < best_m) {
            best_m = farthest_m;
            best = direction;
        }
    }
    sides_[drone].push_back({region, best});
    return best;
}

void AirspacePush::add(double* forces, const Graze& graze, const Vec3& move) const {
    const std::size_t per = sampling_.per_interval(), q = graze.chord % per, m = graze.chord / per;
    for (std::size_t a = 0; a < 3; ++a) {
        double* force = forces + a * sampling_.axis_stride();
        force[sampling_.before(q) + m] += kRelaxation * (1.0 - graze.share) * move[static_cast<int>(a)];
        force[sampling_.after(q) + m] += kRelaxation * graze.share * move[static_cast<int>(a)];
    }
}

}  // namespace aerogram::planner
