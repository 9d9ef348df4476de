#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "export/report/report.hpp"
#include "geo/vec3.hpp"

/// How the report writes numbers, for every page alike. A minus is "−", what is absent or not finite "–".
namespace aerogram::exporter {

inline constexpr const char* kAbsent = "–";

/// With this many decimals, rounded half away from zero.
[[nodiscard]] std::string fixed_text(double value, int digits);
/// With its sign: "+0.133", "−0.020", "0.000".
[[nodiscard]] std::string signed_text(double value, int digits);
/// "10,000".
[[nodiscard]] std::string count_text(std::size_t count);
/// "1 drone", "10,000 drones".
[[nodiscard]] std::string counted(std::size_t count, const std::string& one, const std::string& many);
/// Show time, "3:07.5"; minutes run on beyond an hour.
[[nodiscard]] std::string clock_text(double time_s, int digits = 1);
/// "0.62" is "62 %" with digits = 0.
[[nodiscard]] std::string percent_text(double share, int digits);
/// "12.3, −4.0, 60.0".
[[nodiscard]] std::string place_text(const Vec3& place_m);
/// "17 and 23", "1, 2, 3 and 9,997 more".
[[nodiscard]] std::string drones_text(std::span<const std::size_t> numbers, std::size_t most = 3);
/// Ascending numbers as "1–40, 57, 60–99"; after `most` ranges "… (312)" with their count.
[[nodiscard]] std::string ranges_text(std::span<const std::size_t> numbers, std::size_t most = 6);
/// "37.4219444° N, 122.0841111° W".
[[nodiscard]] std::string origin_text(const geo::ShowOrigin& origin);
/// The first 12 digits of a hash, "a1b2 c3d4 e5f6".
[[nodiscard]] std::string short_hash(const std::string& hash);
/// Groups of four digits with spaces between, from digit `begin` on.
[[nodiscard]] std::string grouped_hash(const std::string& hash, std::size_t begin = 0,
                                       std::size_t end = std::string::npos);

/// At least so many decimals, and as many more as a margin below 0 needs to be seen, at most 6.
[[nodiscard]] int digits_of_margin(double margin, int least);
/// Decimals of a rule's numbers: three (of seconds one), more where a broken rule would look held for want of them.
[[nodiscard]] int rule_digits(const ReportRule& rule);

}  // namespace aerogram::exporter
