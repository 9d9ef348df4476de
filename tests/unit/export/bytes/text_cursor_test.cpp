#include "export/bytes/text_cursor.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "export/bytes/decimal.hpp"
#include "export/skybrush/skyc_trajectory.hpp"

namespace aerogram::exporter {
namespace {

TEST(TextCursor, NumbersAreThoseOfStrtod) {
    std::uint64_t state = 11;
    for (int round = 0; round < 20'000; ++round) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        const auto units = static_cast<std::int64_t>(state >> 16U) % 1'000'000'000'000 - 500'000'000'000;
        std::string text;
        append_units(text, units, static_cast<int>(state >> 60U) % 10);
        TextCursor cursor(text);
        const double value = cursor.number();
        ASSERT_TRUE(cursor.ok() && cursor.at_end()) << text;
        ASSERT_EQ(value, std::strtod(text.c_str(), nullptr)) << text;
    }
}

TEST(TextCursor, GivesUpWhereTheCarefulReaderMustLook) {
    for (const std::string text :
         {"", "-", "+1", " 1", "01", "-01.5", "1.", ".5", "nan", "1234567890123456", "0.1234567890123456"}) {
        TextCursor cursor(text);
        static_cast<void>(cursor.number());
        EXPECT_FALSE(cursor.ok() && cursor.at_end()) << text;
    }
    TextCursor exponent("1e5");
    EXPECT_EQ(exponent.number(), 1.0);
    EXPECT_FALSE(exponent.at_end());
    TextCursor far("1000000.001");
    static_cast<void>(far.number(1e6));
    EXPECT_FALSE(far.ok());
    TextCursor wide("256");
    EXPECT_EQ(wide.whole(255), 0);
    EXPECT_FALSE(wide.ok());
}

TEST(PlainTrajectory, OtherTextLeavesTheDroneAsItWas) {
    const std::string good =
        R"({"version":1,"points":[[0,[1.000,2.000,0.000],[]],[2.5,[1.000,2.000,0.000],[]],[4,[1,2,9],[[1,2,3],[1,2,6]]]],)"
        R"("takeoffTime":0,"landingTime":4})"
        "\n";
    RecordedDrone drone;
    ASSERT_TRUE(read_plain_trajectory(good, drone));
    ASSERT_EQ(drone.pieces.size(), 2U);
    EXPECT_EQ(drone.pieces[0].degree, 0);
    EXPECT_EQ(drone.pieces[1].degree, 3);
    EXPECT_EQ(drone.controls_m.size(), 4U);
    for (std::size_t size = 0; size < good.size(); ++size) {
        RecordedDrone untouched;
        EXPECT_FALSE(read_plain_trajectory(good.substr(0, size), untouched)) << size;
        EXPECT_TRUE(untouched.pieces.empty() && untouched.controls_m.empty()) << size;
    }
}

}  // namespace
}  // namespace aerogram::exporter
