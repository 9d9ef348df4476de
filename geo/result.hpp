#pragma once
#include <string>
#include <utility>
#include <variant>

#include "geo/contract.hpp"

namespace aerogram {

/// One code per thing a caller may do differently.
enum class ErrorCode {
    invalid_input,  ///< a mission, a file or an argument is wrong: correct it
    infeasible,     ///< the input is sound but the show cannot be flown within its limits
    stopped,        ///< the caller asked to stop; nothing was written
    io,             ///< a file could not be read or written
};

/// Why something failed. `message` is for people: one problem a line, each naming place, value and what would do.
struct Error {
    ErrorCode code = ErrorCode::invalid_input;
    std::string message;
};

/// A value or the reason why there is none. Asking for the wrong one is a bug (AEROGRAM_REQUIRE).
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

    [[nodiscard]] bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    T& value() & { return checked(); }
    const T& value() const& { return const_cast<Result*>(this)->checked(); }
    T&& value() && { return std::move(checked()); }
    T& operator*() & { return checked(); }
    const T& operator*() const& { return value(); }
    T* operator->() { return &checked(); }
    const T* operator->() const { return &value(); }

    [[nodiscard]] const Error& error() const {
        AEROGRAM_REQUIRE(!ok());
        return std::get<1>(state_);
    }

  private:
    T& checked() {
        AEROGRAM_REQUIRE(ok(), std::get<1>(state_).message);
        return std::get<0>(state_);
    }
    std::variant<T, Error> state_;
};

/// The value of an operation that only succeeds or fails.
struct Done {};
using Status = Result<Done>;

}  // namespace aerogram
