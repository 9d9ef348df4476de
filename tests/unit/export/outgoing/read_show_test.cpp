#include "export/outgoing/read_show.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "export/exact/show_hash.hpp"
#include "export/formats.hpp"
#include "export/outgoing/curve_fit.hpp"
#include "export/outgoing/piecewise_fit.hpp"
#include "export/record/stands.hpp"
#include "geo/units.hpp"
#include "tests/unit/export/fixed_show.hpp"
#include "tests/unit/export/written_files.hpp"

namespace aerogram::exporter {
namespace {

using ::testing::HasSubstr;

RecordedShow recorded(std::string_view format) {
    const Format& f = *find_format(format);
    return read_back(f, written_files(f, fixed::show(), {show_hash(fixed::show()), true}));
}

std::unique_ptr<ReadShow> read_show(RecordedShow show, const ReadShowOptions& options = {}) {
    auto read = ReadShow::of(std::move(show), options, aerogram::Run{});
    EXPECT_TRUE(read.ok()) << (read.ok() ? "" : read.error().message);
    return std::move(read).value();
}

std::string refusal(RecordedShow show, const ReadShowOptions& options = {}) {
    const auto read = ReadShow::of(std::move(show), options, aerogram::Run{});
    return read.ok() ? "none" : read.error().message;
}

Vec3 fitted_at(const Fitted& fitted, double t_s) {
    const FittedPiece* piece = &fitted.pieces.front();
    for (const FittedPiece& p : fitted.pieces)
        if (seconds_from_ms(p.start_ms) <= t_s) piece = &p;
    const double u = (t_s - seconds_from_ms(piece->start_ms)) / seconds_from_ms(piece->duration_ms), v = 1.0 - u;
    const auto& c = piece->controls_m;
    return v * v * v * c[0] + 3.0 * u * v * v * c[1] + 3.0 * u * u * v * c[2] + u * u * u * c[3];
}

/// One drone on straight lines between places at times.
RecordedShow polyline(const std::vector<std::pair<double, Vec3>>& corners) {
    RecordedShow show;
    show.format = "made";
    show.rounding.position_m = 0.0005;
    RecordedDrone drone;
    drone.name = "one 7";
    for (std::size_t k = 0; k < corners.size(); ++k) {
        drone.controls_m.push_back(corners[k].second);
        if (k > 0)
            drone.pieces.push_back(
                {corners[k - 1].first, corners[k].first - corners[k - 1].first, static_cast<std::uint32_t>(k - 1), 1});
    }
    show.drones = {drone};
    show.duration_s = corners.back().first;
    return show;
}

void expect_covering(const Fitted& fitted, Millis duration_ms) {
    Millis now_ms = 0;
    for (std::size_t k = 0; k < fitted.pieces.size(); ++k) {
        ASSERT_EQ(fitted.pieces[k].start_ms, now_ms);
        now_ms += fitted.pieces[k].duration_ms;
        if (k == 0) continue;
        const auto &a = fitted.pieces[k - 1], &b = fitted.pieces[k];
        EXPECT_LE(glm::length(a.controls_m[3] - b.controls_m[0]), 1e-6);
        const Vec3 before = 3.0 * (a.controls_m[3] - a.controls_m[2]) / seconds_from_ms(a.duration_ms);
        const Vec3 after = 3.0 * (b.controls_m[1] - b.controls_m[0]) / seconds_from_ms(b.duration_ms);
        EXPECT_LE(glm::length(after - before), kSameSpeed_mps + 1e-9) << "at " << b.start_ms << " ms";
    }
    EXPECT_EQ(now_ms, duration_ms);
}

TEST(ReadShow, ExactFileTellsWhatThePlanTold) {
    const planner::FlightPlan plan = fixed::show();
    const PlannedShow planned(plan);
    const auto read = read_show(recorded("trajectories"));
    const OutgoingFacts &want = planned.facts(), &got = read->facts();
    EXPECT_EQ(got.title, want.title);
    EXPECT_EQ(got.duration_ms, want.duration_ms);
    EXPECT_EQ(got.takeoff_end_ms, want.takeoff_end_ms);
    EXPECT_EQ(got.landing_begin_ms, want.landing_begin_ms);
    EXPECT_EQ(got.cues, want.cues);
    EXPECT_EQ(got.endurance_s, want.endurance_s);
    EXPECT_EQ(got.airspace.geofence_m, want.airspace.geofence_m);
    ASSERT_EQ(got.drones.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(got.drones[i].name, want.drones[i].name);
        EXPECT_EQ(got.drones[i].number, want.drones[i].number);
        EXPECT_EQ(got.drones[i].home_m, want.drones[i].home_m);
        EXPECT_EQ(read->tracks(i), planned.tracks(i));
        const Flight a = planned.flight(i), b = read->flight(i);
        FlightCursor exact(a), again(b);
        for (double t_s = 0.0; t_s < 72.0; t_s += 0.013)
            ASSERT_LE(glm::length(exact.position_at(t_s) - again.position_at(t_s)), 1e-9) << t_s;
    }
    ASSERT_EQ(got.keyframes.size(), 2u);
    EXPECT_EQ(got.keyframes[0].name, "A stands");  // from the cue
    EXPECT_EQ(got.keyframes[1].name, "finale");
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_LE(got.keyframes[k].stands_from_ms, want.keyframes[k].stands_from_ms);
        EXPECT_GE(got.keyframes[k].stands_to_ms, want.keyframes[k].stands_to_ms);
        EXPECT_LE(want.keyframes[k].stands_from_ms - got.keyframes[k].stands_from_ms, 1500);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_LE(glm::length(got.keyframes[k].places_m[i] - want.keyframes[k].places_m[i]), 1e-9);
    }
    EXPECT_TRUE(read->assumed().empty());
}

TEST(ReadShow, EveryTimedFormatFindsTheFormationsWithinItsError) {
    std::size_t formats_seen = 0;
    for (const Format& format : formats()) {
        const planner::FlightPlan plan = fixed::show();
        if (!format.unsuited(PlannedShow(plan)).empty()) continue;
        RecordedShow show = read_back(format, written_files(format, plan, {show_hash(plan), true}));
        if (!show.timed) continue;
        ++formats_seen;
        const double tolerance_m = standing_tolerance_m(show.rounding);
        const auto read = read_show(std::move(show));
        ASSERT_EQ(read->facts().keyframes.size(), 2u) << format.name;
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_LE(glm::length(read->facts().keyframes[0].places_m[i] - fixed::formation_a()[i]), tolerance_m)
                << format.name;
            EXPECT_LE(glm::length(read->facts().keyframes[1].places_m[i] - fixed::formation_b()[i]), tolerance_m)
                << format.name;
        }
    }
    EXPECT_GE(formats_seen, 3u);
}

