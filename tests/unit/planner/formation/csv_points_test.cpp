#include "planner/formation/csv_points.hpp"

#include <gtest/gtest.h>

namespace aerogram::planner {
namespace {

std::string message(std::string_view text) {
    const auto read = parse_csv_points(text, "wing.csv");
    return read.ok() ? "read" : read.error().message;
}

TEST(CsvPoints, ReadsASkybrushFormation) {
    const auto read =
        parse_csv_points("Name,x_m,y_m,z_m,Red,Green,Blue\nA,1,-2.5,3e1,255,0,51\nB,4,5,6,0,0,0\n", "wing.csv");
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_EQ(read->points_m.size(), 2U);
    EXPECT_EQ(read->points_m[0], Vec3(1, -2.5, 30));
    EXPECT_EQ(read->colors[0], (Rgb{1.0, 0.0, 0.2}));  // linear lamp values
}

TEST(CsvPoints, NameUnitsAndColoursMayBeMissingAndColumnsMayBeInAnyOrder) {
    const auto read = parse_csv_points("\xEF\xBB\xBFz,x,y\r\n3,1,2\r\n\r\n6,4,5", "wing.csv");
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->points_m, (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_TRUE(read->colors.empty());
}

TEST(CsvPoints, QuotedFieldsMayHoldCommas) {
    const auto read = parse_csv_points("Name,x,y,z\n\"left, \"\"first\"\"\", 1 , 2 ,3\n", "wing.csv");
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->points_m[0], Vec3(1, 2, 3));
}

TEST(CsvPoints, EveryWrongLineIsNamed) {
    EXPECT_EQ(message("x,y,z\n1,2,3\n1,two,3\n1,2\n1,2,inf\n"),
              "wing.csv:3: y_m = \"two\": must be a number of metres\n"
              "wing.csv:4: 2 fields, expected 3\n"
              "wing.csv:5: z_m = \"inf\": must be a number of metres");
}

TEST(CsvPoints, LampValuesAreWholeNumbersTo255) {
    EXPECT_EQ(message("x,y,z,Red,Green,Blue\n1,2,3,256,0,0\n1,2,3,0,0.5,0\n1,2,3,0,0,-1\n"),
              "wing.csv:2: Red = \"256\": must be a whole number from 0 to 255\n"
              "wing.csv:3: Green = \"0.5\": must be a whole number from 0 to 255\n"
              "wing.csv:4: Blue = \"-1\": must be a whole number from 0 to 255");
}

TEST(CsvPoints, HeadersAreChecked) {
    const std::string accepted = "expected the columns [Name,]x_m,y_m,z_m[,Red,Green,Blue]";
    EXPECT_EQ(message(""), "wing.csv: the file is empty; " + accepted);
    EXPECT_EQ(message("x,y\n1,2\n"), "wing.csv:1: columns missing; " + accepted);
    EXPECT_EQ(message("x,y,z,Red\n"), "wing.csv:1: columns missing; " + accepted);
    EXPECT_EQ(message("x,y,z,heading\n"), "wing.csv:1: unknown column \"heading\"; " + accepted);
    EXPECT_EQ(message("x,y,z,x_m\n"), "wing.csv:1: column \"x_m\" twice");
    EXPECT_EQ(message("1,2,3\n"), "wing.csv:1: unknown column \"1\"; " + accepted);
    EXPECT_EQ(message("x,y,z\n"), "wing.csv:1: no points after the header");
}

}  // namespace
}  // namespace aerogram::planner
