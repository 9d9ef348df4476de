#pragma once
#include <sstream>
#include <stdexcept>
#include <string>

namespace aerogram {

/// Thrown when the program itself is wrong: a broken precondition, never bad input.
class ContractViolation : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

namespace detail {
template <class... Values>
[[noreturn]] void contract_violated(const char* condition, const char* file, int line, const Values&... values) {
    std::ostringstream text;
    text << file << ':' << line << ": required: " << condition;
    ((text << " [" << values << ']'), ...);
    throw ContractViolation(text.str());
}
}  // namespace detail
}  // namespace aerogram

/// States a precondition or invariant; always on. Extra arguments are values shown in the message.
#define AEROGRAM_REQUIRE(condition, ...)                                                                         \
    do {                                                                                                         \
        if (!(condition)) ::aerogram::detail::contract_violated(#condition, __FILE__, __LINE__ __VA_OPT__(, ) __VA_ARGS__); \
    } while (false)