TEST(ReadShow, CubicsOfHalfASecondPassAsTheyAre) {
    const RecordedShow show = recorded("skyc");
    const auto read = read_show(show);
    for (std::size_t i = 0; i < 3; ++i) {
        const Fitted fitted = read->fitted(i);
        EXPECT_EQ(fitted.error.position_m, 0.0);
        expect_covering(fitted, read->facts().duration_ms);
        for (double t_s = 0.0; t_s < show.duration_s; t_s += 0.01)
            ASSERT_LE(glm::length(fitted_at(fitted, t_s) - position_at(show.drones[i], t_s)), 1e-9) << t_s;
    }
}

TEST(ReadShow, LinesInTimeBecomeCubicsWithinTheBound) {
    const RecordedShow show = recorded("csv");
    const auto read = read_show(show);
    const FitError bound = fit_bound(read->facts().limits);
    for (std::size_t i = 0; i < 3; ++i) {
        const Fitted fitted = read->fitted(i);
        expect_covering(fitted, read->facts().duration_ms);
        EXPECT_TRUE(fitted.error.within(bound))
            << fitted.error.position_m << " " << fitted.error.speed_mps << " " << fitted.error.acceleration_mps2;
        for (const FittedPiece& piece : fitted.pieces) EXPECT_GE(piece.duration_ms, kShortestPieceMs);
        for (double t_s = 0.0; t_s < show.duration_s; t_s += 0.01)
            ASSERT_LE(glm::length(fitted_at(fitted, t_s) - position_at(show.drones[i], t_s)),
                      fitted.error.position_m + 1e-12);
    }
}

