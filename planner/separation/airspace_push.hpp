#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "planner/separation/fleet_curves.hpp"
#include "planner/separation/projection.hpp"

namespace aerogram::planner {

/// Pushes drones out of obstacles and audience areas and back inside the fence. A drone that only grazes goes along the
/// distance's gradient; one whose way leads right through keeps to one side, chosen once (the shortest of left, right
/// and, for obstacles, over the top), so that the detour is smooth.
class AirspacePush {
  public:
    AirspacePush(const ProjectionTask& task, const Sampling& sampling, std::size_t drones);
    [[nodiscard]] bool empty() const { return regions_.empty(); }

    struct Outcome {
        double shortfall_m = 0.0;  ///< what the worst chord is short of its margin; 0: none
        double slack_m = 0.0;      ///< the drone may move so far without being looked at again
    };
    /// Adds to the forces (laid out like samples, metres) what takes the drone's chords clear. Safe to call from
    /// several threads for different drones.
    Outcome push(std::size_t drone, const double* samples, double* forces);

  private:
    struct Region {
        std::function<double(const Vec3&)> clear_m;  ///< distance from the forbidden side; negative inside it
        double top_m;                                ///< one can fly over it from here; infinity: not
    };
    /// The nearest point of a chord, sought in steps that the distance allows.
    struct Graze {
        std::size_t chord = 0;
        double share = 0.0, clear_m = 0.0;
        Vec3 at{};
    };
    struct Side {
        std::size_t region = 0;
        Vec3 direction{};
    };

    [[nodiscard]] Vec3 sample(const double* samples, std::size_t s) const;
    [[nodiscard]] Graze graze(const Region& region, const double* samples, std::size_t chord, double enough_m) const;
    [[nodiscard]] Vec3 side(std::size_t drone, std::size_t region, std::span<const Graze> run, const Vec3& along,
                            double aim_m);
    void push_run(std::size_t drone, std::size_t region, std::span<const Graze> run, double aim_m,
                  const double* samples, double* forces);
    void add(double* forces, const Graze& graze, const Vec3& move) const;

    const Sampling& sampling_;
    double downwash_, margin_m_, ceiling_z_m_;
    std::vector<Region> regions_;
    std::vector<std::vector<Side>> sides_;  ///< by drone
};

}  // namespace aerogram::planner
