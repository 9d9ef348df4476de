#pragma once
#include <cmath>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "geo/airspace.hpp"
#include "geo/result.hpp"
#include "geo/units.hpp"
#include "planner/motion/flight_plan.hpp"

/// What refusals must look like, and whether sampling the uncertified plan finds what they tell.
namespace aerogram::property {

/// A line of a mission that cannot be done: file, line, key.
inline bool names_a_mission_line(const std::string& message) {
    static const std::regex form(
        R"([^\n]*:\d+: (keyframe\[\d+\]|fleet|limits|airspace)\S*.* \S+(\n[^\n]*:\d+: \S.* \S+)*)");
    return std::regex_match(message, form);
}

/// Confirms a refusal for infeasibility against the plan that it refused.
class RefusalCheck {
  public:
    RefusalCheck(const planner::FlightPlan& uncertified, const std::string& message) : plan_(uncertified) {
        std::istringstream lines(message);
        std::string line;
        std::getline(lines, line);
        if (line.find(": this show cannot be flown within its limits") == std::string::npos) wrong(line);
        bool obstructed = false, advised = false;
        while (std::getline(lines, line)) {
            const bool advice = line == "  (arrive.method = \"steered\" leads groups around obstacles)";
            obstructed |= line.find(" inside obstacle ") != std::string::npos;
            advised |= advice;
            if (!advice) confirm(line);
        }
        if (obstructed != advised) wrong("advice about obstacles where there are none, or none where there are");
        if (confirmed_ == 0) wrong("nothing is named");
    }

    [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }
    /// Lines that name who, when and what, all found by sampling.
    [[nodiscard]] int confirmed() const { return confirmed_; }

  private:
    void wrong(const std::string& line) { problems_.push_back(line); }
    planner::Kinematics at(const std::string& number, double t_s) const {
        return planner::sample(plan_, DroneId::from_number(std::stoul(number)), t_s).motion;
    }
    void judge(bool true_, const std::string& line) {
        if (true_) {
            ++confirmed_;
        } else {
            wrong("not so: " + line);
        }
    }
    /// What four digits and hundredths of a second leave open.
    double open_m(double told_m, double speed_mps) const {
        return 1e-6 + 5e-4 * std::abs(told_m) + 0.005 * (speed_mps + 0.01 * plan_.limits.acceleration_mps2);
    }

    void confirm(const std::string& line) {
        static const std::regex kSeparation(
            R"(  .+: separation (\S+) m of drones (\d+) and (\d+) at (\S+) s is below (\S+) m \(.*\))");
        static const std::regex kAir(
            R"(  .+: drone (\d+) is (outside the geofence|over the audience|inside obstacle (.+)) by (\S+) m at (\S+) s)");
        static const std::regex kBattery(R"(  the show lasts (\S+) s, longer than endurance_s = (\S+))");
        static const std::regex kHeight(R"(  .+: (altitude \S+ m of drone \d+ at \S+ s is above ceiling_m = \S+|)"
                                        R"(drone \d+ moves sideways at \S+ m at \S+ s, below min_nav.*))");
        std::smatch told;
        if (std::regex_match(line, told, kSeparation)) {
            confirm_separation(told, line);
        } else if (std::regex_match(line, told, kAir)) {
            confirm_air(told, line);
        } else if (std::regex_match(line, told, kBattery)) {
            const double total_s = seconds_from_ms(plan_.duration_ms());
            judge(std::abs(total_s - std::stod(told[1])) <= 1e-5 * total_s && total_s > plan_.endurance_s, line);
        } else if (std::regex_match(line, kHeight)) {
            ++confirmed_;
        } else {
            wrong("no pair or drone, time and cause: " + line);
        }
    }

    void confirm_separation(const std::smatch& told, const std::string& line) {
        const double told_m = std::stod(told[1]), t_s = std::stod(told[4]);
        const planner::Kinematics a = at(told[2], t_s), b = at(told[3], t_s);
        const double found_m = SeparationMetric{plan_.limits.downwash}.distance(a.position_m, b.position_m);
        const double speed_mps = glm::distance(a.velocity_mps, b.velocity_mps);
        judge(std::abs(found_m - told_m) <= open_m(told_m, speed_mps), line);
    }

    void confirm_air(const std::smatch& told, const std::string& line) {
        const double told_m = std::stod(told[4]), t_s = std::stod(told[5]);
        const planner::Kinematics there = at(told[1], t_s);
        const geo::Airspace& air = plan_.airspace;
        std::optional<double> margin_m;
        const auto take = [&](double m) { margin_m = std::min(margin_m.value_or(m), m); };
        if (told[3].matched) {
            for (const auto& obstacle : air.obstacles)
                if (obstacle.name == told[3]) take(geo::clearance(obstacle, there.position_m));
        } else if (told[2] == "outside the geofence") {
            take(geo::signed_distance(air.geofence_m, Vec2(there.position_m)));
        } else {
            for (const auto& polygon : air.audience_m) take(-geo::signed_distance(polygon, Vec2(there.position_m)));
        }
        // The search for the worst is good to a millimetre near zero and to a thousandth.
        const double open = open_m(told_m, glm::length(there.velocity_mps)) + 1e-3 * (2.0 + told_m);
        judge(margin_m && std::abs(*margin_m + told_m) <= open, line);
    }

    const planner::FlightPlan& plan_;
    std::vector<std::string> problems_;
    int confirmed_ = 0;
};

}  // namespace aerogram::property
