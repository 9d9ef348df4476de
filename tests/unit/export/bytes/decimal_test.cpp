#include "export/bytes/decimal.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/contract.hpp"

namespace aerogram::exporter {
namespace {

std::string fixed_text(double value, int digits) {
    std::string text;
    append_fixed(text, value, digits);
    return text;
}

TEST(Decimal, WritesExactlyTheDigitsAskedFor) {
    EXPECT_EQ(fixed_text(1.0, 3), "1.000");
    EXPECT_EQ(fixed_text(-0.025, 3), "-0.025");
    EXPECT_EQ(fixed_text(12345.6789, 2), "12345.68");
    EXPECT_EQ(fixed_text(7.5, 0), "8");
    EXPECT_EQ(fixed_text(-139.74540001, 8), "-139.74540001");
}

TEST(Decimal, NeverWritesMinusZero) {
    EXPECT_EQ(fixed_text(-0.0, 3), "0.000");
    EXPECT_EQ(fixed_text(-0.0004, 3), "0.000");
}

TEST(Decimal, WrittenNumbersAreWithinHalfADigit) {
    for (int i = -5000; i < 5000; ++i) {
        const double value = 0.000'137 * i * (1 + i % 7);
        const auto back = parse_number(fixed_text(value, 3), 1e6);
        ASSERT_TRUE(back);
        EXPECT_NEAR(*back, value, 0.0005 + 1e-12);
    }
}

TEST(Decimal, RefusesWhatIsNotANumber) {
    EXPECT_THROW(fixed_text(std::nan(""), 3), ContractViolation);
    for (const char* text : {"", " ", "abc", "1,5", "1.5x", "nan", "inf", "1e400", "0x10", "--1", "1 2"})
        EXPECT_FALSE(parse_number(text, 1e9)) << text;
    EXPECT_FALSE(parse_number("1001", 1000.0));
    EXPECT_EQ(parse_number(" -1.5\t", 10.0), -1.5);
    for (const char* text : {"", "1.0", "-1", "256", "99999999999999999999"})
        EXPECT_FALSE(parse_whole(text, 0, 255)) << text;
    EXPECT_EQ(parse_whole("255", 0, 255), 255);
}

TEST(Decimal, FieldsKeepEmptyOnes) {
    Fields fields("a,,b,", ',');
    EXPECT_EQ(fields.next(), "a");
    EXPECT_EQ(fields.next(), "");
    EXPECT_EQ(fields.next(), "b");
    EXPECT_EQ(fields.next(), "");
    EXPECT_FALSE(fields.next());
}

TEST(Decimal, ShownTextIsPrintableAndShort) {
    EXPECT_EQ(shown("a\x01\xFF z"), "\"a?? z\"");
    EXPECT_EQ(shown(std::string(100, 'x')).size(), 45u);
}

}  // namespace
}  // namespace aerogram::exporter
