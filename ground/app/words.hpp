#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace aerogram::ground {

/// A number with a fixed count of decimals, '.' whatever the locale.
std::string decimals(double value, int digits);
/// "1 drone", "3 drones".
std::string counted(std::size_t count, const std::string& what);
/// "drone 3", "drones 3 and 7", "".
std::string drones_in_words(const std::vector<std::size_t>& numbers);

}  // namespace aerogram::ground
