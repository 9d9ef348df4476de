#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Decimal numbers in text files: written with a fixed number of digits, read strictly; never a locale, a decimal comma
/// or NaN.
namespace aerogram::exporter {

/// The nearest whole number of 1 / 10^digits. @param value  finite, |value| * 10^digits below 2^62.
[[nodiscard]] std::int64_t in_units(double value, int digits);
/// Appends units / 10^digits with exactly `digits` decimals: (-25, 3) is "-0.025". @param digits  0..9.
void append_units(std::string& out, std::int64_t units, int digits);
/// Appends the value with `digits` decimals, rounded half away from zero; never "-0".
void append_fixed(std::string& out, double value, int digits);

/// The whole text as one finite number, spaces around it allowed. Absent when it is not one or |number| > limit.
[[nodiscard]] std::optional<double> parse_number(std::string_view text, double limit);
/// The whole text as one whole number in [lowest, highest], spaces around it allowed.
[[nodiscard]] std::optional<std::int64_t> parse_whole(std::string_view text, std::int64_t lowest, std::int64_t highest);

/// Splits at a separator; "a,,b" has three fields.
class Fields {
  public:
    Fields(std::string_view text, char separator) : rest_(text), separator_(separator) {}
    /// The next field, absent after the last one.
    std::optional<std::string_view> next();

  private:
    std::optional<std::string_view> rest_;
    char separator_;
};
/// The text without spaces and tabs at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// A field of an untrusted file as a message may show it: printable ASCII, quoted, at most 40 characters.
[[nodiscard]] std::string shown(std::string_view text);

}  // namespace aerogram::exporter
