#include "export/vehicle/crazyflie.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "export/vehicle/septic_fit.hpp"
#include "export/verify/judge.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHeader =
    "duration,x^0,x^1,x^2,x^3,x^4,x^5,x^6,x^7,y^0,y^1,y^2,y^3,y^4,y^5,y^6,y^7,z^0,z^1,z^2,z^3,z^4,z^5,z^6,z^7,"
    "yaw^0,yaw^1,yaw^2,yaw^3,yaw^4,yaw^5,yaw^6,yaw^7\n";

Result<RecordedShow> read(const std::string& csv) {
    return crazyflie_format().read(std::vector<FileBytes>{{"crazyflie/cf7.csv", csv}});
}
std::string error_of(const std::string& csv) {
    const auto show = read(csv);
    return show ? "none" : show.error().message;
}

/// Evaluated as the vehicle does: single precision, Horner, x front, y left; yaw last.
std::array<float, 4> flown(const std::string& csv, double t_s) {
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    std::array<float, 4> state{};
    for (double left_s = t_s; std::getline(lines, line);) {
        std::istringstream fields(line);
        std::vector<float> c;
        for (std::string field; std::getline(fields, field, ',');) c.push_back(std::stof(field));
        EXPECT_EQ(c.size(), 33U);
        const float t = std::min(static_cast<float>(left_s), c[0]);
        for (std::size_t axis = 0; axis < 4; ++axis) {
            state[axis] = 0.0F;
            for (std::size_t i = 8; i-- > 0;) state[axis] = state[axis] * t + c[1 + 8 * axis + i];
        }
        if (left_s < static_cast<double>(c[0])) break;
        left_s -= static_cast<double>(c[0]);
    }
    return state;
}

TEST(Crazyflie, WritesTheseBytes) {
    const auto files = written_files(crazyflie_format(), fixed::show());
    ASSERT_EQ(files.size(), 4U);
    EXPECT_EQ(files[1].path, "crazyflie/drone-001.csv");
    for (const FileBytes& file : files) EXPECT_TRUE(crazyflie_format().recognises(file.path, file.bytes));
    EXPECT_TRUE(files[1].bytes.starts_with(kHeader));
    expect_golden("crazyflie.txt", unpacked_text(files));
}

/// X is the show's y, Y the show's -x, yaw counter-clockwise from X: by the text alone.
TEST(Crazyflie, AxesAreFrontLeftUp) {
    const planner::FlightPlan plan = fixed::show();
    const auto files = written_files(crazyflie_format(), plan);
    for (std::size_t i = 0; i < 3; ++i) {
        for (double t_s = 0.3; t_s < seconds_from_ms(plan.duration_ms()); t_s += 0.77) {
            const planner::DroneState exact = planner::sample(plan, DroneId(i), t_s);
            const auto state = flown(files[1 + i].bytes, t_s);
            ASSERT_NEAR(static_cast<double>(state[0]), exact.motion.position_m.y, 0.005) << i << ' ' << t_s;
            ASSERT_NEAR(static_cast<double>(state[1]), -exact.motion.position_m.x, 0.005) << i << ' ' << t_s;
            ASSERT_NEAR(static_cast<double>(state[2]), exact.motion.position_m.z, 0.005) << i << ' ' << t_s;
            ASSERT_NEAR(static_cast<double>(state[3]), exact.yaw_rad, 1e-4) << i << ' ' << t_s;
        }
    }
}

TEST(Crazyflie, ReadsBackWithinTheStatedRounding) {
    const planner::FlightPlan plan = fixed::show();
    const RecordedShow show = read_back(crazyflie_format(), written_files(crazyflie_format(), plan));
    ASSERT_EQ(show.drones.size(), 3U);
    ASSERT_TRUE(well_formed(show).ok()) << well_formed(show).error().message;
    EXPECT_EQ(show.show_hash, test_seal().show_hash);
    EXPECT_EQ(show.certified, true);
    EXPECT_EQ(show.origin->heading_deg, plan.origin.heading_deg);
    EXPECT_NEAR(show.duration_s, seconds_from_ms(plan.duration_ms()), 1e-3);
    EXPECT_LT(show.rounding.position_m, 1e-3);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(show.drones[i].name, "drone-00" + std::to_string(i + 1));
        EXPECT_EQ(show.drones[i].home_m, plan.pads_m[i]);
        EXPECT_LE(show.drones[i].pieces.size(), kCrazyfliePieces);
        const double allowed = show.rounding.fit_m + std::sqrt(3.0) * show.rounding.position_m;
        for (Millis t = 0; t <= plan.duration_ms(); t += 7) {
            const double t_s = seconds_from_ms(t);
            const planner::DroneState exact = planner::sample(plan, DroneId(i), t_s);
            ASSERT_LE(glm::length(position_at(show.drones[i], t_s) - exact.motion.position_m), allowed)
                << i << ' ' << t;
            ASSERT_NEAR(yaw_at(show.drones[i].tracks.yaw, t_s), exact.yaw_rad, 0.002) << i << ' ' << t;
        }
    }
}

