#pragma once
#include "geo/result.hpp"

namespace aerogram::ground {

inline constexpr int kDone = 0;
inline constexpr int kCannotBeFlown = 1;
inline constexpr int kBadInput = 2;
inline constexpr int kLinkFailed = 3;
inline constexpr int kInterrupted = 130;  ///< what shells expect after Ctrl-C

[[nodiscard]] constexpr int exit_status(ErrorCode code) {
    switch (code) {
        case ErrorCode::invalid_input:
            return kBadInput;
        case ErrorCode::infeasible:
            return kCannotBeFlown;
        case ErrorCode::stopped:
            return kInterrupted;
        case ErrorCode::io:
            break;
    }
    return kBadInput;
}

}  // namespace aerogram::ground
