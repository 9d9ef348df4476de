#include "export/bytes/json_cursor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

namespace aerogram::exporter {
namespace {

using ::testing::ElementsAre;

double number_of(const std::string& text) {
    JsonCursor cursor(text);
    const double value = cursor.number(-1e300, 1e300);
    cursor.finish();
    EXPECT_TRUE(cursor.ok()) << cursor.problem();
    return value;
}
bool is_json(const std::string& text) {
    JsonCursor cursor(text);
    cursor.skipped();
    cursor.finish();
    return cursor.ok();
}
std::string text_of(const std::string& text, std::size_t longest = 100) {
    JsonCursor cursor(text);
    const std::string value = cursor.text(longest);
    return cursor.ok() ? value : cursor.problem();
}

TEST(JsonCursor, NumbersAreWhatStrtodReads) {
    for (const char* text : {"0", "-0", "12", "-3.25", "0.1", "1e3", "1E-3", "2.5e+10", "123456789012345", "1e-320",
                             "1234567890123456789", "0.30000000000000004", "179769313486231570000000000000e200"})
        EXPECT_EQ(number_of(text), std::strtod(text, nullptr)) << text;
    std::mt19937_64 random(1);
    for (int k = 0; k < 20'000; ++k) {
        std::string text = random() % 2 == 0 ? "-" : "";
        text += std::to_string(random() >> random() % 64);
        if (random() % 2 == 0) text += "." + std::to_string(random() >> random() % 64);
        if (random() % 4 == 0) text += "e" + std::to_string(static_cast<int>(random() % 60) - 30);
        ASSERT_EQ(number_of(text), std::strtod(text.c_str(), nullptr)) << text;
    }
}

TEST(JsonCursor, RefusesWhatIsNoNumber) {
    for (const char* text : {"", "-", "01", "1.", ".5", "+1", "1e", "1e+", "NaN", "Infinity", "0x1", "\"1\"", "- 1"}) {
        JsonCursor cursor(text);
        static_cast<void>(cursor.number(-1e9, 1e9));
        cursor.finish();
        EXPECT_FALSE(cursor.ok()) << text;
    }
    for (const char* text : {"1e999", "-1e999", "10.5", "-11"}) {
        JsonCursor cursor(text);
        EXPECT_EQ(cursor.number(-10.0, 10.0), 0.0);
        EXPECT_EQ(cursor.problem(), "byte 1: must be a number from -10 to 10") << text;
    }
    JsonCursor half("1.5");
    EXPECT_EQ(half.whole(-4, 4), -4);
    EXPECT_EQ(half.problem(), "byte 1: must be a whole number from -4 to 4");
}

TEST(JsonCursor, TextsAreUnescaped) {
    EXPECT_EQ(text_of(R"("a\"\\\/b")"), "a\"\\/b");
    EXPECT_EQ(text_of(R"("\u00e9\u20AC\uD83D\uDE00")"), "\u00e9\u20ac\U0001F600");
    EXPECT_EQ(text_of("\"\u00e9\""), "\u00e9");
    EXPECT_EQ(text_of(R"("\ud800")"), "byte 1: must be UTF-8 without control characters");
    EXPECT_EQ(text_of(R"("\n")"), "byte 1: must be UTF-8 without control characters");
    EXPECT_EQ(text_of("\"\xff\""), "byte 1: must be UTF-8 without control characters");
    EXPECT_EQ(text_of("\"a\nb\""), "byte 1: a text holds a control character");
    EXPECT_EQ(text_of(R"("\x")"), "byte 1: a text holds an escape that JSON does not know");
    EXPECT_EQ(text_of(R"("\u12g4")"), "byte 1: a text holds an escape that JSON does not know");
    EXPECT_EQ(text_of(R"("\u1)"), "byte 1: a text does not end");
    EXPECT_EQ(text_of("\"abc\\"), "byte 1: a text does not end");
    EXPECT_EQ(text_of("\"abcdef\"", 5), "byte 1: is too long");
    EXPECT_EQ(text_of("\"" + std::string(1'000'000, 'x') + "\"", 5), "byte 1: is too long");
    EXPECT_EQ(text_of("7"), "byte 1: must be a text");
}

TEST(JsonCursor, WalksThroughObjectsAndLists) {
    JsonCursor cursor(R"( { "a" : [ 1 , 2,3 ] , "\u0062" : { } , "c" : "x" , "d" : [ ] , "e" : null } )");
    std::vector<std::string> seen;
    cursor.object([&](std::string_view key) {
        seen.emplace_back(key);
        if (key == "a") return cursor.array([&] { seen.push_back(std::to_string(cursor.whole(0, 9))); });
        if (key == "b") return cursor.object([&](std::string_view) { seen.emplace_back("never"); });
        if (key == "c") return static_cast<void>(seen.emplace_back(cursor.text(9)));
        EXPECT_EQ(cursor.skipped(), key == "d" ? "[ ]" : "null");
    });
    cursor.finish();
    EXPECT_TRUE(cursor.ok()) << cursor.problem();
    EXPECT_THAT(seen, ElementsAre("a", "1", "2", "3", "b", "c", "x", "d", "e"));
}

TEST(JsonCursor, KeepsTheFirstProblemAndItsByte) {
    JsonCursor cursor(R"({"a":1,"b":"x","c":2})");
    int members = 0;
    cursor.object([&](std::string_view) {
        ++members;
        static_cast<void>(cursor.number(0, 9));
    });
    cursor.fail("later");
    cursor.finish();
    EXPECT_EQ(members, 2);
    EXPECT_EQ(cursor.problem(), "byte 12: must be a number from 0 to 9");
    EXPECT_EQ(cursor.number(0, 9), 0.0);
    EXPECT_EQ(cursor.text(9), "");
    EXPECT_EQ(cursor.skipped(), "");
}

TEST(JsonCursor, PassesOverJsonAndNothingElse) {
    for (const char* text : {"{}", "[]", "[[],{}]", "{\"a\":{\"b\":[1,2,{\"c\":null}]}}", "true", "\"\\u0000\"", " 1 "})
        EXPECT_TRUE(is_json(text)) << text;
    for (const char* text : {"", "{", "[", "[1,]", "{,}", "{\"a\"}", "{\"a\":}", "{\"a\":1,}", "[1 2]", "[1}",
                             "{\"a\":1]", "tru", "nul", "[1],", "{1:2}", "'a'", "[\"a]", "//x\n1"})
        EXPECT_FALSE(is_json(text)) << text;
    EXPECT_TRUE(is_json(std::string(60, '[') + std::string(60, ']')));
    EXPECT_FALSE(is_json(std::string(70, '[') + std::string(70, ']')));
    EXPECT_FALSE(is_json(std::string(5'000'000, '[')));
    EXPECT_FALSE(is_json(std::string(5'000'000, '{')));
}

TEST(JsonCursor, BeginsWhereItIsTold) {
    const std::string text = R"({"a":[1],"b":2})";
    JsonCursor cursor(std::string_view(text).substr(0, 8), 5);
    cursor.array([&] { EXPECT_EQ(cursor.whole(0, 9), 1); });
    EXPECT_TRUE(cursor.ok());
    EXPECT_EQ(cursor.byte(), 8u);
}

}  // namespace
}  // namespace aerogram::exporter