TEST(Crazyflie, ItsOwnJudgeFindsNothingWrong) {
    const RecordedShow show = read_back(crazyflie_format(), written_files(crazyflie_format(), fixed::show()));
    const auto judgement = judge(show, {}, aerogram::Run{});
    ASSERT_TRUE(judgement.ok()) << judgement.error().message;
    for (const Finding& finding : judgement->findings)
        EXPECT_TRUE(finding.held) << finding.rule << " " << finding.worst << " limit " << finding.limit;
}

/// Property 2, on flights of random acts: dense sampling never finds more than the stated error.
TEST(Crazyflie, Property2_ErrorBoundsADenseSampling) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-5.0, 5.0);
    for (int round = 0; round < 20; ++round) {
        planner::FlightPlan plan = fixed::show();
        for (planner::Act& act : plan.acts) {
            if (auto* lattice = std::get_if<planner::Lattice>(&act.motion))
                for (std::size_t k = 12; k + 12 < lattice->points_m.size(); ++k)
                    lattice->points_m[k] += 0.05 * Vec3(coordinate(random), coordinate(random), coordinate(random));
        }
        const PlannedShow show(plan);
        const Flight flight = show.flight(1);
        const SepticFit fit = septic_fit(flight, plan.tracks[1].yaw, plan.limits);
        FlightCursor cursor(flight);
        double start_s = 0.0, worst_m = 0.0, worst_mps = 0.0;
        for (const SepticPiece& piece : fit.pieces) {
            const Bezier curve = curve_of(piece), speed = derivative(curve);
            const double length_s = static_cast<double>(piece.duration_s);
            for (int k = 0; k <= 200; ++k) {
                const double u = k / 200.0;
                const FlightState exact = cursor.state_at(start_s + u * length_s);
                worst_m = std::max(worst_m, glm::length(value(curve, u) - exact.position_m));
                worst_mps = std::max(worst_mps, glm::length(value(speed, u) / length_s - exact.velocity_mps));
            }
            start_s += length_s;
        }
        EXPECT_NEAR(start_s, seconds_from_ms(plan.duration_ms()), 1e-3);
        EXPECT_LE(worst_m, fit.error.position_m + 1e-6);
        EXPECT_LE(worst_mps, fit.error.speed_mps + 1e-5);
        EXPECT_LE(fit.error.position_m, 0.004);
    }
}

/// Properties 1 and 3.
TEST(Crazyflie, Property1And3_PiecesJoinAndStandsAreOne) {
    const planner::FlightPlan plan = fixed::show();
    const PlannedShow show(plan);
    const SepticFit fit = septic_fit(show.flight(0), {}, plan.limits);
    for (std::size_t k = 0; k + 1 < fit.pieces.size(); ++k) {
        const double a_s = static_cast<double>(fit.pieces[k].duration_s),
                     b_s = static_cast<double>(fit.pieces[k + 1].duration_s);
        const Bezier a = curve_of(fit.pieces[k]), b = curve_of(fit.pieces[k + 1]);
        EXPECT_LT(glm::length(a.back() - b.front()), 1e-4) << k;
        EXPECT_LT(glm::length(derivative(a).back() / a_s - derivative(b).front() / b_s), 1e-3) << k;
        EXPECT_LT(glm::length(derivative(derivative(a)).back() / (a_s * a_s) -
                              derivative(derivative(b)).front() / (b_s * b_s)),
                  0.02)
            << k;
    }
    Flight still{{{0.0, 20.0, 0, 0}, {20.0, 10.0, 1, 1}}, {Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)}};
    EXPECT_EQ(septic_fit(still, {}, plan.limits).pieces.size(), 1U);
    EXPECT_EQ(septic_fit(still, {{5'000, 0.0}, {9'000, 1.0}}, plan.limits).pieces.size(), 3U);
}

