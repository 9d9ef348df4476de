#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "export/outgoing/curve_fit.hpp"
#include "export/outgoing/outgoing_show.hpp"
#include "export/record/recorded_show.hpp"
#include "geo/run.hpp"

namespace aerogram::exporter {

/// Why a show's curves cannot be written, or empty: the first drone whose half-second cubics are not within fit_bound.
[[nodiscard]] std::string skyc_misfit(const OutgoingShow& show);

/// trajectory.json of the drones from `first` to before `end`: the show's flights refitted
/// (export/outgoing/curve_fit.hpp), rounded to millimetres, X front. Errors: infeasible naming drone and misfit when a
/// curve cannot be held within fit_bound; stopped.
Result<std::vector<std::string>> skyc_trajectories(const OutgoingShow& show, std::size_t first, std::size_t end,
                                                   const Run& run);

/// What our reader believes: coordinates and times, as numbers of the file.
inline constexpr double kFarthestSkyc_m = 1e6, kLongestSkyc_s = 86'400.0;

/// Reads a trajectory.json into a drone without pieces, when it is written just as skyc_trajectories writes; false when
/// it is not, and the drone is as it was: then the careful reader must look.
[[nodiscard]] bool read_plain_trajectory(std::string_view text, RecordedDrone& drone);

}  // namespace aerogram::exporter
