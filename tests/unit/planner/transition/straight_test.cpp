#include "planner/transition/straight.hpp"

#include <gtest/gtest.h>

#include "geo/contract.hpp"

namespace aerogram::planner {
namespace {

TEST(StraightTransition, CarriesEndsAndProfile) {
    const Straight s =
        straight_transition({{0, 0, 10}, {5, 0, 10}}, {{0, 0, 20}, {9, 0, 10}}, ProfileKind::trapezoid, 12);
    EXPECT_EQ(s.from_m[1], Vec3(5, 0, 10));
    EXPECT_EQ(s.to_m[1], Vec3(9, 0, 10));
    EXPECT_EQ(s.profile, profile_rows(ProfileKind::trapezoid, 12));
}

TEST(StraightTransition, RefusesUnequalFleetsAndTooFewRows) {
    EXPECT_THROW((void)straight_transition({{0, 0, 1}}, {}, ProfileKind::s_curve, 12), ContractViolation);
    EXPECT_THROW((void)straight_transition({{0, 0, 1}}, {{0, 0, 2}}, ProfileKind::s_curve, 6), ContractViolation);
}

}  // namespace
}  // namespace aerogram::planner
