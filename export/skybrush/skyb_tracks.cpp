#include "export/skybrush/skyb_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "export/skybrush/skyb_layout.hpp"
#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr std::int64_t kLongestTurnMs = 65'535, kLargestTurn = 32'767, kFullTurn = 3'600;
constexpr std::uint8_t kVehiclesOwnYaw = 1;

std::int64_t tenths(const YawKey& key) {
    return std::llround(-10.0 * degrees(key.yaw_rad));
}

/// A turn by `change` tenths within duration_ms, in as many parts as it takes.
void put_turn(std::string& out, Millis duration_ms, std::int64_t change) {
    const std::int64_t parts = std::max((duration_ms + kLongestTurnMs - 1) / kLongestTurnMs,
                                        (std::abs(change) + kLargestTurn - 1) / kLargestTurn);
    for (std::int64_t part = 0; part < parts; ++part) {
        const auto between = [&](std::int64_t whole) { return whole * (part + 1) / parts - whole * part / parts; };
        put(out, static_cast<std::uint16_t>(between(duration_ms)));
        put(out, static_cast<std::int16_t>(between(change)));
    }
}

}  // namespace

std::string skyb_yaw(std::span<const YawKey> keys) {
    std::string out;
    std::int64_t at = keys.empty() ? 0 : tenths(keys.front());
    put(out, std::uint8_t{0});
    put(out, static_cast<std::int16_t>(at % kFullTurn));
    Millis time_ms = 0;
    for (const YawKey& key : keys) {
        put_turn(out, key.time_ms - time_ms, tenths(key) - at);
        at = tenths(key);
        time_ms = key.time_ms;
    }
    return out;
}

std::vector<YawKey> read_skyb_yaw(ByteCursor& in) {
    std::vector<YawKey> keys;
    const auto flags = in.number<std::uint8_t>();
    std::int64_t at = in.number<std::int16_t>();
    Millis time_ms = 0;
    const auto add = [&] { keys.push_back({time_ms, -radians(static_cast<double>(at) / 10.0)}); };
    add();
    while (in.ok() && in.left() > 0) {
        time_ms += in.number<std::uint16_t>();
        at += in.number<std::int16_t>();
        add();
    }
    if ((flags & kVehiclesOwnYaw) != 0) keys.clear();
    return keys;
}

std::string skyb_events(std::span<const PayloadEvent> events) {
    std::string out;
    for (const PayloadEvent& event : events) {
        put(out, static_cast<std::uint32_t>(event.time_ms));
        put(out, skyb::kPyro);
        put(out, static_cast<std::uint8_t>(event.channel));
        put(out, event.on ? skyb::kEventOn : skyb::kEventOff);
    }
    return out;
}

std::vector<PayloadEvent> read_skyb_events(ByteCursor& in) {
    std::vector<PayloadEvent> events;
    while (in.ok() && in.left() > 0) {
        const Millis time_ms = in.number<std::uint32_t>();
        const auto type = in.number<std::uint8_t>();
        const int channel = in.number<std::uint8_t>();
        const bool on = in.number<std::uint32_t>() != skyb::kEventOff;
        if (in.ok() && type == skyb::kPyro) events.push_back({time_ms, channel, on});
    }
    std::ranges::stable_sort(events, {}, &PayloadEvent::time_ms);
    return events;
}

}  // namespace aerogram::exporter
