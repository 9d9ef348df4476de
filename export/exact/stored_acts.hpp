#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "export/exact/payload_cursor.hpp"
#include "export/record/recorded_show.hpp"

namespace aerogram::exporter::trajectories {

/// An act as it lies in trajectories.bin; its points are read when pieces are made of them.
struct StoredAct {
    std::int32_t start_ms = 0, duration_ms = 0;
    std::size_t rows = 0;         ///< 0: a hold
    std::vector<double> profile;  ///< straight only
    std::string_view points;      ///< hold: N; straight: from, to; lattice: rows
    std::size_t points_offset = 0;

    [[nodiscard]] std::size_t intervals() const { return rows == 0 ? 1 : rows - 3; }
};

/// The act block; on anything wrong the cursor is no longer ok().
std::vector<StoredAct> read_acts(PayloadCursor& in, std::size_t drones);

/// Adds every act's pieces to the drones. @returns what is wrong with a coordinate, or empty.
std::string add_pieces(const std::vector<StoredAct>& acts, std::size_t scalar_bytes,
                       std::vector<RecordedDrone>& drones);

/// What is lost: with floats, their rounding; with doubles, that of the reader's own arithmetic.
Rounding stated_rounding(const std::vector<StoredAct>& acts, std::size_t scalar_bytes,
                         const std::vector<RecordedDrone>& drones);

}  // namespace aerogram::exporter::trajectories
