#include "planner/transition/straight.hpp"

#include <utility>

#include "geo/contract.hpp"

namespace aerogram::planner {

Straight straight_transition(Points from_m, Points to_m, ProfileKind profile, std::size_t rows) {
    AEROGRAM_REQUIRE(from_m.size() == to_m.size(), from_m.size(), to_m.size());
    AEROGRAM_REQUIRE(rows >= 7, rows);
    return Straight{std::move(from_m), std::move(to_m), profile_rows(profile, rows)};
}

}  // namespace aerogram::planner
