#pragma once
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "geo/random.hpp"
#include "planner/mission/mission_reader.hpp"
#include "planner/plan.hpp"

/// Seeded random small missions, written as TOML so that a failure can be flown again from its text.
namespace aerogram::property {

/// How many random cases a property test tries; AEROGRAM_TEST_N sets it.
inline int cases(int usual) {
    const char* asked = std::getenv("AEROGRAM_TEST_N");
    return asked != nullptr ? std::atoi(asked) : usual;
}

/// One of several words.
template <std::size_t N>
const char* one_of(Random& random, const char* const (&words)[N]) {
    return words[random.below(N)];
}

/// A number of one decimal.
inline double tenth(Random& random, double low, double high) {
    return std::round(10.0 * random.between(low, high)) / 10.0;
}

inline std::string random_limits(Random& random) {
    std::ostringstream out;
    out << "[limits]\npreset = \"" << one_of(random, {"dense", "standard", "standard", "conservative"}) << "\"\n";
    if (random.below(3) == 0) out << "downwash = " << tenth(random, 1.0, 2.0) << '\n';
    if (random.below(3) == 0) out << "min_separation_m = " << tenth(random, 0.8, 2.2) << '\n';
    if (random.below(3) == 0) out << "export_margin_m = " << tenth(random, 0.1, 0.2) << '\n';
    if (random.below(3) == 0) out << "speed_horizontal_mps = " << tenth(random, 1.0, 12.0) << '\n';
    if (random.below(3) == 0) out << "speed_down_mps = " << tenth(random, 0.5, 4.0) << '\n';
    if (random.below(3) == 0) out << "acceleration_mps2 = " << tenth(random, 0.5, 5.0) << '\n';
    if (random.below(4) == 0) out << "jerk_mps3 = " << tenth(random, 2.0, 20.0) << '\n';
    return out.str();
}

inline std::string random_figure(Random& random) {
    std::ostringstream out;
    const bool letters = random.below(2) == 0;
    if (letters) {
        out << "text = \"" << one_of(random, {"T", "H", "E", "N", "D", "A", "8", "AB", "OK"}) << "\"\n";
    } else {
        out << "shape = \"" << one_of(random, {"line", "grid", "circle", "sphere", "helix"}) << "\"\n";
    }
    // Mostly the smallest legal size; else one that may prove too small.
    if (random.below(5) == 0) out << "size_m = { height = " << tenth(random, 12.0, 36.0) << " }\n";
    out << "center_m = [" << tenth(random, -10, 10) << ", " << tenth(random, -10, 10) << ", " << tenth(random, 45, 65)
        << "]\n";
    if (random.below(2) == 0)
        out << "rotate_deg = [" << tenth(random, -90, 90) << ", " << tenth(random, -40, 40) << ", "
            << tenth(random, -180, 180) << "]\n";
    return out.str();
}

inline std::string random_arrival(Random& random, const std::string& method) {
    std::ostringstream out;
    out << "arrive = { method = \"" << method << "\", assign = \"" << one_of(random, {"shortest", "shortest", "keep"})
        << "\", profile = \"" << one_of(random, {"minimum-jerk", "minimum-jerk", "trapezoid", "s-curve"}) << '"';
    if (random.below(8) == 0) out << ", separation = \"none\"";
    if (random.below(8) == 0) out << ", duration_s = " << tenth(random, 20, 90);
    if (method == "spectral") {
        out << ", spectral = { align = \"" << one_of(random, {"kabsch", "pca", "none"}) << "\", reorder = \""
            << one_of(random, {"optimal", "greedy", "none"}) << "\", inflate = " << one_of(random, {"false", "true"})
            << " }";
    }
    if (method == "flow") {
        out << ", flow = { tension = " << tenth(random, 0, 1) << ", of = \""
            << one_of(random, {"positions", "spectral"})
            << "\", corner = " << one_of(random, {"false", "false", "true"}) << " }";
    }
    out << " }\n";
    return out.str();
}

/// A mission of 2 to 25 drones and 1 to 4 keyframes, by any method; most can be flown.
inline std::string random_mission(std::uint64_t seed) {
    Random random(seed);
    std::ostringstream out;
    const std::size_t drones = 2 + random.below(24);
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(drones))));
    out << "[show]\nname = \"random\"\nseed = " << 1 + seed % 1000
        << "\norigin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = 420, heading_deg = "
        << tenth(random, 0, 359) << " }\ngeoid_undulation_m = 48.9\n";
    out << "[fleet]\ndrones = " << drones << "\npads = { rows = " << columns << ", columns = " << columns
        << ", spacing_m = " << tenth(random, 2.5, 4.0) << ", center_m = [0, -20] }\n";
    out << random_limits(random);
    const std::size_t keyframes = 1 + random.below(4);
    std::string method = one_of(random, {"straight", "spectral", "flow"});
    for (std::size_t k = 0; k < keyframes; ++k) {
        const std::string next = one_of(random, {"straight", "spectral", "flow"});
        const bool last = k + 1 == keyframes;
        out << "[[keyframe]]\nname = \"k" << k + 1 << "\"\n" << random_figure(random);
        const bool passed = !last && next == "flow" && random.below(2) == 0;
        out << "hold_s = " << (passed ? 0.0 : tenth(random, 0.5, 4.0)) << "\ncolor = \""
            << one_of(random, {"#ff0000", "#00c4ff", "#fff", "#123456"}) << "\"\n";
        if (!last && !passed && random.below(8) == 0)
            out << "at_s = " << tenth(random, 30, 90) + 60.0 * double(k) << '\n';
        out << random_arrival(random, method);
        method = next;
    }
    return out.str();
}

inline Result<planner::FlightPlan> plan_text(const std::string& text, unsigned threads = 1, bool best_effort = false) {
    auto mission = planner::parse_mission(text, "random.toml");
    if (!mission) return mission.error();
    return planner::plan(*mission, {best_effort}, Run{{}, {}, threads});
}

/// Calls check(plan, text) for each of `count` random missions that can be flown (of those tried, at least half).
template <class Check>
void for_each_flown_plan(std::uint64_t first_seed, int count, const Check& check) {
    int flown = 0;
    for (int tried = 0; tried < 2 * count && flown < count; ++tried) {
        const std::string text = random_mission(first_seed + static_cast<std::uint64_t>(tried));
        const auto plan = plan_text(text);
        if (!plan) continue;
        ++flown;
        SCOPED_TRACE("seed " + std::to_string(first_seed + static_cast<std::uint64_t>(tried)) + "\n" + text);
        check(*plan, text);
        if (::testing::Test::HasFatalFailure()) return;
    }
    EXPECT_EQ(flown, count) << "less than half of the random missions can be flown";
}

}  // namespace aerogram::property
