#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace aerogram::planner {

inline constexpr std::size_t kLongestPlyHeader = 65'536;

/// What is wrong with the front of a PLY file, in words ("is damaged: ..."); empty: nothing. Looks whether the header
/// ends, its lines can be read, and the file is long enough for what it announces: the library behind read_mesh runs
/// for ever or crashes where that is not so.
/// @param front  the file's first bytes, kLongestPlyHeader or all of them. @param size  of the whole file.
[[nodiscard]] std::string fault_of_ply(std::string_view front, std::uintmax_t size);

}  // namespace aerogram::planner
