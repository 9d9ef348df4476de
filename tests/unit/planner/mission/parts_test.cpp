#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "planner/mission/problems.hpp"
#include "planner/mission/sections.hpp"

namespace aerogram::planner::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr CountWish kRest{};
CountWish count(std::size_t n) {
    return {n, std::nullopt};
}
CountWish share(double s) {
    return {std::nullopt, s};
}

std::vector<std::size_t> resolved(const std::vector<CountWish>& parts, std::size_t fleet) {
    const auto counts = resolve_counts(parts, fleet);
    return counts ? *counts : std::vector<std::size_t>{};
}

TEST(Counts, AreWholeAndSumToTheFleet) {
    EXPECT_THAT(resolved({count(3), count(7)}, 10), ElementsAre(3, 7));
    EXPECT_THAT(resolved({kRest, kRest, kRest}, 10), ElementsAre(4, 3, 3));
    EXPECT_THAT(resolved({share(0.5), kRest}, 11), ElementsAre(6, 5));
    EXPECT_THAT(resolved({share(1.0 / 3), share(1.0 / 3), share(1.0 / 3)}, 10), ElementsAre(4, 3, 3));
    EXPECT_THAT(resolved({share(0.47), share(0.53)}, 10), ElementsAre(5, 5));
    EXPECT_THAT(resolved({count(4), share(0.2), kRest, kRest}, 10), ElementsAre(4, 2, 2, 2));
    EXPECT_THAT(resolved({share(0.333), share(0.333), share(0.333)}, 10), ElementsAre(4, 3, 3));
}

TEST(Counts, PartsThatAllSayHowManyMayLeaveDronesOver) {
    EXPECT_THAT(resolved({count(3), count(4)}, 10), ElementsAre(3, 4));
    EXPECT_THAT(resolved({share(0.5), share(0.25)}, 20), ElementsAre(10, 5));
}

TEST(Counts, RefuseWhatDoesNotAddUp) {
    const auto why = [](const std::vector<CountWish>& parts, std::size_t fleet) {
        const auto counts = resolve_counts(parts, fleet);
        return counts ? std::string("accepted") : counts.error().message;
    };
    EXPECT_THAT(why({count(3), count(8)}, 10), HasSubstr("take 11 of 10 drones; must be at most all of them"));
    EXPECT_THAT(why({share(0.8), share(0.45)}, 10), HasSubstr("take 12.5 of 10 drones"));
    EXPECT_THAT(why({count(10), kRest}, 10), HasSubstr("must leave at least one"));
    EXPECT_THAT(why({share(0.01), kRest}, 10), HasSubstr("a part would get no drone"));
}

// Properties 1 to 3 of resolve_counts, for every split of a fleet in hundredths.
TEST(Counts, SharesAreWithinOneOfWhatWasAsked) {
    for (std::size_t fleet = 3; fleet < 200; fleet += 7) {
        for (int a = 1; a < 98; ++a) {
            const double first = a / 100.0;
            const double second = (99 - a) / 150.0;
            const auto counts = resolve_counts(std::vector<CountWish>{share(first), share(second), kRest}, fleet);
            if (!counts) continue;
            ASSERT_EQ(counts->size(), 3U);
            EXPECT_EQ(std::accumulate(counts->begin(), counts->end(), std::size_t{0}), fleet);
            EXPECT_GE(*std::min_element(counts->begin(), counts->end()), 1U);
            EXPECT_LE(std::abs(static_cast<double>((*counts)[0]) - first * static_cast<double>(fleet)), 1.0);
            EXPECT_LE(std::abs(static_cast<double>((*counts)[1]) - second * static_cast<double>(fleet)), 1.0);
        }
    }
    EXPECT_THAT(resolved({share(0.25), share(0.25), kRest}, 200), ElementsAre(50, 50, 100));
}

std::vector<std::size_t> numbers(std::string_view list, std::size_t fleet) {
    const auto drones = parse_drone_list(list, fleet);
    std::vector<std::size_t> out;
    if (drones) {
        for (const DroneId d : *drones) out.push_back(d.number());
    }
    return out;
}

TEST(DroneList, ReadsRangesAndSingles) {
    EXPECT_THAT(numbers("1-3,8", 10), ElementsAre(1, 2, 3, 8));
    EXPECT_THAT(numbers(" 9 , 2 - 4 ", 10), ElementsAre(2, 3, 4, 9));
    EXPECT_THAT(numbers("10", 10), ElementsAre(10));
}

TEST(DroneList, SaysWhatIsWrong) {
    const auto why = [](std::string_view list) {
        const auto drones = parse_drone_list(list, 10);
        return drones ? std::string("accepted") : drones.error().message;
    };
    for (const char* list : {"", "a", "1-", "-3", "5-2", "1,,2", "1-2-3", "1.5", "99999999999"}) {
        EXPECT_THAT(why(list), HasSubstr("must be drone numbers")) << list;
    }
    EXPECT_EQ(why("0-2"), "drone 0 must be from 1 to 10");
    EXPECT_EQ(why("9-11"), "drone 11 must be from 1 to 10");
    EXPECT_EQ(why("1-3,2"), "names drone 2 twice");
    EXPECT_EQ(why("1-10,1-10"), "names a drone twice");
}

TEST(NearestWord, FindsTyposAndLeavesStrangersAlone) {
    const std::vector<std::string_view> known{"name", "hold_s", "center_m", "speed_up_mps", "text", "at_s"};
    EXPECT_EQ(nearest_word("nmae", known), "name");
    EXPECT_EQ(nearest_word("hold", known), "hold_s");
    EXPECT_EQ(nearest_word("centre_m", known), "center_m");
    EXPECT_EQ(nearest_word("speed_up_kmh", known), "speed_up_mps");
    EXPECT_EQ(nearest_word("tex", known), "text");
    EXPECT_EQ(nearest_word("zzzz", known), "");
    EXPECT_EQ(nearest_word("", known), "");
    EXPECT_EQ(nearest_word(std::string(1000, 'a'), known), "");
}

TEST(Problems, AreToldInLineOrderAndStableWithinALine) {
    Problems problems("shows/x.toml");
    problems.add(9, "later");
    problems.add(2, "first");
    problems.add(2, "second");
    EXPECT_EQ(problems.error().message, "shows/x.toml:2: first\nshows/x.toml:2: second\nshows/x.toml:9: later");
    EXPECT_EQ(problems.resolved("a/../b.csv"), "shows/b.csv");
    EXPECT_EQ(problems.resolved("/data/b.csv"), "/data/b.csv");
}

}  // namespace
}  // namespace aerogram::planner::test
