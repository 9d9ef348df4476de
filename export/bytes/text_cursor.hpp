#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace aerogram::exporter {

/// Walks through plain text as our own writers leave it, quickly: numbers are [-]digits[.digits] with at most 15 digits
/// and no idle zeros in front, which a double division makes exact. The first thing that is otherwise ends it: then the
/// careful reader of the format must look, which knows all that is allowed and what to say of the rest.
class TextCursor {
  public:
    explicit TextCursor(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

    [[nodiscard]] bool ok() const { return ok_; }
    [[nodiscard]] bool at_end() const { return at_ == end_; }
    void give_up() { ok_ = false; }

    /// Whether this stands here; if so, goes beyond it.
    bool skip(std::string_view literal) {
        if (!ok_ || static_cast<std::size_t>(end_ - at_) < literal.size()) return false;
        if (std::string_view(at_, literal.size()) != literal) return false;
        at_ += literal.size();
        return true;
    }
    /// This must stand here.
    void expect(std::string_view literal) {
        if (!skip(literal)) give_up();
    }

    double number() {
        const bool negative = skip("-");
        std::uint64_t units = 0;
        std::size_t decimals = 0, count = leading_digits(units);
        if (skip(".")) {
            decimals = digits(units);
            if (decimals == 0) give_up();
            count += decimals;
        }
        if (count > kMostDigits) give_up();
        if (!ok_) return 0.0;
        const double value = static_cast<double>(units) / kPowers[decimals];
        return negative ? -value : value;
    }
    /// A number within ±limit.
    double number(double limit) {
        const double value = number();
        if (value > limit || value < -limit) give_up();
        return value;
    }
    std::int64_t whole(std::int64_t highest) {
        std::uint64_t units = 0;
        if (leading_digits(units) > kMostDigits || units > static_cast<std::uint64_t>(highest)) give_up();
        return ok_ ? static_cast<std::int64_t>(units) : 0;
    }

  private:
    static constexpr std::size_t kMostDigits = 15;
    static constexpr std::array<double, kMostDigits + 1> kPowers{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                                 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

    /// Appends the digits that stand here to `units`, which wraps beyond kMostDigits; @returns how many they are.
    std::size_t digits(std::uint64_t& units) {
        const char* const begin = at_;
        while (at_ != end_ && *at_ >= '0' && *at_ <= '9') units = 10 * units + static_cast<unsigned>(*at_++ - '0');
        return static_cast<std::size_t>(at_ - begin);
    }

    /// The digits of a whole number: at least one, no 0 before others.
    std::size_t leading_digits(std::uint64_t& units) {
        const char* const begin = at_;
        const std::size_t count = digits(units);
        if (count == 0 || (count > 1 && *begin == '0')) give_up();
        return count;
    }

    const char* at_;
    const char* end_;
    bool ok_ = true;
};

}  // namespace aerogram::exporter
