#include "planner/text/directions.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

namespace aerogram::planner {
namespace {

/// The characters of a line as they are seen, capitals standing for Hebrew letters. Expected texts are worked out by
/// hand after Unicode's annex 9.
std::string seen(const std::string& line) {
    constexpr char32_t kAlef = 0x05D0;
    std::u32string text;
    for (const char c : line) {
        const auto code = static_cast<unsigned char>(c);
        text.push_back(c >= 'A' && c <= 'Z' ? static_cast<char32_t>(kAlef + code - 'A') : code);
    }
    std::string out;
    for (const DirectedRun& run : runs_as_seen(text)) {
        const std::string part = line.substr(run.begin, run.end - run.begin);
        out += run.right_to_left ? std::string(part.rbegin(), part.rend()) : part;
    }
    return out;
}

TEST(Directions, WordsNumbersAndBracketsKeepTheirOwn) {
    EXPECT_EQ(seen("abc"), "abc");
    EXPECT_EQ(seen("ABC"), "CBA");
    EXPECT_EQ(seen("car is THE CAR in arabic"), "car is RAC EHT in arabic");
    EXPECT_EQ(seen("CAR means car"), "means car RAC");
    EXPECT_EQ(seen("HE SAID car 24 AND LEFT"), "TFEL DNA car 24 DIAS EH");
    EXPECT_EQ(seen("A 12,5 B"), "B 12,5 A");
    EXPECT_EQ(seen("A (b) C"), "C )b( A");  // the glyphs of brackets are mirrored when they are shaped
    EXPECT_EQ(seen(""), "");
    EXPECT_EQ(seen("12"), "12");
}

TEST(Directions, EachCharacterIsInExactlyOneRun) {
    std::u32string text;
    std::uint32_t state = 7;  // a fixed sequence of letters, digits, spaces, brackets and control characters
    constexpr char32_t kAlphabet[] = {U'a',      U'\u05D0', U'\u0633', U'1',      U'\u0661', U' ',
                                      U'(',      U')',      U',',      U'-',      U'\u202E', U'\u202C',
                                      U'\u2067', U'\u2069', U'\u0301', U'\u200F', U'\t'};
    for (int round = 0; round < 300; ++round) {
        text.clear();
        for (int i = 0; i < round % 40; ++i) {
            state = state * 1664525U + 1013904223U;
            text.push_back(kAlphabet[(state >> 16U) % std::size(kAlphabet)]);
        }
        std::vector<int> times(text.size(), 0);
        for (const DirectedRun& run : runs_as_seen(text)) {
            ASSERT_LT(run.begin, run.end);
            ASSERT_LE(run.end, text.size());
            for (std::size_t i = run.begin; i < run.end; ++i) ++times[i];
        }
        EXPECT_EQ(times, std::vector<int>(text.size(), 1)) << round;
    }
}

}  // namespace
}  // namespace aerogram::planner
