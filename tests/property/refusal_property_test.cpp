// Missions that cannot be flown: the refusal names two drones, a time and a distance, and sampling the uncertified plan
// finds just that.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "brute_force.hpp"
#include "fleet_sampling.hpp"
#include "random_missions.hpp"
#include "random_shows.hpp"
#include "refusals.hpp"

namespace aerogram::property {
namespace {

using planner::FlightPlan;
using planner::Mission;

struct Witness {
    double distance_m = 0.0, time_s = 0.0;
    std::size_t first = 0, second = 0;
};

std::vector<Witness> witnesses(const std::string& message) {
    static const std::regex form(R"(separation (\S+) m of drones (\d+) and (\d+) at (\S+) s is below)");
    std::vector<Witness> found;
    for (std::sregex_iterator it(message.begin(), message.end(), form), end; it != end; ++it)
        found.push_back({std::stod((*it)[1]), std::stod((*it)[4]), std::stoul((*it)[2]), std::stoul((*it)[3])});
    return found;
}

/// What a message's four digits and hundredths of a second leave open, at the pair's speed there.
double open_m(const FlightPlan& plan, const Witness& w) {
    const auto velocity = [&](std::size_t number) {
        return planner::sample(plan, DroneId::from_number(number), w.time_s).motion.velocity_mps;
    };
    const double speed_mps = glm::distance(velocity(w.first), velocity(w.second));
    return 1e-9 + 5e-4 * w.distance_m + 0.005 * (speed_mps + 0.005 * 2.0 * plan.limits.acceleration_mps2);
}

void expect_true_witnesses(const Mission& mission, const Error& refusal) {
    const auto uncertified = planner::plan(mission, {.best_effort = true}, aerogram::Run{});
    ASSERT_TRUE(uncertified) << uncertified.error().message;
    EXPECT_FALSE(uncertified->certificate.certified());
    const auto told = witnesses(refusal.message);
    ASSERT_FALSE(told.empty()) << refusal.message;
    for (const Witness& w : told) {
        EXPECT_LT(w.distance_m, planned_separation_m(mission.limits));
        EXPECT_NEAR(distance_at(*uncertified, w.first - 1, w.second - 1, w.time_s), w.distance_m,
                    open_m(*uncertified, w))
            << refusal.message;
    }
    for (std::size_t a = 0; a < uncertified->acts.size(); ++a) {
        const planner::ActCertificate& act = uncertified->certificate.acts[a];
        if (act.certified()) continue;
        ASSERT_TRUE(act.separation.closest);
        const auto& e = *act.separation.closest;
        const double t_s = seconds_from_ms(act.start_ms) + e.time_s;
        EXPECT_NEAR(distance_at(*uncertified, e.first.value, e.second.value, t_s), e.distance_m, 1e-6) << act.name;
        EXPECT_LE(act.separation.lower_bound_m, e.distance_m);
    }
}

std::string head(std::size_t drones, double spacing_m) {
    std::ostringstream out;
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(drones))));
    out << "[show]\nname = \"refused\"\norigin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = 420 }\n"
        << "[fleet]\ndrones = " << drones << "\npads = { rows = " << side << ", columns = " << side
        << ", spacing_m = " << spacing_m << " }\n";
    return out.str();
}

/// A formation turned by about half a turn, everybody keeping the own slot, nobody separating them.
TEST(RefusalProperty, CrossingFlightsAreNamedWithPairTimeAndDistance) {
    int refused = 0;
    for (int seed = 1; seed <= cases(30); ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        std::ostringstream text;
        const char* shape = one_of(random, {"shape = \"grid\"", "shape = \"circle\"", "text = \"H\"", "text = \"8\""});
        text << head(2 + random.below(15), 2.5) << "[[keyframe]]\nname = \"a\"\n"
             << shape << "\ncenter_m = [0, 0, 50]\n[[keyframe]]\nname = \"b\"\n"
             << shape << "\ncenter_m = [" << tenth(random, -9, 9) << ", 4, 55]\nrotate_deg = ["
             << tenth(random, -10, 10) << ", " << tenth(random, 140, 220)
             << ", 0]\narrive = { assign = \"keep\", separation = \"none\" }\n";
        SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text.str());
        const Mission mission = planner::parse_mission(text.str(), "refused.toml").value();
        const auto plan = planner::plan(mission, {}, aerogram::Run{});
        if (plan) continue;
        ++refused;
        EXPECT_EQ(plan.error().code, ErrorCode::infeasible);
        expect_true_witnesses(mission, plan.error());
    }
    EXPECT_GE(2 * refused, cases(30));
}

