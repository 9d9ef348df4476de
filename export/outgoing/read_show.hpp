#pragma once
#include <memory>
#include <string>
#include <vector>

#include "export/outgoing/outgoing_show.hpp"
#include "export/record/recorded_show.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"

namespace aerogram::exporter {

/// What a file does not say, or what is wanted otherwise.
struct ReadShowOptions {
    std::vector<std::size_t> drones;  ///< only these, by their numbers, rising; empty: all
    std::optional<geo::ShowOrigin> origin;
    planner::ExportWishes exporting;
};

/// A show on its way out that was read from a file with times.
class ReadShow final : public OutgoingShow {
  public:
    /// Facts that the file lacks: limits of the standard preset (or what a mission has without keys), no airspace,
    /// 900 s of endurance, homes where drones begin and landing places where they end; numbers are those in the drones'
    /// names where each has one of its own, else 1, 2, 3...; names that could not name a file, or are not unique, give
    /// way to "drone-001". Keyframes are where the whole fleet stands in the air (stands.hpp).
    /// Errors: invalid_input when the show is not well formed, has no times, no drones, or not those asked for;
    /// stopped.
    static Result<std::unique_ptr<ReadShow>> of(RecordedShow show, const ReadShowOptions& options, const Run& run);

    [[nodiscard]] const OutgoingFacts& facts() const override { return facts_; }
    [[nodiscard]] const Tracks& tracks(std::size_t drone) const override;
    /// The recorded pieces; the first and last points are held where the file has none.
    [[nodiscard]] Flight flight(std::size_t drone) const override;
    /// See piecewise_fit.hpp.
    [[nodiscard]] Fitted fitted(std::size_t drone) const override;

    /// What was assumed, for people, one sentence each.
    [[nodiscard]] const std::vector<std::string>& assumed() const { return assumed_; }

  private:
    ReadShow() = default;
    void take_facts(const ReadShowOptions& options);
    void note_drones();
    void note_motion(const Run& run);

    RecordedShow show_;  ///< of the drones that go out
    OutgoingFacts facts_;
    std::vector<std::string> assumed_;
};

/// A drone's number: the last digits of its name, when all have one of their own from 1 to 100,000; else its place.
[[nodiscard]] std::vector<std::size_t> numbers_of(const std::vector<RecordedDrone>& drones);

}  // namespace aerogram::exporter
