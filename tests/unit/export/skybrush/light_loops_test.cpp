#include "export/skybrush/light_loops.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "export/skybrush/light_program.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Steps = std::vector<std::string>;

/// Steps of these tests are "aX": one byte that is no loop's, then any other.
Steps steps_of(const std::string& letters) {
    Steps steps;
    for (const char c : letters) steps.push_back({'\x06', c});
    return steps;
}
std::string joined(const Steps& steps) {
    std::string text;
    for (const std::string& step : steps) text += step;
    return text;
}

/// Plays a program of such steps, round by round; notes how deep it goes.
struct Player {
    const Bytes& program;
    std::size_t deepest = 0;

    std::string play() { return play(0, program.size(), 1); }
    std::string play(std::size_t from, std::size_t to, std::size_t depth) {
        std::string out;
        for (std::size_t at = from; at < to;) {
            if (program[at] != 0x0C) {
                out += {static_cast<char>(program[at]), static_cast<char>(program[at + 1])};
                at += 2;
                continue;
            }
            deepest = std::max(deepest, depth);
            const std::size_t rounds = program[at + 1], end = closing(at + 2);
            EXPECT_GE(rounds, 2U);
            for (std::size_t k = 0; k < rounds; ++k) out += play(at + 2, end, depth + 1);
            at = end + 1;
        }
        return out;
    }
    std::size_t closing(std::size_t at) const {
        for (std::size_t open = 1;; at += program[at] == 0x0D ? 1U : 2U) {
            if (program[at] == 0x0C) ++open;
            if (program[at] == 0x0D && --open == 0) return at;
        }
    }
};

TEST(LightLoops, WritesRepeatsAsLoopsWhereThatIsShorter) {
    EXPECT_EQ(looped(steps_of("abc")), (Bytes{6, 'a', 6, 'b', 6, 'c'}));
    EXPECT_EQ(looped(steps_of("aa")), (Bytes{6, 'a', 6, 'a'}));  // a loop would take one byte more
    EXPECT_EQ(looped(steps_of("aaa")), (Bytes{0x0C, 3, 6, 'a', 0x0D}));
    EXPECT_EQ(looped(steps_of("xabababy")), (Bytes{6, 'x', 0x0C, 3, 6, 'a', 6, 'b', 0x0D, 6, 'y'}));
    EXPECT_EQ(looped({}), Bytes{});
}

TEST(LightLoops, NestsLoops) {
    std::string letters;
    for (int k = 0; k < 5; ++k) letters += "abababababcc";
    EXPECT_EQ(looped(steps_of(letters)), (Bytes{0x0C, 5, 0x0C, 5, 6, 'a', 6, 'b', 0x0D, 6, 'c', 6, 'c', 0x0D}));
}

TEST(LightLoops, CountsToAtMost255) {
    const Bytes program = looped(steps_of(std::string(1000, 'a')));
    EXPECT_LE(program.size(), 13U);
    EXPECT_EQ((Player{program}).play(), joined(steps_of(std::string(1000, 'a'))));
}

std::uint64_t next(std::uint64_t& state) {
    state += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}
std::size_t test_count(std::size_t usual) {
    const char* n = std::getenv("AEROGRAM_TEST_N");
    return n == nullptr ? usual : std::strtoul(n, nullptr, 10);
}

/// Letters with repeats of repeats in them.
std::string random_letters(std::uint64_t& state, int depth) {
    std::string text;
    for (std::uint64_t n = next(state) % 6; n > 0; --n) {
        if (depth > 0 && next(state) % 2 == 0) {
            const std::string part = random_letters(state, depth - 1);
            for (std::uint64_t k = next(state) % 9; k > 0; --k) text += part;
        } else {
            text += static_cast<char>('a' + next(state) % 4);
        }
    }
    return text;
}