/// Pads closer than the separation are left and come back to in layers: whoever has left the ground is clear of all
/// others that have, at every instant of every wave.
TEST(RefusalProperty, PadsTighterThanTheSeparationAreLeftInLayers) {
    for (int seed = 1; seed <= cases(30) / 3; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const std::string text =
            head(4 + random.below(20), tenth(random, 0.9, 2.4)) +
            "[limits]\nmin_separation_m = 2.5\ndownwash = " + std::to_string(tenth(random, 1.0, 2.0)) +
            "\n[[keyframe]]\nname = \"a\"\nshape = \"grid\"\ncenter_m = [0, 0, 60]\n";
        SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text);
        const auto plan = plan_text(text);
        ASSERT_TRUE(plan) << plan.error().message;
        const Shortfall found = BruteForce(*plan, 1e4).check();
        EXPECT_THAT(found.lies, ::testing::IsEmpty());
        int waves = 0;
        for (const planner::Act& act : plan->acts) {
            if (act.role != planner::ActRole::takeoff) continue;
            ++waves;
            EXPECT_EQ(act.name.rfind("take-off " + std::to_string(waves) + " of ", 0), 0U) << act.name;
        }
        EXPECT_GT(waves, 1);
    }
}

TEST(RefusalProperty, PadsOnTopOfEachOtherAreNamed) {
    const std::string text = head(9, 0.1) + "[[keyframe]]\nname = \"a\"\nshape = \"grid\"\ncenter_m = [0, 0, 50]\n";
    const auto read = planner::parse_mission(text, "refused.toml");
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find("fleet.pads"), std::string::npos) << read.error().message;
}

/// Shows that may ask for anything: what is refused names a mission line, or who, when and what, and the plan that was
/// refused does just that.
TEST(RefusalProperty, WildShowsAreRefusedByWhatSamplingFinds) {
    int refused = 0, lines = 0;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(30)) * 5; ++seed) {
        const RandomShow show = random_show(seed, 60);
        if (show.tame) continue;
        SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + show.text);
        const auto plan = plan_text(show.text);
        if (plan) continue;
        if (plan.error().code == ErrorCode::invalid_input) {
            ++lines;
            EXPECT_TRUE(names_a_mission_line(plan.error().message)) << plan.error().message;
            continue;
        }
        ++refused;
        const auto uncertified = plan_text(show.text, 1, true);
        ASSERT_TRUE(uncertified) << uncertified.error().message;
        EXPECT_THAT(RefusalCheck(*uncertified, plan.error().message).problems(), ::testing::IsEmpty());
    }
    EXPECT_GT(refused, 0);
    EXPECT_GT(lines, 0);
}

/// Nobody keeps the drones from a mast between them and their places: who flies into it, when and how deep is told.
TEST(RefusalProperty, FlightsThroughAMastAreNamedWithDroneTimeAndDepth) {
    int through = 0;
    for (int seed = 1; seed <= cases(30); ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        std::ostringstream text;
        text << head(2 + random.below(15), 2.5) << "[[airspace.obstacle]]\nname = \"the mast\"\nkind = \"cylinder\"\n"
             << "center_m = [0, " << tenth(random, 15, 25) << "]\nradius_m = " << tenth(random, 2, 6)
             << "\nheight_m = 60\n[[keyframe]]\nname = \"a\"\nshape = \"grid\"\ncenter_m = [" << tenth(random, -9, 9)
             << ", 45, 40]\narrive = { separation = \"none\" }\n";
        SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text.str());
        const auto plan = plan_text(text.str());
        if (plan) continue;
        ASSERT_EQ(plan.error().code, ErrorCode::infeasible) << plan.error().message;
        through += plan.error().message.find("is inside obstacle the mast by") != std::string::npos;
        const auto uncertified = plan_text(text.str(), 1, true);
        ASSERT_TRUE(uncertified) << uncertified.error().message;
        EXPECT_THAT(RefusalCheck(*uncertified, plan.error().message).problems(), ::testing::IsEmpty());
    }
    EXPECT_GT(2 * through, cases(30));
}

}  // namespace
}  // namespace aerogram::property
