#include "export/skybrush/light_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

std::string error_of(const Bytes& program) {
    const auto keys = decoded_light_program(program);
    return keys ? "none" : keys.error().message;
}

double apart(const Rgb& a, const Rgb& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

TEST(LightProgram, WritesSetsAndFadesInTicksOf20MsAndEndsBlack) {
    const std::vector<LightKey> keys{
        {1'000, {1.0, 1.0, 1.0}, false}, {2'000, {1.0, 0.0, 0.0}, true}, {3'000, {0.0, 0.0, 1.0}, false}};
    const Bytes expected{0x06, 50,                          // dark for 1 s
                         0x07, 50,                          // white for 1 s
                         0x04, 255,  0,   0,   0,           // red at once,
                         0x08, 0,    0,   255, 50,          // then blue within 1 s
                         0x04, 0,    0,   255, 0xAC, 0x02,  // blue for 6 s: 300 ticks
                         0x06, 0x01, 0x00};
    EXPECT_EQ(light_program(keys, 9'000), expected);
}

TEST(LightProgram, WithoutKeysIsDark) {
    EXPECT_EQ(light_program({}, 60'000), (Bytes{0x06, 0x01, 0x00}));
}

/// One reader extrapolates an unfinished fade without limit.
TEST(LightProgram, NeverEndsOnAFade) {
    const std::vector<LightKey> keys{{0, {1, 0, 0}, true}, {10'000, {0, 1, 0}, true}};
    for (const Millis duration_ms : {0, 5'000, 10'000, 20'000}) {
        const Bytes program = light_program(keys, duration_ms);
        ASSERT_GE(program.size(), 3u);
        EXPECT_EQ(Bytes(program.end() - 3, program.end()), (Bytes{0x06, 0x01, 0x00}));
    }
}

std::uint64_t next(std::uint64_t& state) {
    state += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

std::vector<LightKey> random_keys(std::uint64_t& state) {
    std::vector<LightKey> keys;
    Millis time_ms = 20 * static_cast<Millis>(next(state) % 3);
    const auto share = [&] { return static_cast<double>(next(state) % 1001) / 1000.0; };
    for (std::uint64_t n = next(state) % 12; n > 0; --n) {
        const Rgb color = next(state) % 4 == 0 ? Rgb{} : Rgb{share(), share(), share()};
        keys.push_back({time_ms, color, next(state) % 2 == 0});
        time_ms += 20 * static_cast<Millis>(next(state) % 5 == 0 ? 0 : next(state) % 400);
    }
    return keys;
}

/// Property 1. Within 1/255: half a step at each end of a fade.
TEST(LightProgram, Property1DecodesToTheSameLight) {
    std::uint64_t state = 20'240'701;
    RecordProperty("seed", std::to_string(state));
    for (int round = 0; round < 500; ++round) {
        const std::vector<LightKey> keys = random_keys(state);
        const Millis duration_ms = (keys.empty() ? 0 : keys.back().time_ms) + 400;
        const auto decoded = decoded_light_program(light_program(keys, duration_ms));
        ASSERT_TRUE(decoded.ok()) << decoded.error().message;
        for (Millis t = 0; t < duration_ms; t += 4) {
            const double t_s = static_cast<double>(t) / 1000.0;
            ASSERT_LE(apart(light_at(keys, t_s), light_at(*decoded, t_s)), 1.0 / 255.0)
                << "round " << round << " at " << t << " ms";
        }
        EXPECT_EQ(decoded->back().color, Rgb{});
    }
}

TEST(LightProgram, ReadsGrayAndSleepAndNestedLoops) {
    const auto keys = decoded_light_program(Bytes{0x0C, 2, 0x0C, 3, 0x05, 51, 5, 0x06, 5, 0x0D, 0x02, 10, 0x0D, 0x00});
    ASSERT_TRUE(keys.ok());
    EXPECT_EQ(keys->size(), 12u);
    EXPECT_EQ(keys->at(0), (LightKey{0, {0.2, 0.2, 0.2}, false}));
    EXPECT_EQ(keys->at(2).time_ms, 200);
    EXPECT_EQ(keys->at(6).time_ms, 3 * 200 + 200);
}

TEST(LightProgram, FadesOfEveryKindAreRead) {
    const auto keys = decoded_light_program(Bytes{0x0B, 10, 0x09, 51, 10, 0x0A, 10, 0x00});
    ASSERT_TRUE(keys.ok());
    EXPECT_EQ(light_at(*keys, 0.1), (Rgb{0.5, 0.5, 0.5}));
    EXPECT_NEAR(light_at(*keys, 0.4).g, 0.2, 1e-12);
    EXPECT_EQ(light_at(*keys, 0.7), Rgb{});
}

TEST(LightProgram, AnEndlessLoopStopsAtTheShowsEnd) {
    LightProgramLimits limits;
    limits.until_ms = 1'000;
    const auto keys = decoded_light_program(Bytes{0x0C, 0, 0x07, 5, 0x06, 5, 0x0D, 0x00}, limits);
    ASSERT_TRUE(keys.ok());
    EXPECT_EQ(keys->size(), 11u);
}

TEST(LightProgram, RefusesBrokenProgramsByByte) {
    EXPECT_THAT(error_of({}), HasSubstr("byte 0: the program is cut off"));
    EXPECT_THAT(error_of({0x07, 1}), HasSubstr("byte 2: the program is cut off"));
    EXPECT_THAT(error_of({0x04, 1, 2}), HasSubstr("byte 0: the program is cut off"));
    EXPECT_THAT(error_of({0x06, 0x80, 0x80}), HasSubstr("cut off"));
    EXPECT_THAT(error_of({0x06, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 1}), HasSubstr("longer than 32 bits"));
    EXPECT_THAT(error_of({0x06, 1, 0x13, 0}), HasSubstr("byte 2: instruction 19 is not known"));
    EXPECT_THAT(error_of({0x0D, 0}), HasSubstr("a loop ends that never began"));
    EXPECT_THAT(error_of({0x0C, 1, 0x0C, 1, 0x0C, 1, 0x0C, 1, 0x0C, 1, 0}), HasSubstr("loops deeper than 4"));
    EXPECT_THAT(error_of({0x0C, 0, 0x07, 0, 0x0D, 0}), HasSubstr("too many instructions"));
}

TEST(LightProgram, LoopsCannotMakeEndlessOutput) {
    const auto keys =
        decoded_light_program(Bytes{0x0C, 255, 0x0C, 255, 0x0C, 255, 0x07, 1, 0x06, 1, 0x0D, 0x0D, 0x0D, 0x00});
    EXPECT_FALSE(keys.ok());
}

}  // namespace
}  // namespace aerogram::exporter