TEST(LightLoops, Property1To3_PlaysTheSameIsNeverLongerAndAtMostFourDeep) {
    std::uint64_t state = 20'261'122;
    RecordProperty("seed", std::to_string(state));
    std::size_t deepest = 0;
    for (std::size_t round = 0; round < test_count(2'000); ++round) {
        const Steps steps = steps_of(random_letters(state, 6).substr(0, 4'000));
        const Bytes program = looped(steps);
        Player player{program};
        ASSERT_EQ(player.play(), joined(steps)) << "round " << round;
        ASSERT_LE(program.size(), 2 * steps.size());
        deepest = std::max(deepest, player.deepest);
    }
    EXPECT_EQ(deepest, kLightLoopDepth);
}

/// One level against every way to choose loops in short texts.
std::size_t fewest_bytes(const std::string& text, std::size_t from, std::size_t depth) {
    if (from == text.size()) return 0;
    std::size_t best = 2 + fewest_bytes(text, from + 1, depth);
    for (std::size_t body = 1; body <= (text.size() - from) / 2; ++body)
        for (std::size_t rounds = 2; from + body * rounds <= text.size(); ++rounds) {
            if (text.compare(from + body * (rounds - 1), body, text, from, body) != 0) break;
            best = std::min(best, 3 + 2 * body + fewest_bytes(text, from + body * rounds, depth));
        }
    return best;
}

TEST(LightLoops, IsAsShortAsAnyChoiceOfLoopsOfOneLevel) {
    std::uint64_t state = 5;
    std::size_t longer = 0;
    for (int round = 0; round < 300; ++round) {
        std::string text;
        for (std::size_t n = 3 + next(state) % 10; n > 0; --n) text += static_cast<char>('a' + next(state) % 2);
        const std::size_t best = fewest_bytes(text, 0, 0), ours = looped(steps_of(text)).size();
        longer += ours > best ? 1U : 0U;
        EXPECT_LE(ours, best + 1) << text;
    }
    EXPECT_LE(longer, 3U);  // only where a loop should have taken fewer rounds than it could
}

/// A lamp that pulses: hundreds of keys, tens of bytes.
TEST(LightLoops, PulsesBlinksAndRainbowsBecomeShort) {
    std::vector<LightKey> pulse, blink, rainbow;
    const std::array<Rgb, 6> hues{Rgb{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}};
    for (int k = 0; k < 400; ++k) {
        const bool odd = k % 2 != 0;
        pulse.push_back({k * 500, odd ? Rgb{1, 0.2, 0} : Rgb{0.1, 0.02, 0}, true});
        blink.push_back({k * 120, odd ? Rgb{1, 1, 1} : Rgb{}, false});
        rainbow.push_back({k * 200, hues[static_cast<std::size_t>(k % 6)], true});
    }
    EXPECT_LE(light_program(pulse, 200'000).size(), 40U);
    EXPECT_LE(light_program(blink, 48'000).size(), 20U);
    EXPECT_LE(light_program(rainbow, 80'000).size(), 70U);
}

/// Worst case: nothing repeats. Property 4 of light_program.
TEST(LightLoops, ProgramsOfNoiseAreNoLongerThanTheirSteps) {
    std::uint64_t state = 77;
    std::vector<LightKey> keys;
    const auto share = [&] { return static_cast<double>(next(state) % 256) / 255.0; };
    for (int k = 0; k < 20'000; ++k) keys.push_back({k * 20, {share(), share(), share()}, next(state) % 2 == 0});
    const Bytes program = light_program(keys, 400'000);
    EXPECT_LE(program.size(), 14 * keys.size() + 9);
    const auto decoded = decoded_light_program(program);
    ASSERT_TRUE(decoded.ok());
    for (int k = 0; k < 20'000; k += 7)
        EXPECT_EQ(quantised(light_at(*decoded, seconds_from_ms(k * 20))), quantised(keys[std::size_t(k)].color));
}

}  // namespace
}  // namespace aerogram::exporter
