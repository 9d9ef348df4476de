#pragma once
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "planner/formation/csv_points.hpp"

/// What the fuzz target of formation csv files does with any bytes: they are points with a colour each or without
/// colours, or are refused with messages that name the file. Build tests/fuzz/points_fuzz.cpp with
/// -fsanitize=fuzzer,address,undefined; the corpus tests/fuzz/corpus/points is replayed by a unit test.
namespace aerogram::planner::fuzz {

inline void insist_points(bool sound) {
    if (!sound) std::abort();
}

inline void try_points(std::string_view bytes) {
    const auto points = parse_csv_points(bytes, "any.csv");
    if (!points) {
        insist_points(points.error().code == ErrorCode::invalid_input &&
                      points.error().message.starts_with("any.csv:"));
        return;
    }
    insist_points(!points->points_m.empty());
    insist_points(points->colors.empty() || points->colors.size() == points->points_m.size());
    for (const Vec3& p : points->points_m) insist_points(is_finite(p));
    for (const Rgb& c : points->colors)
        insist_points(c.r >= 0.0 && c.r <= 1.0 && c.g >= 0.0 && c.g <= 1.0 && c.b >= 0.0 && c.b <= 1.0);
}

}  // namespace aerogram::planner::fuzz
