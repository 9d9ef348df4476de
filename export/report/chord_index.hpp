#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "export/report/emergency.hpp"
#include "export/report/survey.hpp"

namespace aerogram::exporter {

/// All drones' ways through space and time, as straight lines between instants, in cells of space. Where space drifts
/// up with drift_mps, whoever rises (or sinks) as fast stays in one place: the question who comes near it at any later
/// time is then one about one cell.
class ChordIndex {
  public:
    /// @param drift_mps  of space, in the metric. With 0 drones on their pads are in it and stay there after the end.
    ChordIndex(const Survey& all, double drift_mps, const Run& run);

    /// A drone that drifts along with space from a place on.
    struct Question {
        std::size_t drone = 0;
        Stance stance = Stance::flying;
        Vec3 at{};  ///< at begin_s
        double begin_s = 0.0, end_s = std::numeric_limits<double>::infinity();
    };
    /// Lowers `found` to the closest that anybody else comes who is not excused, if that is closer.
    void ask(const Question& question, Found& found) const;
    /// The same of a mover, whatever its speed; only with drift 0.
    void ask(const Mover& mover, Stance stance, Found& found) const;

  private:
    struct Cell {
        std::int32_t x = 0, y = 0, z = 0;
    };
    /// Somewhere it stands, from instant to instant.
    struct Stand {
        std::uint32_t drone = 0, from = 0, to = 0;
    };
    static constexpr std::uint32_t kStand = 1U << 31U;  ///< marks an entry as one of stands_

    [[nodiscard]] Vec3 drifted(std::size_t drone, std::size_t k) const;
    [[nodiscard]] double time_s(std::size_t k) const;
    [[nodiscard]] Cell cell_of(const Vec3& p) const;
    [[nodiscard]] std::size_t bucket(const Cell& cell) const;
    void find_stands();
    void choose_cells(const Run& run);
    template <class Visit>
    void walk(const Vec3& a, const Vec3& b, const Visit& visit) const;
    template <class Visit>
    void for_each_entry(std::size_t drone, const Visit& visit) const;
    void look_around(const Mover& way, const Vec3& low, const Vec3& high, Stance stance, Found& found) const;
    void meet(std::uint32_t entry, const Mover& way, Stance stance, Found& found) const;

    const Survey& all_;
    double drift_mps_, cell_ = 1.0;
    std::size_t mask_ = 0;
    std::vector<Stand> stands_;               ///< by drone and time
    std::vector<std::uint32_t> first_stand_;  ///< one a drone, and the total
    std::vector<std::uint32_t> starts_, entries_;
};

}  // namespace aerogram::exporter
