#include "export/exact/knot_pieces.hpp"

#include <utility>

namespace aerogram::exporter {

void KnotPieces::add_row(std::vector<Vec3> row) {
    rows_[added_ % 4] = std::move(row);
    ++added_;
    if (added_ < 4) return;
    const std::size_t interval = added_ - 4;
    const auto& r0 = rows_[interval % 4];
    const auto& r1 = rows_[(interval + 1) % 4];
    const auto& r2 = rows_[(interval + 2) % 4];
    const auto& r3 = rows_[(interval + 3) % 4];
    const double piece_start_s = start_s_ + static_cast<double>(interval) * knot_step_s_;
    for (std::size_t i = 0; i < drones_.size(); ++i) {
        RecordedDrone& drone = drones_[i];
        // Neighbouring pieces share their common point: what ends one begins the next.
        if (interval == 0) drone.controls_m.push_back((r0[i] + 4.0 * r1[i] + r2[i]) / 6.0);
        drone.pieces.push_back(
            {piece_start_s, knot_step_s_, static_cast<std::uint32_t>(drone.controls_m.size() - 1), 3});
        drone.controls_m.push_back((2.0 * r1[i] + r2[i]) / 3.0);
        drone.controls_m.push_back((r1[i] + 2.0 * r2[i]) / 3.0);
        drone.controls_m.push_back((r1[i] + 4.0 * r2[i] + r3[i]) / 6.0);
    }
}

}  // namespace aerogram::exporter