TEST(PiecewiseFit, Property3_ErrorBoundsADenseSampling) {
    std::mt19937_64 random(20261122);
    std::uniform_real_distribution<double> step_s(0.05, 2.5), step_m(-4.0, 4.0);
    for (int round = 0; round < 40; ++round) {
        std::vector<std::pair<double, Vec3>> corners{{0.0, {}}};
        while (corners.size() < 30) {
            const bool stands = corners.size() % 5 == 0;
            const Vec3 move = stands ? Vec3{} : Vec3{step_m(random), step_m(random), step_m(random)};
            corners.emplace_back(corners.back().first + step_s(random), corners.back().second + move);
        }
        const auto read = read_show(polyline(corners));
        const Fitted fitted = read->fitted(0);
        expect_covering(fitted, read->facts().duration_ms);
        for (double t_s = 0.0; t_s < corners.back().first; t_s += 0.004) {
            const RecordedShow show = polyline(corners);
            ASSERT_LE(glm::length(fitted_at(fitted, t_s) - position_at(show.drones[0], t_s)),
                      fitted.error.position_m + 1e-9);
        }
        EXPECT_GT(fitted.error.position_m, fit_bound(Limits{}).position_m);  // such a flight cannot pass for smooth
    }
}

TEST(PiecewiseFit, PlacesThatJumpAreMisses) {
    RecordedShow show = polyline({{0.0, {}}, {2.0, {}}, {4.0, {}}});
    show.drones[0].controls_m.push_back({3.0, 0.0, 0.0});
    show.drones[0].pieces[1] = {2.0, 2.0, 3, 0};
    EXPECT_GE(read_show(show)->fitted(0).error.position_m, 3.0);
}

TEST(Stands, AreFoundInTimeOrderAndOnlyAloftBetweenThePads) {
    const Vec3 up{0.0, 0.0, 10.0}, away{8.0, 0.0, 10.0}, far{8.0, 6.0, 12.0};
    const RecordedShow show = polyline({{0.0, {}},
                                        {2.0, {}},
                                        {7.0, up},
                                        {9.0, up},
                                        {12.0, away},
                                        {15.0, away},
                                        {18.0, far},
                                        {18.4, far},
                                        {21.0, away},
                                        {21.75, away},
                                        {25.0, up},
                                        {27.0, up},
                                        {33.0, {}},
                                        {36.0, {}}});
    const auto found = stands(show, aerogram::Run{}).value();
    const std::vector<std::pair<double, bool>> want{{0.0, false}, {7.0, false},  {12.0, true},
                                                    {21.0, true}, {25.0, false}, {33.0, false}};
    ASSERT_EQ(found.size(), want.size());
    for (std::size_t k = 0; k < want.size(); ++k) {
        EXPECT_NEAR(seconds_from_ms(found[k].from_ms), want[k].first, 0.011);
        EXPECT_EQ(found[k].aloft, want[k].second) << k;
    }
    EXPECT_EQ(found[2].places_m, Points{away});
    EXPECT_NEAR(seconds_from_ms(found[2].to_ms), 15.0, 0.011);
}

