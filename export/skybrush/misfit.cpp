#include "export/skybrush/misfit.hpp"

#include <sstream>

namespace aerogram::exporter {

std::string misfit_text(const std::string& drone, const FitError& error, const FitError& bound) {
    std::ostringstream text;
    text.precision(3);
    text << drone << ": pieces of " << kShortestPieceMs << " ms miss the flight by " << error.position_m << " m, "
         << error.speed_mps << " m/s, " << error.acceleration_mps2 << " m/s²; within " << bound.position_m << " m, "
         << bound.speed_mps << " m/s, " << bound.acceleration_mps2
         << " m/s² would do: a longer duration or a gentler profile helps";
    return text.str();
}

}  // namespace aerogram::exporter
