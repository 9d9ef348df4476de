#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "geo/run.hpp"
#include "planner/separation/airspace_push.hpp"
#include "planner/separation/close_pairs.hpp"
#include "planner/separation/fleet_curves.hpp"
#include "planner/separation/motion_push.hpp"
#include "planner/separation/projection.hpp"
#include "planner/separation/smoother.hpp"

namespace aerogram::planner {

/// The fleet while it is projected: control rows, samples, what pulls at the samples, and how far each drone has moved.
/// Drones are in neighbourly order here. All loops are cut into fixed pieces, so threads change nothing.
class FleetState {
  public:
    FleetState(const Lattice& input, const ProjectionTask& task);

    struct Closeness {
        double closest_m = std::numeric_limits<double>::infinity();  ///< of all chords; infinity when nobody is near
        double shortfall_m = 0.0;                                    ///< sum over chords of what they lack of the aim
        std::size_t looked_at = 0;                                   ///< chords: the work done
        std::uint32_t i = 0, j = 0;                                  ///< who is closest, in the fleet's order
        double share = 0.0;                                          ///< and when: share of the act
    };
    /// Adds to the forces what takes too close pairs to the aim. @param limit_m  pairs closer than this are in `close`.
    Closeness push_pairs(double aim_m, double limit_m, const Run& run);
    /// Adds what takes drones clear of the airspace's edges; returns the largest shortfall, metres.
    double push_airspace(const Run& run);
    /// Moves the drones that something pulls at: gain times the filtered forces, limits and band; clears the forces.
    /// @returns how many.
    std::size_t advance(double gain, bool limits, const Run& run);
    /// Instead of moving by the forces, which are cleared: a smooth seeded bump for each drone of a close pair.
    void nudge_close(std::uint64_t seed, double size_m, const Run& run);

    /// Lists the pairs anew, or brings the list up to date. False when stopped or crowded.
    bool list_pairs(double needed_m, double slack_m, const Run& run);
    bool refresh_pairs(const Run& run) { return pairs_->refresh(samples_, run); }
    [[nodiscard]] std::size_t listed() const { return pairs_->listed(); }
    [[nodiscard]] bool crowded() const { return pairs_->crowded(); }

    [[nodiscard]] double motion_ratio() const;   ///< worst over all drones, 1: at a limit; 0 without limits
    [[nodiscard]] double band_excess_m() const;  ///< what the worst free row is outside the band
    /// The closest pair of push_pairs with its input's numbers.
    [[nodiscard]] Encounter encounter(const Closeness& closeness) const;
    [[nodiscard]] Lattice lattice_in_band() const;  ///< in the input's order, free rows put into the band
    /// The pairs that push_pairs found closer than its limit, input's numbers, ordered.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> close() const;

  private:
    struct Push {
        std::uint32_t i = 0, j = 0, before = 0, after = 0;
        double share = 0.0;
        Vec3 move{};
    };
    struct Piece {  ///< what one piece of the pair list gives
        Closeness closeness;
        std::vector<Push> pushes;
        std::vector<std::uint32_t> close;
    };
    void look_at(ClosePair& pair, double aim_m, double limit_m, Piece& piece, std::uint32_t place) const;
    void assess(std::size_t drone);
    void sample(std::size_t drone, double* samples) const;
    template <class Fill>
    void move(const std::vector<std::uint32_t>& drones, double gain, const Run& run, Fill fill);
    void fill_corrections(std::size_t drone, double gain, bool limits, double* const c[3]);

    const ProjectionTask& task_;
    std::vector<std::uint32_t> order_;
    ControlCurves curves_;
    Sampling sampling_;
    SampledCurves samples_, forces_;
    std::vector<std::uint8_t> pulled_;  ///< by drone: forces are not all zero
    std::vector<double> moved_m_;       ///< by drone: at least how far any of its samples has moved so far
    std::vector<double> ratio_, outside_m_, clear_until_m_;
    double longest_step_m_;     ///< nobody moves farther in one round: overshooting costs more than it gains
    std::vector<bool> banded_;  ///< rows that the band binds
    std::optional<MotionPush> motion_;
    std::optional<AirspacePush> airspace_;
    std::optional<SobolevSmoother> smoother_;
    std::optional<ClosePairs> pairs_;
    std::vector<Piece> pieces_;
};

}  // namespace aerogram::planner
