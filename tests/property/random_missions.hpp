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

/// Two groups, "left" and "right", each half of the fleet; right is clustered into two more.
inline std::string random_groups(std::size_t drones) {
    std::ostringstream out;
    out << "[[group]]\nname = \"left\"\ndrones = \"1-" << drones / 2 << "\"\n[[group]]\nname = \"right\"\ndrones = \""
        << drones / 2 + 1 << '-' << drones << "\"\ncluster = { count = 2, method = \"spectral\" }\n";
    return out.str();
}

/// How groups move as bodies.
inline std::string random_bodies(Random& random) {
    std::ostringstream out;
    const auto body = [&] {
        out << "{ method = \"" << one_of(random, {"straight", "spectral", "rigid"})
            << "\", blend = " << tenth(random, 0, 1);
    };
    out << ", groups = { left = ";
    body();
    out << " }, right = ";
    body();
    if (random.below(2) == 0) out << ", levels = [{ method = \"rigid\" }]";
    out << " } }";
    return out.str();
}

/// Who flies where, and when.
inline std::string random_wishes(Random& random, std::size_t drones) {
    std::ostringstream out;
    if (random.below(8) == 0) out << ", separation = \"" << one_of(random, {"none", "social_force"}) << '"';
    if (random.below(8) == 0) out << ", duration_s = " << tenth(random, 20, 90);
    if (random.below(10) == 0) out << ", pins = { 1 = " << 1 + random.below(drones) << " }";
    if (random.below(10) == 0) out << ", forbid = [[2, " << 1 + random.below(drones) << "]]";
    if (random.below(10) == 0) out << ", min_separation_m = 2.2";
    return out.str();
}

/// @param grouped  whether the mission has random_groups.
inline std::string random_arrival(Random& random, const std::string& method, std::size_t drones, bool grouped) {
    std::ostringstream out;
    out << "arrive = { method = \"" << method << "\", assign = \""
        << one_of(random, {"shortest", "shortest", "bottleneck", "keep"}) << "\", profile = \""
        << one_of(random, {"minimum-jerk", "minimum-jerk", "trapezoid", "s-curve"}) << '"'
        << random_wishes(random, drones);
    if (grouped && method != "flow") {
        out << random_bodies(random);
    } else if (method == "straight" && random.below(3) == 0) {
        out << ", stagger_s = " << tenth(random, 0.5, 5.0);
    }
    if (method == "spectral") {
        out << ", spectral = { align = \"" << one_of(random, {"kabsch", "pca", "none"}) << "\", reorder = \""
            << one_of(random, {"optimal", "greedy", "max-min", "none"})
            << "\", inflate = " << one_of(random, {"false", "true"}) << " }";
    }
    if (method == "flow") {
        out << ", flow = { tension = " << tenth(random, 0, 1) << ", of = \""
            << one_of(random, {"positions", "spectral"})
            << "\", corner = " << one_of(random, {"false", "false", "true"}) << " }";
    }
    out << " }\n";
    return out.str();
}

/// A hold that the formation may spend turning and drifting; most are long enough.
inline std::string random_hold(Random& random) {
    if (random.below(4) != 0) return "hold_s = " + std::to_string(tenth(random, 0.5, 4.0)) + '\n';
    std::ostringstream out;
    out << "hold_s = " << tenth(random, 15.0, 40.0) << "\nmotion = { spin_deg = " << tenth(random, -120, 120)
        << ", drift_m = [" << tenth(random, -5, 5) << ", 0, " << tenth(random, -5, 5) << "] }\n";
    return out.str();
}

/// Sometimes a mast beside the pads, most of whose way up is in the way.
inline std::string random_airspace(Random& random) {
    std::ostringstream out;
    if (random.below(4) == 0)
        out << "[[airspace.obstacle]]\nkind = \"cylinder\"\ncenter_m = [" << tenth(random, -15, 15)
            << ", 0]\nradius_m = " << tenth(random, 0.5, 2.0) << "\nheight_m = " << tenth(random, 10, 30) << '\n';
    return out.str();
}

/// A mission of 2 to 25 drones and 1 to 4 keyframes, by any method; most can be flown.
inline std::string random_mission(std::uint64_t seed) {
    Random random(seed);
    std::ostringstream out;
    const std::size_t drones = 2 + random.below(24);
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(drones))));
    const bool grouped = drones >= 8 && random.below(5) == 0;
    out << "[show]\nname = \"random\"\nseed = " << 1 + seed % 1000 << "\nobjective = \""
        << one_of(random, {"shortest", "together", "smooth"})
        << "\"\norigin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = 420, heading_deg = "
        << tenth(random, 0, 359) << " }\ngeoid_undulation_m = 48.9\n";
    // Every sixth fleet stands too close to leave at once.
    const double spacing_m = random.below(6) == 0 ? tenth(random, 0.4, 1.5) : tenth(random, 2.5, 4.0);
    out << "[fleet]\ndrones = " << drones << "\npads = { rows = " << columns << ", columns = " << columns
        << ", spacing_m = " << spacing_m << ", center_m = [0, -20] }\n";
    if (random.below(2) == 0)
        out << "spares = { where = \"" << one_of(random, {"pads", "wings", "overflow"}) << "\" }\n";
    out << random_limits(random) << random_airspace(random);
    if (grouped) out << random_groups(drones);
    const std::size_t keyframes = 1 + random.below(4);
    const char* const methods[] = {"straight", "straight", "spectral", "flow", "flow", "rigid", "auto"};
    std::string method = methods[random.below(7)];
    for (std::size_t k = 0; k < keyframes; ++k) {
        const std::string next = methods[random.below(7)];
        const bool last = k + 1 == keyframes;
        const bool passed = !last && next == "flow" && random.below(2) == 0;
        const bool spares = !grouped && drones >= 6 && random.below(8) == 0;
        const std::string figure = random_figure(random);
        out << "[[keyframe]]\nname = \"k" << k + 1 << "\"\n" << (spares ? "" : figure);
        out << (passed ? "hold_s = 0\n" : random_hold(random)) << "color = \""
            << one_of(random, {"#ff0000", "#00c4ff", "#fff", "#123456"}) << "\"\n";
        if (!last && !passed && random.below(8) == 0)
            out << "at_s = " << tenth(random, 30, 90) + 60.0 * double(k) << '\n';
        out << random_arrival(random, method, drones, grouped);
        if (spares) out << "[[keyframe.part]]\ndrones = " << drones - 1 - random.below(4) << '\n' << figure;
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
