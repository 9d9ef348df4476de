#include <gtest/gtest.h>

#include "export/report/parts.hpp"
#include "tests/unit/export/report/hand_made.hpp"

namespace aerogram::exporter {
namespace {

using hand_made::Show;
using hand_made::Way;

constexpr Rgb kWhite{1.0, 1.0, 1.0}, kDark{};

/// On and off every half period from a time on.
std::vector<LightKey> blinking(Millis from_ms, Millis half_ms, Millis to_ms, const Rgb& bright = kWhite) {
    std::vector<LightKey> keys;
    bool on = true;
    for (Millis t = from_ms; t < to_ms; t += half_ms, on = !on) keys.push_back({t, on ? bright : kDark, false});
    return keys;
}

Show lamps(std::size_t count) {
    Show show;
    for (std::size_t d = 0; d < count; ++d) show.add(Way({3.0 * static_cast<double>(d), 0.0, 10.0}).stand(10.0));
    return show;
}

TEST(Flashes, OneLampThatBlinksFiveTimesASecond) {
    Show show = lamps(1);
    show.set_tracks(0).lights = blinking(2000, 100, 6000);
    const ReportLights lights = report_lights(show, {});
    EXPECT_EQ(lights.keys, 40U);
    EXPECT_EQ(lights.most_keys_per_s, 10.0);
    EXPECT_EQ(lights.fastest_flash_hz, 5.0);
    EXPECT_EQ(lights.fleet_flash_hz, 5.0);
    EXPECT_NEAR(lights.fleet_flash_s, 2.0, 1e-9);
    EXPECT_TRUE(lights.warning);
}

TEST(Flashes, LampsThatTakeTurnsLeaveTheFleetsLightAlone) {
    Show show = lamps(2);
    show.set_tracks(0).lights = blinking(0, 100, 6000);
    show.set_tracks(1).lights = blinking(100, 100, 6000);
    const ReportLights lights = report_lights(show, {});
    EXPECT_EQ(lights.fastest_flash_hz, 5.0);
    EXPECT_LE(lights.fleet_flash_hz, 0.5);  // both go on once
    EXPECT_FALSE(lights.warning);
}

TEST(Flashes, ThreeASecondIsNoWarningAndMoreIsOne) {
    Show show = lamps(1);
    show.set_tracks(0).lights = blinking(0, 180, 9000);  // 5.6 changes a second
    EXPECT_EQ(report_lights(show, {}).fleet_flash_hz, 3.0);
    EXPECT_FALSE(report_lights(show, {}).warning);
    show.set_tracks(0).lights = blinking(0, 140, 9000);  // 7.1
    EXPECT_TRUE(report_lights(show, {}).warning);
}

TEST(Flashes, SmallChangesAndBrightOnesDoNotCount) {
    EXPECT_EQ(flashes({{0.0, 0.0}, {0.1, 0.09}, {0.2, 0.0}, {0.3, 0.09}}).most_hz, 0.0);
    EXPECT_EQ(flashes({{0.0, 0.85}, {0.1, 1.0}, {0.2, 0.85}, {0.3, 1.0}}).most_hz, 0.0);
    EXPECT_EQ(flashes({{0.0, 0.0}, {0.1, 0.1}, {0.2, 0.0}, {0.3, 0.1}}).most_hz, 1.5);
}

TEST(Flashes, FadesCountAsTheirSum) {
    // Up in four steps of 0.05, down in two fades: two opposing changes.
    EXPECT_EQ(flashes({{0.0, 0.0}, {0.1, 0.05}, {0.2, 0.1}, {0.3, 0.15}, {0.4, 0.2}, {0.5, 0.12}, {0.6, 0.0}}).most_hz,
              1.0);
}

TEST(Flashes, FleetIsTheMeanOfLinearFades) {
    Show show = lamps(2);  // one fades to white and back in 2 s, the other is dark: the mean goes to 0.5
    show.set_tracks(0).lights = {{0, kDark, true}, {1000, kWhite, true}, {2000, kDark, false}};
    const ReportLights lights = report_lights(show, {});
    EXPECT_EQ(lights.fleet_flash_hz, 0.5);  // up after 0.2 s, down after 1.2 s
    show.set_tracks(0).lights = {{0, kDark, true}, {200, kWhite, true}, {400, kDark, false}};
    EXPECT_EQ(report_lights(show, {}).fleet_flash_hz, 1.0);
}

}  // namespace
}  // namespace aerogram::exporter