TEST(Crazyflie, ReadsWhatOthersWrite) {
    const auto show =
        read("Duration,x^0,anything\r\n2,1,0,0,1,0,0,0,0,2,0,0,0,0,0,0,0,3,0.5,0,0,0,0,0,0,0,0,1,0,0,0,0,0,\r\n");
    ASSERT_TRUE(show.ok()) << show.error().message;
    const RecordedDrone& drone = show->drones[0];
    EXPECT_EQ(drone.name, "cf7");
    EXPECT_EQ(show->duration_s, 2.0);
    // x = 1 + t³, y = 2, z = 3 + t / 2, yaw = t²; show x is -y, show y is x.
    EXPECT_LT(glm::length(position_at(drone, 1.5) - Vec3(-2.0, 1.0 + 3.375, 3.75)), 1e-12);
    EXPECT_NEAR(yaw_at(drone.tracks.yaw, 1.5), 2.25, 1e-3);
}

TEST(Crazyflie, ErrorsNameFileAndLine) {
    const std::string header = kHeader, at = "crazyflie/cf7.csv: line ";
    std::string row = "1";
    for (int k = 0; k < 32; ++k) row += ",0";
    EXPECT_EQ(error_of(""), at + "1: must be the header duration,x^0,...");
    EXPECT_EQ(error_of(header), at + "3: holds no piece");
    EXPECT_EQ(error_of(header + row.substr(0, row.size() - 2)), at + "2: column 33 of 33 = \"\": must be a number");
    EXPECT_EQ(error_of(header + "0" + row.substr(1)), at + "2: column 1: a duration must be at least 0.001 s");
    EXPECT_EQ(error_of(header + "1,nan" + row.substr(3)), at + "2: column 2 of 33 = \"nan\": must be a number");
    EXPECT_EQ(error_of(header + "1,1e9" + row.substr(3)), at + "2: flies beyond 1000 km");
    EXPECT_EQ(error_of(header + "80000" + row.substr(1) + "\n80000" + row.substr(1)),
              at + "3: ends after more than a day");
}

TEST(Crazyflie, DamagedInputIsRefusedNotCrashedOn) {
    const auto files = written_files(crazyflie_format(), fixed::show());
    std::size_t tried = 0, refused = 0;
    for (const std::size_t which : {0U, 1U}) {
        for_damaged(files[which].bytes, 300, [&](const std::string& damaged) {
            std::vector<FileBytes> changed = files;
            changed[which].bytes = damaged;
            ++tried;
            const auto show = crazyflie_format().read(changed);
            if (!show) ++refused;
            if (show)
                EXPECT_TRUE(well_formed(*show).ok()) << well_formed(*show).error().message;
            else
                EXPECT_THAT(show.error().message, HasSubstr("crazyflie/"));
        });
    }
    EXPECT_GE(tried, 800U);
    EXPECT_GE(refused, 300U);
}

TEST(Crazyflie, SaysWhyAShowDoesNotFit) {
    planner::FlightPlan plan = fixed::show();
    EXPECT_EQ(crazyflie_format().unsuited(PlannedShow(plan)), "");
    plan.limits.plane = PlaneLimits{};
    EXPECT_THAT(crazyflie_format().unsuited(PlannedShow(plan)), HasSubstr("planes"));
    plan = fixed::show();
    for (Millis t_ms = 1'000; t_ms < 60'000; t_ms += 1'000)
        plan.tracks[1].yaw.push_back({t_ms, 0.1 * static_cast<double>(t_ms % 3'000)});
    std::ranges::sort(plan.tracks[1].yaw, {}, &YawKey::time_ms);
    EXPECT_THAT(crazyflie_format().unsuited(PlannedShow(plan)),
                ::testing::MatchesRegex("drone-002 needs [67]. pieces of degree 7; 31 fit.*"));
}

}  // namespace
}  // namespace aerogram::exporter
