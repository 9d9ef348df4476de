#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace aerogram::ground {

/// A number with a fixed count of decimals, '.' whatever the locale.
std::string decimals(double value, int digits);
/// "drone 3", "drones 3 and 7", "".
std::string drones_in_words(const std::vector<std::size_t>& numbers);

}  // namespace aerogram::ground