TEST(Stands, Property1_NobodyMovesWithinOne) {
    for (const char* const format : {"trajectories", "csv", "skyc"}) {
        const RecordedShow show = recorded(format);
        const double tolerance_m = standing_tolerance_m(show.rounding);
        const auto found = stands(show, aerogram::Run{}).value();
        EXPECT_GE(found.size(), 2u);
        for (const Stand& stand : found) {
            for (Millis ms = stand.from_ms; ms <= stand.to_ms; ms += 3)
                for (std::size_t i = 0; i < 3; ++i)
                    ASSERT_LE(glm::length(position_at(show.drones[i], seconds_from_ms(ms)) - stand.places_m[i]),
                              tolerance_m + 1e-3);
        }
    }
}

TEST(Stands, OneDroneThatMovesIsEnough) {
    RecordedShow show = polyline({{0.0, {}}, {10.0, {}}});
    show.drones.push_back(polyline({{0.0, {5.0, 0.0, 0.0}}, {10.0, {9.0, 0.0, 0.0}}}).drones[0]);
    EXPECT_TRUE(stands(show, aerogram::Run{}).value().empty());
}

TEST(ReadShow, NumbersAreThoseInTheNamesWhereEachHasItsOwn) {
    RecordedShow show = recorded("trajectories");
    show.drones[0].name = "swarm2 unit 40", show.drones[1].name = "u-7", show.drones[2].name = "u012b";
    EXPECT_EQ(numbers_of(show.drones), (std::vector<std::size_t>{40, 7, 12}));
    show.drones[2].name = "seven 7";
    EXPECT_EQ(numbers_of(show.drones), (std::vector<std::size_t>{1, 2, 3}));
    show.drones[2].name = "none";
    EXPECT_EQ(numbers_of(show.drones), (std::vector<std::size_t>{1, 2, 3}));
}

TEST(ReadShow, NamesThatCannotNameFilesGiveWay) {
    for (const char* const name : {"../x", "a/b", "", "DRONE-002", "tab\t"}) {
        RecordedShow show = recorded("trajectories");
        show.drones[0].name = name;
        const auto read = read_show(show);
        EXPECT_EQ(read->facts().drones[0].name, "drone-001") << name;
        EXPECT_FALSE(read->assumed().empty());
    }
}

TEST(ReadShow, SomeDronesKeepTheirNumbersAndFlights) {
    const RecordedShow show = recorded("trajectories");
    const auto read = read_show(show, {{1, 3}, {}, {}});
    ASSERT_EQ(read->drones(), 2u);
    EXPECT_EQ(read->facts().fleet, 3u);
    EXPECT_EQ(read->facts().drones[1].name, "drone-003");
    EXPECT_EQ(read->facts().drones[1].number, 3u);
    EXPECT_EQ(read->facts().keyframes[0].places_m.size(), 2u);
    EXPECT_EQ(read->tracks(1), show.drones[2].tracks);
    EXPECT_THAT(refusal(show, {{4}, {}, {}}), HasSubstr("has no drone 4"));
}

TEST(ReadShow, TimesBefore0AreCutOffAndEndsHeld) {
    RecordedShow show = polyline({{-2.0, {}}, {2.0, {4.0, 0.0, 0.0}}, {3.0, {4.0, 0.0, 1.0}}});
    show.duration_s = 5.0;
    const auto read = read_show(show);
    const Flight flight = read->flight(0);
    EXPECT_EQ(flight.pieces.front().start_s, 0.0);
    FlightCursor cursor(flight);
    EXPECT_NEAR(cursor.position_at(0.0).x, 2.0, 1e-12);
    EXPECT_NEAR(cursor.position_at(1.0).x, 3.0, 1e-12);
    EXPECT_NEAR(cursor.position_at(5.0).z, 1.0, 1e-12);
    EXPECT_EQ(read->facts().duration_ms, 5000);
}

TEST(ReadShow, WaypointsWithoutTimesAndEmptyShowsAreRefused) {
    EXPECT_THAT(refusal(recorded("qgc")), HasSubstr("says where, not when"));
    EXPECT_THAT(refusal(RecordedShow{}), HasSubstr("holds no drones"));
}

}  // namespace
}  // namespace aerogram::exporter
