#pragma once
#include <string>

#include "export/outgoing/fitted.hpp"

namespace aerogram::exporter {

/// What is said of a drone whose refitted curve is beyond the bound.
[[nodiscard]] std::string misfit_text(const std::string& drone, const FitError& error, const FitError& bound);

}  // namespace aerogram::exporter
