#include "geo/result.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "geo/ids.hpp"
#include "geo/limits.hpp"
#include "geo/vec3.hpp"

namespace aerogram {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

TEST(Result, HoldsAValue) {
    Result<std::string> result = std::string("show");
    EXPECT_TRUE(result.ok());
    EXPECT_TRUE(static_cast<bool>(result));
    EXPECT_EQ(*result, "show");
    EXPECT_EQ(result->size(), 4U);
    *result += "!";
    EXPECT_EQ(result.value(), "show!");
}

TEST(Result, HoldsAnError) {
    const Result<int> result = Error{ErrorCode::infeasible, "3.0 m needed"};
    EXPECT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::infeasible);
    EXPECT_EQ(result.error().message, "3.0 m needed");
}

TEST(Result, GivesAwayWhatCannotBeCopied) {
    Result<std::unique_ptr<int>> result = std::make_unique<int>(7);
    const std::unique_ptr<int> owned = std::move(result).value();
    EXPECT_EQ(*owned, 7);
}

TEST(Result, AskingForTheWrongOneIsABugThatQuotesTheError) {
    const Result<int> bad = Error{ErrorCode::io, "disk full"};
    try {
        (void)bad.value();
        FAIL() << "did not throw";
    } catch (const ContractViolation& violation) {
        EXPECT_THAT(violation.what(), HasSubstr("disk full"));
    }
    const Result<int> good = 1;
    EXPECT_THROW((void)good.error(), ContractViolation);
}

TEST(Result, ErrorMayBeTheValueOfAnother) {
    const Result<int> first = Error{ErrorCode::stopped, "why"};
    const Status second = first.error();
    EXPECT_EQ(second.error().code, ErrorCode::stopped);
    EXPECT_TRUE(Status(Done{}).ok());
}

TEST(Require, NamesPlaceConditionAndValues) {
    const int drones = 3;
    try {
        AEROGRAM_REQUIRE(drones > 4, drones, "limit", 4);
        FAIL() << "did not throw";
    } catch (const ContractViolation& violation) {
        EXPECT_THAT(violation.what(), HasSubstr("result_test.cpp:"));
        EXPECT_THAT(violation.what(), EndsWith("required: drones > 4 [3] [limit] [4]"));
    }
}

TEST(Require, PassesSilentlyAndEvaluatesTheConditionOnce) {
    int evaluated = 0;
    AEROGRAM_REQUIRE(++evaluated == 1);
    EXPECT_EQ(evaluated, 1);
}

TEST(Index, CountsFrom1ForPeople) {
    EXPECT_EQ(DroneId(std::size_t{0}).number(), 1U);
    EXPECT_EQ(DroneId::from_number(12), DroneId(std::size_t{11}));
    static_assert(!std::is_convertible_v<DroneId, SlotId> && !std::is_constructible_v<SlotId, DroneId>);
}

TEST(SeparationMetric, ShrinksHeightByTheDownwash) {
    const SeparationMetric metric{2.0};
    EXPECT_DOUBLE_EQ(metric.distance({0.0, 0.0, 0.0}, {0.0, 0.0, 4.0}), 2.0);
    EXPECT_DOUBLE_EQ(metric.distance({0.0, 0.0, 0.0}, {3.0, 4.0, 0.0}), 5.0);
    EXPECT_DOUBLE_EQ(metric.length({2.0, 1.0, 4.0}), 3.0);
}

TEST(Limits, PlannedSeparationHoldsTheExportMargin) {
    Limits limits;
    limits.min_separation_m = 2.0;
    limits.export_margin_m = 0.25;
    EXPECT_DOUBLE_EQ(planned_separation_m(limits), 2.25);
}

}  // namespace
}  // namespace aerogram
